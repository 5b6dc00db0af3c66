// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/kernel.hpp>

#include <cmath>
#include <numbers>

namespace spam::test {

/// Weight functions as [HH07] 3 has them: Monaghan's spline, and the family w_n, w_3 Lucy's.
template <int Dim>
struct OracleWeight {
    Kernel kernel;
    double h;

    double value(double r) const {
        const double u = r / h, pi = std::numbers::pi;
        if (u >= 1.0) return 0.0;
        if (kernel == Kernel::monaghan) {
            const double A = amplitude();
            return u < 0.5 ? A * (1.0 - 6.0 * u * u + 6.0 * u * u * u)
                           : 2.0 * A * std::pow(1.0 - u, 3);
        }
        const int n = family();
        const double C = Dim == 1   ? (n + 2) / (4.0 * h)
                         : Dim == 2 ? (n + 2) * (n + 3) / (6.0 * pi * h * h)
                                    : (n + 2) * (n + 3) * (n + 4) / (32.0 * pi * h * h * h);
        return C * (1.0 + n * u) * std::pow(1.0 - u, n);
    }
    double slope(double r) const {  // w'
        const double u = r / h;
        if (kernel == Kernel::monaghan)
            return amplitude() / h *
                   (u < 0.5 ? -12.0 * u + 18.0 * u * u : -6.0 * (1.0 - u) * (1.0 - u));
        const int n = family();  // from w itself
        return value(r) * (n / (h + n * r) - n / (h - r));
    }

  private:
    double amplitude() const {
        const double pi = std::numbers::pi;
        return Dim == 1   ? 4.0 / (3.0 * h)
               : Dim == 2 ? 40.0 / (7.0 * pi * h * h)
                          : 8.0 / (pi * h * h * h);
    }
    int family() const { return kernel == Kernel::lucy ? 3 : to_string(kernel).back() - '0'; }
};

}  // namespace spam::test
