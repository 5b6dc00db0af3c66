// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/density_potential.hpp>

#include <concepts>

namespace spam {

/// An energy of two particles by their distance alone: `energy` and `force_over_r` (F/r, so that the force on
/// i is this times r_ij) as functions of r^2, zero beyond a range, over any arithmetic type.
template <class Potential>
concept DistancePotential = requires(const Potential potential, double r2) {
    { potential.energy(r2) } -> std::same_as<double>;
    { potential.force_over_r(r2) } -> std::same_as<double>;
};

/// In double, for tests and as the oracle of passes. The list's reach must not be below the range.
template <int Dim, DistancePotential Potential>
EnergyAndForces<Dim> energy_and_forces(const Potential& potential,
                                       const ListedParticles<Dim>& near) {
    EnergyAndForces<Dim> result{0.0, Points<Dim>(Dim, near.position.cols())};
    ExactSum energy;
    for (std::size_t i = 0; i < near.size(); ++i) {
        Vec<Dim> F;
        for (const std::uint32_t j : near.pairs.neighbours(i)) {
            if (j == i) continue;
            const Vec<Dim> r_ij = near.separation(i, j);
            const double r2 = dot(r_ij, r_ij);
            energy += 0.5 * potential.energy(r2);
            F += potential.force_over_r(r2) * r_ij;
        }
        for (int a = 0; a < Dim; ++a) result.force(a, static_cast<Eigen::Index>(i)) = F[a];
    }
    result.energy = energy;
    return result;
}

}  // namespace spam
