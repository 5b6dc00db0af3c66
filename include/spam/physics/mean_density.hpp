// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace spam {

/// rho_ij = (rho_i + rho_j)/2, [HHM04] VI.
struct ArithmeticMean {
    template <class T>
    static T mean(const T& rho_i, const T& rho_j) {
        return T(0.5) * (rho_i + rho_j);
    }
};

/// rho_ij = sqrt(rho_i rho_j), [HHM04] VI.
struct GeometricMean {
    template <class T>
    static T mean(const T& rho_i, const T& rho_j) {
        using std::sqrt;
        return sqrt(rho_i * rho_j);
    }
};

}  // namespace spam
