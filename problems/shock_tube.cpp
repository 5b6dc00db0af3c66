// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: Sod's shock tube against the exact solution, three resolutions; 10 s
//
// Sod's shock tube: a gas at rest, rho = 1, P = 1 on the left of a diaphragm, rho = 0.125, P = 0.1 on its right.
//
//     |ooooooooooooooooo|. . . . . . . . .|     At t = 0 the diaphragm is gone. A fan runs to the left, a
//       rho = 1, P = 1     0.125, 0.1           contact and a shock to the right; until they meet the ends
//    -1/2               0                1/2    the solution depends on x/t alone and is known.
//
// All particles have the same distance at the start, those on the right an eighth of the mass. Von Neumann's
// artificial viscosity turns the energy that a shock takes into heat. The ends are mirrors (--left, --right); what
// they give is the pressure of the gas before them, as long as nothing has arrived.
#include "shock_tube/riemann.hpp"
#include <spam/core/error.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/picture/draw.hpp>
#include <spam/problem/nearest_state.hpp>
#include <spam/problem/sides.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/spam.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace shock_tube {

using namespace spam;

namespace {

constexpr double known_until =
    0.25;  // the fan meets the left end at 0.42, the shock the right one at 0.28

struct Parameters {
    const Sides* sides = nullptr;
    int cells = 800;
    double gamma = 1.4;
    bool single = false;
    Scheme scheme{
        .density = Density::continuity, .viscosity = 1.0, .kernel = Kernel::w4, .range = 10.0};
};

struct Tube {
    int cells;
    RiemannProblem exact;
    std::shared_ptr<FluidModel<1>> model;
    std::vector<double> y0{};
    std::string label{};
};

Tube make_tube(const Parameters& p, int cells, bool only_described) {
    const GasState left{1.0, 0.0, 1.0}, right{0.125, 0.0, 0.1};
    const double spacing = 1.0 / cells;
    const auto box = p.sides->box<1>(Point<1>(-0.5), Point<1>(0.5));
    Points<1> x(1, cells);
    for (int k = 0; k < cells; ++k) x(0, k) = spacing * (k + 0.5) - 0.5;
    auto particles = make_particles<1>(x, spacing, spacing, box);
    Scheme scheme = p.scheme;
    scheme.range *= spacing;
    for (Eigen::Index i = 0; i < cells; ++i)
        if (particles.reference_position(0, i) > 0.0)
            particles.mass[static_cast<std::size_t>(i)] *= right.rho;
    Tube tube{cells, RiemannProblem(left, right, p.gamma),
              std::make_shared<FluidModel<1>>(std::move(particles), Fluid{GammaGas{p.gamma}},
                                              scheme, box)};
    if (only_described) return tube;
    const Points<1>& at = tube.model->particles().reference_position;
    tube.y0 = tube.model->state(at, Points<1>::Zero(1, cells), 1.0);
    const State<1> state(tube.model->layout(), tube.y0);
    // Of the same pressures on both sides with the densities as they are summed.
    const auto rho = tube.model->density(tube.y0);
    for (Eigen::Index i = 0; i < cells; ++i) {
        const double P = at(0, i) < 0.0 ? left.P : right.P;
        state.energy()(0, i) = P / ((p.gamma - 1.0) * rho[static_cast<std::size_t>(i)]);
    }
    tube.model->layout().set_scale(Field::velocity, 1.0);
    return tube;
}

/// Mean |rho - exact| over the particles.
double density_error(const Tube& tube, std::span<const double> y, double t) {
    const auto rho = tube.model->density(y);
    const auto x = ConstState<1>(tube.model->layout(), y).position();
    double sum = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        sum += std::abs(rho[static_cast<std::size_t>(i)] - tube.exact.at(x(0, i), t).rho);
    return sum / static_cast<double>(x.cols());
}

/// Median over the particles in the middle half of a plateau, which lies between two speeds.
template <class Value>
double plateau(const Tube& tube, std::span<const double> y, double t, double from, double to,
               const Value& value) {
    const auto x = ConstState<1>(tube.model->layout(), y).position();
    std::vector<double> all;
    const double width = to - from;
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        if (const double s = x(0, i) / t; s > from + 0.25 * width && s < to - 0.25 * width)
            all.push_back(value(i));
    if (all.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2),
                     all.end());
    return all[all.size() / 2];
}

