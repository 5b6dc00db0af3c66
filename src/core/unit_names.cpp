// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/unit_names.hpp>

#include <fmt/format.h>

#include <array>
#include <cstdlib>

namespace spam {
namespace {

/// Powers of mass, length and time.
using Powers = std::array<int, 3>;

/// "m l^(2-D)/t^2" in D dimensions. Grammar: factors of one letter, each with ^ and a number, D or (2-D); the
/// one after a / divides.
Powers powers_of(std::string_view made_of, int dim) {
    Powers powers{};
    int sign = 1;
    while (!made_of.empty()) {
        const char letter = made_of.front();
        made_of.remove_prefix(1);
        if (letter == '/') sign = -1;
        const auto which = std::string_view("mlt").find(letter);
        if (which == std::string_view::npos) continue;
        int power = 1;
        if (made_of.starts_with("^(2-D)")) {
            power = 2 - dim;
            made_of.remove_prefix(6);
        } else if (made_of.starts_with("^D")) {
            power = dim;
            made_of.remove_prefix(2);
        } else if (made_of.starts_with('^') && made_of.size() > 1) {
            power = made_of[1] - '0';
            made_of.remove_prefix(2);
        }
        powers[which] += sign * power;
        sign = 1;
    }
    return powers;
}

std::string with_power(const std::string& name, int power) {
    return power == 1   ? name
           : power == 2 ? name + "²"
           : power == 3 ? name + "³"
                        : fmt::format("{}^{}", name, power);
}

}  // namespace

std::string UnitNames::of(std::string_view made_of, int dim) const {
    Powers powers = powers_of(made_of, dim);
    if (!named() || powers == Powers{}) return {};
    if (of_unit_thickness) powers[1] -= powers[0];
    if (powers == Powers{1, -1, -2} && !stress.empty()) return stress;
    if (powers == Powers{1, 2, -2} && !energy.empty()) return energy;
    std::string above, below;
    int divisors = 0;
    const std::array names{&mass, &length, &time};
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (powers[k] == 0) continue;
        std::string& side = powers[k] > 0 ? above : below;
        if (!side.empty()) side += ' ';
        side += with_power(*names[k], std::abs(powers[k]));
        if (powers[k] < 0) ++divisors;
    }
    if (divisors == 0) return above;
    return fmt::format(fmt::runtime(divisors > 1 ? "{}/({})" : "{}/{}"),
                       above.empty() ? std::string("1") : above, below);
}

std::string UnitNames::axis(std::string_view quantity, std::string_view made_of, int dim) const {
    const std::string unit = of(made_of, dim);
    return unit.empty() ? std::string(quantity) : fmt::format("{}, {}", quantity, unit);
}

std::vector<std::pair<std::string, std::string>> UnitNames::table(int dim) const {
    std::vector<std::pair<std::string, std::string>> all;
    if (!named()) return all;
    for (const auto& [name, made_of] : {std::pair{"length", "l"},
                                        {"mass", "m"},
                                        {"time", "t"},
                                        {"velocity", "l/t"},
                                        {"density", "m/l^D"},
                                        {"stress", "m l^(2-D)/t^2"},
                                        {"momentum", "m l/t"},
                                        {"angular momentum", "m l^2/t"},
                                        {"energy", "m l^2/t^2"},
                                        {"energy by mass", "l^2/t^2"}})
        all.emplace_back(name, of(made_of, dim));
    return all;
}

std::string UnitNames::describe() const {
    if (!named())
        return reduced.empty() ? std::string("those of its numbers") : "reduced: 1 is " + reduced;
    return fmt::format("{}, {}{}, {}; stress {}, speed {}", length, mass,
                       of_unit_thickness ? fmt::format(" (of a thickness of 1 {})", length) : "",
                       time, of("m l^(2-D)/t^2", of_unit_thickness ? 2 : 3), of("l/t", 3));
}

UnitNames reduced_units(std::string what_is_one) {
    UnitNames units;
    units.reduced = std::move(what_is_one);
    return units;
}

}  // namespace spam
