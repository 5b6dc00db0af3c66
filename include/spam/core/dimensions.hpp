// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace spam {

/// How a quantity depends on the units of mass, length and time: m^mass l^length t^time.
struct Dimensions {
    int mass = 0, length = 0, time = 0;

    friend constexpr bool operator==(const Dimensions&, const Dimensions&) = default;
};

/// Of a unit as fields name it (FieldKind::unit) in `dim` dimensions of space: "m l^(2-D)/t^2". Precondition:
/// factors m, l, t with whole powers, D or a number less D, divided by those behind a '/'; or "1".
Dimensions dimensions_of(std::string_view unit, int dim);

/// x^power, for powers of two without rounding.
double whole_power(double x, int power);

/// A mass, a length and a time, as units of others.
struct Units {
    double mass = 1.0, length = 1.0, time = 1.0;

    /// What a quantity of these dimensions that is 1 in these units is in those that they are given in.
    double of(const Dimensions& d) const {
        return whole_power(mass, d.mass) * whole_power(length, d.length) *
               whole_power(time, d.time);
    }
    double of(std::string_view unit, int dim) const { return of(dimensions_of(unit, dim)); }
};

}  // namespace spam
