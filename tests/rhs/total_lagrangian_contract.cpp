// SPDX-License-Identifier: GPL-3.0-or-later
// What a total-Lagrangian solid owes the house: no history and no thread count in its bits, states
// without meaning named, any hyperelastic law, bad input refused in a line.
#include "support/refusal.hpp"
#include "support/turned_body.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/total_lagrangian.hpp>

#include <boost/test/unit_test.hpp>

#include <limits>
#include <numeric>

using namespace spam;
using namespace spam::test;

namespace {

const StVenantKirchhoff solid{0.7, 0.4};
const TotalLagrangianScheme usual{1.2, 2.6, 0.1};

/// Energy (eta/2) (F:F - 2 - 2 ln J) + (lambda/2) (ln J)^2 in the plane, J = det F > 0.
struct NeoHookean {
    double lambda, eta;

    double stiffness() const { return lambda; }
    std::string describe() const { return "neo-Hookean"; }
    static double J(const Mat<2>& F) { return F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0); }
    double energy(const Mat<2>& F) const {
        double square = -2.0;
        for (const double f : F.c) square += f * f;
        return 0.5 * eta * (square - 2.0 * std::log(J(F))) +
               0.5 * lambda * std::pow(std::log(J(F)), 2);
    }
    Mat<2> stress(const Mat<2>& F) const {  // eta F + (lambda ln J - eta) F^-t
        const double s = (lambda * std::log(J(F)) - eta) / J(F);
        Mat<2> P;
        P(0, 0) = eta * F(0, 0) + s * F(1, 1);
        P(0, 1) = eta * F(0, 1) - s * F(1, 0);
        P(1, 0) = eta * F(1, 0) - s * F(0, 1);
        P(1, 1) = eta * F(1, 1) + s * F(0, 0);
        return P;
    }
};

using spam::test::refusal;
std::string refusal(const TotalLagrangianScheme& scheme, const StVenantKirchhoff& law = solid,
                    const Box<2>& box = {}) {
    return refusal([&] {
        TotalLagrangianModel<2>(jittered_particles<2>(8, 101, 0.15, box), law, scheme, box);
    });
}

}  // namespace

BOOST_AUTO_TEST_CASE(threads_and_history_leave_no_trace) {
    const auto particles = jittered_particles<2>(40, 102);
    BOOST_TEST(particles.size() > parallel_threshold);
    TotalLagrangianModel<2> model(particles, solid, usual);
    const auto y = moved(model, 0.2, 103), other = moved(model, 3.0, 104);
    const auto one = rates_of(model, y);
    rates_of(model, other);
    for (const int threads : {1, 2, 3}) {
        set_threads(threads);
        BOOST_TEST((rates_of(model, y) == one));
        model.internal_energy(other);
        BOOST_TEST((rates_of(model, y) == one));
    }
    set_threads(1);
}

BOOST_AUTO_TEST_CASE(numbers_are_names_only) {
    // Shuffled, slots are no longer numbers.
    const auto particles = jittered_particles<2>(20, 105);
    std::vector<std::size_t> order(particles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937_64(106));
    Particles<2> shuffled = particles;
    TotalLagrangianModel<2> model(particles, solid, usual);
    const auto y = moved(model, 0.2, 107);
    auto z = y;
    const std::size_t n = particles.size();
    for (std::size_t k = 0; k < n; ++k) {
        shuffled.mass[k] = particles.mass[order[k]];
        shuffled.reference_position.col(static_cast<Eigen::Index>(k)) =
            particles.reference_position.col(static_cast<Eigen::Index>(order[k]));
        for (std::size_t c = 0; c < 4; ++c) {
            const std::size_t block = c < 2 ? c : 2 * n + c - 2;
            z[block + 2 * k] = y[block + 2 * order[k]];
        }
    }
    TotalLagrangianModel<2> again(shuffled, solid, usual);
    const auto expected = rates_of(model, y), found = rates_of(again, z);
    double worst = 0.0;
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t c = 0; c < 2; ++c)
            worst = std::max(worst,
                             std::abs(found[2 * (n + k) + c] - expected[2 * (n + order[k]) + c]));
    BOOST_TEST(worst < 1e-13);
    BOOST_TEST(std::abs(model.internal_energy(y) - again.internal_energy(z)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(states_without_meaning_are_named) {
    TotalLagrangianModel<2> model(jittered_particles<2>(7, 108), solid, usual);
    const auto good = moved(model, 0.1, 109);
    rates_of(model, good);
    BOOST_TEST(model.failure().empty());
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1e200}) {
        auto y = good;
        y[5] = bad;
        const auto y_dot = rates_of(model, y);
        BOOST_TEST(std::isnan(y_dot[0]));
        BOOST_TEST(std::isnan(y_dot.back()));
        const char* what = bad == 1e200 ? "the stress of particle" : "the deformation gradient of";
        BOOST_TEST(model.failure().find(what) == 0U, model.failure());
    }
    rates_of(model, good);
    BOOST_TEST(model.failure().empty());
}

