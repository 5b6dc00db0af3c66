// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/external/drag.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

template <int Dim>
Drag<Dim>::Drag(double c, double fastest, const Point<Dim>& U) : c_(c),
                                                                 fastest_(fastest),
                                                                 U_(U) {
    if (!(c >= 0.0) || !std::isfinite(c) || !(fastest >= 0.0) || !U.allFinite())
        throw InputError(fmt::format(
            "drag: coefficient {} and speed {} must be finite and not below 0", c, fastest));
}

template <int Dim>
std::string Drag<Dim>::describe() const {
    return fmt::format("quadratic drag c = {:g}", c_);
}

SPAM_COMPILED(template class Drag);

}  // namespace spam