/// Mean pressure on a wall at an end: its impulse by the time.
void report_ends(Session& session, const Parameters& p, const Tube& tube, const RunRecord& run,
                 const std::string& prefix) {
    const double t = run.statistics.t_end;
    if (!run.complete || !(t > 0.0)) return;
    for (const bool upper : {false, true}) {
        const Wall<1>& wall = tube.model->box().wall(0, upper);
        if (wall.open()) continue;
        const double P = upper ? 0.1 : 1.0;
        const std::string side = Sides::name(0, upper);
        session.claim({prefix + "pressure_on_" + side,
                       std::abs(run.history.last("impulse_" + side + "_x")) / t, P, 0.02 * P,
                       "of the gas at rest before that end"},
                      wall.kind == WallKind::mirror && t <= known_until &&
                          session.when_default({"kernel", "range", "viscosity", "density"}) &&
                          p.gamma <= 1.4 && tube.cells >= 800);
    }
}

void report(Session& session, const Parameters& p, const Tube& tube, const RunRecord& run) {
    const std::string prefix = tube.label.empty() ? "" : tube.label + "_";
    const double t = run.statistics.t_end;
    const bool known = session.when_default({"gamma", "kernel", "range", "viscosity", "density"}) &&
                       run.complete && t > 0.15 && t <= known_until && tube.cells >= 800;
    session.measure(prefix + "density_error", density_error(tube, run.y, t), "mean |rho - exact|");
    const ConstState<1> state(tube.model->layout(), run.y);
    const auto rho = tube.model->density(run.y);
    const auto P = tube.model->pressure(run.y);
    const double u = tube.exact.velocity();
    const GasState ahead{0.125, 0.0, 0.1};
    const double behind = std::sqrt(p.gamma * tube.exact.pressure() / tube.exact.density(false));
    const double shock = tube.exact.density(true) * u / (tube.exact.density(true) - ahead.rho);
    const auto claim = [&](const char* name, double from, double to, double exact, auto value) {
        const double found = plateau(tube, run.y, t, from, to, value);
        if (!std::isfinite(found)) return;  // so early that no particle is on it
        session.claim(
            {prefix + name, found, exact, 0.02 * exact, "the exact solution of Riemann's problem"},
            known);
    };
    const auto of = [](const std::vector<double>& values) {
        return [&values](Eigen::Index i) { return values[static_cast<std::size_t>(i)]; };
    };
    claim("density_behind_fan", u - behind, u, tube.exact.density(false), of(rho));
    claim("density_behind_shock", u, shock, tube.exact.density(true), of(rho));
    claim("pressure", u - behind, shock, tube.exact.pressure(), of(P));
    claim("velocity", u - behind, shock, u, [&](Eigen::Index i) { return state.velocity()(0, i); });
    report_ends(session, p, tube, run, prefix);
    session.check_promises(run, prefix);
}

/// How the error falls with the number of particles.
void compare(Session& session, const std::vector<Tube>& tubes, const std::vector<RunRecord>& runs) {
    LogLogCurve curve{.x = {}, .y = {}};
    for (std::size_t k = 0; k < runs.size(); ++k) {
        curve.x.push_back(tubes[k].cells);
        curve.y.push_back(density_error(tubes[k], runs[k].y, runs[k].statistics.t_end));
        if (k > 0)
            session.measure(fmt::format("order_{}_to_{}", tubes[k - 1].label, tubes[k].label),
                            std::log2(curve.y[k - 1] / curve.y[k]), "of the density's error");
    }
    const double order = std::log2(curve.y.front() / curve.y.back()) / 2.0;
    session.claim(
        {"order", order, 1.0, 0.2, "shocks and contacts are a few particles wide"},
        session.when_default({"cells", "gamma", "kernel", "range", "viscosity", "density"}) &&
            runs.back().statistics.t_end > 0.15 && runs.back().statistics.t_end <= known_until);
    if (!session.plots()) return;
    session.note_drawn(draw_log_log(session.plots_folder(), "error",
                                    {.title = "Sod's shock tube: mean error of the density",
                                     .panels = {{.title = "",
                                                 .x_label = "particles",
                                                 .y_label = "mean |ρ - exact|",
                                                 .curves = {curve},
                                                 .words = fmt::format("order {:.2f}", order)}},
                                     .columns = 1,
                                     .key = {"smooth particles"},
                                     .note = ""}));
}

