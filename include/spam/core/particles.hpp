// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace spam {

/// The particles at the corners of a plane element, counterclockwise.
using Quadrilateral = std::array<std::uint32_t, 4>;

/// What a particle keeps for the whole run. Particles are stored in spatial (strip) order; `id` is
/// the number the problem gave them and never changes.
template <int Dim>
struct Particles {
    std::vector<double> mass{};            ///< N
    std::vector<std::int64_t> id{};        ///< N
    std::vector<std::int32_t> body{};      ///< N, connected part 0, 1, ...
    Points<Dim> reference_position{};      ///< Dim x N, the stress-free configuration
    double spacing = 1.0;                  ///< nearest-neighbour distance of the reference lattice
    std::vector<std::int32_t> material{};  ///< N, place in a term's list of materials; empty: all 0

    /// N
    std::size_t size() const { return mass.size(); }
    /// Those of these numbers, in their order.
    Particles some(std::span<const std::uint32_t> numbers) const {
        const auto chosen = [&]<class Value>(const std::vector<Value>& all) {
            std::vector<Value> values;
            for (const auto i : numbers)
                if (!all.empty()) values.push_back(all[i]);
            return values;
        };
        return {chosen(mass), chosen(id),
                chosen(body), reference_position(Eigen::all, numbers),
                spacing,      chosen(material)};
    }
    /// How many bodies there are: the largest number in `body`, and one more.
    std::int32_t bodies() const {
        std::int32_t n = 0;
        for (const auto b : body) n = b >= n ? b + 1 : n;
        return n;
    }
};

}  // namespace spam
