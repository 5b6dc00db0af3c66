// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/pair.hpp>
#include <spam/physics/pass_constants.hpp>

/// The velocity u that moves the particles, r_dot = u. It is a field, never an edit of v: stress
/// and energy go on using v.
namespace spam {

/// u = v
template <int Dim>
struct PlainTransport {
    template <class T>
    struct Sums {};
    template <class T, class Record>
    static void add(const Pair<Dim, T>&, const Record&, const Record&, Sums<T>&) {}
    template <class T, class Record>
    static Vec<Dim, T> result(const Record& i, const Sums<T>&) {
        return i.v;
    }
    static double* sets(const auto& out) { return out.x_dot; }
};

/// ⟨v⟩: u_i = sum_j m_j v_j w_ij / sum_j m_j w_ij, self included, [HHM04] IV. The paper divides by
/// rho_i, which is the same for summed density only.
template <int Dim>
struct AverageTransport {
    template <class T>
    struct Sums {
        Vec<Dim, T> momentum;
        T weight{};
    };
    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record&, const Record& j, Sums<T>& sums) {
        const T m_w = j.m * pair.w;
        sums.momentum += m_w * j.v;
        sums.weight += m_w;
    }
    template <class T, class Record>
    static Vec<Dim, T> result(const Record&, const Sums<T>& sums) {
        return (T(1.0) / sums.weight) * sums.momentum;
    }
    static double* sets(const auto& out) { return out.x_dot; }
};

/// ⟨v⟩_Monaghan: u_i = v_i + sum_j m_j (v_j - v_i) w_ij / rho_ij, [HHM04] IV. Keeps sum m u = sum m
/// v and sum m u x v = 0.
template <int Dim, class MeanDensity>
struct MonaghanTransport {
    [[no_unique_address]] MeanDensity mean{};
    static MonaghanTransport with(const PassConstants& c) {
        return {MeanDensity::of(c.mean_density)};
    }

    template <class T>
    struct Sums {
        Vec<Dim, T> correction;  ///< by `factor`
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        const T volume = mean.over(j.m, i.rho, j.rho);
        sums.correction += pair.w * (volume * pair.v_ji);
    }
    template <class T, class Record>
    static Vec<Dim, T> result(const Record& i, const Sums<T>& sums) {
        return i.v + T(MeanDensity::factor) * sums.correction;
    }
    static double* sets(const auto& out) { return out.x_dot; }
};

}  // namespace spam
