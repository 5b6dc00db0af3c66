// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/scheme.hpp>

#include <cmath>

namespace spam {

/// A pass that divides by rho_ij sums over(m_j, i.rho, j.rho), which is m_j/rho_ij but for `factor`,
/// and multiplies the sum by that. Exchanging i and j changes no bit. `of` makes the mean of a scheme.

/// rho_ij = (rho_i + rho_j)/2, [HHM04] VI.
struct ArithmeticMean {
    static constexpr double factor = 2.0;
    static ArithmeticMean of(MeanDensityKind) { return {}; }
    template <class T>
    static T over(const T& number, const T& rho_i, const T& rho_j) {
        return number / (rho_i + rho_j);
    }
};

/// The same or rho_ij = sqrt(rho_i rho_j), [HHM04] VI, in one formula without a branch, for sweeps that
/// are to be compiled once:
///     1/rho_ij = (p + (1 - p) g_i g_j)/(p (g_i + g_j)/2 + 1 - p),   p = 1 or 0,
/// where records hold g = rho or g = 1/sqrt(rho) in place of the density: the pair needs no second
/// square root.
struct EitherMean {
    static constexpr double factor = 1.0;

    double arithmetic = 1.0, half = 0.5, geometric = 0.0;  ///< p, p/2, 1 - p

    static EitherMean of(MeanDensityKind kind) {
        if (kind == MeanDensityKind::arithmetic) return {};
        return {0.0, 0.0, 1.0};
    }
    /// g
    static double number(MeanDensityKind kind, double rho) {
        return kind == MeanDensityKind::arithmetic ? rho : 1.0 / std::sqrt(rho);
    }
    template <class T>
    T over(const T& number, const T& g_i, const T& g_j) const {
        return number * (T(arithmetic) + T(geometric) * (g_i * g_j)) /
               (T(geometric) + T(half) * (g_i + g_j));
    }
};

/// rho_i in place of a mean, from the same records: then (grad v)_i is the gradient by which the stress of i
/// does its work (Work::own), so that friction heats every particle, by sigma : grad v/rho >= 0.
struct OwnDensity {
    static constexpr double factor = 1.0;

    double arithmetic = 1.0, geometric = 0.0;

    static OwnDensity of(MeanDensityKind kind) {
        if (kind == MeanDensityKind::arithmetic) return {};
        return {0.0, 1.0};
    }
    template <class T>
    T over(const T& number, const T& g_i, const T&) const {
        return number * (T(arithmetic) / g_i + T(geometric) * (g_i * g_i));
    }
};

}  // namespace spam
