// SPDX-License-Identifier: GPL-3.0-or-later
// Words for formulations and schemes: of the option --formulation, of which a problem offers those that it has, and of
// pictures.
#pragma once

#include <spam/physics/scheme.hpp>

#include <string>
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

/// For pictures: the velocity that moves particles; `plain`: of their own.
inline std::string velocity_title(Transport transport, std::string_view plain) {
    if (transport == Transport::plain) return std::string(plain);
    return transport == Transport::average ? "⟨v⟩" : "⟨v⟩ Monaghan";
}
/// For pictures, behind the velocity: what keeps the angular momentum, if anything.
inline std::string torque_title(AngularMomentum law) {
    switch (law) {
        case AngularMomentum::torque_pair:
            return ", pair torque";
        case AngularMomentum::torque_particle:
            return ", particle torque";
        case AngularMomentum::gauss:
            return ", Gauss";
        case AngularMomentum::free:
            break;
    }
    return "";
}

}  // namespace spam
