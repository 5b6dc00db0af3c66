// SPDX-License-Identifier: GPL-3.0-or-later
#include "torque_factors.hpp"

#include <spam/core/parallel.hpp>

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

void TorqueFactors::add_parts(double* v_dot, double* e_dot) const {
    const double positive = scales_.front().positive - 1.0,
                 negative = scales_.front().negative - 1.0;
    parallel_for(positive_.size(), [=, this](std::size_t i) {
        const double* const part = &parts_[TorqueParts::numbers * i];
        v_dot[2 * i] += positive * part[0] - negative * part[3];
        v_dot[2 * i + 1] += positive * part[1] - negative * part[4];
        e_dot[i] += positive * part[2] - negative * part[5];
    });
}

}  // namespace spam
