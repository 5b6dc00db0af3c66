// SPDX-License-Identifier: GPL-3.0-or-later
#include "body.hpp"

#include <spam/core/exact_sum.hpp>
#include <spam/core/rigid_motion.hpp>

#include <Eigen/Geometry>

#include <numeric>

namespace rotating_body {
namespace {

Points<3> lattice_of(const Parameters& p) {
    const int n = p.size;
    const std::array<int, 3> edges = p.block() ? std::array{n + 2, n, n - 2} : std::array{n, n, n};
    const Points<3> all = centred<3>(square_lattice<3>(edges));
    return p.shape == Shape::ball ? ball_of(all, 0.5 * n) : all;
}

}  // namespace

Body make_body(const Parameters& p, Formulation formulation, double speed, const Scheme& scheme) {
    Body body;
    // lattice: simple cubic, density 1
    auto particles = one_body(make_particles<3>(lattice_of(p), 1.0));
    body.reference = particles.reference_position;
    for (int a = 0; a < 3; ++a)
        body.inertia[a] = exact_sum(particles.size(), [&](std::size_t i) {
            const Point<3> x = body.reference.col(static_cast<Eigen::Index>(i));
            return x.squaredNorm() - x[a] * x[a];
        });
    // rotation: a block about its middle axis, or nearly so; others about an axis that the lattice does not know
    const Point<3> axis =
        p.block() ? Point<3>(0.05, 1.0, 0.0) : Point<3>(1.0, 2.0, 3.0).normalized();
    body.speed = speed;
    body.omega = speed / body.reference.colwise().norm().maxCoeff() * axis;
    // material and formulation
    const auto solid = ElasticSolid::triangular_lattice();
    SolidChoice choice = p.solid;
    choice.formulation = formulation;
    const std::size_t n = particles.size();
    body.model = std::make_shared<ParticleModel<3>>(std::move(particles));
    choice.add_term(*body.model, 0, n, solid, 1.0, scheme.range, scheme);
    body.smooth = dynamic_cast<const SmoothParticles<3>*>(body.model->terms().front().get());
    body.title = formulation == Formulation::updated ? velocity_title(scheme.transport, "plain v") +
                                                           torque_title(scheme.angular_momentum)
                 : choice.lagrangian() ? "total Lagrangian"
                                       : "material vectors";
    body.y0 = initial_state<3>(*body.model, 1.0, solid.eta, rigid_rotation(body.omega));
    return body;
}

std::vector<Column<3>> own_angular_velocity(const Body& body) {
    std::vector<Column<3>> columns;
    for (int a = 0; a < 3; ++a)
        columns.push_back({fmt::format("omega_{}", a + 1),
                           [a, &body](const Model<3>& model, std::span<const double> y) {
                               const ConstState<3> state(model.layout(), y);
                               const auto motion =
                                   best_rigid_motion<3>(body.reference, state.position());
                               const Point<3> V =
                                   mean_by_mass<3>(model.particles().mass, state.velocity());
                               Point<3> L;
                               for (int b = 0; b < 3; ++b)
                                   L[b] = exact_sum(model.particles().size(), [&](std::size_t k) {
                                       const auto i = static_cast<Eigen::Index>(k);
                                       const Point<3> r = state.position().col(i) - motion.to,
                                                      v = state.velocity().col(i) - V;
                                       return model.particles().mass[k] * r.cross(v)[b];
                                   });
                               return (motion.rotation.transpose() * L)[a] / body.inertia[a];
                           }});
    return columns;
}

std::vector<double> flips(const History& h) {
    const auto t = h.column("t"), omega = h.column("omega_2");
    std::vector<double> times;
    for (std::size_t k = 1; k < t.size(); ++k)
        if (omega[k - 1] * omega[k] < 0.0)
            times.push_back(t[k - 1] +
                            (t[k] - t[k - 1]) * omega[k - 1] / (omega[k - 1] - omega[k]));
    return times;
}

namespace {

/// Seen along an axis from the upper right, the particles in front last.
ConfigurationPanel view(const std::string& title, const NearestState<3>& state) {
    const Eigen::Matrix3d look =
        (Eigen::AngleAxisd(-0.35 * std::numbers::pi, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(0.2 * std::numbers::pi, Eigen::Vector3d::UnitZ()))
            .toRotationMatrix();
    const Points<3> seen = look * state.position;
    std::vector<Eigen::Index> order(static_cast<std::size_t>(seen.cols()));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::sort(order.begin(), order.end(),
              [&](Eigen::Index i, Eigen::Index j) { return seen(2, i) < seen(2, j); });
    ConfigurationPanel panel{title, Points<2>(2, seen.cols()), {}, {}};
    for (std::size_t k = 0; k < order.size(); ++k) {
        panel.position.col(static_cast<Eigen::Index>(k)) = seen.col(order[k]).head<2>();
        panel.colour.push_back(state.velocity.col(order[k]).norm());
    }
    panel.diameter = 1.0;
    return panel;
}

/// The components of omega on Jacobi's solution, and the path of their ends.
void draw_top(Session& session, const std::vector<Body>& bodies,
              const std::vector<RunRecord>& runs) {
    std::vector<CurvePanel> panels;
    const Body& first = bodies.front();
    const double omega_0 = first.omega[1];
    const FreeTop top = first.top();
    constexpr const char* omega[] = {"ω₁", "ω₂", "ω₃"};
    for (int a = 0; a < 3; ++a) {
        auto panel =
            frame(fmt::format("about axis {}", a + 1), "ω₀ t", fmt::format("{}/ω₀", omega[a]));
        const double end = runs.front().history.last("t") * omega_0;
        panel.curves.push_back(graph("rigid body", 0.0, end, 600, [&](double t) {
            return top.omega(t / omega_0)[a] / omega_0;
        }));
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const double own = bodies[k].omega[1];
            Curve curve{.title = bodies[k].title, .x = {}, .y = {}};
            const auto t = runs[k].history.column("t"),
                       value = runs[k].history.column(fmt::format("omega_{}", a + 1));
            for (std::size_t i = 0; i < t.size(); ++i) add_point(curve, t[i] * own, value[i] / own);
            panel.curves.push_back(std::move(curve));
        }
        panels.push_back(std::move(panel));
    }
    auto path = frame("path", "ω₁/ω₀", "ω₂/ω₀");
    Curve exact{.title = "rigid body", .x = {}, .y = {}};
    for (int k = 0; k <= 400; ++k) {
        const Point<3> there = top.omega(4.0 * top.quarter() * k / 400.0) / omega_0;
        add_point(exact, there[0], there[1]);
    }
    path.curves.push_back(std::move(exact));
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const double own = bodies[k].omega[1];
        path.curves.push_back({.title = bodies[k].title,
                               .x = divided(runs[k].history.column("omega_1"), own),
                               .y = divided(runs[k].history.column("omega_2"), own)});
    }
    panels.push_back(std::move(path));
    draw_curves(session, "angular_velocity", "A block that turns about its middle axis", panels);
}

}  // namespace

void draw(Session& session, const Parameters& p, const std::vector<Body>& bodies,
          const std::vector<RunRecord>& runs) {
    std::vector<ConfigurationPanel> panels;
    for (const auto& state : bodies.front().drawn)
        if (state.there())
            panels.push_back(
                view(fmt::format("{:.2g} turns", state.t / bodies.front().turn()), state));
    draw_configurations(session, "configurations",
                        fmt::format("{} of {} particles: {}", to_string(p.shape),
                                    bodies.front().model->particles().size(), bodies.front().title),
                        panels, panels.size(), "speed");
    if (p.block()) draw_top(session, bodies, runs);
}

}  // namespace rotating_body
