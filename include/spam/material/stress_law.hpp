// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>

#include <concepts>
#include <string>

namespace spam {

/// A law that integrates the stress of one particle: sigma_dot from the velocity gradient
/// (grad v)_ab = d v_b / d x_a and the present stress; `describe` names it with its constants, for
/// the banner of a run. Where it has a double sound_speed(double density), schemes with artificial
/// viscosity can use it.
template <class Law, int Dim>
concept StressLaw = requires(const Law law, Mat<Dim> grad_v, SymTensor<Dim> stress) {
    { law.stress_rate(grad_v, stress) } -> std::same_as<SymTensor<Dim>>;
    { law.describe() } -> std::convertible_to<std::string>;
};

}  // namespace spam
