// SPDX-License-Identifier: GPL-3.0-or-later
// A solid with material vectors that yields and tears: the constants of the problems in which it breaks.
#pragma once

#include "bond_limits.hpp"
#include <spam/material/flowing_solid.hpp>
#include <spam/rhs/material_vectors.hpp>

namespace breaking {

using namespace spam;

/// Of the triangular lattice of spacing and masses 1.
struct FlowingMatter {
    double yield_stress = 0.05;                              ///< Y, of von Mises' q
    double tension_limit = 0.05;                             ///< p_c, of the mean tension
    double penalty = MaterialVectorScheme::default_penalty;  ///< kappa
    double range = 3.0;                                      ///< h
    BondLimits bonds{};
    double core = 0.0;  ///< e_c
    double core_range = 0.8;
};

/// `--yield-stress`, `--tension-limit`, `--penalty` and those of BondLimits.
void add_flowing_options(Options& options, FlowingMatter& matter);
/// The names of these.
std::vector<std::string> flowing_option_names();

/// Material vectors and a core among all particles of the model, which meet by a contact where they are of
/// different bodies, if there is one. Returns the first.
MaterialVectors<2>& add_flowing_terms(ParticleModel<2>& model, const FlowingMatter& matter,
                                      const std::optional<ContactScheme>& contact);

}  // namespace breaking
