// SPDX-License-Identifier: GPL-3.0-or-later
#include "torque_factors.hpp"

#include <algorithm>

namespace spam {

void TorqueFactors::balance(const Groups& groups, const double* u, const double* v) {
    sums_.assign(groups.count, Sums{});
    scales_.resize(groups.count);
    for (std::size_t i = 0; i < groups.mass.size(); ++i) {
        Sums& sums = sums_[static_cast<std::size_t>(groups.group[i])];
        double positive = 0.5 * positive_[i], negative = 0.5 * negative_[i];
        if (law_ == AngularMomentum::torque_particle) {
            const double T = positive - negative;
            positive = std::max(T, 0.0);
            negative = std::max(-T, 0.0);
        }
        sums.P += positive;
        sums.M += negative;
        sums.X += groups.mass[i] * (u[2 * i] * v[2 * i + 1] - u[2 * i + 1] * v[2 * i]);
    }
    for (std::size_t g = 0; g < groups.count; ++g)
        scales_[g] = torque_balance(sums_[g].P, sums_[g].M, sums_[g].X);
}

}  // namespace spam
