// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/pass_constants.hpp>
#include <spam/physics/stress_force.hpp>

namespace spam {

/// Von Neumann's artificial viscosity as a pair force, [HHM04] IV and IX; form of its reference [1],
/// with the quadratic term twice the linear one. For approaching particles, v_ij . r_ij < 0,
///     f_ij = -Pi_ij grad_i w_ij,   Pi_ij = alpha (c mu + 2 mu^2) / rho_ij,
///     mu = l |v_ij . r_ij| / (r^2 + 0.01 l^2).
/// Central and antisymmetric: it keeps p and L; what it takes from the motion becomes heat. Not
/// smooth where a pair begins to approach.
template <int Dim, class MeanDensity>
struct ViscousForce {
    template <class T>
    using Sums = ForceSums<Dim, T>;

    ViscosityConstants constants{};
    [[no_unique_address]] MeanDensity mean{};
    static ViscousForce with(const PassConstants& c) {
        return {c.viscosity, MeanDensity::of(c.mean_density)};
    }

    /// Of the pair: the mean of both particles', where records hold them.
    template <class T, class Record>
    T sound_speed(const Record& i, const Record& j) const {
        if constexpr (requires { i.c; })
            return T(0.5) * (i.c + j.c);
        else
            return T(constants.sound_speed);
    }
    template <class T, class Record>
    Vec<Dim, T> force(const Pair<Dim, T>& pair, const Record& i, const Record& j) const {
        const double l = constants.length;
        const T approach = positive_part(-dot(pair.v_ji, pair.r_ji));
        const T mu = T(l) * approach / (pair.r2 + T(0.01 * l * l));
        const T Pi = mean.over(
            T(constants.alpha * MeanDensity::factor) * mu * (sound_speed<T>(i, j) + T(2.0) * mu),
            i.rho, j.rho);
        return -Pi * pair.grad_w;
    }
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        sums.add(j.m, force(pair, i, j), pair.v_ji);
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        sums.store_more(to);
    }
};

}  // namespace spam
