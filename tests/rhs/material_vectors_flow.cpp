// SPDX-License-Identifier: GPL-3.0-or-later
// A solid with material vectors that yields: the return to the yield surface, what it leaves as it is, and a
// block that flows while energy with heat, p and L are kept.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/total_energy.hpp>
#include <spam/material/flowing_solid.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

constexpr PolynomialSolid elastic{0.43, 0.43};
constexpr MaterialVectorScheme usual{1.2, 2.6, 1.0};

template <int Dim>
Mat<Dim> random_gradient(unsigned seed, double size) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> g;
    Mat<Dim> F;
    for (double& f : F.c) f = size * g(random);
    for (int a = 0; a < Dim; ++a) F(a, a) += 1.0;
    return F;
}

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

}  // namespace

BOOST_AUTO_TEST_CASE(the_return_ends_on_the_yield_surface) {
    check_the_return<2>();
    check_the_return<3>();
}
BOOST_AUTO_TEST_CASE(yielding_leaves_separations_and_energy_with_heat) {
    check_what_stays<2>();
    check_what_stays<3>();
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
        double heat = 0.0;
        for (double t = 1.0; t <= 30.0; t += 1.0) {
            motion.advance_to(t);
            BOOST_TEST(model.law.heat() > heat - 1e-3 * start.energy);
            heat = model.law.heat();
        }
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

BOOST_AUTO_TEST_CASE(a_solid_of_the_reference_configuration_cannot_flow_so) {
    BOOST_TEST(refusal([] {
                   TotalLagrangianModel<2>(jittered_particles<2>(8, 101),
                                           FlowingSolid{elastic, 0.05}, {1.2, 2.6, 0.1});
               }).starts_with("material: '"));
}
