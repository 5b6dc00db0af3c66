// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure, energy, temperature, entropy and sound speed of every fluid belong together: they are the
// derivatives of each other that thermodynamics says. A law with one of them off by a thousandth fails.
#include <spam/material/cavitation.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/isentropic_gas.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/material/van_der_waals_isotherm.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <functional>
#include <random>

using namespace spam;

namespace {

constexpr double accuracy = 1e-8;

/// Fourth order; the functions here change over distances of order one.
double derivative(const std::function<double(double)>& f, double x) {
    const double h = 1e-3 * std::abs(x);
    return (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h);
}

/// The larger of the errors of P = rho^2 de/d rho and c^2 = dP/d rho over random densities.
template <ColdEquationOfState Law>
double cold_error(const Law& law) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> density(0.2, 3.0);
    double worst = 0.0;
    for (int k = 0; k < 200; ++k) {
        const double rho = density(random);
        const double work = derivative([&](double x) { return law.cold_energy(x); }, rho);
        const double slope = derivative([&](double x) { return law.pressure(x, 0.0); }, rho);
        const double P = law.pressure(rho, 0.0), c2 = law.sound_speed_squared(rho, 0.0);
        worst = std::max({worst, std::abs(P - rho * rho * work) / (1.0 + std::abs(P)),
                          std::abs(c2 - slope) / (1.0 + std::abs(c2))});
    }
    return worst;
}

/// The energy at density rho on the isentrope through (rho_0, e_0): the root of s(rho, e) = s_0, by
/// Newton's method with the slope 1/T from the entropy itself.
template <ThermalEquationOfState Law>
double isentrope(const Law& law, double rho_0, double e_0, double rho) {
    const double s_0 = law.entropy(rho_0, e_0);
    double e = e_0;
    for (int k = 0; k < 20; ++k) {
        const double d = 1e-6;
        const double slope = (law.entropy(rho, e + d) - law.entropy(rho, e - d)) / (2.0 * d);
        e -= (law.entropy(rho, e) - s_0) / slope;
    }
    return e;
}

/// The largest error of e(rho, T(rho, e)) = e, c_v = de/dT, 1/T = ds/de, P = rho^2 de/d rho and c^2 = dP/d rho at
/// constant s, over random states.
template <ThermalEquationOfState Law>
double thermal_error(const Law& law, double most_dense) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> density(0.05 * most_dense, 0.8 * most_dense),
        temperature(0.5, 2.0);
    double worst = 0.0;
    for (int k = 0; k < 200; ++k) {
        const double rho = density(random), T = temperature(random), e = law.energy(rho, T);
        const auto on_isentrope = [&](double x) { return isentrope(law, rho, e, x); };
        const double coldness = derivative([&](double x) { return law.entropy(rho, x); }, e);
        const double work = rho * rho * derivative(on_isentrope, rho);
        const double slope =
            derivative([&](double x) { return law.pressure(x, on_isentrope(x)); }, rho);
        const double heating = derivative([&](double x) { return law.temperature(rho, x); }, e);
        worst =
            std::max({worst, std::abs(law.temperature(rho, e) - T), std::abs(coldness * T - 1.0),
                      std::abs(heating * law.heat_capacity(rho, e) - 1.0),
                      std::abs(law.pressure(rho, e) - work) / (1.0 + std::abs(work)),
                      std::abs(law.sound_speed_squared(rho, e) - slope) / (1.0 + slope)});
    }
    return worst;
}

/// A law with factors of its own on what it gives.
template <class Law>
struct Mutated {
    Law law;
    double P = 1.0, c2 = 1.0, T = 1.0, c_v = 1.0;

    double pressure(double rho, double e) const { return P * law.pressure(rho, e); }
    double sound_speed_squared(double rho, double e) const {
        return c2 * law.sound_speed_squared(rho, e);
    }
    double cold_energy(double rho) const requires ColdEquationOfState<Law> {
        return law.cold_energy(rho);
    }
    double temperature(double rho, double e) const requires ThermalEquationOfState<Law> {
        return T * law.temperature(rho, e);
    }
    double energy(double rho, double temperature) const requires ThermalEquationOfState<Law> {
        return law.energy(rho, temperature / T);
    }
    double entropy(double rho, double e) const requires ThermalEquationOfState<Law> {
        return law.entropy(rho, e);
    }
    double heat_capacity(double rho, double e) const requires ThermalEquationOfState<Law> {
        return c_v * law.heat_capacity(rho, e);
    }
    std::string describe() const { return "wrong"; }
};

