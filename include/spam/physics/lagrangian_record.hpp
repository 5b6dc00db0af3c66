// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/pair.hpp>
#include <spam/physics/record.hpp>

namespace spam {

namespace column {

template <int Dim, class T>
struct Present {
    static constexpr auto quantity = Quantity::position;
    Vec<Dim, T> present;  ///< the position now, moved by as many periods as X was
};
template <int Dim, class T>
struct Volume {
    T volume{};  ///< V = m/rho_0
};
template <int Dim, class T>
struct Correction {
    SymTensor<Dim, T> K;  ///< symmetric, because grad w_ij is along X_ij
};
template <int Dim, class T>
struct Deformation {
    Mat<Dim, T> F;  ///< F = A K
};
template <int Dim, class T>
struct ReferenceStress {
    Mat<Dim, T> B;  ///< what pairs feel, (P - M/V) K^t; without M before that is known
};

}  // namespace column

/// Records of a total-Lagrangian solid. Pairs are pairs of reference positions, so that in the passes
/// over them `x` is X, r_ji is X_j - X_i and w, grad_w are the initial weights. Each sweep reads what the
/// one before it found, one record is the beginning of the next.
template <int Dim, class T = double>
using ReferenceRecord =
    RecordOf<Dim, T, column::Position, column::Present, column::Volume, column::Correction>;
template <int Dim, class T = double>
using DeformedRecord = typename ReferenceRecord<Dim, T>::template And<column::Deformation>;
template <int Dim, class T = double>
using StressedRecord = typename DeformedRecord<Dim, T>::template And<column::ReferenceStress>;

/// x_j - x_i now.
template <int Dim, class T, class Record>
constexpr Vec<Dim, T> present_separation(const Pair<Dim, T>&, const Record& i, const Record& j) {
    return j.present - i.present;
}

}  // namespace spam
