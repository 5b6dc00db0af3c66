// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/lanes.hpp>
#include <spam/core/tensor.hpp>

#include <tuple>
#include <type_traits>
#include <utility>

namespace spam {

/// f(number) for every number of a value: of a number itself, of a Vec, Mat or SymTensor, of a tuple of
/// such.
template <class Value, class F>
SPAM_INLINE constexpr void for_each_number(Value& value, const F& f) {
    if constexpr (requires { value.c; })
        for (auto& number : value.c) f(number);
    else if constexpr (requires { std::tuple_size<Value>::value; })
        std::apply([&](auto&... part) { (for_each_number(part, f), ...); }, value);
    else
        f(value);
}

/// What a record may carry of a particle. A column is a struct with
///     template <int Dim, class T> struct In { Vec<Dim, T> x; static constexpr auto member = &In::x; };
/// a record has that member under its name. T is double in memory, and lanes in a pair body.
namespace column {

struct Position {
    template <int Dim, class T>
    struct In {
        Vec<Dim, T> x;  ///< wrapped into the box where it is periodic
        static constexpr auto member = &In::x;
    };
};
struct Velocity {
    template <int Dim, class T>
    struct In {
        Vec<Dim, T> v;
        static constexpr auto member = &In::v;
    };
};
struct Mass {
    template <int Dim, class T>
    struct In {
        T m{};
        static constexpr auto member = &In::m;
    };
};
struct Density {
    template <int Dim, class T>
    struct In {
        T rho{};  ///< or what the mean density takes instead (mean_density.hpp, EitherMean)
        static constexpr auto member = &In::rho;
    };
};
/// Stored: formed inside the pair, FMA would break F_ij = -F_ji.
struct Stress {
    template <int Dim, class T>
    struct In {
        SymTensor<Dim, T> A;  ///< sigma/rho^2
        static constexpr auto member = &In::A;
    };
};
struct Transport {
    template <int Dim, class T>
    struct In {
        Vec<Dim, T> u;  ///< transport velocity, r_dot
        static constexpr auto member = &In::u;
    };
};
struct NegativeFactor {
    template <int Dim, class T>
    struct In {
        T negative_factor = T(1.0);  ///< R of the particle's body, for pair torques below zero
        static constexpr auto member = &In::negative_factor;
    };
};
struct PositiveFactor {
    template <int Dim, class T>
    struct In {
        T positive_factor = T(1.0);  ///< 1/R
        static constexpr auto member = &In::positive_factor;
    };
};

struct SoundSpeed {
    template <int Dim, class T>
    struct In {
        T c{};
        static constexpr auto member = &In::c;
    };
};

}  // namespace column

/// The type of a column's value.
template <class Column, int Dim, class T>
using ColumnValue =
    std::remove_reference_t<decltype(std::declval<typename Column::template In<Dim, T>&>().*
                                     Column::template In<Dim, T>::member)>;
/// How many numbers it holds.
template <class Column, int Dim>
inline constexpr int column_numbers = static_cast<int>(sizeof(ColumnValue<Column, Dim, double>) /
                                                       sizeof(double));

/// A row of numbers in memory and a struct in a pair body, made of columns: packed once per right-hand
/// side in the order of the slots, so that a sweep reads neighbours from adjacent memory. `visit` calls
/// f(number, k) for k = 0, 1, ... `numbers` - 1; `at<Column>` is the k of the column's first number.
/// A record may be read as one that has fewer columns, the same ones at its beginning.
template <int Dim, class T, class... Columns>
struct RecordOf : Columns::template In<Dim, T>... {
    template <class U>
    using With = RecordOf<Dim, U, Columns...>;
    template <class... More>
    using And = RecordOf<Dim, T, Columns..., More...>;

    static constexpr int numbers = (0 + ... + column_numbers<Columns, Dim>);

    template <class Column>
    static constexpr bool has = (std::is_same_v<Column, Columns> || ...);
    template <class Column>
    static constexpr int at = [] {
        static_assert(has<Column>);
        int k = 0;
        bool before = true;
        ((before = before && !std::is_same_v<Column, Columns>,
          k += before ? column_numbers<Columns, Dim> : 0),
         ...);
        return k;
    }();

    template <class F>
    SPAM_INLINE constexpr void visit(const F& f) {
        int k = 0;
        const auto one = [&](T& number) { f(number, k++); };
        (for_each_number(this->*(Columns::template In<Dim, T>::member), one), ...);
    }
};

/// What pairs that act by their distance alone need of a particle.
template <int Dim, class T = double>
using PointRecord = RecordOf<Dim, T, column::Position, column::Mass>;

/// What every moving particle has.
template <int Dim, class T = double>
using MotionRecord = RecordOf<Dim, T, column::Position, column::Velocity, column::Mass>;

/// What a pair body may know of a particle of a solid.
template <int Dim, class T = double>
using Record = typename MotionRecord<Dim, T>::template And<column::Density, column::Stress>;

/// The same for passes that need the transport velocity or the torque factors of the first sweep.
template <int Dim, class T = double>
using TransportRecord =
    typename Record<Dim, T>::template And<column::Transport, column::NegativeFactor,
                                          column::PositiveFactor>;

/// The same where the artificial viscosity needs every particle's own sound speed.
template <int Dim, class T = double>
using ViscousRecord = typename TransportRecord<Dim, T>::template And<column::SoundSpeed>;

}  // namespace spam
