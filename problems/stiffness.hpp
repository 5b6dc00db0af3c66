// SPDX-License-Identifier: GPL-3.0-or-later
// Default steps of problems whose options can make things stiffer or faster than they usually are.
#pragma once

#include <spam/rhs/contact.hpp>

#include <algorithm>
#include <cmath>

namespace spam {

/// By what a step that resolves the usual potential (1 - r^2/s^2)^4 of cores and contacts must be multiplied for
/// another one, at most 1: frequencies go with sqrt(e_c)/s. Without energy there is none.
inline double relative_step(const ContactScheme& one, const ContactScheme& usual) {
    if (!(one.energy > 0.0) || !(usual.energy > 0.0)) return 1.0;
    return std::min(1.0, one.range / usual.range * std::sqrt(usual.energy / one.energy));
}

/// The same for a strength (an energy) that is usually this.
inline double relative_step_of_strength(double strength, double usual) {
    return strength > usual ? std::sqrt(usual / strength) : 1.0;
}

/// The same where something meets with this speed, and usually with no more than that.
inline double relative_step(double speed, double usual) { return std::min(1.0, usual / speed); }

}  // namespace spam
