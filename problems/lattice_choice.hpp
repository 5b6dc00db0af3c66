// SPDX-License-Identifier: GPL-3.0-or-later
// Periodic lattices in the plane or in space, as options choose one.
#pragma once

#include "common.hpp"
#include <spam/analysis/periodic_solid.hpp>

namespace spam {

inline std::string_view to_string(CubicLattice lattice) {
    return lattice == CubicLattice::sc ? "sc" : lattice == CubicLattice::fcc ? "fcc" : "bcc";
}

/// --dimension, of which `help` is the line, and --lattice.
inline void add_lattice_options(Options& options, int& dimension, CubicLattice& lattice,
                                std::string help) {
    options.integer("dimension", dimension, std::move(help), between(2, 3));
    options
        .choice<CubicLattice>("lattice", lattice,
                              {CubicLattice::sc, CubicLattice::fcc, CubicLattice::bcc},
                              "simple, face-centred or body-centred cubic")
        .only_when(
            {"dimension"}, [&dimension] { return dimension == 3; },
            "is of lattices in space; give --dimension 3, or leave it out");
}

}  // namespace spam
