// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/general_weight.hpp>
#include <spam/neighbors/pair.hpp>
#include <spam/physics/core_potential.hpp>
#include <spam/physics/density_potential.hpp>
#include <spam/physics/record.hpp>

#include <tuple>
#include <utility>

/// The two sums over pairs of density_potential.hpp as passes of the engine, for several potentials at
/// once: the derivatives of the weight function are formed once a pair.
namespace spam {

/// f(number) for the numbers of a field of the density: the field itself, a Vec's or a SymTensor's.
template <class Field, class F>
constexpr void for_each_number(Field& field, const F& f) {
    if constexpr (requires { field.c; })
        for (auto& number : field.c) f(number);
    else
        f(field);
}

/// A point, and the slopes of its potentials for a unit of mass, S_i = G_i/m_i.
template <int Dim, class T, class... Terms>
struct SlopeRecord : PointRecord<Dim, T> {
    template <class U>
    using With = SlopeRecord<Dim, U, Terms...>;
    static constexpr int slopes_at = PointRecord<Dim, T>::numbers;
    static constexpr int numbers =
        slopes_at + (0 + ... + int(sizeof(typename Terms::template Field<Dim>) / sizeof(double)));

    std::tuple<typename Terms::template Field<Dim, T>...> slopes;

    template <class F>
    constexpr void visit(const F& f) {
        PointRecord<Dim, T>::visit(f);
        int k = slopes_at;
        const auto one = [&](T& number) { f(number, k++); };
        std::apply([&](auto&... slope) { (for_each_number(slope, one), ...); }, slopes);
    }
};

/// The weight function of a pair, seen from i.
template <int Dim, class T>
WeightAt<Dim, T> weight_at(const GeneralWeight<Dim>& weight, const Pair<Dim, T>& pair) {
    return {weight, T(-1.0) * pair.r_ji, pair.r2, pair.r};
}

/// f_i = sum_j m_j K(r_ij), the particle itself counted.
template <int Dim, class... Terms>
struct DensityFields {
    GeneralWeight<Dim> weight;

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
};

/// v_dot_i = -sum_j m_j (S_i +- S_j) . grad_i K(r_ij), + for even K, - for odd K, and the force of the
/// core, which is no force by mass.
template <int Dim, class... Terms>
struct DensityForces {
    GeneralWeight<Dim> weight;
    CorePotential core;

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

/// sum_j of the core's energy of the pair: each is found from both ends, a particle itself once.
template <int Dim>
struct CoreEnergy {
    static constexpr bool light = true;  // sweep.hpp
    CorePotential core;

    template <class T>
    struct Sums {
        T energy{};
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record&, const Record&, Sums<T>& sums) const {
        sums.energy += core.energy(pair.r2);
    }
};

}  // namespace spam
