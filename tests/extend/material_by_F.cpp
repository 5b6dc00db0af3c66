// SPDX-License-Identifier: GPL-3.0-or-later
// A material by F of one's own, in one file, in solids that keep their reference and in those with material vectors: a
// rubber, W = mu (F:F - D - 2 ln J)/2 + kappa (ln J)^2/2.
#include <spam/diagnostics/invariants.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;
namespace {

struct Rubber {
    double mu = 0.43, kappa = 0.43;

    template <int Dim>
    double energy(const Mat<Dim>& F) const {
        double squares = 0.0;
        for (const double f : F.c) squares += f * f;
        const double log_J = std::log(determinant(F));
        return 0.5 * mu * (squares - Dim - 2.0 * log_J) + 0.5 * kappa * log_J * log_J;
    }
    template <int Dim>
    Mat<Dim> stress(const Mat<Dim>& F) const {
        const Mat<Dim> back = inverse(F);
        const double pressure = kappa * std::log(determinant(F)) - mu;
        Mat<Dim> P;
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b) P(a, b) = mu * F(a, b) + pressure * back(b, a);
        return P;
    }
    double stiffness() const { return mu; }
    std::string describe() const { return "rubber"; }
};

/// Frequency of a bar that is stretched and let go, by its first return; p, L and E are kept on the way.
template <int Dim, class Law, class Scheme>
double first_swing(const Scheme& scheme) {
    std::array<int, Dim> cells{};
    cells.fill(5);
    cells[0] = 9;
    ParticleModel<Dim> model(make_particles<Dim>(square_lattice<Dim>(cells), 1.0, 1.0));
    model.template add_term<Law>(Rubber{}, scheme);
    const auto y0 = initial_state<Dim>(model, 1.0, 0.43, [](const Point<Dim>& x) {
        Point<Dim> v = Point<Dim>::Zero();
        v[0] = 0.05 * (x[0] - 4.0);
        return v;
    });
    IntegratorOptions rk4;
    rk4.dt = 0.1;
    Motion<Dim> motion(model, y0, rk4);
    const auto before = measure_invariants<Dim>(model, motion.y());
    double kinetic = 1e300, turned = 0.0;
    for (double t = 0.5; t < 40.0; t += 0.5) {
        motion.advance_to(t);
        const double now = measure_invariants<Dim>(model, motion.y()).kinetic;
        if (turned == 0.0 && now > kinetic) turned = t;
        kinetic = now;
    }
    const auto after = measure_invariants<Dim>(model, motion.y());
    BOOST_TEST((after.momentum - before.momentum).norm() < 1e-12);
    BOOST_TEST((after.angular_momentum - before.angular_momentum).norm() < 1e-10);
    BOOST_TEST(std::abs(after.energy - before.energy) < 1e-4 * before.energy);
    return turned;
}

}  // namespace

BOOST_AUTO_TEST_CASE(two_formulations_swing_alike) {
    const double flat = first_swing<2, TotalLagrangian<2>>(TotalLagrangianScheme{1.0, 2.6});
    BOOST_TEST(flat > 1.0);
    BOOST_TEST(std::abs(first_swing<2, MaterialVectors<2>>(MaterialVectorScheme{1.0, 2.6}) -
                        flat) <= 0.15 * flat);
    const double deep = first_swing<3, TotalLagrangian<3>>(TotalLagrangianScheme{1.0, 2.6});
    BOOST_TEST(deep > 1.0);
    BOOST_TEST(std::abs(first_swing<3, MaterialVectors<3>>(MaterialVectorScheme{1.0, 2.6}) -
                        deep) <= 0.15 * deep);
}
