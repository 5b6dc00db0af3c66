// SPDX-License-Identifier: GPL-3.0-or-later
// --ranges of gases.
#pragma once

#include <string_view>

namespace spam {

enum class Ranges { fixed, density, ellipses };
inline std::string_view to_string(Ranges r) {
    return r == Ranges::fixed ? "fixed" : r == Ranges::density ? "density" : "ellipses";
}

}  // namespace spam
