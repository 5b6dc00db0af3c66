// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>

#include <string>

namespace spam {

/// Why there is no total_energy() that the rates keep whatever y is; empty where there is.
template <int Dim>
std::string why_no_energy(const Model<Dim>& model);

/// E = sum m v^2/2 + internal energy, as an exact sum rounded once (ExactSum).
template <int Dim>
double total_energy(const Model<Dim>& model, std::span<const double> y);

/// dE/dy, as long as y. Where y holds energies, E = sum m (e + v^2/2):
///     dE/dv = m v, dE/de = m, all else 0;
/// where y = (x, v), the internal energy is the potential of the forces:
///     dE/dx = -m dv/dt, dE/dv = m v.
/// Returns how many right-hand sides that took. Precondition: why_no_energy() is empty.
template <int Dim>
std::size_t energy_gradient(Model<Dim>& model, double t, std::span<const double> y,
                            std::span<double> gradient);

}  // namespace spam
