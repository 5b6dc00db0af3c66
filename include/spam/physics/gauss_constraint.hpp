// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>

#include <cmath>

/// Gauss' principle of least constraint, [HHM04] VII (the printed multipliers lack a sign and mix
/// masses): of all constraint forces that keep a body's angular momentum and energy the smallest are
///     F_i = m_i (-alpha (v_i - V) + beta z x (r_i - X)),
///     beta = -L_dot / (I - L^2/2K),   alpha = beta L / 2K,
/// about the body's centre of mass X and its velocity V, so that momentum is kept as well and nothing depends
/// on the frame: I = sum m r^2, L = sum m r x v, K = sum m v^2/2 and L_dot, the rate without the constraint,
/// are those of r - X and v - V; X moves with the mean of what moves particles. The
/// denominator is I times the share of K that is not rigid rotation: what the rotation is to get is
/// taken from there. It is zero in a rigid rotation, and nearly so again and again. In space L and beta are vectors and
/// I is the tensor sum m (r^2 - r r^t):
///     (I - L L^t/2K) beta = -L_dot,   alpha = beta . L / 2K,   F_i = m_i (-alpha w_i + beta x r_i).
namespace spam {

template <class Beta>
struct GaussMultipliersOf {
    double alpha = 0.0;
    Beta beta{};
    double health = 1.0;    ///< (I - L^2/2K)/I, in space 1 - L . I^-1 L/2K, from 0 to 1
    bool singular = false;  ///< the constraint is off
};
using GaussMultipliers = GaussMultipliersOf<double>;

/// `twice_K` = sum m v^2. Called singular, and left off, is a constraint that would use up the rest of
/// K before the body has turned by half a radian, |alpha| > |L|/I: soon after no finite one exists,
/// and while it diverges no integrator keeps the energy.
inline GaussMultipliers gauss_multipliers(double I, double L, double twice_K, double L_dot) {
    GaussMultipliers m;
    if (!(I > 0.0) || !(twice_K > 0.0)) return m;  // nothing moves, nothing to keep
    m.health = 1.0 - L * L / (twice_K * I);
    m.beta = -L_dot / (I * m.health);
    m.alpha = m.beta * L / twice_K;
    m.singular = !(m.health > 0.0) || !(std::abs(m.alpha) * I <= std::abs(L));
    if (m.singular) m.alpha = m.beta = 0.0;
    return m;
}
/// The same in space: off where |alpha| > |I^-1 L|. Straight bodies turn about two axes alone.
GaussMultipliersOf<Vec<3>> gauss_multipliers(const SymTensor<3>& I, const Vec<3>& L, double twice_K,
                                             const Vec<3>& L_dot);

/// What the multipliers are made of, as sums of numbers over particles with r and w = v - V relative to the centre
/// of mass, and the acceleration that they give.
template <int Dim>
struct GaussLaw;

template <>
struct GaussLaw<2> {
    static constexpr std::size_t numbers = 4;
    using Multipliers = GaussMultipliers;
    /// `a` without the constraint.
    static std::array<double, numbers> terms(double m, const Vec<2>& r, const Vec<2>& r_dot,
                                             const Vec<2>& w, const Vec<2>& a) {
        return {m * dot(r, r), m * cross(r, w), m * dot(w, w), m * (cross(r_dot, w) + cross(r, a))};
    }
    static Multipliers multipliers(const std::array<double, numbers>& sums) {
        const auto& [inertia, L, twice_K, L_dot] = sums;
        return gauss_multipliers(inertia, L, twice_K, L_dot);
    }
    static Vec<2> acceleration(const Multipliers& of, const Vec<2>& r, const Vec<2>& w) {
        return {{-(of.alpha * w[0] + of.beta * r[1]), -(of.alpha * w[1] - of.beta * r[0])}};
    }
};

template <>
struct GaussLaw<3> {
    static constexpr std::size_t numbers = 13;
    using Multipliers = GaussMultipliersOf<Vec<3>>;
    static std::array<double, numbers> terms(double m, const Vec<3>& r, const Vec<3>& r_dot,
                                             const Vec<3>& w, const Vec<3>& a) {
        const Vec<3> L = m * cross(r, w), L_dot = m * (cross(r_dot, w) + cross(r, a));
        SymTensor<3> I;
        for (int p = 0; p < 3; ++p)
            for (int q = p; q < 3; ++q) I(p, q) = m * ((p == q ? dot(r, r) : 0.0) - r[p] * r[q]);
        return {I.c[0], I.c[1], I.c[2],   I.c[3],   I.c[4],   I.c[5],       L[0],
                L[1],   L[2],   L_dot[0], L_dot[1], L_dot[2], m * dot(w, w)};
    }
    static Multipliers multipliers(const std::array<double, numbers>& s) {
        return gauss_multipliers({{s[0], s[1], s[2], s[3], s[4], s[5]}}, {{s[6], s[7], s[8]}},
                                 s[12], {{s[9], s[10], s[11]}});
    }
    static Vec<3> acceleration(const Multipliers& of, const Vec<3>& r, const Vec<3>& w) {
        return cross(of.beta, r) + (-of.alpha) * w;
    }
};

}  // namespace spam
