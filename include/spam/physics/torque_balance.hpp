// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/stress_force.hpp>

#include <cmath>
#include <span>
#include <vector>

/// Torque scaling, [HHM04] VIII, made exact: in the plane the pair torques
///     T_ij = x_ij F_y - y_ij F_x
/// of each body are multiplied by s_ij, with one R for the body such that its angular momentum about
/// the origin is constant:
///     torque_pair      s_ij = R where T_ij < 0, 1/R where T_ij > 0
///     torque_particle  s_ij = (s_i + s_j)/2, s_i = R or 1/R by the sign of T_i = 1/2 sum_j T_ij; it
///                      jumps where a T_i changes sign
/// Bodies: connected parts, each with its own R. With u = ⟨v⟩ the term X depends on the frame (sum m u differs from
/// sum m v), so that scheme is not Galilean covariant; with v or ⟨v⟩_Monaghan X vanishes and it is.
namespace spam {

/// What a scheme needs of the torques of its first sweep; in space see torque_balance_in_space.hpp.
template <int Dim>
struct TorqueSums;

/// Sums over the pairs of particle i: of its positive torques and of minus its negative ones (every
/// pair is met twice, once from each end).
template <>
struct TorqueSums<2> {
    template <class T>
    struct Sums {
        T positive{};
        T negative{};
    };
    template <class T, class Record>
    static void add(const Pair<2, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        const T torque = i.m * j.m * cross(stress_force(pair, i, j), pair.r_ji);
        sums.positive += positive_part(torque);
        sums.negative += positive_part(-torque);
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        to.set(to.out.positive_torque, sums.positive);
        to.set(to.out.negative_torque, sums.negative);
    }
};

/// Forces by stress, and apart from them what positive and negative torques contribute: where all pairs
/// have one R the balanced forces are made of these sums, without a second sweep.
struct TorqueParts {
    /// The forces perpendicular to r_ij that make up the torques of one sign.
    template <class T>
    struct Part {
        Vec<2, T> v_dot;
        T power{};
        T torque{};  ///< for a unit of m_i

        void add(const T& torque_by_mass, const T& inverse_r2, const Vec<2, T>& r,
                 const T& across) {
            const T k = torque_by_mass * inverse_r2;
            v_dot[0] += k * r[1];
            v_dot[1] -= k * r[0];
            power += k * across;
            torque += torque_by_mass;
        }
    };
    template <class T>
    struct Sums {
        ForceSums<2, T> force;
        Part<T> positive, negative;
    };
    /// Numbers that are stored of a particle: v_dot and e_dot of either part.
    static constexpr std::size_t numbers = 6;

    template <class T, class Record>
    static void add(const Pair<2, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        using std::max;
        const Vec<2, T> f = stress_force(pair, i, j);
        sums.force.add(j.m, f, pair.v_ji);
        const T torque = j.m * cross(f, pair.r_ji);
        // A particle's pair with itself has r = 0 and torque = 0; the floor keeps 0/0 out.
        const T inverse_r2 = T(1.0) / max(pair.r2, T(1e-300));
        const T across = -cross(pair.r_ji, pair.v_ji);  // v_ji by r_ji turned
        const T positive = positive_part(torque);
        sums.positive.add(positive, inverse_r2, pair.r_ji, across);
        sums.negative.add(positive - torque, inverse_r2, pair.r_ji, across);  // one of the two is 0
    }
    template <class T, class Record>
    static Sums<T> result(const Record& i, Sums<T> sums) {
        sums.positive.torque = i.m * sums.positive.torque;
        sums.negative.torque = i.m * sums.negative.torque;
        return sums;
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        sums.force.store(to);
        to.set(to.out.positive_torque, sums.positive.torque);
        to.set(to.out.negative_torque, sums.negative.torque);
        to.set(to.out.torque_parts,
               std::make_tuple(sums.positive.v_dot, T(0.5) * sums.positive.power,
                               sums.negative.v_dot, T(0.5) * sums.negative.power));
    }
};

/// What negative torques are multiplied by, and positive ones.
struct TorqueScale {
    double negative = 1.0, positive = 1.0;
};

/// R and 1/R, with R > 0 the root of P/R - M R + X = 0: positive torques P, minus the negative ones M,
/// and X = sum m u x v (zero unless the transport velocity is ⟨v⟩). Where all torques have one sign
/// that is the limit: they are scaled to cancel X, or away, as in a fragment of two particles. Where
/// there are none it is 1.
inline TorqueScale torque_balance(double P, double M, double X) {
    if (!(P > 0.0) && !(M > 0.0)) return {};
    if (!(M > 0.0)) return {1.0, X < 0.0 ? -X / P : 0.0};
    if (!(P > 0.0)) return {X > 0.0 ? X / M : 0.0, 1.0};
    const double root = std::sqrt(X * X + 4.0 * P * M);
    const double R = X >= 0.0 ? (X + root) / (2.0 * M) : 2.0 * P / (root - X);
    return {R, 1.0 / R};
}

/// Multiplies the tangential part of f_ij by s: f_ij += (s - 1) (T_ij/r^2) (-y_ij, x_ij), with s the
/// mean of both particles' factors for the sign of T_ij, so that f_ij = -f_ji and linear momentum
/// stays exact. torque_particle gives a particle the same factor for both signs.
template <class T, class Record>
Vec<2, T> scale_torque(const Pair<2, T>& pair, const Record& i, const Record& j,
                       const Vec<2, T>& f_ij) {
    using std::max;
    const T torque = cross(f_ij, pair.r_ji);
    const T s_positive = T(0.5) * (i.positive_factor + j.positive_factor);
    const T s_negative = T(0.5) * (i.negative_factor + j.negative_factor);
    const T change = (s_positive - T(1.0)) * positive_part(torque) -
                     (s_negative - T(1.0)) * positive_part(-torque);
    // A particle's pair with itself has r = 0 and torque = 0; the floor keeps 0/0 out.
    const T k = change / max(pair.r2, T(1e-300));
    return {{f_ij[0] + k * pair.r_ji[1], f_ij[1] - k * pair.r_ji[0]}};
}

/// The stress force with balanced torques, by the scale_torque() of its dimension; its power enters the energy like any
/// force's.
template <int Dim>
struct BalancedStressForce {
    template <class T>
    using Sums = ForceSums<Dim, T>;

    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        sums.add(j.m, scale_torque(pair, i, j, stress_force(pair, i, j)), pair.v_ji);
    }
};

}  // namespace spam
