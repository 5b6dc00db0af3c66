// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: an elastic cube, ball or block that rotates in space; balanced torques, and a block that tumbles; 2 s
//
// An elastic body rotates in space, [HHM04] I and VIII.
//
//        +------+       A cube of 7 x 7 x 7 particles, a ball cut out of it, or a block of 9 x 7 x 5, on a
//       /      /|       cubic lattice of spacing 1 with masses 1, begins in rigid rotation with the speed
//      +------+ |       0.1 of the cube's outermost particles, free of stress: cube and ball about the axis
//      |      | +       (1, 2, 3), the block about its middle axis, tilted by 0.05 towards the longest.
//      |      |/
//      +------+         lambda = eta = sqrt(3/16), Lucy's weight
//
// Updated smooth particles that move with Monaghan's averaged velocity keep together and lose angular momentum,
// as in the plane. With torques that are balanced (--angular-momentum torque_pair) they keep the vector L: one
// vector theta a body gives every pair's torque T the factor exp(-theta . T/|T|), and is found by Newton's method
// with some sums over pairs (physics/torque_balance_in_space.hpp). torque_particle needs sums over particles alone,
// and is the cheaper one in space.
//
// A rigid block does not stay with its middle axis: omega_2 changes its sign again and again, at the times of
// Jacobi's elliptic functions. A total-Lagrangian block does the same, but for its elasticity, whose part is
// proportional to speed^2:
//
//     --body block --formulation total_lagrangian --speed 0.02
//     --compare          three speeds, the exponent, and updated particles beside them
#include "rotating_body/body.hpp"

