// SPDX-License-Identifier: GPL-3.0-or-later
#include "torque_factors.hpp"

#include <spam/core/parallel.hpp>

#include <algorithm>

namespace spam {

/// Of one particle, where only the sum of its torques counts.
TorqueFactors::Torques TorqueFactors::torques_of(std::size_t i) const {
    const double positive = 0.5 * positive_[i], negative = 0.5 * negative_[i];
    if (law_ != AngularMomentum::torque_particle) return {positive, negative};
    const double T = positive - negative;
    return {std::max(T, 0.0), std::max(-T, 0.0)};
}

/// Blocks are the same for any number of threads. Within one, sums of every fourth particle do not wait for
/// each other.
TorqueFactors::Sums TorqueFactors::sum_of_one_group(const Groups& groups, const double* u,
                                                    const double* v) {
    constexpr std::size_t block = 256, ways = 4;
    struct Partial {
        double P[ways] = {}, M[ways] = {}, X[ways] = {};
    };
    const std::size_t n = groups.mass.size(), blocks = (n + block - 1) / block;
    block_sums_.resize(3 * blocks);
    parallel_for(
        blocks,
        [&](std::size_t b) {
            Partial sum;
            for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i) {
                const std::size_t k = i % ways;
                const Torques torques = torques_of(i);
                sum.P[k] += torques.positive;
                sum.M[k] += torques.negative;
                sum.X[k] += groups.mass[i] * (u[2 * i] * v[2 * i + 1] - u[2 * i + 1] * v[2 * i]);
            }
            const auto total = [](const double* s) { return (s[0] + s[1]) + (s[2] + s[3]); };
            block_sums_[3 * b] = total(sum.P);
            block_sums_[3 * b + 1] = total(sum.M);
            block_sums_[3 * b + 2] = total(sum.X);
        },
        block);
    Sums sums;
    for (std::size_t b = 0; b < blocks; ++b) {
        sums.P += block_sums_[3 * b];
        sums.M += block_sums_[3 * b + 1];
        sums.X += block_sums_[3 * b + 2];
    }
    return sums;
}

void TorqueFactors::balance(const Groups& groups, const double* u, const double* v) {
    sums_.assign(groups.count, Sums{});
    scales_.resize(groups.count);
    if (groups.count == 1)
        sums_[0] = sum_of_one_group(groups, u, v);
    else
        for (std::size_t i = 0; i < groups.mass.size(); ++i) {
            Sums& sums = sums_[static_cast<std::size_t>(groups.group[i])];
            const Torques torques = torques_of(i);
            sums.P += torques.positive;
            sums.M += torques.negative;
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
