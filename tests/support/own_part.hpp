// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/particles.hpp>
#include <spam/core/parts.hpp>

namespace spam::test {

/// Those of all particles that this part of a run has (core/parts.hpp); all of them where it is alone.
template <int Dim>
Particles<Dim> own_part(const Particles<Dim>& all) {
    return Parts::here().alone() ? all : all.some(Parts::here().numbers());
}

/// For externals, which know particles by their number in the whole run.
inline std::vector<std::uint8_t> of_whole(const std::vector<std::uint8_t>& own) {
    return Parts::here().by_number(std::span<const std::uint8_t>(own));
}
template <int Dim>
Points<Dim> of_whole(const Points<Dim>& own) {
    const std::span<const double> numbers(own.data(), static_cast<std::size_t>(own.size()));
    const auto all = Parts::here().by_number(numbers, Dim);
    return Eigen::Map<const Points<Dim>>(all.data(), Dim,
                                         static_cast<Eigen::Index>(all.size() / Dim));
}

}  // namespace spam::test
