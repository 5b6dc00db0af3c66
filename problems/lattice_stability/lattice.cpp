// SPDX-License-Identifier: GPL-3.0-or-later
#include "lattice.hpp"

#include <spam/material/embedded_atom.hpp>

namespace lattice_stability {

std::string_view to_string(LatticeKind kind) {
    return kind == LatticeKind::triangular ? "triangular" : "square";
}

std::string_view to_string(Acting acting) {
    static constexpr std::array<std::string_view, 4> names{"density", "curvature", "gradient",
                                                           "both"};
    return names[static_cast<std::size_t>(acting)];
}

std::string title_of(Acting acting) {
    static constexpr std::array<const char*, 4> titles{"e(ρ) alone", "e(ρ) + curvature",
                                                       "e(ρ) + gradient", "e(ρ) + both"};
    return titles[static_cast<std::size_t>(acting)];
}

int style_of(Acting acting) {
    static constexpr std::array<int, 4> styles{1, 2, 3, 5};
    return styles[static_cast<std::size_t>(acting)];
}

DensityPotentials Parameters::potentials(LatticeKind kind, Acting which, double h) const {
    DensityPotentials p;
    p.kernel = kernel;
    p.range = h;
    p.state = EmbeddedAtom{1.0, misfit * site_density(vectors_of(kind), kernel, h)};
    if (which == Acting::curvature || which == Acting::both) p.strength = strength;
    if (which == Acting::gradient || which == Acting::both) p.surface_tension = surface_tension;
    return p;
}

LatticeVectors vectors_of(LatticeKind kind) {
    if (kind == LatticeKind::square) return LatticeVectors::Identity();
    return LatticeVectors{{1.0, 0.5}, {0.0, std::sqrt(0.75)}};
}

Points<2> positions_of(LatticeKind kind, int cells) {
    return kind == LatticeKind::square ? square_lattice<2>({cells, cells})
                                       : triangular_block(cells, cells);
}

Box<2> box_of(LatticeKind kind, int cells) {
    return kind == LatticeKind::square ? Box<2>({double(cells), double(cells)})
                                       : triangular_box(cells, cells);
}

void refuse_narrow(const char* option, LatticeKind kind, int cells, double range) {
    const Box<2> box = box_of(kind, cells);
    const double width = std::min(box.length(0), box.length(1)), least = 2.16 * range;
    if (width > least) return;
    refuse(
        "{0}: {1} x {1} particles make a block {2:.3g} wide; with the range {3:g} it must be above "
        "{4:.3g}, or particles would meet their own images; give a larger one",
        option, cells, width, range, least);
}

}  // namespace lattice_stability
