// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/general_weight.hpp>
#include <spam/neighbors/pair.hpp>
#include <spam/physics/core_potential.hpp>
#include <spam/physics/density_potential.hpp>
#include <spam/physics/pass_constants.hpp>
#include <spam/physics/record.hpp>

#include <tuple>
#include <utility>

/// The two sums over pairs of density_potential.hpp as passes of the engine, for several potentials at
/// once: the derivatives of the weight function are formed once a pair.
namespace spam {

namespace column {

/// The fields of the density that potentials depend on, then the slopes of the potentials for a unit of
/// mass, S_i = G_i/m_i.
template <class... Terms>
struct Of {
    template <int Dim, class T>
    struct Slopes {
        std::tuple<typename Terms::template Field<Dim, T>...> slopes;
    };
};

}  // namespace column

template <int Dim, class T, class... Terms>
using SlopeRecord =
    typename PointRecord<Dim, T>::template And<column::Of<Terms...>::template Slopes>;

/// The weight function of a pair, seen from i.
template <int Dim, class T>
SPAM_INLINE WeightAt<Dim, T> weight_at(const GeneralWeight<Dim>& weight, const Pair<Dim, T>& pair) {
    return {weight, T(-1.0) * pair.r_ji, pair.r2, pair.r};
}

/// f_i = sum_j m_j K(r_ij), the particle itself counted.
template <int Dim, class... Terms>
struct DensityFields {
    static constexpr bool light = sizeof...(Terms) == 1;  // sweep.hpp
    GeneralWeight<Dim> weight;
    static DensityFields with(const PassConstants&, const GeneralWeight<Dim>& weight) {
        return {weight};
    }

    template <class T>
    struct Sums {
        std::tuple<typename Terms::template Field<Dim, T>...> fields;
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record&, const Record& j, Sums<T>& sums) const {
        const WeightAt<Dim, T> at = weight_at(weight, pair);
        std::apply([&](auto&... f) { ((f = f + j.m * Terms::template weigh<Dim>(at)), ...); },
                   sums.fields);
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        to.template write<SlopeRecord<Dim, double, Terms...>,
                          column::Of<Terms...>::template Slopes>(sums.fields);
    }
};

/// v_dot_i = -sum_j m_j (S_i +- S_j) . grad_i K(r_ij), + for even K, - for odd K, and the force of the
/// core, which is no force by mass.
template <int Dim, class... Terms>
struct DensityForces {
    GeneralWeight<Dim> weight;
    CorePotential core;
    static DensityForces with(const PassConstants& c, const GeneralWeight<Dim>& weight) {
        return {weight, {c.core_energy, c.core_range}};
    }

    template <class T>
    struct Sums {
        Vec<Dim, T> v_dot, core_force;
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        const WeightAt<Dim, T> at = weight_at(weight, pair);
        add_terms(at, i, j, sums, std::index_sequence_for<Terms...>());
        sums.core_force -= core.force_over_r(pair.r2) * pair.r_ji;
    }
    template <class T, class Record>
    static Vec<Dim, T> result(const Record& i, const Sums<T>& sums) {
        return sums.v_dot + (T(1.0) / i.m) * sums.core_force;
    }
    static double* sets(const auto& out) { return out.v_dot; }

  private:
    template <class T, class Record, std::size_t... K>
    static void add_terms(const WeightAt<Dim, T>& at, const Record& i, const Record& j,
                          Sums<T>& sums, std::index_sequence<K...>) {
        ((sums.v_dot -=
          j.m * Terms::template pull<Dim>(
                    std::get<K>(i.slopes) + T(Terms::parity) * std::get<K>(j.slopes), at)),
         ...);
    }
};

/// The force of a potential of the distance of two particles, a core for instance: no force by mass.
template <int Dim, DistancePotential Potential>
struct DistanceForce {
    static constexpr bool light = true;  // sweep.hpp
    Potential potential;
    static DistanceForce with(const PassConstants& c) { return {{c.core_energy, c.core_range}}; }

    template <class T>
    struct Sums {
        Vec<Dim, T> force;
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record&, const Record&, Sums<T>& sums) const {
        sums.force -= potential.force_over_r(pair.r2) * pair.r_ji;
    }
    template <class T, class Record>
    static Vec<Dim, T> result(const Record& i, const Sums<T>& sums) {
        return (T(1.0) / i.m) * sums.force;
    }
    static double* sets(const auto& out) { return out.v_dot; }
};

/// sum_j of half of the pair's energy: each pair is found from both ends. A particle itself is counted
/// once, and taken off.
template <int Dim, DistancePotential Potential>
struct DistanceEnergy {
    static constexpr bool light = true;  // sweep.hpp
    Potential potential;
    static DistanceEnergy with(const PassConstants& c) { return {{c.core_energy, c.core_range}}; }

    template <class T>
    struct Sums {
        T energy{};
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record&, const Record&, Sums<T>& sums) const {
        sums.energy += potential.energy(pair.r2);
    }
    template <class T, class Record>
    T result(const Record&, const Sums<T>& sums) const {
        return T(0.5) * (sums.energy - T(potential.energy(0.0)));
    }
    static double* sets(const auto& out) { return out.energy; }
};

template <int Dim>
using CoreForce = DistanceForce<Dim, CorePotential>;
template <int Dim>
using CoreEnergy = DistanceEnergy<Dim, CorePotential>;

}  // namespace spam
