// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/pair.hpp>
#include <spam/physics/pass_constants.hpp>
#include <spam/physics/record.hpp>

namespace spam {

namespace column {

template <int Dim, class T>
struct Charge {
    T q{};
};

}  // namespace column

template <int Dim, class T = double>
using ChargedRecord = typename PointRecord<Dim, T>::template And<column::Charge>;

/// Long-range forces, softened:
///     Phi = sum_pairs s q_i q_j u,   u = 1/sqrt(r^2 + eps^2),   F_ij = s q_i q_j u^3 r_ij
/// for all pairs. Gravity has q = m and s = -G; with s > 0 like charges repel each other.
struct LongRangePotential {
    double strength;    ///< s
    double softening2;  ///< eps^2
    static LongRangePotential with(const PassConstants& c) {
        return {c.core_energy, c.core_range * c.core_range};
    }
    /// q_j u. Of itself a particle has none: without softening that would be infinite. (Its r2 in a light sweep is
    /// 1e-300.)
    template <class T>
    T potential(const T& r2, const T& q_j) const {
        return where_below(T(2e-300), r2, q_j * inverse(r2));
    }
    template <class T>
    T inverse(const T& r2) const {
        return inverse_sqrt_by_products(r2 + T(softening2));
    }
};

template <int Dim>
struct LongRangeForce {
    static constexpr bool light = true;  // sweep.hpp
    LongRangePotential law;
    static LongRangeForce with(const PassConstants& c) { return {LongRangePotential::with(c)}; }

    template <class T>
    struct Sums {
        Vec<Dim, T> field;
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record&, const Record& j, Sums<T>& sums) const {
        const T u = law.inverse(pair.r2);
        sums.field -= (law.potential(pair.r2, j.q) * (u * u)) * pair.r_ji;
    }
    template <class T, class Record>
    Vec<Dim, T> result(const Record& i, const Sums<T>& sums) const {
        return (T(law.strength) * i.q / i.m) * sums.field;
    }
    static double* sets(const auto& out) { return out.v_dot; }
};

/// Half of each pair's energy.
template <int Dim>
struct LongRangeEnergy {
    static constexpr bool light = true;  // sweep.hpp
    LongRangePotential law;
    static LongRangeEnergy with(const PassConstants& c) { return {LongRangePotential::with(c)}; }

    template <class T>
    struct Sums {
        T potential{};
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record&, const Record& j, Sums<T>& sums) const {
        sums.potential += law.potential(pair.r2, j.q);
    }
    template <class T, class Record>
    T result(const Record& i, const Sums<T>& sums) const {
        return T(0.5 * law.strength) * i.q * sums.potential;
    }
    static double* sets(const auto& out) { return out.energy; }
};

}  // namespace spam
