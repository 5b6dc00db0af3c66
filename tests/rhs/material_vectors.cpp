// SPDX-License-Identifier: GPL-3.0-or-later
// A solid with material vectors against its formulas (support/material_vector_oracle.hpp), and what it
// keeps: whatever its table holds, its forces are the slope of an energy that knows neither origin nor axes,
// and changes of the table leave that energy as it is. Each property with a law that fails.
#include "support/material_vector_oracle.hpp"
#include "support/turned_body.hpp"
#include <spam/material/polynomial_solid.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

constexpr PolynomialSolid solid{0.7, 0.4};

MaterialVectorScheme scheme(double penalty) { return {1.2, 2.6, penalty}; }

template <int Dim>
MaterialVectorModel<Dim> model_of(double penalty) {
    return {jittered_particles<Dim>(Dim == 2 ? 7 : 4, 91), solid, scheme(penalty)};
}

/// Far from the start: stretched along one axis, every particle displaced by up to 0.2, one pulled
/// out of the body, turned and moved.
template <int Dim>
std::vector<double> deformed_state(const Model<Dim>& model, unsigned seed, double stretch = 1.3,
                                   double pull = 0.0) {
    auto y = random_state(model, seed);
    std::mt19937_64 random(seed + 1);
    std::uniform_real_distribution<double> u(-0.2, 0.2);
    auto x = State<Dim>(model.layout(), y).position();
    for (auto& c : x.reshaped()) c += u(random);
    x.row(0) *= stretch;
    const Point<Dim> out = x.col(0) - x.rowwise().mean();
    x.col(0) += pull / out.norm() * out;
    x = (rotation<Dim>(2.1) * x).eval();
    x.array() += 5.3;
    return y;
}

/// The same, with the particle so far out that it is neither whole nor alone.
template <int Dim>
std::vector<double> torn_state(const MaterialVectorModel<Dim>& model, unsigned seed,
                               double stretch = 1.3) {
    for (double pull = 0.5;; pull += 0.05) {
        auto y = deformed_state<Dim>(model, seed, stretch, pull);
        BOOST_TEST_REQUIRE(pull < 4.0);
        if (MaterialVectorOracle<Dim>(model, 0.7, 0.4, y).partly_whole(y) > 0) return y;
    }
}

/// Whether the table changed in a way that rates see.
template <int Dim>
bool settle(MaterialVectorModel<Dim>& model, std::vector<double>& y) {
    return model.settle(0.0, y);
}

template <int Dim>
void check_properties() {
    for (const double penalty : {0.0, 1.0})
        for (const bool new_neighbours : {false, true})
            BOOST_TEST_CONTEXT(Dim << " dimensions, penalty " << penalty
                                   << (new_neighbours ? ", new neighbours" : "")) {
                auto model = model_of<Dim>(penalty);
                constexpr unsigned seed = Dim == 2 ? 93 : 96;
                auto y = torn_state<Dim>(model, seed);
                if (new_neighbours) {
                    settle<Dim>(model, y);
                    y = torn_state<Dim>(model, seed + 100, 1.2);
                }
                const MaterialVectorOracle<Dim> oracle(model, 0.7, 0.4, y);
                const auto force = forces_of<Dim>(model, y);
                BOOST_TEST(relative_difference(force, forces_of<Dim>(oracle, y)) < 1e-10);
                const double energy = oracle.energy(y) + model.law.heat();
                BOOST_TEST(std::abs(model.internal_energy(y) / energy - 1.0) < 1e-11);
                BOOST_TEST(slope_error<Dim>(model, y, 4e-5) < 1e-9);
                BOOST_TEST(invariance_error<Dim>(model, y) < 1e-11);
                const auto [p, L] = residuals<Dim>(y, force);
                BOOST_TEST(p < 1e-14);
                BOOST_TEST(L < 1e-14);
            }
}

template <int Dim>
void check_that_they_can_fail() {
    auto model = model_of<Dim>(1.0);
    const auto y = torn_state<Dim>(model, Dim == 2 ? 93 : 96);
    const auto wrong = [&](BondMutation mutation) {
        return MaterialVectorOracle<Dim>(model, 0.7, 0.4, y, mutation);
    };
    const auto slope_error_of = [&](BondMutation mutation) {
        const auto oracle = wrong(mutation);
        return slope_error(
            y, forces_of<Dim>(oracle, y), [&](const auto& z) { return oracle.energy(z); }, 4e-5);
    };
    BOOST_TEST(slope_error_of(BondMutation::none) < 1e-9);
    BOOST_TEST(slope_error_of(BondMutation::fixed_weight) < 1e-9);  // other weights, one energy
    for (const auto mutation :
         {BondMutation::no_fade, BondMutation::one_sided, BondMutation::no_misfit})
        BOOST_TEST(slope_error_of(mutation) > 1e-3);
    BOOST_TEST(slope_error_of(BondMutation::misfit_apart) > 1e-5);
    const auto expected = forces_of<Dim>(model, y);
    for (const auto mutation : {BondMutation::no_fade, BondMutation::one_sided,
                                BondMutation::fixed_weight, BondMutation::no_misfit})
        BOOST_TEST(relative_difference(forces_of<Dim>(wrong(mutation), y), expected) > 1e-3);
    const auto one_sided = residuals<Dim>(y, forces_of<Dim>(wrong(BondMutation::one_sided), y));
    BOOST_TEST(one_sided[0] > 1e-3);
    BOOST_TEST(one_sided[1] > 1e-3);
}

