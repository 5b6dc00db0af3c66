// SPDX-License-Identifier: GPL-3.0-or-later
// Maxwell's construction of van der Waals' fluid against Lekner's exact solution, against equal areas, and near the
// critical point. A law whose energy and pressure do not belong together fails.
#include <spam/analysis/coexistence.hpp>
#include <spam/material/van_der_waals_isotherm.hpp>

#include <boost/test/unit_test.hpp>

#include <vector>

using namespace spam;

namespace {

constexpr double a = 9.0 / 8.0, b = 1.0 / 3.0;  // critical density, temperature: 1

/// J. Lekner, Am. J. Phys. 50, 161 (1982): y is half of the entropy that a particle of the vapour has more than one of
/// the liquid. In units of the critical point.
struct Lekner {
    double T, P, vapour, liquid;

    explicit Lekner(double y) {
        const double c = std::cosh(y), s = std::sinh(y);
        const double f = (y * c - s) / (s * c - y), g = 1.0 + 2.0 * f * c + f * f;
        T = 27.0 * f * (f + c) / (4.0 * g * g);
        P = 27.0 * f * f * (1.0 - f * f) / (g * g);
        vapour = 3.0 * f * std::exp(-y) / (1.0 + f * std::exp(-y));
        liquid = 3.0 * f * std::exp(y) / (1.0 + f * std::exp(y));
    }
};

/// The largest relative difference of densities and pressure from Lekner's, over temperatures from 0.25 to 0.9996 of
/// the critical one. `wrong`: a factor of the pressure that the construction sees, but not of the energy.
struct Mistaken : VanDerWaalsIsotherm {
    double wrong = 1.0;
    double pressure(double rho, double e = 0.0) const {
        return VanDerWaalsIsotherm::pressure(rho, e) * wrong;
    }
};
double largest_difference(double wrong = 1.0) {
    double worst = 0.0;
    for (const double y : {0.03, 0.1, 0.3, 1.0, 2.0, 4.0, 7.0}) {
        const Lekner exact(y);
        Mistaken law{{a, b, exact.T}, wrong};
        const Coexistence found = coexistence(law);
        const double P_c = a / (27.0 * b * b);
        worst = std::max({worst, std::abs(found.vapour / exact.vapour - 1.0),
                          std::abs(found.liquid / exact.liquid - 1.0),
                          std::abs(found.pressure / (P_c * exact.P) - 1.0)});
    }
    return worst;
}

}  // namespace

BOOST_AUTO_TEST_CASE(liquid_and_vapour_are_those_of_the_exact_solution) {
    BOOST_TEST(largest_difference() < 1e-9);
    BOOST_TEST(largest_difference(1.001) > 1e-4);
}

BOOST_AUTO_TEST_CASE(areas_between_isotherm_and_pressure_are_equal) {
    for (const double T : {0.3, 0.6, 0.85, 0.95}) {
        const VanDerWaalsIsotherm law{2.0 * a, 0.7 * b, 2.0 / 0.7 * T};
        const Coexistence found = coexistence(law);
        // P dv by Simpson's rule, in the logarithm of v = 1/rho: it spans decades.
        const double from = -std::log(found.liquid), to = -std::log(found.vapour);
        const int pieces = 4000;
        double area = 0.0, whole = 0.0;
        for (int k = 0; k <= pieces; ++k) {
            const double v = std::exp(from + (to - from) * k / pieces);
            const double part = (k % pieces == 0 ? 1.0
                                 : k % 2 == 1    ? 4.0
                                                 : 2.0) *
                                v * (law.pressure(1.0 / v) - found.pressure);
            area += part;
            whole += std::abs(part);
        }
        BOOST_TEST(std::abs(area) < 1e-9 * whole, "T = " << T);
        BOOST_TEST(std::abs(law.pressure(found.liquid) - found.pressure) < 1e-10);
    }
}

BOOST_AUTO_TEST_CASE(spinodal_lies_between_the_phases_and_all_meet_at_the_critical_point) {
    for (const double T : {0.1, 0.5, 0.9, 0.999, 0.9999}) {
        const VanDerWaalsIsotherm law{a, b, T};
        const auto [thin, dense] = spinodal(law);
        // 4 T = rho (3 - rho)^2, in units of the critical point.
        for (const double rho : {thin, dense})
            BOOST_TEST(std::abs(rho * (3.0 - rho) * (3.0 - rho) - 4.0 * T) < 1e-12);
        const Coexistence found = coexistence(law);
        BOOST_TEST((found.vapour < thin && thin < 1.0 && 1.0 < dense && dense < found.liquid));
        // Half the width is 2 sqrt(1 - T) of the phases and 1/sqrt(3) of that of the spinodal, in the limit.
        const double half = 0.5 * (found.liquid - found.vapour), distance = std::sqrt(1.0 - T);
        if (T > 0.99) {
            BOOST_TEST(std::abs(half / (2.0 * distance) - 1.0) < 0.5 * (1.0 - T) + 1e-6);
            BOOST_TEST(std::abs((dense - thin) / (2.0 * half) * std::sqrt(3.0) - 1.0) < 1.0 - T);
        }
        BOOST_TEST(std::abs(found.vapour_share(found.vapour) - 1.0) < 1e-12);
        BOOST_TEST(found.vapour_share(found.liquid) == 0.0);
        // Mass and room of both phases make up the whole.
        const double share = found.vapour_share(1.0);
        BOOST_TEST(std::abs(share / found.vapour + (1.0 - share) / found.liquid - 1.0) < 1e-12);
    }
    for (const double T : {1.0, 1.1}) {
        BOOST_CHECK_THROW(spinodal(VanDerWaalsIsotherm{a, b, T}), InputError);
        BOOST_CHECK_THROW(coexistence(VanDerWaalsIsotherm{a, b, T}), InputError);
    }
}

BOOST_AUTO_TEST_CASE(the_isotherm_has_the_pressure_of_the_full_law) {
    const VanDerWaalsIsotherm law{0.5, 0.7, 0.4};
    const VanDerWaals full = law.at_any_temperature();
    for (const double rho : {0.01, 0.5, 1.3})
        BOOST_TEST(std::abs(law.pressure(rho) - full.pressure(rho, full.energy(rho, 0.4))) < 1e-14);
    for (const double rho : {1.0 / 0.7, 2.0}) {
        BOOST_TEST(std::isnan(law.pressure(rho)));
        BOOST_TEST(std::isnan(law.cold_energy(rho)));
        BOOST_TEST(std::isnan(law.sound_speed_squared(rho)));
    }
}
