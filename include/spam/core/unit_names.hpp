// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spam {

/// Names of the units in which a run's numbers are. The numbers themselves know nothing of it.
struct UnitNames {
    /// "mm", "g", "µs". Empty: nothing is known of the units, or they are reduced.
    std::string length, mass, time;
    /// Names, where they have some, of mass/(length time^2) and mass length^2/time^2 (in space).
    std::string stress{}, energy{};
    /// Masses, and what is made of them, are those of a plate as thick as one unit of length.
    bool of_unit_thickness = false;
    /// What is 1, in words, where the units have no names: "the mass of a particle and its spacing".
    std::string reduced{};

    /// Whether they have names.
    bool named() const { return !time.empty(); }
    /// Whether anything is known of them.
    bool declared() const { return named() || !reduced.empty(); }

    /// Of a quantity made of mass m, length l and time t in D dimensions, as fields say it (core/field.hpp):
    /// "m/l^D" is "g/mm³". Empty for pure numbers and where units have no names.
    std::string of(std::string_view made_of, int dim) const;
    /// Name of an axis: "t, µs".
    std::string axis(std::string_view quantity, std::string_view made_of, int dim) const;
    /// Name and unit of each kind of number that results hold in D dimensions.
    std::vector<std::pair<std::string, std::string>> table(int dim) const;
    /// One line: the three, or what is 1.
    std::string describe() const;
};

/// Of numbers that are ratios to what is 1: `what_is_one` completes "1 is ...".
UnitNames reduced_units(std::string what_is_one);

}  // namespace spam
