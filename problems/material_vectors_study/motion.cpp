// SPDX-License-Identifier: GPL-3.0-or-later
#include "../cantilever/beam.hpp"
#include "trials.hpp"
#include <spam/material/flowing_solid.hpp>
#include <spam/neighbors/connected_parts.hpp>
#include <spam/problem/run_in_memory.hpp>

namespace material_vectors_study {
namespace {

using std::numbers::pi;

const IntegratorOptions leapfrog{.method = "leapfrog", .dt = 0.3};
const IntegratorOptions of_shot{.method = "rk4", .dt = 0.1};

/// Nothing where it was interrupted.
std::optional<RunRecord> finished(Case<2> one, const IntegratorOptions& integrator) {
    RunRecord run = run_in_memory<2>(std::move(one), integrator);
    if (run.statistics.stopped.starts_with("signal")) return {};
    return run;
}

/// How far the bar is bent: its displacement along the first mode (f, -y f').
Column<2> deflection(const cantilever::Beam& beam) {
    return {"deflection", [beam](const Model<2>& model, std::span<const double> y) {
                const auto x = ConstState<2>(model.layout(), y).position();
                const Points<2>& X = model.particles().reference_position;
                double sum = 0.0;
                for (Eigen::Index i = 0; i < X.cols(); ++i) {
                    const Point<2> moved = x.col(i) - X.col(i);
                    sum += moved.y() * beam.free_shape(X(0, i)) -
                           moved.x() * X(1, i) * beam.free_slope(X(0, i));
                }
                return sum / static_cast<double>(X.cols());
            }};
}

/// Of a body that turns from rest in shape and stress, until it has lost its shape.
std::optional<History> history_of(const Points<2>& sites, double omega, double t_end,
                                  const MaterialVectorScheme& scheme) {
    auto model =
        std::make_shared<MaterialVectorModel<2>>(make_particles<2>(sites, 1.0), solid(), scheme);
    auto y0 = initial_state<2>(*model, rho, solid().eta, rigid_rotation(omega));
    Plan<2> plan;
    plan.t_end = t_end;
    plan.output_every = 3.0;
    plan.snapshot_every = plan.t_end;
    plan.observe({.columns = {closest_pair_column<2>(), shape_error_column<2>()},
                  .enough = [](const History& h) { return !survival(h).whole; }});
    const auto run = finished({std::move(model), std::move(y0), std::move(plan)}, leapfrog);
    if (!run) return {};
    return run->history;
}

}  // namespace

void refuse_endless(const Sizes& sizes) {
    spam::refuse_endless(leapfrog, sizes.turning_time());
    spam::refuse_endless(of_shot, sizes.shot_time);
}

std::optional<Turned> turn_hexagon(const MaterialVectorScheme& scheme, const Sizes& sizes) {
    const auto h = history_of(triangular_hexagon(sizes.hexagon), Sizes::speed / sizes.hexagon,
                              sizes.turning_time(), scheme);
    if (!h) return {};
    return Turned{h->smallest("closest_pair"), h->largest("shape_error"),
                  h->relative_drift("energy")};
}

std::optional<double> disorder_error(const MaterialVectorScheme& scheme, const Sizes& sizes) {
    const double omega = 0.1 / sizes.hexagon, t_end = 10.0 * sizes.hexagon;
    const Points<2> lattice = triangular_hexagon(sizes.hexagon);
    Points<2> displaced = lattice;
    displace(displaced, 0.2, 5);
    const auto ordered = history_of(lattice, omega, t_end, scheme);
    if (!ordered) return {};
    const auto disordered = history_of(displaced, omega, t_end, scheme);
    if (!disordered) return {};
    return disordered->largest("shape_error") / ordered->largest("shape_error") - 1.0;
}

std::optional<double> beam_error(const MaterialVectorScheme& scheme, int rows) {
    const PolynomialSolid matter = solid();
    const double nu = matter.lambda / (2.0 * (matter.lambda + matter.eta));
    const int columns = 10 * rows;
    const cantilever::Beam beam{static_cast<double>(columns), rows * std::sqrt(0.75),
                                2.0 * matter.eta * (1.0 + nu), nu, rho};
    auto model = std::make_shared<MaterialVectorModel<2>>(
        make_particles<2>(centred<2>(triangular_block(columns, rows)), 1.0), matter, scheme);
    constexpr double speed = 5e-4;
    auto y0 = initial_state<2>(*model, rho, matter.eta, [&](const Point<2>& X) {
        return Point<2>(-speed * X.y() * beam.free_slope(X.x()), speed * beam.free_shape(X.x()));
    });
    Plan<2> plan;
    plan.t_end = 2.5 * beam.free_period();
    plan.output_every = beam.free_period() / 200.0;
    plan.snapshot_every = plan.t_end;
    const auto zeros = [](const History& h) {  // begins with one
        auto t = h.column("t"), bent = h.column("deflection");
        std::vector<double> at;
        for (std::size_t k = 2; k < bent.size(); ++k)
            if (bent[k - 1] * bent[k] < 0.0)
                at.push_back(t[k] - (t[k] - t[k - 1]) * bent[k] / (bent[k] - bent[k - 1]));
        return at;
    };
    plan.observe({.columns = {deflection(beam)},
                  .enough = [zeros](const History& h) { return zeros(h).size() >= 2; }});
    const auto run = finished({std::move(model), std::move(y0), std::move(plan)}, leapfrog);
    if (!run) return {};
    const auto at = zeros(run->history);
    return at.size() < 2 ? std::nan("") : at[1] / beam.free_period() - 1.0;
}

std::optional<Shot> shoot(const MaterialVectorScheme& scheme, const Sizes& sizes) {
    const int n = std::max(2, sizes.bar_rows / 2 + 1);
    const double height = 0.5 * sizes.bar_rows * std::sqrt(0.75), radius = n * std::sqrt(0.75);
    Points<2> ball = triangular_hexagon(n);
    ball.row(1).array() -= height + radius + 1.5;
    auto model = std::make_shared<ParticleModel<2>>(
        joined<2>({make_particles<2>(
                       centred<2>(triangular_block(15 * sizes.bar_rows / 2, sizes.bar_rows)), 1.0),
                   make_particles<2>(ball, 1.0)}));
    const auto& law =
        model->add_term<MaterialVectors<2>>(FlowingSolid{solid(), 0.05, 0.05}, scheme);
    model->add_term<Contact<2>>(ContactScheme{1.0, 1.0});
    auto y0 = initial_state<2>(*model, rho, solid().eta, [height](const Point<2>& x) {
        return Point<2>(0.0, x.y() < -height - 0.5 ? 1.0 : 0.0);
    });
    Plan<2> plan;
    plan.t_end = sizes.shot_time;
    plan.output_every = 2.0;
    plan.snapshot_every = plan.t_end;
    plan.observe({.columns = {closest_pair_column<2>()}});
    const Model<2>& last = *model;
    const auto run = finished({model, std::move(y0), std::move(plan)}, of_shot);
    if (!run) return {};
    const History& h = run->history;
    const auto body =
        connected_parts<2>(ConstState<2>(last.layout(), run->y).position(), 1.6, last.box());
    return Shot{h.smallest("closest_pair"), h.relative_drift("energy"),
                law.heat() / h.first("energy"), 1 + *std::max_element(body.begin(), body.end())};
}

}  // namespace material_vectors_study
