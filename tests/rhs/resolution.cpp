// SPDX-License-Identifier: GPL-3.0-or-later
// What coarse sums make of friction, conduction and free faces: the numbers that src/docs/limits.md states.
#include "support/random_state.hpp"
#include <spam/external/clamp.hpp>
#include <spam/external/friction.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>

using namespace spam;
using namespace spam::test;

namespace {

constexpr double pi = std::numbers::pi;

enum class By { pairs, gradients };

/// The damping of a shear wave of n spacings on a square (cubic) lattice of density 1, by Newton's eta k^2.
template <int Dim>
double friction(By by, Kernel kernel, double range, double n, double lambda = 0.0) {
    std::array<int, Dim> cells;
    cells.fill(6);
    cells[1] = int(n);
    std::array<double, Dim> sides;
    for (int a = 0; a < Dim; ++a) sides[std::size_t(a)] = cells[std::size_t(a)];
    const Box<Dim> box(sides);
    Fluid fluid{IdealGas{Dim}, NewtonViscosity{lambda, 1.0}};
    fluid.by_pairs = by == By::pairs;
    FluidModel<Dim> model(make_particles<Dim>(square_lattice<Dim>(cells), 1.0, 1.0, box), fluid,
                          {.density = Density::continuity, .kernel = kernel, .range = range}, box);
    const double k = 2.0 * pi / n;
    std::vector<double> y(model.layout().size());
    const State<Dim> state(model.layout(), y);
    state.position() = model.particles().reference_position;
    state.density().setOnes();
    state.energy().setOnes();
    const auto sine = (k * state.position().row(1).array()).sin().eval();
    state.velocity().row(0) = sine.matrix();
    const auto rates = rates_of(model, y);
    const ConstState<Dim> rate(model.layout(), rates);
    return -2.0 * (sine * rate.velocity().row(0).array()).mean() / (k * k);
}

/// Root mean square error of the temperature between plates at 1.5 and 0.5, n rows of a square lattice that
/// stand still, when nothing changes any more.
double conduction(By by, int n) {
    Box<2> box({6.0, 0.0});
    box.set_wall(1, false, {WallKind::no_slip, 0.0, {0.0, 0.0}, 1.5});
    box.set_wall(1, true, {WallKind::no_slip, double(n), {0.0, 0.0}, 0.5});
    Fluid gas{IdealGas{2}, {}, FourierConduction{1.0}};
    gas.by_pairs = by == By::pairs;
    Points<2> x = square_lattice<2>({6, n});
    x.row(1).array() += 0.5;
    FluidModel<2> model(make_particles<2>(x, 1.0, 1.0, box), gas,
                        {.density = Density::continuity, .range = 3.0}, box);
    model.add(std::make_unique<Clamp<2>>());
    const Points<2> sites = model.particles().reference_position;
    auto y = model.state(sites, Points<2>::Zero(2, sites.cols()), 1.0);
    const Eigen::ArrayXd exact = (1.5 - sites.row(1).array() / n).transpose();
    Motion<2> motion(model, y, {.method = "rk4", .dt = 1.0 / model.fastest_damping(y)});
    motion.advance_to(double(n * n));
    const Eigen::ArrayXd T = motion.state().energy().row(0).transpose().array();
    return std::sqrt((T - exact).square().mean());
}

/// Force across the middle of a bar of so many rows that is stretched a little, by that of a continuum.
double stiffness(int rows, double range) {
    const auto solid = ElasticSolid::triangular_lattice();
    const double contraction = solid.lambda / (solid.lambda + 2.0 * solid.eta), strain = 1e-6;
    Points<2> x = triangular_block(40, rows);
    x.colwise() -= x.rowwise().mean().eval();
    SmoothParticleModel<2> bar(make_particles<2>(x, 1.0), solid, {.range = range});
    auto y = initial_state<2>(bar, std::sqrt(4.0 / 3.0), solid.eta, [&](const Point<2>& at) {
        return Point<2>(at.x(), -contraction * at.y());
    });
    const auto stretching = rates_of(bar, y);
    const State<2> state(bar.layout(), y);
    state.stress() += strain * ConstState<2>(bar.layout(), stretching).stress();
    state.velocity().setZero();
    std::vector<std::uint8_t> held;  // grips
    for (Eigen::Index i = 0; i < state.position().cols(); ++i)
        held.push_back(std::abs(state.position()(0, i)) > 17.0);
    SmoothParticleModel<2> relaxing(bar.particles(), solid, {.range = range});
    relaxing.add(std::make_unique<Friction<2>>(0.2));
    relaxing.add(std::make_unique<Clamp<2>>(held));
    auto z = initial_state<2>(relaxing, std::sqrt(4.0 / 3.0), solid.eta, at_rest<2>());
    const State<2> start(relaxing.layout(), z);
    start.stress() = state.stress();
    Motion<2> motion(relaxing, z, {.method = "rk4", .dt = 0.5});
    motion.advance_to(200.0);
    state.position() = motion.state().position();
    state.stress() = motion.state().stress();
    state.density() = motion.state().density();
    const auto pulled = rates_of(bar, y);
    const auto v_dot = ConstState<2>(bar.layout(), pulled).velocity();
    double force = 0.0;  // on the left half
    for (Eigen::Index i = 0; i < v_dot.cols(); ++i)
        if (state.position()(0, i) < 0.0) force += v_dot(0, i);
    const double modulus = 4.0 * solid.eta * (solid.lambda + solid.eta) /
                           (solid.lambda + 2.0 * solid.eta),
                 height = rows * std::sqrt(0.75);
    return force / (modulus * strain * height);
}

}  // namespace

