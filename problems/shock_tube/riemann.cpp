// SPDX-License-Identifier: GPL-3.0-or-later
#include "riemann.hpp"

#include <cmath>

namespace shock_tube {
namespace {

/// By how much the wave into a state changes the velocity if it leaves pressure P behind: shock or fan.
double velocity_change(const GasState& s, double gamma, double P) {
    if (P > s.P) {
        const double A = 2.0 / ((gamma + 1.0) * s.rho), B = (gamma - 1.0) / (gamma + 1.0) * s.P;
        return (P - s.P) * std::sqrt(A / (P + B));
    }
    return 2.0 * s.sound_speed(gamma) / (gamma - 1.0) *
           (std::pow(P / s.P, (gamma - 1.0) / (2.0 * gamma)) - 1.0);
}

/// Of the tail of a fan that runs into a vacuum.
double escape_speed(const GasState& s, double gamma, double sign) {
    return s.u - sign * 2.0 * s.sound_speed(gamma) / (gamma - 1.0);
}

}  // namespace

double GasState::sound_speed(double gamma) const { return std::sqrt(gamma * P / rho); }

double GasState::energy(double gamma) const { return rho > 0.0 ? P / ((gamma - 1.0) * rho) : 0.0; }

/// The pressure at which both waves agree about the velocity: the changes grow with it. Where they do not even at
/// P = 0 there is a vacuum.
RiemannProblem::RiemannProblem(const GasState& left, const GasState& right, double gamma)
    : left_(left),
      right_(right),
      gamma_(gamma),
      vacuum_(escape_speed(left, gamma, -1.0) <= escape_speed(right, gamma, 1.0)) {
    if (vacuum_) return;
    const auto excess = [&](double P) {
        return velocity_change(left, gamma, P) + velocity_change(right, gamma, P) + right.u -
               left.u;
    };
    double low = 0.0, high = 1.0 + left.P + right.P;
    while (excess(high) < 0.0) high *= 2.0;
    for (int k = 0; k < 200; ++k)
        (excess(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
    P_ = 0.5 * (low + high);
    u_ = 0.5 *
         (left.u + right.u + velocity_change(right, gamma, P_) - velocity_change(left, gamma, P_));
}

double RiemannProblem::density(bool right) const {
    const GasState& outside = right ? right_ : left_;
    const double ratio = P_ / outside.P, g = (gamma_ - 1.0) / (gamma_ + 1.0);
    return outside.rho *
           (ratio > 1.0 ? (ratio + g) / (g * ratio + 1.0) : std::pow(ratio, 1.0 / gamma_));
}

double RiemannProblem::shock_speed(const GasState& outside, double sign) const {
    return outside.u + sign * outside.sound_speed(gamma_) *
                           std::sqrt((gamma_ + 1.0) / (2.0 * gamma_) * P_ / outside.P +
                                     (gamma_ - 1.0) / (2.0 * gamma_));
}

double RiemannProblem::inner_speed(bool right) const {
    const GasState& outside = right ? right_ : left_;
    const double sign = right ? 1.0 : -1.0;
    if (vacuum_) return escape_speed(outside, gamma_, sign);
    if (P_ > outside.P) return shock_speed(outside, sign);
    return u_ + sign * GasState{density(right), u_, P_}.sound_speed(gamma_);
}

/// sign = -1: the wave that runs to the left. `speed`: x/t.
GasState RiemannProblem::beyond_wave(const GasState& outside, double sign, double speed) const {
    const double c = outside.sound_speed(gamma_);
    const bool shock = P_ > outside.P;
    if (sign * speed > sign * (shock ? shock_speed(outside, sign) : outside.u + sign * c))
        return outside;
    if (vacuum_ && sign * speed <= sign * inner_speed(sign > 0.0)) return {0.0, 0.0, 0.0};
    if (!vacuum_ && (shock || sign * speed < sign * inner_speed(sign > 0.0)))
        return {density(sign > 0.0), u_, P_};
    const double here =
        2.0 / (gamma_ + 1.0) - sign * (gamma_ - 1.0) / ((gamma_ + 1.0) * c) * (outside.u - speed);
    return {outside.rho * std::pow(here, 2.0 / (gamma_ - 1.0)),
            2.0 / (gamma_ + 1.0) * (-sign * c + 0.5 * (gamma_ - 1.0) * outside.u + speed),
            outside.P * std::pow(here, 2.0 * gamma_ / (gamma_ - 1.0))};
}

GasState RiemannProblem::at(double x, double t) const {
    if (!(t > 0.0)) return x < 0.0 ? left_ : right_;
    const double speed = x / t;
    const double middle = vacuum_ ? 0.5 * (inner_speed(false) + inner_speed(true)) : u_;
    return speed < middle ? beyond_wave(left_, -1.0, speed) : beyond_wave(right_, 1.0, speed);
}

}  // namespace shock_tube
