// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of material_vectors_study share: what is tried with every scheme.
#pragma once

#include "../common.hpp"
#include <spam/material/polynomial_solid.hpp>
#include <spam/rhs/material_vectors.hpp>

namespace material_vectors_study {

using namespace spam;

/// Triangular lattice of spacing and mass one: lambda = eta = sqrt(3/16), density sqrt(4/3).
inline PolynomialSolid solid() { return PolynomialSolid::like(ElasticSolid::triangular_lattice()); }
inline const double rho = triangular_density;

struct Sizes {
    int hexagon = 8, beam_rows = 12, bar_rows = 8;
    double turns = 5.0;       // at a corner speed of 0.4
    double shot_time = 60.0;  // of the projectile

    static constexpr double speed = 0.4;  // of the hexagon's corners
    double turning_time() const { return turns * 2.0 * std::numbers::pi * hexagon / speed; }
};

// ---- lattice.cpp: linear stability ----

/// The largest tension, by the shear modulus and in steps of 0.02, under which no wave grows: uniaxial,
/// biaxial 2 to 1, shear in five directions each, hydrostatic.
double tension_borne(const MaterialVectorScheme& scheme);
/// Smallest omega/(c_T k) of the lattice free of stress.
double lowest_frequency(const MaterialVectorScheme& scheme);

// ---- motion.cpp: runs by leapfrog and rk4; nothing where a signal interrupted one ----

/// Throws InputError where turns or the shot would take too many steps.
void refuse_endless(const Sizes& sizes);

struct Turned {
    double closest_pair, shape_error, energy_drift;
};
/// The hexagon of [HHM04] at a corner speed of 0.4, 16 times the stress of the paper's.
std::optional<Turned> turn_hexagon(const MaterialVectorScheme& scheme, const Sizes& sizes);

/// How much more a hexagon breathes whose particles are displaced by up to 0.2 at the start, by one that is a
/// lattice, less 1; corner speed 0.1.
std::optional<double> disorder_error(const MaterialVectorScheme& scheme, const Sizes& sizes);

/// Period of the first bending mode of a free bar, ten times as long in particles as it has rows, by that of
/// Timoshenko's beam, less 1.
std::optional<double> beam_error(const MaterialVectorScheme& scheme, int rows);

struct Shot {
    double closest_pair, energy_drift, heat;  // heat by the energy at the start
    int pieces;
};
/// A hexagon of 91 particles through a bar that yields and tears at 0.05, speed 1.
std::optional<Shot> shoot(const MaterialVectorScheme& scheme, const Sizes& sizes);

}  // namespace material_vectors_study
