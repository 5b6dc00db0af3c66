// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/stress_force.hpp>

namespace spam {

/// The stress force where the stress is a pressure, f_ij = -(P_i/rho_i^2 + P_j/rho_j^2) grad_i w_ij,
/// [HH01], [HH07] 4: along r_ij, so that it keeps the angular momentum too.
template <int Dim, Work work = Work::mean>
struct PressureForce {
    template <class T>
    using Sums = ForceSums<Dim, T>;

    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        const Vec<Dim, T> f = -(i.a + j.a) * pair.grad_w;
        if constexpr (work == Work::own)
            sums.add_own(j.m, f, -i.a * pair.grad_w, pair.v_ji);
        else
            sums.add(j.m, f, pair.v_ji);
    }
};

}  // namespace spam