namespace rotating_body {
namespace {

/// max over rows of |L - L_0|/|L_0|
double change_of_L(const History& h) {
    std::array<std::vector<double>, 3> L;
    for (std::size_t a = 0; a < 3; ++a)
        L[a] = h.column(std::string("angular_momentum_") + "xyz"[a]);
    double largest = 0.0;
    for (std::size_t k = 0; k < L[0].size(); ++k)
        largest =
            std::max(largest, std::hypot(L[0][k] - L[0][0], L[1][k] - L[1][0], L[2][k] - L[2][0]));
    return largest / std::hypot(L[0][0], L[1][0], L[2][0]);
}

double size_of_L(const History& h, double t) {
    return std::hypot(h.at(t, "angular_momentum_x"), h.at(t, "angular_momentum_y"),
                      h.at(t, "angular_momentum_z"));
}

void report(Session& session, const Parameters& p, const Body& body, const RunRecord& run) {
    const Findings findings(session, body.prefix);
    const History& h = run.history;
    const auto law =
        body.smooth != nullptr ? body.smooth->scheme().angular_momentum : AngularMomentum::free;
    const bool cube =
        p.shape == Shape::cube && run.complete && body.smooth != nullptr &&
        session.when_default({"size", "speed", "turns", "density", "transport", "mean-density",
                              "viscosity", "closest-approach", "kernel", "range"}) &&
        session.integrator().method == "rk4" && *session.integrator().dt <= 0.25;
    const bool balanced = body.smooth != nullptr && body.smooth->scheme().balances_torques();
    if (balanced || body.smooth == nullptr) {
        const bool particle = law == AngularMomentum::torque_particle;
        const bool leapfrog =
            body.smooth == nullptr && !session.given("integrator") && undamped(session.scheme());
        findings.claim("angular_momentum_change", change_of_L(h), 0.0,
                       leapfrog   ? 1e-13
                       : particle ? 1e-7
                                  : 1e-8,
                       "the vector, by its size", leapfrog || (cube && balanced));
        findings.claim("energy_change", h.largest_change("energy") / h.first("energy"), 0.0,
                       particle ? 1e-5 : 1e-6, "to the error of RK4", cube && balanced);
    }
    if (balanced) {
        const TorqueSearch search = body.smooth->torque_search();
        findings.claim("newton_sums_by_rate",
                       static_cast<double>(search.sums) / static_cast<double>(search.balances), 2.5,
                       2.5, "sums over torques that find theta", cube);
    }
    if (law == AngularMomentum::free && body.smooth != nullptr)
        for (const auto& [turns, ratio] : {std::pair{0.083, 0.9410}, std::pair{0.165, 0.8053},
                                           std::pair{0.248, 0.6115}, std::pair{0.331, 0.3664}})
            if (turns * body.turn() <= h.last("t"))
                findings.claim(fmt::format("angular_momentum_ratio_at_{:g}_turns", turns),
                               size_of_L(h, turns * body.turn()) / size_of_L(h, 0.0), ratio, 0.01,
                               "another program", cube);
    findings.measure("shape_error_largest", h.largest("shape_error"));
    findings.measure("closest_pair", h.smallest("closest_pair"));
    findings.check_promises(run);
}

/// The largest relative difference from the rigid block of the times between two flips, the first one from the start.
double flip_deviation(const Body& body, const RunRecord& run) {
    const auto times = flips(run.history);
    const double quarter = body.top().quarter();
    double largest = 0.0, before = -quarter;
    for (const double t : times) {
        largest = std::max(largest, std::abs((t - before) / (2.0 * quarter) - 1.0));
        before = t;
    }
    return largest;
}

void report_flips(Session& session, const Parameters& p, const Body& body, const RunRecord& run) {
    const Findings findings(session, body.prefix);
    const auto times = flips(run.history);
    const bool lagrangian = (p.solid.lagrangian() || p.compare) && body.smooth == nullptr;
    const bool known = lagrangian && run.complete && !session.common().smoke && body.speed <= 0.1 &&
                       resolves(run.history.column("t"), 2.0 * body.top().quarter()) &&
                       session.at_default({"size", "range", "penalty", "kernel", "turns", "t-end"});
    findings.claim("flips", static_cast<double>(times.size()), 3.0, 0.0, "of a rigid block", known);
    for (std::size_t k = 0; k < times.size(); ++k)
        findings.measure(fmt::format("flip_{}", k + 1), times[k] * body.omega[1],
                         "the time by 1/omega_0");
    if (times.empty()) return;
    // Elasticity: proportional to speed^2, 0.00022 at 0.02 and 0.0055 at 0.1 in another program.
    findings.claim("flip_deviation", flip_deviation(body, run), 0.0,
                   5e-4 * std::max(1.0, std::pow(body.speed / 0.02, 2)), "of a rigid block", known);
}

double step_of_leapfrog(double speed) { return speed > 0.05 ? 0.2 : 0.4; }

void compute(Session& session, const Parameters& p) {
    std::vector<Body> bodies;
    const double speed = p.speed.value_or(p.block() && p.solid.lagrangian() ? 0.02 : 0.1);
    Scheme of_lagrangian = session.scheme(), of_updated = session.scheme();
    if (!session.given("range")) {
        of_lagrangian.range = 2.2;
        if (p.compare || p.solid.lagrangian()) session.leave_out_of_case({"range"});
    }
    if (!session.given("angular-momentum") && p.compare)
        of_updated.angular_momentum = AngularMomentum::torque_pair;
    if (p.compare) {
        for (const double v : {0.02, 0.05, 0.1}) {
            bodies.push_back(make_body(p, Formulation::total_lagrangian, v, of_lagrangian));
            bodies.back().call(fmt::format("speed_{:g}", v));
            bodies.back().title = fmt::format("speed {:g}", v);
        }
        bodies.push_back(make_body(p, Formulation::updated, 0.1, of_updated));
        bodies.back().call("updated");
        bodies.back().title = "updated";
    } else {
        bodies.push_back(make_body(p, p.solid.formulation, speed,
                                   p.solid.lagrangian() ? of_lagrangian : of_updated));
        // L by it is conserved to round-off, for a quarter of the right-hand sides.
        if (p.solid.remembers() && undamped(of_lagrangian))
            session.prefer_leapfrog(step_of_leapfrog(speed) * p.solid.relative_step());
        else if (p.block())
            session.prefer_step(0.1);
    }
    const double turns = p.turns.value_or(session.common().smoke ? 0.05 : p.block() ? 12.0 : 1.0);
    const auto runs = run_all(session, bodies, [&](Body& body) {
        Plan<3> plan;
        plan.t_end = session.common().t_end.value_or(turns * body.turn());
        if (p.compare && body.smooth != nullptr) {
            plan.step = 0.1;
            plan.t_end = std::min(plan.t_end, 2.0 * body.turn());
            plan.own_end = true;
        } else if (p.compare && undamped(of_lagrangian)) {
            plan.method = "leapfrog";
            plan.step = step_of_leapfrog(body.speed);
        }
        plan.record({closest_pair_column<3>(), shape_error_column<3>()});
        if (p.block()) plan.record(own_angular_velocity(body));
        body.drawn = states_at<3>({0.0, 0.5, 1.0}, plan.t_end);
        plan.observe(keep_nearest<3>(body.drawn));
        return plan;
    });
    for (std::size_t k = 0; k < runs.size(); ++k) {
        report(session, p, bodies[k], runs[k]);
        if (p.block()) report_flips(session, p, bodies[k], runs[k]);
    }
    if (p.compare && runs.size() == bodies.size() && !session.common().smoke) {
        const double exponent =
            std::log(flip_deviation(bodies[2], runs[2]) / flip_deviation(bodies[0], runs[0])) /
            std::log(bodies[2].speed / bodies[0].speed);
        session.claim({"exponent_of_speed", exponent, 2.0, 0.1, "stretch by the rotation"},
                      session.at_default({"size", "turns", "range", "penalty", "kernel"}));
    }
    if (session.plots() && runs.size() == bodies.size()) draw(session, p, bodies, runs);
}

}  // namespace
}  // namespace rotating_body

