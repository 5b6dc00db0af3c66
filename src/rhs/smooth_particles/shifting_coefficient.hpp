// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/scheme.hpp>
#include <spam/rhs/selection.hpp>

#include <optional>

namespace spam {

/// D of shifting.hpp for particles whose density at rest and sound speed there are these. Throws InputError
/// where shifting has no meaning: a free surface looks to it like a place where particles are missing.
template <int Dim>
double shifting_coefficient(const Selection<Dim>& among, const Scheme& scheme, double density,
                            std::optional<double> sound_speed);

}  // namespace spam
