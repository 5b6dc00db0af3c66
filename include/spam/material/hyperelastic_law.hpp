// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>

#include <concepts>
#include <string>

namespace spam {

/// A law that knows the stress from the deformation alone, F_ab = d x_a / d X_b: `energy` per volume of
/// the reference configuration, unchanged by rotations F -> Q F; `stress` its derivative, the first
/// Piola-Kirchhoff stress P_ab = d energy / d F_ab; `stiffness` the modulus in which penalties are
/// measured; `describe` names it with its constants. Where F is outside the law the stress is NaN.
template <class Law, int Dim>
concept HyperelasticLaw = requires(const Law law, Mat<Dim> F) {
    { law.energy(F) } -> std::same_as<double>;
    { law.stress(F) } -> std::same_as<Mat<Dim>>;
    { law.stiffness() } -> std::convertible_to<double>;
    { law.describe() } -> std::convertible_to<std::string>;
};

}  // namespace spam
