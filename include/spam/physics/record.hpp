// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/lanes.hpp>
#include <spam/core/tensor.hpp>
#include <spam/neighbors/image.hpp>

#include <array>
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

/// What a record may carry of a particle: a struct of one member, which records have under its name. T is
/// double in memory, and lanes in a pair body. `quantity` says what it becomes in an image of the particle;
/// without it the same number, or a vector or tensor that turns with the axes.
namespace column {

template <int Dim, class T>
struct Position {
    static constexpr auto quantity = Quantity::position;
    Vec<Dim, T> x;  ///< of the image that the list took
};
template <int Dim, class T>
struct Velocity {
    static constexpr auto quantity = Quantity::velocity;
    Vec<Dim, T> v;
};
template <int Dim, class T>
struct Mass {
    T m{};
};
template <int Dim, class T>
struct Density {
    T rho{};  ///< or what the mean density takes instead (mean_density.hpp, EitherMean)
};
/// Stored: formed inside the pair, FMA would break F_ij = -F_ji.
template <int Dim, class T>
struct Stress {
    static constexpr auto quantity = Quantity::stress;
    SymTensor<Dim, T> A;  ///< sigma/rho^2
};
template <int Dim, class T>
struct Transport {
    static constexpr auto quantity = Quantity::velocity;
    Vec<Dim, T> u;  ///< transport velocity, r_dot
};
template <int Dim, class T>
struct NegativeFactor {
    T negative_factor = T(1.0);  ///< R of the particle's body, for pair torques below zero
};
template <int Dim, class T>
struct PositiveFactor {
    T positive_factor = T(1.0);  ///< 1/R
};

/// In space. An axial vector: bodies whose torques are balanced have no images behind mirrors.
template <int Dim, class T>
struct TorqueMultiplier {
    Vec<Dim, T> theta;
};

template <int Dim, class T>
struct SoundSpeed {
    T c{};
};

}  // namespace column

/// The one member of a column.
template <class Column>
SPAM_INLINE constexpr auto& column_value(Column& column) {
    auto& [value] = column;
    return value;
}

/// Writes what the numbers of a value are: a scalar, a vector, a tensor, or the quantity given.
template <int Dim, class Value>
constexpr NumberKind* write_kinds(const Value& value, NumberKind* to,
                                  Quantity given = Quantity::scalar) {
    const auto either = [given](Quantity own) { return given == Quantity::scalar ? own : given; };
    if constexpr (requires { std::tuple_size<Value>::value; }) {
        std::apply([&](const auto&... part) { ((to = write_kinds<Dim>(part, to)), ...); }, value);
    } else if constexpr (requires { value(0, 0); }) {
        constexpr bool symmetric = std::is_same_v<Value, SymTensor<Dim>>;
        for (int a = 0; a < Dim; ++a)
            for (int b = symmetric ? a : 0; b < Dim; ++b)
                to[symmetric ? symmetric_index(Dim, a, b) : a * Dim + b] = {
                    either(Quantity::tensor), static_cast<unsigned char>(a),
                    static_cast<unsigned char>(b)};
        to += value.c.size();
    } else if constexpr (requires { value.c; }) {
        for (unsigned char a = 0; a < Dim; ++a) *to++ = {either(Quantity::vector), a, a};
    } else {
        *to++ = {given, 0, 0};
    }
    return to;
}

template <int Dim, class Column>
constexpr NumberKind* write_kinds_of(const Column& column, NumberKind* to) {
    if constexpr (requires { Column::quantity; })
        return write_kinds<Dim>(column_value(column), to, Column::quantity);
    else
        return write_kinds<Dim>(column_value(column), to);
}

/// A row of numbers in memory and a struct in a pair body, made of columns: packed once per right-hand
/// side in the order of the slots, so that a sweep reads neighbours from adjacent memory. `visit` calls
/// f(number, k) for k = 0, 1, ... `numbers` - 1; `at<Column>` is the k of the column's first number.
/// A record may be read as one that has fewer columns, the same ones at its beginning.
template <int Dim, class T, template <int, class> class... Columns>
struct RecordOf : Columns<Dim, T>... {
    template <class U>
    using With = RecordOf<Dim, U, Columns...>;
    template <template <int, class> class... More>
    using And = RecordOf<Dim, T, Columns..., More...>;

    template <template <int, class> class Column>
    static constexpr bool has = (std::is_same_v<Column<Dim, T>, Columns<Dim, T>> || ...);
    template <template <int, class> class Column>
    static constexpr int at = [] {
        static_assert(has<Column>);
        int k = 0;
        bool before = true;
        ((before = before && !std::is_same_v<Column<Dim, T>, Columns<Dim, T>>,
          k += before ? int(sizeof(Columns<Dim, double>) / sizeof(double)) : 0),
         ...);
        return k;
    }();
    static constexpr int numbers = (0 + ... + int(sizeof(Columns<Dim, double>) / sizeof(double)));
    static constexpr auto kinds = [] {
        std::array<NumberKind, numbers> kinds{};
        NumberKind* to = kinds.data();
        ((to = write_kinds_of<Dim>(Columns<Dim, double>{}, to)), ...);
        return kinds;
    }();

    template <class F>
    SPAM_INLINE constexpr void visit(const F& f) {
        int k = 0;
        const auto one = [&](T& number) { f(number, k++); };
        (for_each_number(column_value(static_cast<Columns<Dim, T>&>(*this)), one), ...);
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

/// The same where torques are balanced in space.
template <int Dim, class T = double>
using BalancedRecord = typename ViscousRecord<Dim, T>::template And<column::TorqueMultiplier>;

}  // namespace spam
