// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/pair.hpp>

namespace spam {

/// rho_i = sum_j m_j w_ij, self term included, [HHM04] II.
struct DensitySum {
    static constexpr bool light = true;  // sweep.hpp

    template <class T>
    struct Sums {
        T rho{};
    };
    template <int Dim, class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record&, const Record& j, Sums<T>& sums) {
        sums.rho += j.m * pair.w;
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        to.set(to.out.rho, sums.rho);
    }
};

}  // namespace spam
