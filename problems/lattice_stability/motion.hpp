// SPDX-License-Identifier: GPL-3.0-or-later
// In motion: particles of a lattice with small random velocities, and the paths they draw.
#pragma once

#include "lattice.hpp"

namespace lattice_stability {

/// Where particles have been, snapshot by snapshot.
struct Paths {
    std::vector<Points<2>> at;

    void remember(Archive& archive) { archive(at); }
    /// Of every particle, a line.
    std::vector<Points<2>> lines() const;
};

/// One block under some of the potentials, ready to move.
struct Sample : Variant<2, Model<2>> {
    Acting acting;
    Paths paths{};
};

/// The same velocities for all potentials: of random directions and sizes, rms p.speed, sum zero.
Sample make_sample(const Parameters& p, Acting acting, double range);

/// Root mean square of the particles' displacements from their sites, column `rms_displacement`.
Column<2> rms_displacement_column();

/// As in [HH07] 8: melted and held.
void draw_paths(Session& session, const Parameters& p, const std::vector<Sample>& samples,
                double t_end);
void draw_displacements(Session& session, const std::vector<Sample>& samples,
                        const std::vector<RunRecord>& runs);

}  // namespace lattice_stability
