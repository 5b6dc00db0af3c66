// SPDX-License-Identifier: GPL-3.0-or-later
// A solid with material vectors that yields: the return to the yield surface, what it leaves as it is, and a
// block that flows while energy with heat, p and L are kept.
#include "support/random_gradient.hpp"
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include "support/turned_body.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/total_energy.hpp>
#include <spam/material/flowing_solid.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <numbers>

using namespace spam;
using namespace spam::test;

namespace {

constexpr PolynomialSolid elastic{0.43, 0.43};
constexpr MaterialVectorScheme usual{1.2, 2.6, 1.0};

/// Kirchhoff's tau = P F^t: von Mises' q and the mean.
template <int Dim>
std::array<double, 2> stresses(const Mat<Dim>& F) {
    const Mat<Dim> P = elastic.stress(F);
    Mat<Dim> tau;
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b)
            for (int c = 0; c < Dim; ++c) tau(a, b) += P(a, c) * F(b, c);
    const double mean = tau.trace() / Dim;
    double square = 0.0;
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) square += std::pow(tau(a, b) - (a == b ? mean : 0.0), 2);
    return {std::sqrt((Dim == 2 ? 2.0 : 1.5) * square), mean};
}

template <int Dim>
Mat<Dim> product(const Mat<Dim>& A, const Mat<Dim>& B) {
    Mat<Dim> C;
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b)
            for (int c = 0; c < Dim; ++c) C(a, b) += A(a, c) * B(c, b);
    return C;
}

template <int Dim>
void check_the_return() {
    const FlowingSolid soft{elastic, 0.05}, brittle{elastic, FlowingSolid::never, 0.04},
        both{elastic, 0.05, 0.04};
    int yielded = 0, torn = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        const Mat<Dim> F = random_gradient<Dim>(seed, 0.1);
        const double q = stresses<Dim>(F)[0], mean = stresses<Dim>(F)[1];
        const auto G = soft.flow(F);
        BOOST_TEST(G.has_value() == (q > 0.05));
        if (G) {
            const Mat<Dim> after = product<Dim>(F, *G);
            BOOST_TEST(std::abs(stresses<Dim>(after)[0] / 0.05 - 1.0) < 1e-12);
            BOOST_TEST(std::abs(determinant(after) / determinant(F) - 1.0) < 1e-13);
            BOOST_TEST(elastic.energy(after) < elastic.energy(F));
            ++yielded;
        }
        const auto opened = brittle.flow(F);
        BOOST_TEST(opened.has_value() == (mean > 0.04));
        if (opened) {
            BOOST_TEST(std::abs(stresses<Dim>(product<Dim>(F, *opened))[1] / 0.04 - 1.0) < 1e-12);
            ++torn;
        }
        if (const auto flow = both.flow(F)) {
            const Mat<Dim> after = product<Dim>(F, *flow);
            BOOST_TEST(stresses<Dim>(after)[0] < 0.05 * (1.0 + 1e-12));
            BOOST_TEST(stresses<Dim>(after)[1] < 0.04 * (1.0 + 1e-12));
        }
    }
    BOOST_TEST(yielded > 50);
    BOOST_TEST(torn > 20);
}

/// Sheared as a whole, so that every r is F X.
template <int Dim>
void check_what_stays() {
    MaterialVectorModel<Dim> model(jittered_particles<Dim>(Dim == 2 ? 8 : 5, 3),
                                   FlowingSolid{elastic, 0.05}, usual);
    std::vector<double> y(model.layout().size(), 0.0);
    auto x = State<Dim>(model.layout(), y).position();
    x = model.particles().reference_position;
    x.row(0) += 0.2 * model.particles().reference_position.row(1);
    const double energy = model.internal_energy(y);
    BOOST_TEST(model.settle(0.0, y));
    BOOST_TEST(model.law.heat() > 0.1 * energy);
    BOOST_TEST(std::abs(model.internal_energy(y) / energy - 1.0) < 1e-14);
    const auto F = model.law.deformation_gradients(y);
    double misfit = 0.0, off = 0.0;
    for (std::size_t k = 0; k < F.size(); ++k) {
        off = std::max(off, std::abs(stresses<Dim>(F[k])[0] / 0.05 - 1.0));
        for (const auto& bond : model.law.bonds(y, k)) {
            const Vec<Dim> FX = F[k] * bond.X;
            for (int a = 0; a < Dim; ++a)
                misfit = std::max(misfit, std::abs(FX[a] - (x(a, bond.partner) -
                                                            x(a, static_cast<Eigen::Index>(k)))));
        }
    }
    BOOST_TEST(off < 1e-11);
    BOOST_TEST(misfit < 1e-11);
    BOOST_TEST(!model.settle(0.0, y));  // on the surface it stays
}

