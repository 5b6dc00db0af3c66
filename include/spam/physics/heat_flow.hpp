// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>
#include <spam/neighbors/pair.hpp>
#include <spam/physics/pass_constants.hpp>

namespace spam {

/// (grad T)_i = sum_j m_j (T_j - T_i) grad_i w_ij / rho_ij, [HH07] 4.
template <int Dim, class MeanDensity>
struct TemperatureGradient {
    [[no_unique_address]] MeanDensity mean{};
    static TemperatureGradient with(const PassConstants& c) {
        return {MeanDensity::of(c.mean_density)};
    }

    using Kept = Vec<Dim>;

    template <class T>
    struct Sums {
        Vec<Dim, T> grad_T;  ///< by `factor`
        constexpr Vec<Dim, T> value() const { return T(MeanDensity::factor) * grad_T; }
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        const T volume = mean.over(j.m, i.rho, j.rho);
        sums.grad_T += (volume * (j.temperature - i.temperature)) * pair.grad_w;
    }
    template <class T, class Record>
    static Vec<Dim, T> result(const Record&, const Sums<T>& sums) {
        return sums.value();
    }
};

/// e_dot_i = -sum_j m_j (Q_i/rho_i^2 + Q_j/rho_j^2) . grad_i w_ij, [HH07] 4: what one particle loses
/// its partner gains.
template <int Dim>
struct HeatFlow {
    template <class T>
    struct Sums {
        T e_dot{};
    };
    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        sums.e_dot -= j.m * dot(i.q + j.q, pair.grad_w);
    }
    /// On top of the work that a pass before it has stored.
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        to.add(to.out.e_dot, sums.e_dot);
    }
};

}  // namespace spam
