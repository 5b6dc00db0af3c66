// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of lattice_stability share: lattices, and which potentials act on them.
#pragma once

#include "../common.hpp"
#include "lattice_strength.hpp"

namespace lattice_stability {

using namespace spam;

enum class LatticeKind { triangular, square };
std::string_view to_string(LatticeKind kind);

/// e(rho) alone, or with one of the others, or with both.
enum class Acting { density, curvature, gradient, both };
std::string_view to_string(Acting acting);
/// "e(ρ) + curvature"
std::string title_of(Acting acting);
/// Its colour in every picture.
int style_of(Acting acting);
inline bool has_curvature(Acting acting) {
    return acting == Acting::curvature || acting == Acting::both;
}
inline bool has_gradient(Acting acting) {
    return acting == Acting::gradient || acting == Acting::both;
}
inline const std::vector<Acting> all_potentials{Acting::density, Acting::curvature,
                                                Acting::gradient, Acting::both};

struct Parameters {
    LatticeKind lattice = LatticeKind::triangular;
    Acting acting = Acting::density;
    Kernel kernel = Kernel::w5;
    std::optional<double> range{};
    int cells = 10, block = 12;
    double strength = 0.1, surface_tension = 0.1, misfit = 1.0;
    double speed = 0.01;
    int seed = 1;

    /// At rest on the lattice where misfit is 1.
    DensityPotentials potentials(LatticeKind kind, Acting which, double h) const;
};

LatticeVectors vectors_of(LatticeKind kind);
/// cells x cells particles, spacing 1.
Points<2> positions_of(LatticeKind kind, int cells);
/// Their periodic box.
Box<2> box_of(LatticeKind kind, int cells);
/// Throws InputError naming `option` where that block is too narrow for the range: a list looks a
/// little beyond it.
void refuse_narrow(const char* option, LatticeKind kind, int cells, double range);

}  // namespace lattice_stability
