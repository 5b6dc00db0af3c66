// SPDX-License-Identifier: GPL-3.0-or-later
// Exact solutions beside the gases of shock_tube and blast: Toro's numbers, jumps across shocks, adiabats in fans, a
// vacuum; Sedov's constants, and conservation across his profile.
#include "blast/sedov.hpp"
#include "shock_tube/riemann.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <numbers>

using blast::Sedov;
using shock_tube::GasState;
using shock_tube::RiemannProblem;

namespace {

struct Known {
    GasState left, right;
    double P, u, rho_left, rho_right;  ///< between the waves: Toro's table 4.3
};
const Known toro[] = {{{1.0, 0.0, 1.0}, {0.125, 0.0, 0.1}, 0.30313, 0.92745, 0.42632, 0.26557},
                      {{1.0, -2.0, 0.4}, {1.0, 2.0, 0.4}, 0.00189, 0.0, 0.02185, 0.02185},
                      {{1.0, 0.0, 1000.0}, {1.0, 0.0, 0.01}, 460.894, 19.5975, 0.57506, 5.99924},
                      {{1.0, 0.0, 0.01}, {1.0, 0.0, 100.0}, 46.0950, -6.19633, 5.99242, 0.57511},
                      {{5.99924, 19.5975, 460.894},
                       {5.99242, -6.19633, 46.0950},
                       1691.64,
                       8.68975,
                       14.2823,
                       31.0426}};

/// Mass, momentum and energy that pass a wave of this speed, by their sizes.
double jump(const GasState& a, const GasState& b, double speed, double gamma) {
    const auto fluxes = [&](const GasState& s, double out[3]) {
        const double m = s.rho * (s.u - speed), v = s.u - speed;
        out[0] = m;
        out[1] = m * v + s.P;
        out[2] = m * (s.energy(gamma) + 0.5 * v * v) + s.P * v;
    };
    double one[3], other[3], worst = 0.0;
    fluxes(a, one), fluxes(b, other);
    for (int k = 0; k < 3; ++k)
        worst = std::max(worst, std::abs(one[k] - other[k]) / std::abs(one[k]));
    return worst;
}

}  // namespace

BOOST_AUTO_TEST_CASE(riemann_problems_have_the_values_of_the_book) {
    for (const Known& known : toro) {
        const RiemannProblem exact(known.left, known.right, 1.4);
        BOOST_TEST(!exact.vacuum());
        BOOST_TEST(std::abs(exact.pressure() - known.P) < 6e-6 * std::max(1.0, known.P));
        BOOST_TEST(std::abs(exact.velocity() - known.u) < 6e-6 * std::max(1.0, std::abs(known.u)));
        BOOST_TEST(std::abs(exact.density(false) - known.rho_left) <
                   6e-6 * std::max(1.0, known.rho_left));
        BOOST_TEST(std::abs(exact.density(true) - known.rho_right) <
                   6e-6 * std::max(1.0, known.rho_right));
    }
}

BOOST_AUTO_TEST_CASE(waves_keep_what_they_must) {
    constexpr double off = 1e-9;
    for (const double gamma : {1.2, 1.4, 5.0 / 3.0, 3.0})
        for (const Known& known : toro) {
            const RiemannProblem exact(known.left, known.right, gamma);
            if (exact.vacuum()) continue;
            for (const bool right : {false, true}) {
                const GasState& outside = right ? known.right : known.left;
                const double sign = right ? 1.0 : -1.0, edge = exact.inner_speed(right);
                const GasState inside = exact.at(edge - sign * off * std::abs(edge), 1.0);
                const GasState ahead = exact.at(edge + sign * off * std::abs(edge), 1.0);
                if (exact.shock(right)) {
                    BOOST_TEST(ahead.rho == outside.rho);
                    BOOST_TEST(jump(ahead, inside, edge, gamma) < 1e-10);
                    continue;
                }
                // In fans P/rho^gamma and u -+ 2 c/(gamma - 1) are those of the gas outside.
                const double head = outside.u + sign * outside.sound_speed(gamma);
                for (const double part : {0.1, 0.5, 0.9}) {
                    const double s = edge + part * (head - edge);
                    const GasState in = exact.at(s, 1.0);
                    BOOST_TEST(std::abs(in.P / std::pow(in.rho, gamma) /
                                            (outside.P / std::pow(outside.rho, gamma)) -
                                        1.0) < 1e-10);
                    BOOST_TEST(std::abs(in.u + sign * in.sound_speed(gamma) - s) <
                               1e-9 * std::abs(s));
                    BOOST_TEST(std::abs(in.u - outside.u -
                                        sign * 2.0 / (gamma - 1.0) *
                                            (in.sound_speed(gamma) - outside.sound_speed(gamma))) <
                               1e-9 * outside.sound_speed(gamma));
                }
            }
        }
}

