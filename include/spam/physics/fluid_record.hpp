// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>

namespace spam {

/// What a pair body may know of a particle of a fluid without friction and conduction. The first
/// numbers are those of Record (record.hpp), so that the same code packs them.
template <int Dim, class T = double>
struct InviscidRecord {
    template <class U>
    using With = InviscidRecord<Dim, U>;
    static constexpr int a_at = 2 * Dim + 1;
    static constexpr int numbers = a_at + 1;

    Vec<Dim, T> x;  ///< wrapped into the box where it is periodic
    Vec<Dim, T> v;
    T m{};
    T a{};  ///< P/rho^2, stored: formed inside the pair, FMA would break F_ij = -F_ji

    template <class F>
    constexpr void visit(const F& f) {
        int k = 0;
        for (T& c : x.c) f(c, k++);
        for (T& c : v.c) f(c, k++);
        f(m, k++);
        f(a, k++);
    }
};

/// What gradients of velocity and temperature are summed from.
template <int Dim, class T = double>
struct GradientRecord {
    template <class U>
    using With = GradientRecord<Dim, U>;
    static constexpr int rho_at = 2 * Dim + 1;
    static constexpr int numbers = rho_at + 2;

    Vec<Dim, T> x;
    Vec<Dim, T> v;
    T m{};
    T rho{};  ///< EitherMean's number (mean_density.hpp)
    T temperature{};

    template <class F>
    constexpr void visit(const F& f) {
        int k = 0;
        for (T& c : x.c) f(c, k++);
        for (T& c : v.c) f(c, k++);
        f(m, k++);
        f(rho, k++);
        f(temperature, k++);
    }
};

/// The same once the gradients have told stress and heat flux.
template <int Dim, class T = double>
struct ConductingRecord : GradientRecord<Dim, T> {
    template <class U>
    using With = ConductingRecord<Dim, U>;
    static constexpr int A_at = GradientRecord<Dim, T>::numbers;
    static constexpr int q_at = A_at + symmetric_size(Dim);
    static constexpr int numbers = q_at + Dim;

    SymTensor<Dim, T> A;  ///< sigma/rho^2, sigma = -P
    Vec<Dim, T> q;        ///< Q/rho^2

    template <class F>
    constexpr void visit(const F& f) {
        GradientRecord<Dim, T>::visit(f);
        int k = A_at;
        for (T& c : A.c) f(c, k++);
        for (T& c : q.c) f(c, k++);
    }
};

}  // namespace spam