// On a square (cubic) lattice of density 1, a wave of 64 spacings.
BOOST_AUTO_TEST_CASE(short_ranges_make_friction_too_weak) {
    struct Row {
        Kernel kernel;
        double range, lambda;
        std::array<double, 2> pairs, gradients;  // plane, space
    };
    const std::vector<Row> rows{{Kernel::w4, 4.0, 0.0, {0.977, 0.988}, {0.988, 0.989}},
                                {Kernel::lucy, 3.0, 0.0, {0.970, 0.987}, {0.994, 1.006}},
                                {Kernel::w5, 3.0, 0.0, {0.892, 0.929}, {0.955, 0.972}},
                                {Kernel::w5, 3.0, 1.0, {0.805, 0.871}, {}},
                                {Kernel::w5, 2.6, 0.0, {0.824, 0.874}, {0.911, 0.949}}};
    const auto near = [](double found, double stated) { return std::abs(found - stated) < 1e-3; };
    for (const auto& [kernel, range, lambda, pairs, gradients] : rows) {
        BOOST_TEST(near(friction<2>(By::pairs, kernel, range, 64, lambda), pairs[0]));
        BOOST_TEST(near(friction<3>(By::pairs, kernel, range, 64, lambda), pairs[1]));
        if (gradients[0] == 0.0) continue;
        BOOST_TEST(near(friction<2>(By::gradients, kernel, range, 64), gradients[0]));
        BOOST_TEST(near(friction<3>(By::gradients, kernel, range, 64), gradients[1]));
    }
}

// Rows at the plates do not see every other row.
BOOST_AUTO_TEST_CASE(gradients_conduct_heat_from_plates_with_an_order_below_one) {
    const double ten = conduction(By::gradients, 10), twenty = conduction(By::gradients, 20);
    BOOST_TEST(std::abs(ten - 0.059) < 1e-3);
    BOOST_TEST(std::abs(twenty - 0.036) < 1e-3);
    BOOST_TEST(std::abs(std::log2(ten / twenty) - 0.7) < 0.1);
    BOOST_TEST(conduction(By::pairs, 10) < 1e-12);
}

BOOST_AUTO_TEST_CASE(updated_solids_are_soft_at_free_faces) {
    BOOST_TEST(std::abs(stiffness(6, 3.0) - 0.758) < 2e-3);
    BOOST_TEST(std::abs(stiffness(10, 3.0) - 0.844) < 2e-3);
    BOOST_TEST(std::abs(stiffness(20, 3.0) - 0.908) < 2e-3);
}
