// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/general_weight.hpp>
#include <spam/neighbors/pair.hpp>
#include <spam/physics/pass_constants.hpp>

namespace spam {

/// v_dot_i = -a sum_j m_j grad_i w_ij: the weight function as a pair potential, a m_i m_j w_ij. Smooth
/// particles of the gas P = a rho^2/2 move like this, [HH01]: P/rho^2 is the same for all.
template <int Dim>
struct PairPotential {
    static constexpr bool light = true;  // sweep.hpp
    double a;                            ///< PassConstants::core_energy
    static PairPotential with(const PassConstants& c) { return {c.core_energy}; }

    template <class T>
    struct Sums {
        Vec<Dim, T> v_dot;
    };
    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record&, const Record& j, Sums<T>& sums) {
        sums.v_dot -= (j.m * pair.minus_slope) * pair.r_ji;
    }
    template <class T, class Record>
    Vec<Dim, T> result(const Record&, const Sums<T>& sums) const {
        return T(a) * sums.v_dot;
    }
    static double* sets(const auto& out) { return out.v_dot; }
};

/// Half of a m_i m_j w_ij, summed over the others.
template <int Dim>
struct PairPotentialEnergy {
    static constexpr bool light = true;  // sweep.hpp
    double a;
    double w_0;  ///< what a particle would have of itself
    static PairPotentialEnergy with(const PassConstants& c, const GeneralWeight<Dim>& weight) {
        return {c.core_energy, weight.value(0.0)};
    }

    template <class T>
    struct Sums {
        T m_w{};
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record&, const Record& j, Sums<T>& sums) const {
        sums.m_w += j.m * pair.w;
    }
    template <class T, class Record>
    T result(const Record& i, const Sums<T>& sums) const {
        return T(0.5 * a) * i.m * (sums.m_w - i.m * T(w_0));
    }
    static double* sets(const auto& out) { return out.energy; }
};

}  // namespace spam
