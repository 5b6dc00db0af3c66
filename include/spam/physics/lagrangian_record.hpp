// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>
#include <spam/neighbors/pair.hpp>

namespace spam {

/// Records of a total-Lagrangian solid (record.hpp). Pairs are pairs of reference positions, so that
/// in the passes over them r_ji is X_j - X_i and w, grad_w are the initial weights. Each sweep reads
/// what the one before it found, one record is the beginning of the next.
template <int Dim, class T = double>
struct ReferenceRecord {
    template <class U>
    using With = ReferenceRecord<Dim, U>;
    static constexpr int present_at = Dim, volume_at = 2 * Dim, K_at = volume_at + 1,
                         numbers = K_at + symmetric_size(Dim);

    Vec<Dim, T> x;        ///< X, the reference position, wrapped into the box where it is periodic
    Vec<Dim, T> present;  ///< the position now, moved by as many periods as X was
    T volume{};           ///< V = m/rho_0
    SymTensor<Dim, T> K;  ///< symmetric, because grad w_ij is along X_ij

    template <class F>
    constexpr void visit(const F& f) {
        int k = 0;
        for (T& c : x.c) f(c, k++);
        for (T& c : present.c) f(c, k++);
        f(volume, k++);
        for (T& c : K.c) f(c, k++);
    }
};

/// With the deformation gradient F = A K.
template <int Dim, class T = double>
struct DeformedRecord : ReferenceRecord<Dim, T> {
    template <class U>
    using With = DeformedRecord<Dim, U>;
    static constexpr int F_at = ReferenceRecord<Dim, T>::numbers, numbers = F_at + Dim * Dim;

    Mat<Dim, T> F;

    template <class V>
    constexpr void visit(const V& f) {
        ReferenceRecord<Dim, T>::visit(f);
        int k = F_at;
        for (T& c : F.c) f(c, k++);
    }
};

/// With the stress that pairs feel, B = (P - M/V) K^t.
template <int Dim, class T = double>
struct StressedRecord : DeformedRecord<Dim, T> {
    template <class U>
    using With = StressedRecord<Dim, U>;
    static constexpr int B_at = DeformedRecord<Dim, T>::numbers, numbers = B_at + Dim * Dim;

    Mat<Dim, T> B;

    template <class F>
    constexpr void visit(const F& f) {
        DeformedRecord<Dim, T>::visit(f);
        int k = B_at;
        for (T& c : B.c) f(c, k++);
    }
};

/// x_j - x_i now, of the images whose reference positions are nearest: what is added is a multiple of
/// the period, in open space an exact zero.
template <int Dim, class T, class Record>
constexpr Vec<Dim, T> present_separation(const Pair<Dim, T>& pair, const Record& i,
                                         const Record& j) {
    return (j.present - i.present) + (pair.r_ji - (j.x - i.x));
}

}  // namespace spam
