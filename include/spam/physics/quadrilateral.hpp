// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>

namespace spam {

/// A plane four-node element with one point of integration, its centre: velocities are interpolated bilinearly,
/// and their gradient at the centre stands for the whole element,
///     A = d_0 x d_1/2,  d_0 = x_2 - x_0, d_1 = x_3 - x_1,        (grad v)_ab = sum_n b_n,a v_n,b,
///     b_0 = -b_2 = (y_1 - y_3, x_3 - x_1)/(2 A),  b_1 = -b_3 = (y_2 - y_0, x_0 - x_2)/(2 A).
/// Corners are counterclockwise. sum_n b_n = 0 and sum_n x_n (x) b_n = 1, so that the forces
/// -A sigma . b_n of a symmetric stress have neither a sum nor a torque, and their power is -A sigma : grad v.
///
/// Eight velocities less three of rigid motion are five, of which the gradient shows three: the other two,
/// v_n = h_n (1, 0) and h_n (0, 1) with h = (1, -1, 1, -1), meet no resistance (hourglass). What shows them and no
/// linear field is gamma_n . v_n (Flanagan and Belytschko 1981),
///     gamma_n = h_n - (sum_m h_m x_m) . b_n,
/// and forces -gamma_n Q have neither a sum nor a torque, because sum gamma_n = 0 and sum gamma_n x_n = 0.
template <class T = double>
struct QuadrilateralShape {
    T area{};
    Vec<2, T> b_0, b_1;  ///< of corners 0 and 1; those of 2 and 3 are their negatives
    std::array<T, 4> gamma{};

    /// Precondition of all but `area`: it is not 0.
    explicit QuadrilateralShape(const std::array<Vec<2, T>, 4>& x) {
        const Vec<2, T> d_0 = x[2] - x[0], d_1 = x[3] - x[1];
        const T twice = d_0[0] * d_1[1] - d_0[1] * d_1[0];
        area = T(0.5) * twice;
        const T inverse = T(1.0) / twice;
        b_0 = inverse * Vec<2, T>{{-d_1[1], d_1[0]}};
        b_1 = inverse * Vec<2, T>{{d_0[1], -d_0[0]}};
        const Vec<2, T> skew = (x[0] - x[1]) + (x[2] - x[3]);
        const T g_0 = dot(skew, b_0), g_1 = dot(skew, b_1);
        gamma = {T(1.0) - g_0, T(-1.0) - g_1, T(1.0) + g_0, T(-1.0) + g_1};
    }

    /// (grad v)_ab = d v_b/d x_a, from differences across the diagonals.
    Mat<2, T> gradient(const std::array<Vec<2, T>, 4>& v) const {
        Mat<2, T> grad;
        add_outer(grad, b_0, v[0] - v[2]);
        add_outer(grad, b_1, v[1] - v[3]);
        return grad;
    }

    /// gamma_n v_n, 0 where velocities are linear in positions.
    Vec<2, T> hourglass(const std::array<Vec<2, T>, 4>& v) const {
        return gamma[0] * v[0] + gamma[1] * v[1] + gamma[2] * v[2] + gamma[3] * v[3];
    }

    /// On the corners: of the stress, and of what resists the hourglass.
    std::array<Vec<2, T>, 4> forces(const SymTensor<2, T>& stress, const Vec<2, T>& Q) const {
        const Vec<2, T> f_0 = area * (stress * b_0), f_1 = area * (stress * b_1), zero{};
        return {zero - f_0 - gamma[0] * Q, zero - f_1 - gamma[1] * Q, f_0 - gamma[2] * Q,
                f_1 - gamma[3] * Q};
    }
};

}  // namespace spam
