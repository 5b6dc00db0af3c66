// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies with material vectors after their neighbours have changed: two that share a table meet and part with no
// bond left, and one that was sheared plastically, until a third of its close pairs was new, turns without drift.
#include "support/effort.hpp"
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/shape.hpp>
#include <spam/material/flowing_solid.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/contact.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace spam;
using spam::test::effort;

namespace {

const double rho = std::sqrt(4.0 / 3.0);
const auto elastic = PolynomialSolid::like(ElasticSolid::triangular_lattice());

/// Two hexagons of 91 that fly at each other, corner to corner, so far apart that none has bonds with the other;
/// of one body, which shares a table, or of two, which touch.
struct Meeting {
    explicit Meeting(bool share) {
        Points<2> left = triangular_hexagon(5), right = left;
        left.row(0).array() -= 7.0;
        right.row(0).array() += 7.0;
        auto both = joined<2>({make_particles<2>(left, 1.0), make_particles<2>(right, 1.0)});
        if (share) both.body.assign(both.size(), 0);
        model = std::make_unique<ParticleModel<2>>(std::move(both));
        law = &model->add_term<MaterialVectors<2>>(elastic, MaterialVectorScheme{rho});
        if (!share) model->add_term<Contact<2>>(ContactScheme{0.2, 1.0});
        y0 = initial_state<2>(*model, 1.0, 1.0, [](const Point<2>& x) {
            return Point<2>(x.x() < 0.0 ? 0.1 : -0.1, 0.0);
        });
    }
    /// Bonds of the first with the second that weigh something.
    std::size_t across(std::span<const double> y) const {
        const std::size_t half = model->particles().size() / 2;
        std::size_t count = 0;
        for (std::size_t k = 0; k < half; ++k)
            for (const auto& bond : law->bonds(y, k))
                count += bond.partner >= half && bond.weight > 0.0;
        return count;
    }

    std::unique_ptr<ParticleModel<2>> model;
    MaterialVectors<2>* law = nullptr;
    std::vector<double> y0;
};

void check_a_bounce(bool share, double least_speed) {
    const Meeting meeting(share);
    Motion<2> motion(*meeting.model, meeting.y0, {.method = "rk4", .dt = 0.025});
    const auto start = measure_invariants(*meeting.model, motion.y());
    BOOST_TEST(meeting.across(motion.y()) == 0U);
    std::size_t most = 0;
    for (double t = 5.0; t <= 120.0; t += 5.0) {
        motion.advance_to(t);
        most = std::max(most, meeting.across(motion.y()));
    }
    const auto end = measure_invariants(*meeting.model, motion.y());
    const auto n = static_cast<Eigen::Index>(meeting.model->particles().size() / 2);
    const auto v = motion.state().velocity();
    const double parting = (v.row(0).tail(n).mean() - v.row(0).head(n).mean()) / 0.2;
    BOOST_TEST_MESSAGE((share ? "one table: " : "contact: ")
                       << "at most " << most << " bonds, they part with " << parting
                       << " of the speed, dE/E " << end.energy / start.energy - 1.0 << ", dL "
                       << end.angular_momentum.norm());
    BOOST_TEST((most > 0) == share);
    BOOST_TEST(meeting.across(motion.y()) == 0U);
    BOOST_TEST(parting > least_speed);
    BOOST_TEST(parting < 1.0);
    BOOST_TEST(std::abs(end.energy / start.energy - 1.0) < 1e-6);
    BOOST_TEST(end.momentum.norm() < 1e-12);
    BOOST_TEST(end.angular_momentum.norm() < 1e-9 * 0.1 * 7.0 * end.mass);  // of sum m |x||v|
}

std::set<std::pair<std::uint32_t, std::uint32_t>> close_pairs(const Points<2>& x) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    const PairList<2> near(x, 1.5, {});
    for (std::uint32_t i = 0; i < near.size(); ++i)
        for (const std::uint32_t j : near.neighbours(i))
            if (i < j) pairs.emplace(i, j);
    return pairs;
}

