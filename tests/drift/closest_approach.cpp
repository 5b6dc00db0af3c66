// SPDX-License-Identifier: GPL-3.0-or-later
// The rotating hexagon with a distance of closest approach, [HHM04] IV: 217 particles, plain velocity,
// where without it particles clump (drift/hexagon).
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/shape.hpp>
#include <spam/integrate/driver.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>

using namespace spam;

namespace {

constexpr double turn = 160.0 * std::numbers::pi;
const ElasticSolid solid = ElasticSolid::triangular_lattice();

struct Outcome {
    std::size_t events = 0;
    double closest = 1.0;  ///< after steps
    double energy_drift = 0.0, momentum = 0.0, shape = 0.0, L_ratio = 1.0;
    double energy_jump = 0.0, momentum_jump = 0.0, L_jump = 0.0;  ///< largest at one event
};

Outcome run(const Scheme& scheme, const IntegratorOptions& options, double t_end) {
    SmoothParticleModel<2> model(make_particles<2>(triangular_hexagon(8), 1.0), solid, scheme);
    const auto y0 =
        initial_state<2>(model, std::sqrt(4.0 / 3.0), solid.eta, rigid_rotation(0.1 / 8));
    const auto start = measure_invariants<2>(model, y0);
    const SundialsContext context;
    Vector y(y0.size(), context);
    std::copy(y0.begin(), y0.end(), y.span().begin());
    Outcome out;
    std::size_t pairs = 0;
    Ode ode = as_ode(model, options, pairs);
    Event& event = ode.events.front();
    event.apply = [&, apply = event.apply](double t, std::span<double> z) {
        const auto before = measure_invariants<2>(model, z);
        const std::size_t n = apply(t, z);
        const auto after = measure_invariants<2>(model, z);
        out.energy_jump = std::max(out.energy_jump, std::abs(after.energy - before.energy));
        out.momentum_jump = std::max(out.momentum_jump, (after.momentum - before.momentum).norm());
        out.L_jump =
            std::max(out.L_jump, std::abs(after.angular_momentum[0] - before.angular_momentum[0]));
        return n;
    };
    const auto integrator = make_integrator(options, ode, y, 0.0, context);
    Observers observers;
    observers.step = [&](double) {
        const Points<2> x = ConstState<2>(model.layout(), y.span()).position();
        const auto now = measure_invariants<2>(model, y.span());
        out.closest = std::min(out.closest, closest_pair<2>(x, 1.0, {}));
        out.energy_drift =
            std::max(out.energy_drift, std::abs(now.energy - start.energy) / start.energy);
        out.momentum = std::max(out.momentum, now.momentum.norm());
        out.shape =
            std::max(out.shape, shape_error<2>(model.particles().reference_position, x, 1.0));
        out.L_ratio = now.angular_momentum[0] / start.angular_momentum[0];
    };
    drive(*integrator, {t_end, t_end, t_end}, observers);
    out.events = integrator->statistics().events;
    return out;
}

const IntegratorOptions rk4{.dt = 0.1};

Scheme with(double R, Transport transport = Transport::plain) {
    return {.transport = transport, .closest_approach = R};
}

void report(const char* what, const Outcome& out) {
    BOOST_TEST_MESSAGE(what << ": " << out.events << " events, closest " << out.closest
                            << ", energy drift " << out.energy_drift << ", L/L0 " << out.L_ratio
                            << ", shape " << out.shape << "; at one event at most dE "
                            << out.energy_jump << ", dp " << out.momentum_jump << ", dL "
                            << out.L_jump);
}

/// Every event keeps all three, whatever the forces between do to L.
void check_invariants(const Outcome& out) {
    BOOST_TEST(out.energy_jump < 1e-13);  // of 0.4
    BOOST_TEST(out.momentum_jump < 1e-13);
    BOOST_TEST(out.L_jump < 1e-12);  // of 65
    BOOST_TEST(out.energy_drift < 1e-7);
    BOOST_TEST(out.momentum < 217 * 1e-12);
}

}  // namespace

BOOST_AUTO_TEST_CASE(plain_velocity_no_longer_clumps) {
    const auto out = run(with(0.7), rk4, turn / 2);
    report("R = 0.7, half a turn", out);
    BOOST_TEST(out.events > 500U);
    BOOST_TEST(out.closest > 0.7 * (1.0 - 1e-12));
    check_invariants(out);
}

BOOST_AUTO_TEST_CASE(near_the_spacing_it_keeps_the_shape) {
    const auto out = run(with(0.9), rk4, turn / 3);
    report("R = 0.9, a third of a turn", out);
    BOOST_TEST(out.closest > 0.9 * (1.0 - 1e-12));
    BOOST_TEST(out.shape < 0.7);  // 0.95 without
    check_invariants(out);
}

BOOST_AUTO_TEST_CASE(adaptive_steps_keep_the_distance_as_well) {
    IntegratorOptions adaptive;
    adaptive.method = "arkode:DORMAND_PRINCE_7_4_5";
    const auto out = run(with(0.7), adaptive, turn / 3);
    report("R = 0.7, a third of a turn, adaptive", out);
    BOOST_TEST(out.events > 100U);
    BOOST_TEST(out.closest > 0.7 * (1.0 - 1e-12));
    check_invariants(out);
}

BOOST_AUTO_TEST_CASE(averaged_velocities_let_reflected_pairs_pass) {
    const auto out = run(with(0.9, Transport::monaghan), rk4, turn / 2);
    report("R = 0.9, Monaghan, half a turn", out);
    BOOST_TEST(out.events > 10U);
    BOOST_TEST(out.closest < 0.9 * (1.0 - 1e-6));  // 0.8994; 0.55 after a whole turn
    check_invariants(out);
}