/// What never yields has the bits of the law beneath.
template <int Dim>
void check_bits_without_yield() {
    const auto particles = jittered_particles<Dim>(Dim == 2 ? 9 : 5, 5);
    MaterialVectorModel<Dim> plain(particles, elastic, usual),
        strong(particles, FlowingSolid{elastic, 10.0, 10.0}, usual);
    const auto y = moved(plain, 0.1, 6);
    BOOST_TEST((rates_of(plain, y) == rates_of(strong, y)));
    BOOST_TEST(plain.internal_energy(y) == strong.internal_energy(y));
    BOOST_TEST(HyperelasticMaterial<Dim>(FlowingSolid{elastic, 10.0}).flows());
    BOOST_TEST(!HyperelasticMaterial<Dim>(FlowingSolid{elastic}).flows());
}

/// Sheared and disordered: what flows has misfits as well.
template <int Dim>
std::vector<double> disturbed(const MaterialVectorModel<Dim>& model, double strain) {
    auto y = moved(model, strain, 8);
    auto x = State<Dim>(model.layout(), y).position();
    x.row(0) += strain * model.particles().reference_position.row(1);
    return y;
}

template <int Dim>
void check_forces() {
    MaterialVectorModel<Dim> model(jittered_particles<Dim>(Dim == 2 ? 6 : 4, 7),
                                   FlowingSolid{elastic, 0.05, 0.03}, usual);
    auto y = disturbed<Dim>(model, 0.1);
    const auto rates = rates_of(model, y);
    const std::size_t n = model.particles().size() * Dim;
    double worst = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < n; i += 7) {
        const double x = y[i], h = 1e-5, m = model.particles().mass[i / Dim];
        y[i] = x + h;
        const double more = model.internal_energy(y);
        y[i] = x - h;
        const double less = model.internal_energy(y);
        y[i] = x;
        worst = std::max(worst, std::abs((less - more) / (2.0 * h) - m * rates[n + i]));
        largest = std::max(largest, std::abs(rates[n + i]));
    }
    BOOST_TEST(worst < 1e-7 * std::max(1.0, largest));
    BOOST_TEST(largest > 0.01);
}

/// Rates before and after flow are the same, and so is the energy with heat; once more nothing flows.
template <int Dim>
void check_the_commit() {
    MaterialVectorModel<Dim> model(jittered_particles<Dim>(Dim == 2 ? 9 : 5, 7),
                                   FlowingSolid{elastic, 0.005, 0.01}, usual);
    auto y = disturbed<Dim>(model, 0.01);  // too little for other neighbours
    const auto before = rates_of(model, y);
    const double energy = model.internal_energy(y), heat = model.law.heat();
    BOOST_TEST(model.settle(0.0, y));
    BOOST_TEST(model.law.heat() > heat + 0.01 * energy);
    BOOST_TEST(std::abs(model.internal_energy(y) / energy - 1.0) < 1e-13);
    BOOST_TEST(relative_difference(rates_of(model, y), before) < 1e-11);
    BOOST_TEST(!model.settle(0.0, y));
}

/// The law whose stress is the elastic one within a step, and is returned after it.
struct ReturnedAfterSteps : FlowingSolid {
    template <int Dim>
    double energy(const Mat<Dim>& F) const {
        return elastic.energy(F);
    }
    template <int Dim>
    Mat<Dim> stress(const Mat<Dim>& F) const {
        return elastic.stress(F);
    }
};