BOOST_AUTO_TEST_CASE(any_hyperelastic_law) {
    TotalLagrangianModel<2> model(jittered_particles<2>(7, 108), NeoHookean{0.7, 0.4}, usual);
    auto y = moved(model, 0.05, 110);
    const auto y_dot = rates_of(model, y);
    const std::size_t n = model.particles().size();
    const double h = 1e-5;
    for (std::size_t k = 0; k < 2 * n; k += 11) {
        auto forward = y, backward = y;
        forward[k] += h;
        backward[k] -= h;
        const double slope =
            (model.internal_energy(forward) - model.internal_energy(backward)) / (2.0 * h);
        BOOST_TEST(std::abs(model.particles().mass[k / 2] * y_dot[2 * n + k] + slope) < 1e-8);
    }
    // A mirror image has no neo-Hookean stress.
    State<2>(model.layout(), y).position().row(0) *= -1.0;
    BOOST_TEST(std::isnan(rates_of(model, y)[0]));
    BOOST_TEST(model.failure().find("the stress of particle") == 0U, model.failure());
    BOOST_TEST(model.density(y)[0] < 0.0);
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    BOOST_TEST(refusal(usual) == "accepted");
    BOOST_TEST(refusal({0.0, 2.6, 0.1}).starts_with("density: 0"));
    BOOST_TEST(refusal({1.2, 0.9, 0.1}).starts_with("range: 0.9"));
    BOOST_TEST(refusal({1.2, 2.6, -0.1}).starts_with("penalty: -0.1"));
    BOOST_TEST(refusal({1.2, 2.6, HUGE_VAL}).starts_with("penalty: inf"));
    BOOST_TEST(refusal(usual, {0.0, 0.0}).starts_with("penalty: 0.1 is measured"));
    BOOST_TEST(refusal(usual, {0.0, 0.4}) == "accepted");  // rods of Poisson ratio 0
    BOOST_TEST(refusal({1.2, 2.6, 0.0}, {0.0, 0.0}) == "accepted");
    BOOST_TEST(refusal(usual, solid, Box<2>({0.5, 0.0})).starts_with("box: periodic length 0.5"));
    // A row of particles has no gradient across.
    BOOST_TEST(refusal([] {
                   const auto row = make_particles<2>(triangular_block(9, 1), 1.0);
                   TotalLagrangianModel<2>(row, solid, usual);
               }).find("too few neighbours") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_it_says_of_itself) {
    const Box<2> box({8.0, 8.0 * std::sqrt(0.75)});
    TotalLagrangianModel<2> open(jittered_particles<2>(8, 101), solid, usual),
        closed(jittered_particles<2>(8, 101, 0.15, box), solid, usual, box);
    BOOST_TEST((open.promises().momentum == Promise::exact));
    BOOST_TEST((open.promises().angular_momentum == Promise::integrator_error));
    BOOST_TEST((closed.promises().angular_momentum == Promise::not_kept));
    for (const char* words : {"St Venant-Kirchhoff", "range 2.6", "kappa = 0.1", "density 1.2"})
        BOOST_TEST((open.describe().find(words) != std::string::npos), words);
    BOOST_TEST(closed.pairs() > open.pairs());
}
