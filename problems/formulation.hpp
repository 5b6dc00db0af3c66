// SPDX-License-Identifier: GPL-3.0-or-later
// The words of the option --formulation. A problem offers those that it has.
#pragma once

#include <string_view>

namespace spam {

/// Over which neighbours a solid sums, and what it remembers of them.
enum class Formulation {
    updated,           ///< those of the present configuration, nothing
    total_lagrangian,  ///< those of the start, where they were
    material_vectors   ///< those of the present configuration, a vector for each
};
inline std::string_view to_string(Formulation formulation) {
    constexpr std::string_view names[] = {"updated", "total_lagrangian", "material_vectors"};
    return names[static_cast<int>(formulation)];
}

}  // namespace spam
