// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/lagrangian_record.hpp>
#include <spam/physics/pass_constants.hpp>

namespace spam {

/// What a pair's separation lacks to follow the deformation gradients of its ends,
///     d_ji = x_ji - (F_i + F_j) X_ji / 2 = -d_ij   bit for bit,
/// and its share of the spring constant k_ij = kappa mu V_i V_j W_ij / |X_ij|^2, without the
/// factor kappa mu V_i. The modes that F cannot see are those with d but without strain.
/// mu is the law's stiffness() (material/hyperelastic_law.hpp); d turns with the body, so that the penalty energy
/// is invariant under rotations.
template <int Dim, class T>
struct UnseenStretch {
    Vec<Dim, T> d_ji;
    T k;

    template <class Record>
    constexpr UnseenStretch(const Pair<Dim, T>& pair, const Record& i, const Record& j)
        : d_ji(present_separation(pair, i, j) - T(0.5) * ((i.F + j.F) * pair.r_ji)),
          // a particle's distance from itself must not be divided by: it has d = 0
          k(j.volume * pair.w / (pair.r2 + T(1e-300))) {}
};

/// Penalty force and its reaction on the deformation gradients, both by kappa mu V_i:
///     -sum_j k_ij d_ij   and   M_i = sum_j (k_ij/2) d_ij (x) X_ij.
template <int Dim>
struct ZeroEnergyPenalty {
    static constexpr bool light = true;  // sweep.hpp

    double stiffness = 0.0;        ///< kappa mu
    double inverse_density = 1.0;  ///< 1/rho_0
    static ZeroEnergyPenalty with(const PassConstants& c) { return {c.penalty, c.inverse_density}; }

    template <class T>
    struct Sums {
        Vec<Dim, T> force;
        Mat<Dim, T> M;
    };
    template <class T>
    struct Result {
        Vec<Dim, T> v_dot;
        Mat<Dim, T> B;
    };
    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        const UnseenStretch<Dim, T> unseen(pair, i, j);
        const Vec<Dim, T> f = unseen.k * unseen.d_ji;
        sums.force += f;
        add_outer(sums.M, T(0.5) * f, pair.r_ji);
    }
    /// What it adds to B = P K^t, which the law has told. Neighbours may not read B meanwhile.
    template <class T, class Record>
    Result<T> result(const Record& i, const Sums<T>& sums) const {
        return {T(stiffness * inverse_density) * sums.force, T(-stiffness) * (sums.M * i.K)};
    }
    template <class To, class T>
    static void store(const To& to, const Result<T>& result) {
        to.set(to.out.v_dot, result.v_dot);
        to.template write_more<StressedRecord<Dim>, column::ReferenceStress>(result.B);
    }
};

/// Half of the energies k_ij |d_ij|^2/2 of a particle's pairs, by kappa mu V_i.
template <int Dim>
struct PenaltyEnergy {
    static constexpr bool light = true;  // sweep.hpp

    double stiffness = 0.0;  ///< kappa mu
    static PenaltyEnergy with(const PassConstants& c) { return {c.penalty}; }

    template <class T>
    struct Sums {
        T energy{};
    };
    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        const UnseenStretch<Dim, T> unseen(pair, i, j);
        sums.energy += T(0.25) * unseen.k * dot(unseen.d_ji, unseen.d_ji);
    }
    template <class T, class Record>
    T result(const Record& i, const Sums<T>& sums) const {
        return T(stiffness) * i.volume * sums.energy;
    }
    static double* sets(const auto& out) { return out.energy; }
};

}  // namespace spam
