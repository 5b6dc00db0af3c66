// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/pair.hpp>
#include <spam/physics/core_potential.hpp>
#include <spam/physics/pass_constants.hpp>
#include <spam/physics/record.hpp>

namespace spam {

namespace column {

/// Which body a particle belongs to, as a coordinate: those of different bodies differ by more than
/// PassConstants::apart.
template <int Dim, class T>
struct Body {
    T body{};
};
/// X, moved by as many periods as x; zero where no body touches itself.
template <int Dim, class T>
struct Reference {
    static constexpr auto quantity = Quantity::position;
    Vec<Dim, T> X;
};

}  // namespace column

template <int Dim, class T = double>
using ContactRecord = typename PointRecord<Dim, T>::template And<column::Body, column::Reference>;

/// Contact of bodies: particles i and j repel each other with the potential of a core,
///     phi = e_c (1 - r^2/s^2)^4,   r < s,
/// where they do not belong together: where they are of different bodies, or of one that has folded, so
/// that they are far apart in its reference configuration. Both are one distance, with the body as one more
/// coordinate. It never changes, so that the energy is a smooth function of the positions; particles that
/// part feel nothing: neither adhesion nor friction.
struct ContactPotential {
    CorePotential core;
    double apart2;  ///< the square of the distance beyond which particles touch
    static ContactPotential with(const PassConstants& c) {
        return {{c.core_energy, c.core_range}, c.apart * c.apart};
    }

    template <class T, class Record>
    static T distance2(const Record& i, const Record& j) {
        const T b = j.body - i.body;
        const auto X_ji = j.X - i.X;
        return b * b + dot(X_ji, X_ji);
    }
    /// `of_pair` where the two touch, else 0: a particle and itself never do.
    template <class T, class Record>
    T where_apart(const Record& i, const Record& j, const T& of_pair) const {
        return where_below(T(apart2), distance2<T>(i, j), of_pair);
    }
};

template <int Dim>
struct ContactForce {
    static constexpr bool light = true;  // sweep.hpp
    ContactPotential contact;
    static ContactForce with(const PassConstants& c) { return {ContactPotential::with(c)}; }

    template <class T>
    struct Sums {
        Vec<Dim, T> force;
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        sums.force -= contact.where_apart(i, j, contact.core.force_over_r(pair.r2)) * pair.r_ji;
    }
    template <class T, class Record>
    static Vec<Dim, T> result(const Record& i, const Sums<T>& sums) {
        return (T(1.0) / i.m) * sums.force;
    }
    static double* sets(const auto& out) { return out.v_dot; }
};

/// Half of each pair's energy.
template <int Dim>
struct ContactEnergy {
    static constexpr bool light = true;  // sweep.hpp
    ContactPotential contact;
    static ContactEnergy with(const PassConstants& c) { return {ContactPotential::with(c)}; }

    template <class T>
    struct Sums {
        T energy{};
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        sums.energy += contact.where_apart(i, j, T(0.5) * contact.core.energy(pair.r2));
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        to.set(to.out.energy, sums.energy);
    }
};

}  // namespace spam
