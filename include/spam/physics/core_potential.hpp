// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/distance_potential.hpp>

namespace spam {

/// A short-ranged repulsion that keeps particles from forming strings, [HH07] 8:
///     Phi = sum_pairs e_c (1 - r^2/s^2)^4,   F_ij = 8 e_c (1 - r^2/s^2)^3 r_ij/s^2,   r < s.
/// Three continuous derivatives. Masses have no part in it.
struct CorePotential {
    double e_c;  ///< energy of two particles at one place
    double s;    ///< its range

    template <class T>
    T energy(const T& r2) const {
        const T q = positive_part(T(1.0) - r2 * T(1.0 / (s * s)));
        return T(e_c) * (q * q) * (q * q);
    }
    /// F/r of a pair: its force on i is this times r_ij.
    template <class T>
    T force_over_r(const T& r2) const {
        const T q = positive_part(T(1.0) - r2 * T(1.0 / (s * s)));
        return T(8.0 * e_c / (s * s)) * (q * q * q);
    }
};

}  // namespace spam
