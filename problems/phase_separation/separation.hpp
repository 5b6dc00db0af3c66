// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of phase_separation share.
#pragma once

#include "../van_der_waals.hpp"
#include "domains.hpp"

namespace phase_separation {

struct Parameters : VanDerWaalsMatter {
    Parameters() : VanDerWaalsMatter{0.85, 4.0} {}

    int cells = 64;
    double density = 1.0;
    double damping = 0.02;
    double disorder = 0.02;
    int seed = 1;
    std::optional<int> samples;
    std::optional<int> wave;
    bool isolated = false, compare = false;
    double viscosity = 0.02, conductivity = 2.0;

    double spacing() const { return 1.0 / std::sqrt(density); }
    Box<2> box() const { return Box<2>({cells * spacing(), cells * spacing()}); }
    /// A square lattice.
    Particles<2> particles() const {
        return one_body(
            make_particles<2>(square_lattice<2>({cells, cells}, spacing()), 1.0, spacing(), box()));
    }
};

/// Refuses a fluid in which small waves do not grow.
void refuse_stable(const Parameters& p);

// ---- quench.cpp ----

/// Parts a fluid that was everywhere alike, at one temperature or (p.isolated) with an energy of its own.
void quench(Session& session, const Parameters& p);

// ---- wave.cpp ----

/// What linear theory says of a longitudinal wave: rate^2 of its amplitude, negative where it swings.
struct WaveTheory {
    double lattice;    ///< by sums over the sites of a square lattice
    double continuum;  ///< by integrals of the weight function
};
WaveTheory wave_theory(const Parameters& p, double k);

/// Grows one wave.
void grow_wave(Session& session, const Parameters& p);

}  // namespace phase_separation
