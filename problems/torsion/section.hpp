// SPDX-License-Identifier: GPL-3.0-or-later
// The torsion of a square bar, as Saint-Venant has it and as particles do.
#pragma once

#include <spam/kernel/kernel.hpp>

namespace torsion {

/// J/a^4 of a square of side a, J the torsional rigidity by the shear modulus (Saint-Venant): 0.140577.
inline constexpr double rigidity_of_square = 0.1405770150;

/// J/I_p of n x n columns of a cubic lattice, particles that sum gradients over their initial neighbours, by that of a
/// square, 6 x 0.140577. The frequency goes as its root.
///
/// A bar that is twisted by tau a length has displacements (-tau z y, tau z x, tau w(x, y)), and w makes the energy
/// least:
///     J = min over w of sum (dw/dx - y*)^2 + (dw/dy + x*)^2.
/// Of a plane w, D_x w = sum_j V (w_j - w_i) (K_i grad_i W_ij)_x is what a gradient that is exact for linear fields
/// makes of it. And d/dz of -tau z y is not -tau y_i: it takes -tau y* from the mean place of the neighbours in
/// weights (r_z)^2 |W'|/r, which near a face is further inside. Shear is worth most at the faces: the bar is too
/// soft.
double rigidity_of_columns(int n, spam::Kernel kernel, double range);

}  // namespace torsion
