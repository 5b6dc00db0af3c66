// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of taylor_bar share. Lengths in mm, times in µs, masses in g: stresses in TPa, 1e3 GPa. Options
// are in the units that they say.
#pragma once

#include <spam/external/rigid_wall.hpp>
#include <spam/problem/variant.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/spam.hpp>

namespace taylor_bar {

using namespace spam;

struct Parameters {
    double radius = 3.2;                                        // mm
    double aspect = 10.125;                                     // length by radius
    double speed = 227.0;                                       // m/s
    double young = 117.0, yield_stress = 0.4, hardening = 0.1;  // GPa
    double poisson = 0.35, density = 8930.0;                    // kg/m^3
    int particles_per_radius = 5;
    double range = 2.6;  // spacings
    double penalty = 0.01;
    bool compare = false;

    double length() const { return aspect * radius; }
    /// Until the bar is at rest, up to a factor, in µs: a rigid, plastic bar loses its speed while it becomes
    /// shorter (Taylor), and waves go up and down the bar.
    double time() const;
};

/// A bar of cubic lattice along z, its face at z = 0 against a rigid wall without friction.
struct Bar : Variant<3> {
    double radius;   ///< at the start, mm
    double spacing;  ///< mm
    int layers;
    const TotalLagrangian<3>* law = nullptr;
    double wave_speed = 0.0, least_stretch = 0.35;
    /// An explicit step for the layer next to the wall, which becomes thinnest.
    double step() const { return 0.4 * least_stretch * spacing / wave_speed; }
};

Bar make_bar(const Parameters& p, int particles_per_radius);

/// The faces of particles are half a spacing before them, stretched as they are.
struct BarShape {
    double length;  ///< mm, from the wall
    double foot;    ///< largest radius, mm: the mean over the rim of the layer at the wall
    double strain;  ///< largest plastic strain
};
BarShape shape_of(const Bar& bar, std::span<const double> y);

/// Particles within half a spacing of the plane y = 0, as (x, z), with their plastic strains.
struct Section {
    Points<2> position;
    std::vector<double> strain;
};
Section section_of(const Bar& bar, std::span<const double> y);

}  // namespace taylor_bar