void draw(Session& session, const Parameters& p, const std::vector<Tube>& tubes,
          const std::vector<RunRecord>& runs) {
    const Tube& last = tubes[runs.size() - 1];
    const double t = runs.back().statistics.t_end;
    std::vector<CurvePanel> panels;
    for (const char* what : {"density", "velocity", "pressure"}) {
        CurvePanel panel{"", "x", what, false, {}};
        const int which = static_cast<int>(panels.size());
        Curve exact{.title = which == 0 ? "exact" : "", .x = {}, .y = {}};
        for (int k = -500; k <= 500; ++k) {
            const GasState s = last.exact.at(0.001 * k, t);
            exact.x.push_back(0.001 * k);
            exact.y.push_back(which == 0 ? s.rho : which == 1 ? s.u : s.P);
        }
        panel.curves.push_back(exact);
        for (std::size_t r = 0; r < runs.size(); ++r) {
            const ConstState<1> state(tubes[r].model->layout(), runs[r].y);
            const auto values = which == 0 ? tubes[r].model->density(runs[r].y)
                                : which == 2
                                    ? tubes[r].model->pressure(runs[r].y)
                                    : std::vector<double>(state.velocity().data(),
                                                          state.velocity().data() + tubes[r].cells);
            Curve points{.title = which == 0 ? fmt::format("{} particles", tubes[r].cells) : "",
                         .x = {state.position().data(), state.position().data() + tubes[r].cells},
                         .y = values,
                         .mark = Mark::points,
                         .style = static_cast<int>(r) + 2};
            panel.curves.push_back(points);
        }
        panels.push_back(panel);
    }
    session.note_drawn(
        draw_curves(session.plots_folder(), "profiles",
                    fmt::format("Sod's shock tube at t = {:g}, γ = {:g}", t, p.gamma), panels));
}

}  // namespace
}  // namespace shock_tube

int main(int argc, char** argv) {
    using namespace shock_tube;
    Problem problem("shock_tube", "Sod's shock tube against the exact solution", 0.1,
                    "0.1 by the number of particles of the largest size");
    problem.units(
        reduced_units("the length of the tube, and the density and pressure on its left"));
    Parameters p;
    auto& options = problem.options();
    options.integer("cells", p.cells, "particles along the tube", between(20, 20000));
    options.number("gamma", p.gamma, "ratio of the heat capacities", between(1.05, 5.0));
    options.number("viscosity", p.scheme.viscosity, "coefficient alpha of the artificial viscosity",
                   non_negative());
    options.choice<Density>("density", p.scheme.density, {Density::summed, Density::continuity},
                            "density as a sum over neighbours, or by the continuity equation");
    const SideOption end(
        "mirror", {{SideKind::periodic,
                    "would let the two gases meet at the ends as well, without a diaphragm"}});
    const Sides sides(options, {end, end}, {.temperatures = false});
    p.sides = &sides;
    options.choice<Kernel>("kernel", p.scheme.kernel, all_kernels(), "weight function");
    options.number("range", p.scheme.range, "range h of the weight function, in spacings",
                   between(1.2, 20.0));
    options.flag(
        "single", p.single,
        "compute this number of particles only, not half as many and twice as many as well");
    return problem.main(argc, argv, [&](Session& session) {
        if (session.common().smoke && !session.given("cells")) p.cells = 100;
        std::vector<int> sizes{p.cells};
        if (!p.single) sizes = {p.cells / 2, p.cells, 2 * p.cells};
        std::vector<Tube> tubes;
        for (const int cells : sizes) {
            tubes.push_back(make_tube(p, cells, session.common().dry_run));
            if (sizes.size() > 1) tubes.back().label = fmt::format("{}", cells);
        }
        session.prefer_step(0.1 / sizes.back());
        std::vector<Case<1>> cases;
        for (auto& tube : tubes) {
            Plan<1> plan;
            plan.t_end = session.common().t_end.value_or(session.common().smoke ? 0.02 : 0.2);
            cases.push_back({tube.model, tube.y0, std::move(plan), tube.label});
        }
        const auto runs = session.run_all(std::move(cases));
        for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, tubes[k], runs[k]);
        if (runs.size() == 3) compare(session, tubes, runs);
        if (session.plots() && !runs.empty()) draw(session, p, tubes, runs);
    });
}
