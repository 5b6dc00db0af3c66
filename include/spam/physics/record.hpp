// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>

namespace spam {

/// A record is a row of numbers in memory and a struct in a pair body: `visit` calls f(number, k)
/// for k = 0, 1, ... `numbers` - 1.

/// What pairs that act by their distance alone need of a particle.
template <int Dim, class T = double>
struct PointRecord {
    template <class U>
    using With = PointRecord<Dim, U>;
    static constexpr int numbers = Dim + 1;

    Vec<Dim, T> x;  ///< wrapped into the box where it is periodic
    T m{};

    template <class F>
    constexpr void visit(const F& f) {
        int k = 0;
        for (T& c : x.c) f(c, k++);
        f(m, k);
    }
};

/// What a pair body may know of a particle of a solid. Packed once per right-hand side, in the order
/// of the slots, so that a sweep reads neighbours from adjacent memory.
template <int Dim, class T = double>
struct Record {
    template <class U>
    using With = Record<Dim, U>;
    static constexpr int numbers = 2 * Dim + 2 + symmetric_size(Dim);

    Vec<Dim, T> x;  ///< wrapped into the box where it is periodic
    Vec<Dim, T> v;
    T m{};
    T rho{};  ///< or what the mean density takes instead (mean_density.hpp, EitherMean)
    SymTensor<Dim, T>
        A;  ///< sigma/rho^2, stored: formed inside the pair, FMA would break F_ij = -F_ji

    template <class F>
    constexpr void visit(const F& f) {
        int k = 0;
        for (T& c : x.c) f(c, k++);
        for (T& c : v.c) f(c, k++);
        f(m, k++);
        f(rho, k++);
        for (T& c : A.c) f(c, k++);
    }
};

/// The same for passes that need the transport velocity or the torque factors of the first sweep.
template <int Dim, class T = double>
struct TransportRecord : Record<Dim, T> {
    template <class U>
    using With = TransportRecord<Dim, U>;
    static constexpr int first = Record<Dim, T>::numbers;  ///< of what comes on top
    static constexpr int numbers = first + Dim + 2;

    Vec<Dim, T> u;               ///< transport velocity, r_dot
    T negative_factor = T(1.0);  ///< R of the particle's body, for pair torques below zero
    T positive_factor = T(1.0);  ///< 1/R

    template <class F>
    constexpr void visit(const F& f) {
        Record<Dim, T>::visit(f);
        int k = first;
        for (T& c : u.c) f(c, k++);
        f(negative_factor, k++);
        f(positive_factor, k++);
    }
};

}  // namespace spam
