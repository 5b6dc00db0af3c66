// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <string>

namespace spam {

/// What a fluid at rest is: `pressure` from the density and the energy per mass, P(rho, e);
/// `sound_speed_squared` the slope dP/drho at constant entropy, negative where the fluid is unstable;
/// `describe` names the law with its constants. All pure; outside the law (rho <= 0, a temperature
/// below zero, rho b >= 1 of van der Waals, NaN) they return NaN, which stops a run with its reason.
template <class Law>
concept EquationOfState = requires(const Law law, double rho, double e) {
    { law.pressure(rho, e) } -> std::same_as<double>;
    { law.sound_speed_squared(rho, e) } -> std::same_as<double>;
    { law.describe() } -> std::convertible_to<std::string>;
};

/// One in which the density alone decides: P does not depend on e, and `cold_energy` is the work per
/// mass stored at density rho, P = rho^2 d(cold_energy)/d rho. Potentials of the density need it.
template <class Law>
concept ColdEquationOfState = EquationOfState<Law> && requires(const Law law, double rho) {
    { law.cold_energy(rho) } -> std::same_as<double>;
};

/// One with a temperature: `energy` is the inverse of `temperature`, e(rho, T), and `entropy` per mass
/// (up to a constant) has ds = (de - P/rho^2 d rho)/T; `heat_capacity` is c_v by mass, de/dT at this density.
/// Boltzmann's constant is 1.
template <class Law>
concept ThermalEquationOfState = EquationOfState<Law> &&
    requires(const Law law, double rho, double x) {
    { law.temperature(rho, x) } -> std::same_as<double>;
    { law.energy(rho, x) } -> std::same_as<double>;
    { law.entropy(rho, x) } -> std::same_as<double>;
    { law.heat_capacity(rho, x) } -> std::same_as<double>;
};

/// For steps and artificial viscosity: 0 where the fluid is unstable, NaN outside the law.
template <EquationOfState Law>
double sound_speed(const Law& law, double rho, double e) {
    const double c2 = law.sound_speed_squared(rho, e);
    return c2 < 0.0 ? 0.0 : std::sqrt(c2);
}

/// `value` where `inside` holds, NaN elsewhere.
inline double only_where(bool inside, double value) {
    return inside ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace spam
