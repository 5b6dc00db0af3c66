// SPDX-License-Identifier: GPL-3.0-or-later
#include "torque_factors.hpp"

#include <spam/core/parallel.hpp>

#include <algorithm>

namespace spam {

/// Of one particle, where only the sum of its torques counts.
template <int Dim>
auto TorqueFactors<Dim>::torques_of(std::size_t i) const -> Torques {
    const double positive = 0.5 * positive_[i], negative = 0.5 * negative_[i];
    if (law_ != AngularMomentum::torque_particle) return {positive, negative};
    const double T = positive - negative;
    return {std::max(T, 0.0), std::max(-T, 0.0)};
}

template <int Dim>
void TorqueFactors<Dim>::balance(const Groups& groups, const double* u, const double* v) {
    const auto terms = [&, this](std::size_t i) {
        const Torques torques = torques_of(i);
        return std::array<double, 3>{
            torques.positive, torques.negative,
            groups.mass[i] * (u[2 * i] * v[2 * i + 1] - u[2 * i + 1] * v[2 * i])};
    };
    scales_.clear();
    for (const auto& [P, M, X] : sums_.of(groups.group, groups.count, terms))
        scales_.push_back(torque_balance(P, M, X));
}

template <int Dim>
void TorqueFactors<Dim>::add_parts(double* v_dot, double* e_dot) const {
    const double positive = scales_.front().positive - 1.0,
                 negative = scales_.front().negative - 1.0;
    parallel_for(positive_.size(), [=, this](std::size_t i) {
        const double* const part = &parts_[TorqueParts::numbers * i];
        v_dot[2 * i] += positive * part[0] - negative * part[3];
        v_dot[2 * i + 1] += positive * part[1] - negative * part[4];
        e_dot[i] += positive * part[2] - negative * part[5];
    });
}

template class TorqueFactors<1>;
template class TorqueFactors<2>;

}  // namespace spam