/// A block that is sheared and turned.
struct Outcome {
    Points<2> x;
    double heat, energy;   ///< of the energy
    double median, worst;  ///< change of energy with heat in a step
};
Outcome outcome(const HyperelasticMaterial<2>& law, const char* method, double dt) {
    MaterialVectorModel<2> model(make_particles<2>(triangular_block(12, 12), 1.0), law, usual);
    const auto y0 = initial_state<2>(model, 1.2, 0.43, [](const Point<2>& x) {
        return Point<2>(0.1 * x.y() + 0.02 * std::sin(x.x()), 0.05 * x.x());
    });
    Motion<2> motion(model, y0, {.method = method, .dt = dt});
    const double energy = total_energy(model, motion.y());
    std::vector<double> steps;
    double last = 0.0;
    for (int n = 1; n <= std::lround(16.0 / dt); ++n) {
        motion.advance_to(n * dt);
        const double now = total_energy(model, motion.y()) / energy - 1.0;
        steps.push_back(std::abs(now - last));
        last = now;
    }
    std::sort(steps.begin(), steps.end());
    return {motion.state().position(), model.law.heat() / energy, last, steps[steps.size() / 2],
            steps.back()};
}

}  // namespace

BOOST_AUTO_TEST_CASE(without_yield_the_bits_are_those_of_the_elastic_law) {
    check_bits_without_yield<2>();
    check_bits_without_yield<3>();
}

BOOST_AUTO_TEST_CASE(forces_are_the_slope_of_the_energy_while_it_flows) {
    check_forces<2>();
    check_forces<3>();
}
BOOST_AUTO_TEST_CASE(what_has_flowed_within_a_step_is_kept_without_a_jump) {
    check_the_commit<2>();
    check_the_commit<3>();
}

BOOST_AUTO_TEST_CASE(the_return_ends_on_the_yield_surface) {
    check_the_return<2>();
    check_the_return<3>();
}
BOOST_AUTO_TEST_CASE(yielding_leaves_separations_and_energy_with_heat) {
    check_what_stays<2>();
    check_what_stays<3>();
}

/// Within steps the return is some twenty times better, and the energy of a step without a beginning or an end of
/// flow is that of the method: flow leaves no kink behind.
BOOST_AUTO_TEST_CASE(the_return_belongs_into_every_right_hand_side) {
    const FlowingSolid soft{elastic, 0.05};
    for (const char* method : {"leapfrog", "rk4"}) {
        const Outcome fine = outcome(soft, method, 0.0125);
        std::array<double, 2> median{};
        for (const double dt : {0.4, 0.2, 0.1, 0.05}) {
            const Outcome within = outcome(soft, method, dt),
                          after = outcome(ReturnedAfterSteps{soft}, method, dt);
            const auto off = [&](const Outcome& o) {
                return (o.x - fine.x).colwise().norm().maxCoeff();
            };
            for (const auto& [what, o] : {std::pair{"within", &within}, {"after", &after}})
                BOOST_TEST_MESSAGE(method << ", dt " << dt << ", returned " << what << ": x off by "
                                          << off(*o) << ", heat " << o->heat << " of " << fine.heat
                                          << ", dE/E " << o->energy << ", in a step " << o->median
                                          << ", at most " << o->worst);
            BOOST_TEST(off(within) < 0.1 * off(after));
            BOOST_TEST(std::abs(within.heat / fine.heat - 1.0) < 0.01);
            BOOST_TEST(std::abs(after.heat / fine.heat - 1.0) > 0.01);
            BOOST_TEST(std::abs(within.energy) < 1e-3 * dt);
            median = {median[1], within.median};
        }
        BOOST_TEST(median[1] < 0.3 * median[0]);
    }
}

/// What new weights may store at a particle: a thousandth of V eta.
constexpr double stored_by_weights = 1e-3 * 0.43 / 1.2;

