// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/error.hpp>
#include <spam/material/equation_of_state.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace spam {

/// A cold law that may have two phases: unstable, if anywhere, about `critical_density`, and below `densest`.
template <class Law>
concept TwoPhaseLaw = ColdEquationOfState<Law> && requires(const Law law) {
    { law.critical_density() } -> std::same_as<double>;
    { law.densest() } -> std::same_as<double>;
};

/// Where f, which is below zero at `negative` and not at `positive`, changes its sign: by bisection, to the last digit.
template <class F>
double sign_change(const F& f, double negative, double positive) {
    for (;;) {
        const double middle = 0.5 * (negative + positive);
        if (middle == negative || middle == positive) return middle;
        (f(middle) < 0.0 ? negative : positive) = middle;
    }
}

/// The densities between which the fluid is unstable, dP/d rho < 0. Throws InputError where it is nowhere: at and above
/// the critical temperature.
template <TwoPhaseLaw Law>
std::array<double, 2> spinodal(const Law& law) {
    const auto slope = [&law](double rho) { return law.sound_speed_squared(rho, 0.0); };
    const double inside = law.critical_density();
    if (!(slope(inside) < -1e-12 * std::abs(law.pressure(inside, 0.0)) / inside))  // rounding apart
        throw InputError(fmt::format(
            "temperature: {} has one phase alone; use a temperature below the critical one",
            law.describe()));
    return {sign_change(slope, inside, 0.0), sign_change(slope, inside, law.densest())};
}

/// Two phases that stay as they are beside each other, and the pressure of both.
struct Coexistence {
    double vapour, liquid;  ///< densities
    double pressure;

    /// Part of the mass that is vapour where the mean density is `mean`, between both.
    double vapour_share(double mean) const {
        return vapour / mean * (liquid - mean) / (liquid - vapour);
    }
};

/// Energy per mass that it takes to add mass at constant pressure: the chemical potential, e + P/rho.
template <ColdEquationOfState Law>
double chemical_potential(const Law& law, double rho) {
    return law.cold_energy(rho) + law.pressure(rho, 0.0) / rho;
}

/// Maxwell's construction: pressure and chemical potential are the same in both phases. By bisection: for every vapour,
/// thinner than the spinodal, the liquid of its pressure is found; the denser the vapour, the less does the liquid's
/// chemical potential exceed the vapour's, d(mu_l - mu_v)/dP = 1/rho_l - 1/rho_v. Throws InputError as spinodal() does.
template <TwoPhaseLaw Law>
Coexistence coexistence(const Law& law) {
    const auto [thin, dense] = spinodal(law);
    const auto liquid_at = [&law, dense = dense](double P) {
        return sign_change([&](double rho) { return law.pressure(rho, 0.0) - P; }, dense,
                           law.densest());
    };
    // By the logarithm of the vapour's density, which at low temperature is next to nothing. Where its pressure is
    // below all of the liquid's the liquid found is the spinodal's, in which mass has the larger potential.
    const double vapour = std::exp(sign_change(
        [&](double log_density) {
            const double rho = std::exp(log_density);
            return chemical_potential(law, rho) -
                   chemical_potential(law, liquid_at(law.pressure(rho, 0.0)));
        },
        std::log(thin) - 700.0, std::log(thin)));
    const double P = law.pressure(vapour, 0.0);
    return {vapour, liquid_at(P), P};
}

}  // namespace spam