BOOST_AUTO_TEST_CASE(gases_that_part_leave_a_vacuum) {
    const GasState left{1.0, -4.0, 0.4}, right{1.0, 4.0, 0.4};
    const double gamma = 1.4, escape = 4.0 - 2.0 * left.sound_speed(gamma) / (gamma - 1.0);
    const RiemannProblem exact(left, right, gamma);
    BOOST_TEST(exact.vacuum());
    BOOST_TEST(exact.inner_speed(true) == escape, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(exact.at(0.0, 1.0).rho == 0.0);
    BOOST_TEST(exact.at(0.0, 1.0).energy(gamma) == 0.0);
    BOOST_TEST(exact.at(0.9 * escape, 1.0).P == 0.0);
    BOOST_TEST(exact.at(1.01 * escape, 1.0).rho > 0.0);
    BOOST_TEST(exact.at(1.01 * escape, 1.0).rho < 1e-4);
    BOOST_TEST(exact.at(-5.0, 1.0).rho == 1.0);
    // The second of Toro's tests is one for stiffer gases.
    BOOST_TEST(!RiemannProblem(toro[1].left, toro[1].right, 1.86).vacuum());
    BOOST_TEST(RiemannProblem(toro[1].left, toro[1].right, 1.87).vacuum());
}

/// J. R. Kamm and F. X. Timmes (2007), for explosions in 1, 2 and 3 dimensions (a plane's is half of it).
BOOST_AUTO_TEST_CASE(explosions_have_their_known_constants) {
    const double alpha[] = {2.0 * 0.538548, 0.984041, 0.851072};
    for (int dim = 1; dim <= 3; ++dim) {
        const Sedov exact(1.4, dim);
        BOOST_TEST(std::pow(exact.xi_0(), -(dim + 2.0)) == alpha[dim - 1],
                   boost::test_tools::tolerance(1e-3));
        BOOST_TEST(exact.radius(exact.time(0.7, 2.0, 3.0), 2.0, 3.0) == 0.7,
                   boost::test_tools::tolerance(1e-12));
    }
    BOOST_TEST(Sedov(5.0 / 3.0, 3).xi_0() == 1.1517, boost::test_tools::tolerance(1e-4));
    // What is swept up is all there is, and pressure is left at the centre.
    for (const double gamma : {1.2, 1.4, 5.0 / 3.0, 2.0, 3.0})
        for (int dim = 1; dim <= 3; ++dim) {
            const Sedov exact(gamma, dim);
            double mass = 0.0;
            constexpr int n = 20000;
            for (int k = 0; k < n; ++k) {
                const double r = (k + 0.5) / n;
                mass += dim * std::pow(r, dim - 1) * (gamma + 1.0) / (gamma - 1.0) *
                        exact.at(r).density / n;
            }
            BOOST_TEST(std::abs(mass - 1.0) < 1e-4);
            BOOST_TEST(exact.at(1.0).density == 1.0);
            BOOST_TEST(exact.at(1.0).velocity == 1.0);
            BOOST_TEST(exact.at(0.0).pressure > 0.1);
            BOOST_TEST(exact.at(0.0).pressure < 0.5);
            // V falls from 2/(gamma + 1) to 1/gamma: v = delta r/(gamma t) about the centre.
            BOOST_TEST(exact.at(1e-3).velocity == 1e-3 * (gamma + 1.0) / (2.0 * gamma),
                       boost::test_tools::tolerance(1e-3));
        }
}
