// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/smooth_particles.hpp>

#include <vector>

namespace spam {

/// The torques that smooth particles exert on each other, [HHM04] III A,
///     T_ij = x_ij F_y - y_ij F_x  (i < j),    T_i = 1/2 sum_j T_ij,
/// with the stress force of the scheme before any balancing: sum T_ij = sum T_i is the rate at which
/// it changes the angular momentum.
struct PairTorques {
    std::vector<double> pair;      ///< of all pairs in range, in the order of i, then j
    std::vector<double> particle;  ///< N
};
PairTorques pair_torques(const SmoothParticleModel<2>& model, std::span<const double> y);

/// How torques divide into negative and positive ones, [HHM04] VIII; zeros count as neither.
struct TorqueDistribution {
    std::size_t negative = 0, positive = 0;         ///< how many
    double negative_sum = 0.0, positive_sum = 0.0;  ///< -M and P

    /// R = sqrt(P/M): the negative ones times R and the positive ones over R sum to zero; 1 where
    /// one kind is missing.
    double balance_factor() const;
};
TorqueDistribution distribution(std::span<const double> torques);

/// Counts in `bins` equal parts of [-largest, largest], largest the largest magnitude.
struct TorqueHistogram {
    double bin_width = 0.0;
    std::vector<double> centre;
    std::vector<double> count;
};
TorqueHistogram histogram(std::span<const double> torques, std::size_t bins);

}  // namespace spam
