// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../common.hpp"

/// Stress in the directions along and across the radius, at the particles' undeformed distances.
struct PolarStress {
    std::vector<double> r, radial, hoop, shear;
};

/// Of a state y of the model, about the body's centre. `density`: its own, by which the virial of springs
/// becomes a stress; smooth particles carry theirs.
PolarStress polar_stress(const spam::Model<2>& model, std::span<const double> y, double density);
