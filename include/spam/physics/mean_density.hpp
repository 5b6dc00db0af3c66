// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace spam {

/// A pass that divides by rho_ij sums m_j / divisor(rho_i, rho_j) and multiplies the sum by `factor`.

/// rho_ij = (rho_i + rho_j)/2, [HHM04] VI.
struct ArithmeticMean {
    static constexpr double factor = 2.0;
    template <class T>
    static T divisor(const T& rho_i, const T& rho_j) {
        return rho_i + rho_j;
    }
};

/// rho_ij = sqrt(rho_i rho_j), [HHM04] VI.
struct GeometricMean {
    static constexpr double factor = 1.0;
    template <class T>
    static T divisor(const T& rho_i, const T& rho_j) {
        using std::sqrt;
        return sqrt(rho_i * rho_j);
    }
};

}  // namespace spam
