// SPDX-License-Identifier: GPL-3.0-or-later

#include "diffusion_waves.hpp"

#include <cmath>
#include <complex>

namespace spam {

SquareLatticeDiffusion::SquareLatticeDiffusion(const AnyWeight<2>& weight, double k) {
    double rho = 0.0, c = 0.0, sum = 0.0;
    const int most = static_cast<int>(weight.range()) + 1;
    for (int x = -most; x <= most; ++x)
        for (int y = -most; y <= most; ++y) {
            const double r = std::hypot(x, y), slope_over_r = -weight.minus_slope_over_r(r);
            rho += weight.value(r);
            c -= slope_over_r * x * std::sin(k * x) / k;
            if (r == 0.0) continue;
            const double w_xx =
                slope_over_r + (weight.second_derivative(r) - slope_over_r) * x * x / (r * r);
            sum += w_xx * (1.0 - std::cos(k * y));
        }
    site_density = rho;
    factor = c * c / (rho * rho * rho);
    spring = 2.0 / (rho * rho) * sum;
}

double SquareLatticeDiffusion::shear_wave(double t, double k, double eta, double P) const {
    const std::complex<double> gamma = eta * k * k * factor;
    const auto root = std::sqrt(0.25 * gamma * gamma - P * spring);
    if (root == 0.0) return (std::exp(-0.5 * gamma * t) * (1.0 - 0.5 * gamma * t)).real();
    const auto a = 0.5 * gamma + root, b = 0.5 * gamma - root;
    return ((a * std::exp(-a * t) - b * std::exp(-b * t)) / (a - b)).real();
}

}  // namespace spam