int main(int argc, char** argv) {
    using namespace rotating_body;
    Problem problem("rotating_body", "an elastic cube, ball or block that rotates in space", 0.2,
                    "0.2, 0.1 for a block; solids that remember take leapfrog with 0.4 without "
                    "--integrator, or 0.2 where faster than 0.05");
    problem.units(reduced_units(
        "the mass of a particle, the spacing and the spring constant of a triangular lattice with the same lambda and eta"));
    Parameters p;
    auto& options = problem.options();
    options.choice<Shape>("body", p.shape, {Shape::cube, Shape::ball, Shape::block},
                          "n x n x n particles, those of them in a ball, or (n + 2) x n x (n - 2)");
    options.integer("size", p.size, "n: particles along an edge, or across the ball",
                    between(3, 200));
    options.number(
        "speed", p.speed,
        "angular velocity times the distance of the farthest particle from the centre (default "
        "0.1; 0.02 for a total-Lagrangian block)",
        between(1e-6, 1e3));
    options.number("turns", p.turns, "number of nominal turns (default 1; 12 for a block)",
                   positive());
    problem.use_scheme({.transport = Transport::monaghan, .range = 2.6});
    p.solid.add_beside_scheme(options, [&p] { return !p.solid.remembers() || p.compare; });
    options.flag("compare", p.compare,
                 "a total-Lagrangian block at three speeds, and updated particles beside it");
    options.one_of({"turns", "t-end"}, "the end of the run");
    options.only_when(
        {"compare"}, {"body"}, [&p] { return p.block(); },
        "is for --body block; give that, or leave it out");
    options.exclude("compare", {"speed", "formulation"},
                    "has no effect with {by} (three speeds, and both); leave one out");

    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("size", p.size, 4);
        p.solid.viscosity = session.scheme().viscosity;
        compute(session, p);
    });
}
