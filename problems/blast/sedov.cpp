// SPDX-License-Identifier: GPL-3.0-or-later
#include "sedov.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace blast {
namespace {

constexpr int steps = 20000;
constexpr double innermost = -10.0, dx = innermost / steps;  // ln(r/R)

/// ln(gamma V - 1), ln G, and the integral of the energy.
using Vars = std::array<double, 3>;

struct Equations {
    double gamma, dim;
    double delta() const { return 2.0 / (dim + 2.0); }
    double V(const Vars& y) const { return (1.0 + std::exp(y[0])) / gamma; }
    double Z(const Vars& y) const {
        const double v = V(y);
        return 0.5 * gamma * (gamma - 1.0) * (1.0 - v) * v * v / std::exp(y[0]);
    }
    Vars rates(double x, const Vars& y) const {
        const double W = std::exp(y[0]), v = V(y);
        // Z'/Z = (2/V - 1/(1 - V) - gamma/W) V'; W' = gamma V', all multiplied by W.
        const double by_W = ((gamma - 1.0) * dim * v - 2.0 * (1.0 / delta() - v)) /
                            ((2.0 * (1.0 - v) / v - gamma) * W - gamma * (1.0 - v));
        const double G = std::exp(y[1]);
        return {gamma * by_W, (by_W * W + dim * v) / (1.0 - v),
                -std::exp((dim + 2.0) * x) * G * (0.5 * v * v + Z(y) / (gamma * (gamma - 1.0)))};
    }
};

Vars moved(const Vars& y, double h, const Vars& k) {
    return {y[0] + h * k[0], y[1] + h * k[1], y[2] + h * k[2]};
}

Vars step(const Equations& f, double x, const Vars& y) {
    const Vars a = f.rates(x, y), b = f.rates(x + 0.5 * dx, moved(y, 0.5 * dx, a)),
               c = f.rates(x + 0.5 * dx, moved(y, 0.5 * dx, b)),
               d = f.rates(x + dx, moved(y, dx, c));
    Vars next = y;
    for (std::size_t k = 0; k < next.size(); ++k)
        next[k] += dx / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
    return next;
}

}  // namespace

Sedov::Sedov(double gamma, int dim) : dim_(dim) {
    const Equations f{gamma, static_cast<double>(dim)};
    Vars y{std::log((gamma - 1.0) / (gamma + 1.0)), std::log((gamma + 1.0) / (gamma - 1.0)), 0.0};
    const double V = f.V(y), G = std::exp(y[1]), GZ = G * f.Z(y);
    for (int k = 0; k <= steps; ++k) {
        const double x = dx * k, r = std::exp(x);
        table_.push_back(
            {std::exp(y[1]) / G, r * f.V(y) / V, r * r * std::exp(y[1]) * f.Z(y) / GZ});
        if (k < steps) y = step(f, x, y);
    }
    constexpr double surface[] = {2.0, 2.0 * std::numbers::pi, 4.0 * std::numbers::pi};
    const double energy =
        surface[dim - 1] * f.delta() * f.delta() * y[2];  // by rho_0 R^(dim + 2)/t^2
    xi_0_ = std::pow(energy, -1.0 / (dim + 2.0));
}

double Sedov::radius(double t, double E, double rho_0) const {
    return xi_0_ * std::pow(E * t * t / rho_0, 1.0 / (dim_ + 2.0));
}

double Sedov::time(double R, double E, double rho_0) const {
    return std::sqrt(rho_0 / E * std::pow(R / xi_0_, dim_ + 2.0));
}

Sedov::Profile Sedov::at(double r_by_R) const {
    const double place = std::log(std::max(r_by_R, 1e-300)) / dx;
    const auto last = static_cast<double>(steps);
    if (place >= last) return {table_.back().density, 0.0, table_.back().pressure};
    const double low = std::floor(std::max(place, 0.0)), part = std::max(place, 0.0) - low;
    const Profile &a = table_[static_cast<std::size_t>(low)],
                  &b = table_[static_cast<std::size_t>(low) + 1];
    return {a.density + part * (b.density - a.density),
            a.velocity + part * (b.velocity - a.velocity),
            a.pressure + part * (b.pressure - a.pressure)};
}

}  // namespace blast
