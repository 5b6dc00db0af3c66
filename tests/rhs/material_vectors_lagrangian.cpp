// SPDX-License-Identifier: GPL-3.0-or-later
// Where no neighbour comes or goes and no weight fades, a solid with material vectors is the total-Lagrangian one, but
// for the penalty: that of the total-Lagrangian solid is of pairs, by the F of both ends, that of material vectors is
// of one end each. So neither is a case of the other.
#include "support/turned_body.hpp"
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/lattices.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include <random>

using namespace spam;
using namespace spam::test;

namespace {

// Nearest neighbours alone, at a distance of 1: nearer than 0.7 h, where fading begins; the next are at 1.73.
constexpr double range = 1.5;

Particles<2> particles() { return make_particles<2>(triangular_block(12, 12), 1.0); }

/// Strained by up to a hundredth, turned by half a turn and more, moving.
template <class Model>
std::vector<double> state_of(Model& model) {
    std::vector<double> y(model.layout().size(), 0.0);
    auto x = State<2>(model.layout(), y).position();
    x = model.particles().reference_position;
    std::mt19937_64 random(301);
    std::uniform_real_distribution<double> u(-0.005, 0.005);
    for (auto& c : x.reshaped()) c += u(random);
    x = (Eigen::Rotation2Dd(3.7).toRotationMatrix() * x).eval();
    return y;
}

template <class Law>
double difference(const Law& law, double penalty) {
    MaterialVectorModel<2> bonded(particles(), law, MaterialVectorScheme{1.2, range, penalty});
    TotalLagrangianModel<2> lagrangian(particles(), law,
                                       TotalLagrangianScheme{1.2, range, penalty});
    const auto y = state_of(bonded);
    BOOST_TEST_REQUIRE((y == state_of(lagrangian)));
    return relative_difference(rates_of(bonded, y), rates_of(lagrangian, y));
}

}  // namespace

/// To what FitSolver adds for directions that no neighbour spans: 1e-13 of F, whose strains are a hundredth.
BOOST_AUTO_TEST_CASE(the_same_without_penalty) {
    BOOST_TEST(difference(StVenantKirchhoff{0.7, 0.4}, 0.0) < 2e-10);
    BOOST_TEST(difference(PolynomialSolid{0.7, 0.4}, 0.0) < 2e-10);
}

BOOST_AUTO_TEST_CASE(penalties_differ) {
    BOOST_TEST(difference(StVenantKirchhoff{0.7, 0.4}, 0.1) > 1e-3);
}
