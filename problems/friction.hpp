// SPDX-License-Identifier: GPL-3.0-or-later
// The option --friction of problems with viscous fluids.
#pragma once

#include <spam/io/options.hpp>

#include <string_view>

namespace spam {

enum class FrictionBy { pairs, gradients };
inline std::string_view to_string(FrictionBy f) {
    return f == FrictionBy::pairs ? "pairs" : "gradients";
}

inline void add_friction_option(Options& options, FrictionBy& friction) {
    options.choice<FrictionBy>(
        "friction", friction, {FrictionBy::pairs, FrictionBy::gradients},
        "viscosity and conduction from differences of pairs, or from gradients");
}

}  // namespace spam
