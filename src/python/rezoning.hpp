// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/problem/rezoning.hpp>

#include <optional>
#include <utility>

namespace spam::python {

/// Rezoning as Python names it, before the number of dimensions is known.
struct RezoningChoice {
    using Limits = std::optional<std::pair<double, double>>;
    double every;
    Limits volume, neighbours, gradient;
    double range;
    bool in_two;

    template <int Dim>
    Rezoning<Dim> of() const {
        const auto limits = [](const Limits& given) -> std::optional<RezoningLimits> {
            if (!given) return {};
            return RezoningLimits{given->first, given->second};
        };
        Rezoning<Dim> how;
        how.every = every;
        how.volume = limits(volume);
        how.neighbours = limits(neighbours);
        how.gradient = limits(gradient);
        how.range = range;
        how.in_two = in_two;
        return how;
    }
};

}  // namespace spam::python
