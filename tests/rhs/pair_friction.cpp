// SPDX-License-Identifier: GPL-3.0-or-later
// Friction and conduction by pairs: Newton's and Fourier's laws on long waves, damping of the shortest ones,
// and what pairs keep.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/kernel/general_weight.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

Fluid rubbing(double eta, double lambda, double kappa) {
    Fluid fluid{IdealGas{}, NewtonViscosity{lambda, eta}, FourierConduction{kappa}};
    fluid.by_pairs = true;
    return fluid;
}

constexpr int n = 64;
constexpr double k = 2.0 * std::numbers::pi / n;

/// Rates at a square lattice where particles have these velocities and energies (by y), density one.
struct Wave {
    std::vector<double> y, rates;
    FluidModel<2> model;

    Wave(const Fluid& fluid, const std::function<Point<2>(double)>& v,
         const std::function<double(double)>& e)
        : model(make_particles<2>(square_lattice<2>({n, n}), 1.0, 1.0, Box<2>({n, n})), fluid,
                {.density = Density::continuity, .kernel = Kernel::w5, .range = 5.0},
                Box<2>({n, n})) {
        y.resize(model.layout().size());
        const State<2> state(model.layout(), y);
        state.position() = model.particles().reference_position;
        state.density().setOnes();
        for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
            state.velocity().col(i) = v(state.position()(1, i));
            state.energy()(0, i) = e(state.position()(1, i));
        }
        rates = rates_of(model, y);
    }
    /// Amplitude of sin ky (component a) in v_dot, or of e_dot.
    double amplitude(Field field, int a) const {
        const ConstState<2> state(model.layout(), y), rate(model.layout(), rates);
        const auto sine = (k * state.position().row(1).array()).sin();
        return 2.0 / (n * n) * (sine * rate.field(field).row(a).array()).sum();
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(long_waves_feel_newton_and_fourier) {
    const double eta = 0.7, lambda = 0.2, kappa = 0.4;
    const auto cold = [](double) { return 1.0; };
    const Fluid fluid = rubbing(eta, lambda, kappa);
    // What the lattice makes of a wave across y: sum F (a + b x_c^2/r^2)(1 - cos ky), to the last digits, and
    // of that the law of long waves.
    const GeneralWeight<2> weight(Kernel::w5, 5.0);
    const auto lattice = [&](double a, double b, int c) {
        double sum = 0.0;
        for (int x = -5; x <= 5; ++x)
            for (int y = -5; y <= 5; ++y) {
                const double r2 = x * x + y * y, part = c == 0 ? x * x : y * y;
                if (r2 > 0.0)
                    sum += weight.minus_slope_over_r(std::sqrt(r2)) * (a + b * part / r2) *
                           (1.0 - std::cos(k * y));
            }
        return sum;
    };
    const auto close = [](double found, double expected, double tolerance) {
        return std::abs(found / expected - 1.0) < tolerance;
    };
    const double a = eta - lambda, b = 4.0 * (eta + lambda);
    const Wave shear(
        fluid, [](double y) { return Point<2>(std::sin(k * y), 0.0); }, cold);
    BOOST_TEST(close(shear.amplitude(Field::velocity, 0), -lattice(a, b, 0), 1e-10));
    BOOST_TEST(close(lattice(a, b, 0), eta * k * k, 0.03));
    BOOST_TEST(std::abs(shear.amplitude(Field::velocity, 1)) < 1e-12);
    const Wave sound(
        fluid, [](double y) { return Point<2>(0.0, std::sin(k * y)); }, cold);
    BOOST_TEST(close(sound.amplitude(Field::velocity, 1), -lattice(a, b, 1), 1e-10));
    BOOST_TEST(close(lattice(a, b, 1), (2.0 * eta + lambda) * k * k, 0.03));
    // T = e in the plane. Pressures change with it, but no particle moves.
    const Wave heat(
        fluid, [](double) { return Point<2>(0.0, 0.0); },
        [](double y) { return 1.0 + 0.1 * std::sin(k * y); });
    BOOST_TEST(close(heat.amplitude(Field::energy, 0), -0.1 * lattice(2.0 * kappa, 0.0, 0), 1e-10));
    BOOST_TEST(close(lattice(2.0 * kappa, 0.0, 0), kappa * k * k, 0.03));
}

// Rows that move against each other: gradients do not see them.
BOOST_AUTO_TEST_CASE(the_shortest_waves_are_damped) {
    const auto zigzag = [](double y) { return Point<2>(std::cos(std::numbers::pi * y), 0.0); };
    const auto damping = [&](const Fluid& fluid) {
        const Wave wave(fluid, zigzag, [](double) { return 1.0; });
        const ConstState<2> state(wave.model.layout(), wave.y),
            rate(wave.model.layout(), wave.rates);
        return -(state.velocity().row(0).array() * rate.velocity().row(0).array()).mean();
    };
    Fluid fluid = rubbing(0.7, 0.2, 0.0);
    BOOST_TEST(damping(fluid) > 0.1);
    fluid.by_pairs = false;
    BOOST_TEST(damping(fluid) < 1e-6);
}

BOOST_AUTO_TEST_CASE(pairs_keep_momentum_and_energy_and_with_central_forces_turning) {
    for (const double lambda : {0.7, 0.1, -0.7}) {
        FluidModel<2> model(jittered_particles<2>(12, 3), rubbing(0.7, lambda, 0.5),
                            {.density = Density::continuity, .range = 2.7});
        auto y = random_state(model, 4);
        const State<2> state(model.layout(), y);
        for (auto& e : state.energy().reshaped()) e = std::abs(e) + 0.5;
        const auto rates = rates_of(model, y);
        const ConstState<2> rate(model.layout(), rates);
        double power = 0.0, turning = 0.0, size = 0.0;
        Point<2> force = Point<2>::Zero();
        for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
            const double m = model.particles().mass[static_cast<std::size_t>(i)];
            const Point<2> f = m * rate.velocity().col(i);
            force += f;
            power += f.dot(state.velocity().col(i)) + m * rate.energy()(0, i);
            turning += state.position()(0, i) * f.y() - state.position()(1, i) * f.x();
            size += f.norm();
        }
        BOOST_TEST(force.norm() < 1e-13 * size);
        BOOST_TEST(std::abs(power) < 1e-12 * size);
        const bool central = lambda == 0.7;
        BOOST_TEST((std::abs(turning) < 1e-12 * size) == central);
        BOOST_TEST((model.promises().angular_momentum == Promise::integrator_error) == central);
    }
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    const auto why = [](const Fluid& fluid, const Scheme& scheme) {
        return refusal([&] { FluidModel<2>(jittered_particles<2>(8, 1), fluid, scheme); });
    };
    const Scheme plain{.density = Density::continuity, .range = 2.6};
    BOOST_TEST(why(rubbing(0.7, 0.7, 0.0), plain) == "accepted");
    BOOST_TEST(why(rubbing(0.7, 0.8, 0.0), plain).find("-eta <= lambda <= eta") !=
               std::string::npos);
}