/// A hexagon drawn out to twice its length, half its height, in steps so short that neighbours enter before they
/// weigh anything; then let go, so that nothing is stressed. y with these positions, at rest.
std::vector<double> drawn_out(MaterialVectorModel<2>& model) {
    auto y = initial_state<2>(model, 1.0, 1.0, at_rest<2>());
    auto x = State<2>(model.layout(), y).position();
    constexpr int steps = 1400;
    const double each = std::pow(2.0, 1.0 / steps);
    for (int k = 0; k < steps; ++k) {
        x.row(0) *= each;
        x.row(1) /= each;
        model.settle(0.0, y);
    }
    // All deform alike: F of any particle is that of all.
    const Mat<2> F = model.law.deformation_gradients(y)[0];
    Eigen::Matrix2d back;
    back << F(0, 0), F(0, 1), F(1, 0), F(1, 1);
    x = (back.inverse() * x).eval();
    model.settle(0.0, y);
    return y;
}

}  // namespace

BOOST_AUTO_TEST_CASE(two_bodies_that_share_a_table_bounce) { check_a_bounce(true, 0.98); }
BOOST_AUTO_TEST_CASE(two_bodies_that_touch_bounce) { check_a_bounce(false, 0.7); }

BOOST_AUTO_TEST_CASE(a_hexagon_that_has_been_drawn_out_turns_without_drift) {
    MaterialVectorModel<2> model(make_particles<2>(triangular_hexagon(8), 1.0),
                                 FlowingSolid{elastic, 0.05}, {rho});
    auto y = drawn_out(model);
    const double heat = model.law.heat();
    BOOST_TEST(heat > 1.0);
    BOOST_TEST(model.internal_energy(y) - heat < 1e-10);
    const State<2> state(model.layout(), y);
    const Points<2> X = state.position();
    const auto before = close_pairs(model.particles().reference_position), after = close_pairs(X);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> fresh;
    std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                        std::back_inserter(fresh));
    const double part = static_cast<double>(fresh.size()) / static_cast<double>(after.size());
    BOOST_TEST(part > 0.3);

    const double length = X.row(0).maxCoeff(), omega = 0.1 / length,
                 turn = 2.0 * std::numbers::pi / omega;
    state.velocity().row(0) = -omega * X.row(1);
    state.velocity().row(1) = omega * X.row(0);
    Motion<2> motion(model, y, {.method = "leapfrog", .dt = 0.3});
    const auto start = measure_invariants(model, motion.y());
    const int turns = effort(20, 8, 2);
    std::vector<double> shape(static_cast<std::size_t>(turns), 0.0);
    double closest = 1.0, L = 0.0, E = 0.0;
    for (int k = 1; k <= 20 * turns; ++k) {
        motion.advance_to(k * turn / 20.0);
        const Points<2> x = motion.state().position();
        double& largest = shape[static_cast<std::size_t>((k - 1) / 20)];
        largest = std::max(largest, shape_error<2>(X, x, 1.0));
        closest = std::min(closest, closest_pair<2>(x, 1.0, {}));
        const auto now = measure_invariants(model, motion.y());
        L = std::max(L, std::abs(now.angular_momentum[0] / start.angular_momentum[0] - 1.0));
        E = std::max(E, std::abs((now.energy - start.energy) / start.kinetic));
    }
    BOOST_TEST_MESSAGE("new pairs " << part << ", length " << length << ", shape " << shape.front()
                                    << " in the first turn, " << shape.back()
                                    << " in the last, closest pair " << closest << ", at the start "
                                    << closest_pair<2>(X, 1.0, {}) << ", dL/L " << L << ", dE " << E
                                    << ", heat of turning " << model.law.heat() - heat);
    BOOST_TEST(model.law.heat() - heat == 0.0, boost::test_tools::tolerance(1e-12));
    const double most = *std::max_element(shape.begin(), shape.end());
    BOOST_TEST(most < 1.2 * shape.front());
    BOOST_TEST(most < 0.05);
    BOOST_TEST(closest > 0.95 * closest_pair<2>(X, 1.0, {}));
    BOOST_TEST(L < 1e-12);
    BOOST_TEST(E < 1e-4);
}
