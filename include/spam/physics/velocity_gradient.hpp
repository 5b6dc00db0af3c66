// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>
#include <spam/neighbors/pair.hpp>
#include <spam/physics/pass_constants.hpp>

namespace spam {

/// (grad v)_i = sum_j m_j (v_j - v_i) grad_i w_ij / rho_ij, (grad v)_ab = d v_b / d x_a.
/// [HHM04] IX prints (v_i - v_j), which would contradict its own continuity equation.
template <int Dim, class MeanDensity>
struct VelocityGradient {
    [[no_unique_address]] MeanDensity mean{};
    static VelocityGradient with(const PassConstants& c) {
        return {MeanDensity::of(c.mean_density)};
    }

    using Kept = Mat<Dim>;

    template <class T>
    struct Sums {
        Mat<Dim, T> grad_v;  ///< by `factor`
        constexpr Mat<Dim, T> value() const { return T(MeanDensity::factor) * grad_v; }
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        const T volume = mean.over(j.m, i.rho, j.rho);
        const Vec<Dim, T> v = volume * pair.v_ji;
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b) sums.grad_v(a, b) += pair.grad_w[a] * v[b];
    }
    template <class T, class Record>
    static Mat<Dim, T> result(const Record&, const Sums<T>& sums) {
        return sums.value();
    }
};

}  // namespace spam
