// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/lagrangian_record.hpp>

namespace spam {

/// A_i = sum_j V_j (x_j - x_i) (x) grad_i W_ij. F_i = A_i K_i is the deformation gradient, with K_i the
/// inverse of A_i in the reference configuration. Exact where x = G X + c: then x_j - x_i is
/// G (X_j - X_i), so that A_i = G K_i^-1 and F_i = G.
template <int Dim>
struct DeformationGradient {
    static constexpr bool light = true;  // sweep.hpp

    template <class T>
    struct Sums {
        Mat<Dim, T> A;
    };
    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        add_outer(sums.A, present_separation(pair, i, j), j.volume * pair.grad_w);
    }
    template <class T, class Record>
    static Mat<Dim, T> result(const Record& i, const Sums<T>& sums) {
        return sums.A * i.K;
    }
    template <class To, class T>
    static void store(const To& to, const Mat<Dim, T>& F) {
        to.template write<DeformedRecord<Dim>, column::Deformation>(F);
    }
};

}  // namespace spam
