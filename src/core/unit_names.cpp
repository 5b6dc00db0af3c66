// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/dimensions.hpp>
#include <spam/core/unit_names.hpp>

#include <fmt/format.h>

#include <cstdlib>

namespace spam {
namespace {

std::string with_power(const std::string& name, int power) {
    return power == 1   ? name
           : power == 2 ? name + "²"
           : power == 3 ? name + "³"
                        : fmt::format("{}^{}", name, power);
}

}  // namespace

std::string UnitNames::of(std::string_view made_of, int dim) const {
    Dimensions powers = dimensions_of(made_of, dim);
    if (!named() || powers == Dimensions{}) return {};
    if (of_unit_thickness) powers.length -= powers.mass;
    if (powers == Dimensions{1, -1, -2} && !stress.empty()) return stress;
    if (powers == Dimensions{1, 2, -2} && !energy.empty()) return energy;
    std::string above, below;
    int divisors = 0;
    for (const auto& [name, power] :
         {std::pair{&mass, powers.mass}, {&length, powers.length}, {&time, powers.time}}) {
        if (power == 0) continue;
        std::string& side = power > 0 ? above : below;
        if (!side.empty()) side += ' ';
        side += with_power(*name, std::abs(power));
        if (power < 0) ++divisors;
    }
    if (divisors == 0) return above;
    if (above.empty()) above.push_back('1');
    return divisors > 1 ? fmt::format("{}/({})", above, below) : fmt::format("{}/{}", above, below);
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
