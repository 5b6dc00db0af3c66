// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/distance_potential.hpp>

namespace spam {

/// The pair potential of the particles in [HH07] 13, which repel each other below the spacing a of their
/// lattice and attract each other up to sqrt(2) a:
///     phi = e_b (q^8 - 2 q^4),   F_ij = (16 e_b/a^2) (q^7 - q^3) r_ij,   q = 2 - r^2/a^2 >= 0.
/// It is -e_b at r = a, has three continuous derivatives, and leaves second neighbours of a triangular lattice
/// (sqrt(3) a) alone. A neighbour is held with the force constant phi'' = 128 e_b/a^2, and torn off by the
/// force 5.30 e_b/a, the largest, at r = 1.098 a. Masses have no part in it.
struct CohesivePotential {
    double e_b = 1.0;  ///< energy that parts two particles
    double a = 1.0;    ///< distance at which they rest

    /// Beyond it there is nothing.
    double range() const { return a * std::sqrt(2.0); }

    template <class T>
    T energy(const T& r2) const {
        const T q4 = fourth(inside(r2));
        return T(e_b) * q4 * (q4 - T(2.0));
    }
    /// F/r of a pair: its force on i is this times r_ij.
    template <class T>
    T force_over_r(const T& r2) const {
        const T q = inside(r2);
        return T(16.0 * e_b / (a * a)) * (q * q * q) * (fourth(q) - T(1.0));
    }

  private:
    template <class T>
    T inside(const T& r2) const {
        return positive_part(T(2.0) - r2 * T(1.0 / (a * a)));
    }
    template <class T>
    static T fourth(const T& q) {
        return (q * q) * (q * q);
    }
};

}  // namespace spam
