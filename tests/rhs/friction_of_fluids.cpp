// SPDX-License-Identifier: GPL-3.0-or-later
// Friction and conduction by pairs between two fluids that lie beside each other: what diffuses across both, and how
// fast it can.
#include "support/random_state.hpp"
#include <spam/material/ideal_gas.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <numbers>

using namespace spam;
using namespace spam::test;

namespace {

Fluid rubbing(double eta, double lambda, double kappa) {
    Fluid fluid{IdealGas{2, 1.0}};
    if (eta > 0.0) fluid.viscosity = NewtonViscosity{lambda, eta};
    if (kappa > 0.0) fluid.conduction = FourierConduction{kappa};
    fluid.by_pairs = true;
    return fluid;
}

struct Gas {
    ParticleModel<2> model;
    Gas(Particles<2> particles, const std::vector<Fluid>& fluids, const Box<2>& box)
        : model(std::move(particles), box) {
        model.add_term<SmoothParticles<2>>(fluids,
                                           Scheme{.density = Density::continuity, .range = 3.0});
    }
};

/// From the border of the first layer, half a spacing before the first particle.
double across(const Particles<2>& particles, Eigen::Index i) {
    const auto x = particles.reference_position.row(0);
    return x[i] - x.minCoeff() + 0.5;
}

/// What diffuses across two layers: a component of velocity, or energy where that is -1.
struct Layers {
    const char* name;
    int component;
    Fluid first, second;
};

/// Each half of a period of `n`, at rest and of one density.
Gas layers(int n, const Layers& of) {
    const Box<2> box({static_cast<double>(n), 8.0});
    auto particles = make_particles<2>(square_lattice<2>({n, 8}), 1.0, 1.0, box);
    for (Eigen::Index i = 0; i < particles.reference_position.cols(); ++i)
        particles.material.push_back(across(particles, i) < 0.5 * n ? 0 : 1);
    return {std::move(particles), {of.first, of.second}, box};
}

/// How fast the slowest change of n columns dies out: the smallest eigenvalue but that of what stays, of the rates of
/// one column after the other.
double decay(int n, const Layers& of) {
    Gas gas = layers(n, of);
    std::vector<double> y(gas.model.layout().size(), 0.0);
    const State<2> state(gas.model.layout(), y);
    state.position() = gas.model.particles().reference_position;
    state.density().setOnes();
    state.energy().setOnes();
    const auto diffusing = of.component < 0 ? Field::energy : Field::velocity;
    const int row = std::max(of.component, 0);
    auto field = state.field(diffusing).row(row);
    const auto column = [&](Eigen::Index i) {
        return static_cast<Eigen::Index>(across(gas.model.particles(), i));
    };
    Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const Eigen::RowVectorXd before = field;
        for (Eigen::Index i = 0; i < field.size(); ++i)
            if (column(i) == k) field[i] += 0.5;
        const auto y_dot = rates_of(gas.model, y);
        const ConstState<2> rate(gas.model.layout(), y_dot);
        const Eigen::RowVectorXd found = rate.field(diffusing).row(row);
        for (Eigen::Index i = 0; i < field.size(); ++i) rates(column(i), k) -= found[i] / (0.5 * 8);
        field = before;
    }
    BOOST_TEST((rates - rates.transpose()).norm() < 1e-13 * rates.norm());
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(rates).eigenvalues()[1];
}

/// Two layers of length l of coefficients 1 and c^2: cos(c q x/l) about the middle of the first goes on as a
/// multiple of cos(q x/l) about that of the second with one flux at both borders where tan(c q/2) + c tan(q/2) = 0,
/// and decays at (c q/l)^2. By that of one layer of 1, (pi/l)^2.
double slowest_of_two(double c) {
    const auto off = [&](double q) {
        return std::sin(0.5 * c * q) * std::cos(0.5 * q) +
               c * std::sin(0.5 * q) * std::cos(0.5 * c * q);
    };
    double below = 0.9 * std::numbers::pi / c, above = 1.9 * std::numbers::pi / c;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (below + above);
        (off(middle) > 0.0 ? below : above) = middle;
    }
    return std::pow(c * below / std::numbers::pi, 2);
}

}  // namespace

// c^2 is the ratio of decays in one layer of each, which leaves out what the lattice makes of a wave in either: what is
// off is what acts between the layers, 1.3 % at most and a half at each doubling. In layers of one viscosity modes of
// either symmetry lie 0.09 % apart, and the lattice decides which is the slowest. With means of eta - lambda and
// eta + lambda they would slip.
BOOST_AUTO_TEST_CASE(heat_and_motion_in_two_layers) {
    BOOST_TEST(std::abs(slowest_of_two(2.0) -
                        std::pow(4.0 / std::numbers::pi * std::atan(std::sqrt(2.0)), 2)) < 1e-14);
    const auto kappa = [](double c) { return rubbing(0.0, 0.0, c); };
    const auto newton = [](double eta, double lambda) { return rubbing(eta, lambda, 0.0); };
    const Layers all[] = {
        {"heat", -1, kappa(1.0), kappa(4.0)},
        {"shear", 1, newton(1.0, 0.0), newton(4.0, 0.0)},
        {"shear, other bulk viscosities", 1, newton(1.0, -1.0), newton(4.0, 4.0)},
        {"shear of one viscosity", 1, newton(1.0, -1.0), newton(1.0, 1.0)},
        {"longitudinal", 0, newton(1.0, 0.0), newton(4.0, 0.0)},
        {"longitudinal, other bulk viscosities", 0, newton(1.0, -1.0), newton(2.0, 0.0)},
    };
    for (const Layers& two : all) {
        double before = 0.014;
        for (const int n : {32, 64, 128}) {
            const double first = decay(n, {two.name, two.component, two.first, two.first}),
                         second = decay(n, {two.name, two.component, two.second, two.second}),
                         off = decay(n, two) / first / slowest_of_two(std::sqrt(second / first)) -
                               1.0;
            BOOST_TEST_MESSAGE(two.name << " " << n << ": " << off);
            BOOST_TEST(std::abs(off) < before);
            before = std::max(0.55 * std::abs(off), 0.001);
        }
    }
}

// Steps are chosen by it. Of two fluids beside each other one is a thousand times as dense.
BOOST_AUTO_TEST_CASE(the_fastest_damping_is_that_of_the_thin_fluid) {
    for (const bool pairs : {false, true}) {
        Fluid fluid = rubbing(0.7, 0.2, 0.0);
        fluid.by_pairs = pairs;
        Gas two = layers(16, {"shear", 1, fluid, fluid});
        auto particles = two.model.particles();
        const auto rate = [&] {
            Gas gas(particles, {fluid, fluid}, two.model.box());
            std::vector<double> y(gas.model.layout().size(), 0.0);
            const State<2> state(gas.model.layout(), y);
            state.position() = particles.reference_position;
            state.density() = Eigen::Map<const Eigen::RowVectorXd>(
                particles.mass.data(), static_cast<Eigen::Index>(particles.size()));
            state.energy().setOnes();
            return gas.model.fastest_damping(y);
        };
        const double thin = rate();
        for (std::size_t i = 0; i < particles.size(); ++i)
            if (particles.material[i] == 1) particles.mass[i] = 1000.0;
        BOOST_TEST(std::abs(rate() / thin - 1.0) < 1e-12);
    }
}
