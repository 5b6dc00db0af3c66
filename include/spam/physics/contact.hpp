// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/pair.hpp>
#include <spam/physics/core_potential.hpp>
#include <spam/physics/pass_constants.hpp>
#include <spam/physics/record.hpp>

namespace spam {

namespace column {
template <int Dim, class T>
struct Body {
    T body{};  ///< its number, whole
};
}  // namespace column

/// What pairs that may be of one body or of two need of a particle.
template <int Dim, class T = double>
using BodyRecord = typename PointRecord<Dim, T>::template And<column::Body>;

/// A core between particles of different bodies, without adhesion and friction:
///     Phi = sum over pairs of two bodies of e_c (1 - r^2/s^2)^4,  r < s.
/// Of one body 1 - (b_i - b_j)^2 is 1, of two it is not above 0.
template <int Dim>
struct ContactForce {
    static constexpr bool light = true;  // sweep.hpp
    CorePotential core;
    static ContactForce with(const PassConstants& c) { return {{c.core_energy, c.core_range}}; }

    template <class T>
    static T apart(const T& b_i, const T& b_j) {
        return T(1.0) - positive_part(T(1.0) - (b_i - b_j) * (b_i - b_j));
    }

    template <class T>
    struct Sums {
        Vec<Dim, T> force;
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        sums.force -= (apart(i.body, j.body) * core.force_over_r(pair.r2)) * pair.r_ji;
    }
    template <class T, class Record>
    static Vec<Dim, T> result(const Record& i, const Sums<T>& sums) {
        return (T(1.0) / i.m) * sums.force;
    }
    template <class To, class T>
    static void store(const To& to, const Vec<Dim, T>& v_dot) {
        to.set(to.out.v_dot, v_dot);
    }
};

/// Half of the energy of each pair of two bodies.
template <int Dim>
struct ContactEnergy {
    static constexpr bool light = true;  // sweep.hpp
    CorePotential core;
    static ContactEnergy with(const PassConstants& c) { return {{c.core_energy, c.core_range}}; }

    template <class T>
    struct Sums {
        T energy{};
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        sums.energy += ContactForce<Dim>::apart(i.body, j.body) * core.energy(pair.r2);
    }
    template <class T, class Record>
    static T result(const Record&, const Sums<T>& sums) {
        return T(0.5) * sums.energy;
    }
    template <class To, class T>
    static void store(const To& to, const T& energy) {
        to.set(to.out.energy, energy);
    }
};

}  // namespace spam
