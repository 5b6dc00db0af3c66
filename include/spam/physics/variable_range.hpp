// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/lanes.hpp>
#include <spam/kernel/general_weight.hpp>
#include <spam/neighbors/pair.hpp>
#include <spam/physics/fluid_record.hpp>
#include <spam/physics/pass_constants.hpp>
#include <spam/physics/record.hpp>

/// Ranges that follow the density, h_i = eta (m_i/rho_i)^(1/D), so that every particle has about as many
/// neighbours wherever the gas is thin. With the density of a particle summed with its own range,
///     rho_i = sum_j m_j w(r_ij; h_i),
/// the derivative of sum m e(rho) along a motion of particle i gives forces that are equal and opposite
/// and central, and rates that keep m, p, L and sum m (e + v^2/2) for any equation of state:
///     Omega_i   = 1 + (h_i/(D rho_i)) sum_j m_j dw/dh(r_ij; h_i)        ("grad-h")
///     rho_dot_i = (1/Omega_i) sum_j m_j v_ij . grad_i w(r_ij; h_i),      e_dot_i = (P_i/rho_i^2) rho_dot_i
///     v_dot_i   = -sum_j m_j (a_i grad_i w(r_ij; h_i) + a_j grad_i w(r_ij; h_j)),  a = P/(Omega rho^2)
/// In terms of the weight function of range one, W(u), with -W'/u = S(u):
///     w(r; h) = W(r/h)/h^D,   grad_i w = S(r/h)/h^(D+2) r_ji,   dw/dh = (u^2 S - D W)/h^(D+1)
/// Friction and conduction are those of pairs (pair_friction.hpp) with
///     F_ij = (S(r/h_i)/h_i^(D+2) + S(r/h_j)/h_j^(D+2))/2.
namespace spam {
namespace column {

template <int Dim, class T>
struct InverseRange {
    T inverse_range{};  ///< 1/h
};
template <int Dim, class T>
struct Pull {
    T pull{};  ///< a/h^(D+2)
};
template <int Dim, class T>
struct HalfSlope {
    T half_slope{};  ///< 1/(2 h^(D+2))
};

}  // namespace column

template <int Dim, class T = double>
using RangeRecord = typename MotionRecord<Dim, T>::template And<column::InverseRange, column::Pull>;

/// Of fluids with friction and conduction, which are those of pairs.
template <int Dim, class T = double>
using RubbingRangeRecord = typename RangeRecord<Dim, T>::template And<
    column::HalfSlope, column::InverseDensity, column::Temperature, column::ShearViscosity,
    column::LongitudinalViscosity, column::ConductionFactor>;

/// h^D by products, which units leave as they are to the last bit.
template <int Dim>
constexpr double range_power(double h) {
    double power = h;
    for (int a = 1; a < Dim; ++a) power *= h;
    return power;
}

inline namespace SPAM_LANES {

/// What Omega and rho_dot are made of: the particle's own range alone.
template <int Dim>
struct OwnRangeSums {
    GeneralWeight<Dim> unit;  ///< of range 1
    static OwnRangeSums with(const PassConstants&, const GeneralWeight<Dim>& unit) {
        return {unit};
    }

    template <class T>
    struct Sums {
        T spread{};    ///< sum m_j (D W - u^2 S) = -h^(D+1) sum m_j dw/dh
        T approach{};  ///< sum m_j S v_ji . r_ji
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        const T u = pair.r * i.inverse_range;
        const T S = unit.minus_slope_over_r(u);
        sums.spread += j.m * (T(double(Dim)) * unit.value(u) - u * u * S);
        sums.approach += j.m * S * dot(pair.v_ji, pair.r_ji);
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        to.set(to.out.spread, sums.spread);
        to.set(to.out.approach, sums.approach);
    }
};

/// Both ranges: the force of the pair, equal and opposite to the last bit.
template <int Dim>
struct BothRangesForce {
    GeneralWeight<Dim> unit;
    static BothRangesForce with(const PassConstants&, const GeneralWeight<Dim>& unit) {
        return {unit};
    }

    template <class T>
    struct Sums {
        Vec<Dim, T> v_dot;
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        // Rounded before they are added: a product inside a fused operation would be another one seen
        // from j.
        const T own = rounded(i.pull * unit.minus_slope_over_r(pair.r * i.inverse_range));
        const T other = rounded(j.pull * unit.minus_slope_over_r(pair.r * j.inverse_range));
        sums.v_dot -= (j.m * (own + other)) * pair.r_ji;
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        to.set(to.out.v_dot, sums.v_dot);
    }
};

/// A pass over pairs that all have one range, with the mean of the slopes of both weights in place of the one
/// of the pair, which is the same seen from either.
template <int Dim, class Pass>
struct OfBothRanges {
    GeneralWeight<Dim> unit;
    Pass pass;
    static OfBothRanges with(const PassConstants& c, const GeneralWeight<Dim>& unit) {
        return {unit, Pass::with(c)};
    }

    template <class T>
    using Sums = typename Pass::template Sums<T>;
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        const T own = rounded(i.half_slope * unit.minus_slope_over_r(pair.r * i.inverse_range));
        const T other = rounded(j.half_slope * unit.minus_slope_over_r(pair.r * j.inverse_range));
        Pair<Dim, T> of_both = pair;
        of_both.minus_slope = own + other;
        of_both.grad_w = of_both.minus_slope * pair.r_ji;
        pass.add(of_both, i, j, sums);
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        Pass::store(to, sums);
    }
};

}  // namespace SPAM_LANES
}  // namespace spam
