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

    template <class T, class Record>
    Vec<Dim, T> force(const Pair<Dim, T>& pair, const Record& i, const Record& j) const {
        const double l = constants.length;
        const T approach = positive_part(-dot(pair.v_ji, pair.r_ji));
        const T mu = T(l) * approach / (pair.r2 + T(0.01 * l * l));
        const T Pi = mean.over(T(constants.alpha * MeanDensity::factor) * mu *
                                   (T(constants.sound_speed) + T(2.0) * mu),
                               i.rho, j.rho);
        return -Pi * pair.grad_w;
    }
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        sums.add(j.m, force(pair, i, j), pair.v_ji);
    }
};

}  // namespace spam
