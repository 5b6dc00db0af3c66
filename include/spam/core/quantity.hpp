// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace spam {

/// What a number measures: decides what becomes of it in an image of the particle, and where particles are split
/// or merged.
enum class Quantity : unsigned char {
    scalar,
    position,
    velocity,
    temperature,
    stress,     ///< or what it is made of: sigma/rho^2
    heat_flux,  ///< or Q/rho^2
    vector,     ///< anything else that turns with the axes
    tensor,
};

}  // namespace spam
