// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>

namespace spam {

/// What a pair body may know of a particle. Packed once per right-hand side, in the order of the
/// particles, so that a sweep reads neighbours from adjacent memory.
template <int Dim, class T = double>
struct Record {
    Vec<Dim, T> x;  ///< wrapped into the box where it is periodic
    Vec<Dim, T> v;
    T m{};
    T rho{};
    SymTensor<Dim, T>
        A;  ///< sigma/rho^2, stored: formed inside the pair, FMA would break F_ij = -F_ji
};

/// The same for passes that need the transport velocity or the torque factors of the first sweep.
template <int Dim, class T = double>
struct TransportRecord : Record<Dim, T> {
    Vec<Dim, T> u;               ///< transport velocity, r_dot
    T negative_factor = T(1.0);  ///< R of the particle's body, for pair torques below zero
    T positive_factor = T(1.0);  ///< 1/R
};

}  // namespace spam