/// Of one particle in one step.
double largest_fall_of_heat(const MaterialVectorModel<2>& model, Motion<2>& motion, double until) {
    std::vector<double> before = model.law.heat_of_particles();
    double fall = 0.0;
    for (double t = 0.05; t < until; t += 0.05) {
        motion.advance_to(t);
        const std::vector<double>& now = model.law.heat_of_particles();
        for (std::size_t k = 0; k < now.size(); ++k) fall = std::max(fall, before[k] - now[k]);
        before = now;
    }
    return fall;
}

BOOST_AUTO_TEST_CASE(a_block_that_flows) {
    for (const auto& options : {IntegratorOptions{.method = "leapfrog", .dt = 0.05},
                                IntegratorOptions{.method = "rk4", .dt = 0.05}}) {
        MaterialVectorModel<2> model(make_particles<2>(triangular_block(12, 12), 1.0),
                                     FlowingSolid{elastic, 0.05}, usual);
        const auto y0 = initial_state<2>(model, 1.2, 0.43, [](const Point<2>& x) {
            return Point<2>(0.1 * x.y(), 0.05 * x.x());
        });
        Motion<2> motion(model, y0, options);
        const auto start = measure_invariants(model, motion.y());
        BOOST_TEST(largest_fall_of_heat(model, motion, 30.0) < stored_by_weights);
        const double heat = model.law.heat();
        const auto end = measure_invariants(model, motion.y());
        BOOST_TEST_MESSAGE(options.method
                           << ": heat " << heat / start.energy << " of the energy, dE/E "
                           << end.energy / start.energy - 1.0 << ", lists " << model.list_builds());
        BOOST_TEST(heat > 0.1 * start.energy);
        BOOST_TEST(std::abs(end.energy / start.energy - 1.0) < 1e-3);
        BOOST_TEST((end.momentum - start.momentum).norm() < 1e-11);
        BOOST_TEST((end.angular_momentum - start.angular_momentum).norm() <
                   1e-7 * start.angular_momentum.norm());
    }
}

/// Particles that are all but alone, vectors that are far from what they were, neighbours met within the range:
/// whatever is done to bonds, no particle gives back what was booked as heat.
BOOST_AUTO_TEST_CASE(heat_does_not_fall_where_a_block_is_torn) {
    for (const double bond_yield : {0.0, 4.0}) {
        MaterialVectorScheme scheme = usual;
        scheme.bond_yield = bond_yield;
        MaterialVectorModel<2> model(make_particles<2>(triangular_block(14, 12), 1.0),
                                     FlowingSolid{elastic, 0.005, 0.005}, scheme);
        const auto y0 = initial_state<2>(model, 1.2, 0.43, [](const Point<2>& x) {
            const double side = x.x() > 0.0 ? 1.0 : -1.0;
            return Point<2>(0.5 * side + 0.3 * x.y(), 0.6 * std::cos(2.0 * x.x()));
        });
        Motion<2> motion(model, y0, {.method = "leapfrog", .dt = 0.05});
        const auto start = measure_invariants(model, motion.y());
        const double fall = largest_fall_of_heat(model, motion, 80.0);
        BOOST_TEST(fall < stored_by_weights);
        const auto end = measure_invariants(model, motion.y());
        BOOST_TEST_MESSAGE("bond yield " << bond_yield << ": heat "
                                         << model.law.heat() / start.energy
                                         << " of the energy, falls by " << fall << ", dE/E "
                                         << end.energy / start.energy - 1.0);
        BOOST_TEST(model.law.heat() > 0.02 * start.energy);
        BOOST_TEST(std::abs(end.energy / start.energy - 1.0) < 1e-3);
    }
}

BOOST_AUTO_TEST_CASE(a_solid_of_the_reference_configuration_cannot_flow_so) {
    BOOST_TEST(refusal([] {
                   TotalLagrangianModel<2>(jittered_particles<2>(8, 101),
                                           FlowingSolid{elastic, 0.05}, {1.2, 2.6, 0.1});
               }).starts_with("material: '"));
}
