// SPDX-License-Identifier: GPL-3.0-or-later
#include "shifting_coefficient.hpp"

#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/rhs/model.hpp>

#include <fmt/format.h>

namespace spam {
namespace {

/// Least share of a box that counts as full. A short range counts particles themselves too much.
constexpr double full = 0.75;

/// How long the box is in this direction; 0 where it is open.
template <int Dim>
double extent(const Box<Dim>& box, int a) {
    if (box.periodic(a)) return box.length(a);
    const auto &lower = box.wall(a, false), &upper = box.wall(a, true);
    return lower.open() || upper.open() ? 0.0 : upper.at - lower.at;
}

}  // namespace

template <int Dim>
double shifting_coefficient(const Selection<Dim>& among, const Scheme& scheme, double density,
                            std::optional<double> sound_speed) {
    const auto& box = among.model().box();
    if (among.particles().size() != among.model().particles().size())
        throw InputError(
            "transport: shifting is for a fluid that is alone in its box, and this one is a part of the "
            "particles; use --transport plain");
    double volume = 1.0;
    for (int a = 0; a < Dim; ++a) {
        if (!(extent(box, a) > 0.0))
            throw InputError(fmt::format(
                "transport: shifting drives particles out of a free surface, and the box is open across "
                "direction {}; make that periodic or put walls on both sides, or use --transport plain",
                "xyz"[a]));
        volume *= extent(box, a);
    }
    const auto& mass = among.particles().mass;
    const double share =
        exact_sum(mass.size(), [&](std::size_t i) { return mass[i]; }) / (density * volume);
    if (share < full)
        throw InputError(fmt::format(
            "transport: shifting drives particles out of a free surface, and they fill {:.0f} % of the box; "
            "fill it, or use --transport plain",
            100.0 * share));
    if (!sound_speed || !(*sound_speed > 0.0))
        throw InputError(
            "transport: shifting goes by the sound speed of the fluid at rest without heat, and this law has "
            "none; use an embedded atom, or --transport plain");
    return scheme.shifting * *sound_speed * scheme.range;
}

#define SPAM_INSTANTIATE(D)                                                          \
    template double shifting_coefficient(const Selection<D>&, const Scheme&, double, \
                                         std::optional<double>);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