template <ColdEquationOfState Law>
void check_cold(const Law& law) {
    BOOST_TEST_CONTEXT(law.describe()) {
        BOOST_TEST(cold_error(law) < accuracy);
        BOOST_TEST(cold_error(Mutated<Law>{.law = law, .P = 1.001}) > 1e-4);
        BOOST_TEST(cold_error(Mutated<Law>{.law = law, .c2 = 1.001}) > 1e-4);
        for (const double rho : {0.0, -1.0, std::nan("")}) {
            BOOST_TEST(std::isnan(law.pressure(rho, 1.0)));
            BOOST_TEST(std::isnan(law.sound_speed_squared(rho, 1.0)));
            BOOST_TEST(std::isnan(law.cold_energy(rho)));
            BOOST_TEST(std::isnan(sound_speed(law, rho, 1.0)));
        }
    }
}

template <ThermalEquationOfState Law>
void check_thermal(const Law& law, double most_dense) {
    BOOST_TEST_CONTEXT(law.describe()) {
        BOOST_TEST(thermal_error(law, most_dense) < accuracy);
        BOOST_TEST(thermal_error(Mutated<Law>{.law = law, .P = 1.001}, most_dense) > 1e-4);
        BOOST_TEST(thermal_error(Mutated<Law>{.law = law, .c2 = 1.001}, most_dense) > 1e-4);
        BOOST_TEST(thermal_error(Mutated<Law>{.law = law, .T = 1.001}, most_dense) > 1e-4);
        BOOST_TEST(thermal_error(Mutated<Law>{.law = law, .c_v = 1.001}, most_dense) > 1e-4);
        for (const double rho : {0.0, -1.0, std::nan("")}) {
            BOOST_TEST(std::isnan(law.pressure(rho, 1.0)));
            BOOST_TEST(std::isnan(law.sound_speed_squared(rho, 1.0)));
            BOOST_TEST(std::isnan(law.temperature(rho, 1.0)));
            BOOST_TEST(std::isnan(law.energy(rho, 1.0)));
        }
        const double rho = 0.5 * most_dense, cold = law.energy(rho, 0.0);
        BOOST_TEST(law.temperature(rho, cold) == 0.0);
        BOOST_TEST(std::isnan(law.pressure(rho, cold - 1e-3)));
        BOOST_TEST(std::isnan(law.temperature(rho, cold - 1e-3)));
        BOOST_TEST(std::isnan(law.energy(rho, -1e-3)));
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(cold_fluids) {
    check_cold(LucyGas{});
    check_cold(IsentropicGas{1.3, 0.9, 5.0 / 3.0});
    check_cold(IsentropicGas{0.7, 1.2, 7.0});
    check_cold(EmbeddedAtom{1.4, 1.1});
    check_cold(VanDerWaalsIsotherm{0.7, 0.2, 0.6});
}

BOOST_AUTO_TEST_CASE(fluids_with_a_temperature) {
    for (const int D : {1, 2, 3}) {
        check_thermal(IdealGas{D, 1.0}, 2.0);
        check_thermal(IdealGas{D, 2.5}, 2.0);
        check_thermal(VanDerWaals{0.5, 0.7, D}, 1.0 / 0.7);
    }
}

BOOST_AUTO_TEST_CASE(the_lucy_gas_is_an_isentrope_of_the_plane_ideal_gas) {
    const IsentropicGas power{0.5, 1.0, 2.0};
    const IdealGas gas{2};
    for (const double rho : {0.3, 1.0, 2.0}) {
        const double e = LucyGas{}.cold_energy(rho);
        BOOST_TEST(std::abs(LucyGas{}.pressure(rho) - gas.pressure(rho, e)) < 1e-15);
        BOOST_TEST(std::abs(LucyGas{}.pressure(rho) - power.pressure(rho)) < 1e-15);
        BOOST_TEST(std::abs(e - power.cold_energy(rho)) < 1e-15);
        BOOST_TEST(std::abs(gas.entropy(rho, e) - gas.entropy(1.0, 0.5)) < 1e-14);
        // On the line, [HH01] exercise 1 as corrected: p = 2 rho e = rho^3/3.
        const double line = rho * rho / 6.0;
        BOOST_TEST(std::abs(IdealGas{1}.pressure(rho, line) - rho * rho * rho / 3.0) < 1e-14);
    }
    BOOST_TEST(sound_speed(LucyGas{}, 1.0, 0.0) == 1.0);
}

BOOST_AUTO_TEST_CASE(the_embedded_atom_is_at_rest_at_rho_0_and_tears_below_two_thirds) {
    const EmbeddedAtom law{1.4, 1.1};
    BOOST_TEST(law.pressure(1.1) == 0.0);
    BOOST_TEST(law.cold_energy(1.1) == 0.0);
    BOOST_TEST(std::abs(law.sound_speed_squared(1.1) - 1.4 / 1.1) < 1e-15);
    BOOST_TEST(std::abs(law.pressure(1.1 * 2.0 / 3.0) + 4.0 / 27.0 * 1.4) < 1e-15);
    BOOST_TEST(law.sound_speed_squared(0.7) < 0.0);
    BOOST_TEST(sound_speed(law, 0.7, 0.0) == 0.0);
}

BOOST_AUTO_TEST_CASE(van_der_waals_has_its_critical_point_and_no_state_beyond_close_packing) {
    const VanDerWaals law{0.5, 0.7, 2};
    const double rho = law.critical_density(), T = law.critical_temperature();
    const auto P = [&](double x) { return law.pressure(x, law.energy(x, T)); };
    BOOST_TEST(std::abs(P(rho) - 0.5 / (27.0 * 0.7 * 0.7)) < 1e-15);
    BOOST_TEST(std::abs(derivative(P, rho)) < 1e-9);
    BOOST_TEST(std::abs(P(1.01 * rho) - 2.0 * P(rho) + P(0.99 * rho)) < 1e-7);
    for (const double dense : {1.0 / 0.7, 2.0}) {
        BOOST_TEST(std::isnan(law.pressure(dense, 1.0)));
        BOOST_TEST(std::isnan(law.temperature(dense, 1.0)));
        BOOST_TEST(std::isnan(law.energy(dense, 1.0)));
        BOOST_TEST(std::isnan(law.sound_speed_squared(dense, 1.0)));
    }
}

BOOST_AUTO_TEST_CASE(cavitation_limits_tension_not_pressure) {
    const Cavitating<EmbeddedAtom> law{{1.0, 1.0}, 0.05};
    BOOST_TEST(law.pressure(1.5, 0.0) == EmbeddedAtom{}.pressure(1.5));
    BOOST_TEST(law.pressure(0.98, 0.0) == EmbeddedAtom{}.pressure(0.98));
    BOOST_TEST(law.pressure(0.7, 0.0) == -0.05);
    BOOST_TEST(law.sound_speed_squared(0.7, 0.0) == 0.0);
    BOOST_TEST(std::isnan(law.pressure(-1.0, 0.0)));
    double worst = 0.0;  // c^2 = dP/d rho on both sides of the clamp
    for (double rho = 0.61; rho < 1.4; rho += 0.01) {
        const double slope = derivative([&](double x) { return law.pressure(x, 0.0); }, rho);
        const bool at_the_clamp = std::abs(EmbeddedAtom{}.pressure(rho) + 0.05) < 0.01;
        if (!at_the_clamp)
            worst = std::max(worst, std::abs(slope - law.sound_speed_squared(rho, 0.0)));
    }
    BOOST_TEST(worst < accuracy);
    static_assert(!ColdEquationOfState<Cavitating<EmbeddedAtom>>, "its energy is the work done");
}

BOOST_AUTO_TEST_CASE(cavitating_embedded_atoms_have_an_energy) {
    for (const double limit : {0.0, 0.01, 0.05, 0.14}) {
        const CavitatingEmbeddedAtom law({1.2, 1.1}, limit);
        const Cavitating<EmbeddedAtom> clamped{{1.2, 1.1}, limit};
        double worst = 0.0;  // P = rho^2 de/d rho, and e without jumps
        for (double rho = 0.1; rho < 1.6; rho += 0.01) {
            BOOST_TEST(law.pressure(rho) == clamped.pressure(rho, 0.0));
            bool at_the_clamp = false;
            for (const double edge : law.limits())
                at_the_clamp = at_the_clamp || std::abs(rho - edge) < 0.005;
            const double slope = derivative([&](double x) { return law.cold_energy(x); }, rho);
            if (!at_the_clamp)
                worst = std::max(worst, std::abs(rho * rho * slope - law.pressure(rho)));
        }
        BOOST_TEST(worst < accuracy);
        for (const double edge : law.limits()) {
            if (edge < 1e-6) continue;  // where no tension is borne there is no lower one
            BOOST_TEST(std::abs(EmbeddedAtom({1.2, 1.1}).pressure(edge) + limit) < 1e-12);
            BOOST_TEST(std::abs(law.cold_energy(edge + 1e-9) - law.cold_energy(edge - 1e-9)) <
                       1e-8);
        }
        BOOST_TEST(std::isnan(law.cold_energy(-1.0)));
    }
}