// ---- changes of the table ----

/// All move as one linear map, so that e = 0 and F is what it is: from 1 by steps to `shape`.
template <int Dim>
std::vector<double> flowing_state(const Model<Dim>& model, double shear, double noise) {
    std::vector<double> y(model.layout().size(), 0.0);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> u(-noise, noise);
    const auto& X = model.particles().reference_position;
    auto x = State<Dim>(model.layout(), y).position();
    x = X;
    x.row(0) += shear * X.row(1);
    for (auto& c : x.reshaped()) c += u(random);
    return y;
}

/// In steps so short that no particle enters before it is seen: not a bit of the energy or of the rates changes.
template <int Dim>
void check_that_they_enter_with_no_trace() {
    auto model = model_of<Dim>(1.0);
    std::size_t pairs = model.pairs();
    int changes = 0;
    for (double shear = 0.0; shear < 0.6; shear += 0.01) {
        auto y = flowing_state<Dim>(model, shear, 0.02);
        const double energy = model.internal_energy(y);
        const auto rates = rates_of(model, y);
        BOOST_TEST(!settle<Dim>(model, y));
        BOOST_TEST(model.internal_energy(y) == energy);
        BOOST_TEST((rates_of(model, y) == rates));
        changes += pairs != model.pairs();
        pairs = model.pairs();
    }
    BOOST_TEST(changes >= 3);
    BOOST_TEST(model.law.heat() == 0.0);
}

/// In one long step: rates change, but no F and, where all are whole, no energy.
template <int Dim>
void check_that_they_enter_late() {
    auto model = model_of<Dim>(1.0);
    auto y = flowing_state<Dim>(model, 0.3, 0.1);
    const double energy = model.internal_energy(y);
    const auto F = model.law.deformation_gradients(y);
    const auto rates = rates_of(model, y);
    BOOST_TEST(settle<Dim>(model, y));
    BOOST_TEST(relative_difference(rates_of(model, y), rates) > 1e-6);
    BOOST_TEST(std::abs(model.internal_energy(y) / energy - 1.0) < 1e-13);
    BOOST_TEST(std::abs(model.law.heat()) < 1e-13 * energy);
    double worst = 0.0;
    const auto after = model.law.deformation_gradients(y);
    for (std::size_t k = 0; k < F.size(); ++k)
        for (std::size_t c = 0; c < F[k].c.size(); ++c)
            worst = std::max(worst, std::abs(after[k].c[c] - F[k].c[c]));
    BOOST_TEST(worst < 1e-12);
    BOOST_TEST(!settle<Dim>(model, y));  // no particle has moved since
}

/// Where particles that are not whole find neighbours within the range, what Phi loses is heat.
template <int Dim>
void check_that_late_entries_are_booked() {
    auto model = model_of<Dim>(1.0);
    auto y = deformed_state<Dim>(model, 94, 1.3, 2.2);
    const double energy = model.internal_energy(y);
    settle<Dim>(model, y);
    BOOST_TEST(std::abs(model.internal_energy(y) / energy - 1.0) < 1e-13);
    auto nearer = deformed_state<Dim>(model, 94);
    const double before = model.internal_energy(nearer);
    BOOST_TEST(settle<Dim>(model, nearer));
    BOOST_TEST(model.law.heat() != 0.0);
    BOOST_TEST(std::abs(model.internal_energy(nearer) / before - 1.0) < 1e-13);
}

}  // namespace

BOOST_AUTO_TEST_CASE(neighbours_enter_with_no_trace) {
    check_that_they_enter_with_no_trace<2>();
    check_that_they_enter_with_no_trace<3>();
}
BOOST_AUTO_TEST_CASE(neighbours_enter_late) {
    check_that_they_enter_late<2>();
    check_that_they_enter_late<3>();
}
BOOST_AUTO_TEST_CASE(what_late_ones_cost_is_heat) {
    check_that_late_entries_are_booked<2>();
    check_that_late_entries_are_booked<3>();
}
BOOST_AUTO_TEST_CASE(forces_are_the_slope_of_an_energy_in_the_plane) { check_properties<2>(); }
BOOST_AUTO_TEST_CASE(forces_are_the_slope_of_an_energy_in_space) { check_properties<3>(); }
BOOST_AUTO_TEST_CASE(wrong_laws_fail_in_the_plane) { check_that_they_can_fail<2>(); }
BOOST_AUTO_TEST_CASE(wrong_laws_fail_in_space) { check_that_they_can_fail<3>(); }
