// SPDX-License-Identifier: GPL-3.0-or-later
#include "gauss_forces.hpp"

#include <algorithm>

namespace spam {
namespace {

Vec<2> vector_at(const double* field, std::size_t i) { return {{field[2 * i], field[2 * i + 1]}}; }

}  // namespace

void GaussForces::constrain(const Groups& groups, const double* x, const double* u, const double* v,
                            double* v_dot) {
    const auto first = first_.of(groups.group, groups.count, [&](std::size_t i) {
        const double m = groups.mass[i];
        return std::array<double, 7>{m,
                                     m * x[2 * i],
                                     m * x[2 * i + 1],
                                     m * u[2 * i],
                                     m * u[2 * i + 1],
                                     m * v[2 * i],
                                     m * v[2 * i + 1]};
    });
    means_.clear();
    for (const auto& s : first)
        means_.push_back({{{s[1] / s[0], s[2] / s[0]}},
                          {{s[3] / s[0], s[4] / s[0]}},
                          {{s[5] / s[0], s[6] / s[0]}}});
    const auto means_of = [&](std::size_t i) -> const Means& {
        return means_[static_cast<std::size_t>(groups.group[i])];
    };
    const auto moments = moments_.of(groups.group, groups.count, [&](std::size_t i) {
        const Means& mean = means_of(i);
        const double m = groups.mass[i];
        const Vec<2> r = vector_at(x, i) - mean.centre, r_dot = vector_at(u, i) - mean.transport,
                     w = vector_at(v, i) - mean.velocity;
        return std::array<double, 4>{m * dot(r, r), m * cross(r, w), m * dot(w, w),
                                     m * (cross(r_dot, w) + cross(r, vector_at(v_dot, i)))};
    });
    multipliers_.clear();
    for (const auto& [inertia, L, twice_K, L_dot] : moments)
        multipliers_.push_back(gauss_multipliers(inertia, L, twice_K, L_dot));
    parallel_for(groups.mass.size(), [&](std::size_t i) {
        const Means& mean = means_of(i);
        const GaussMultipliers& of_group = multipliers_[static_cast<std::size_t>(groups.group[i])];
        const Vec<2> r = vector_at(x, i) - mean.centre, w = vector_at(v, i) - mean.velocity;
        v_dot[2 * i] -= of_group.alpha * w[0] + of_group.beta * r[1];
        v_dot[2 * i + 1] -= of_group.alpha * w[1] - of_group.beta * r[0];
    });
}

double GaussForces::health() const {
    double smallest = 1.0;
    for (const auto& m : multipliers_) smallest = std::min(smallest, m.health);
    return smallest;
}

bool GaussForces::singular() const {
    return std::any_of(multipliers_.begin(), multipliers_.end(),
                       [](const auto& m) { return m.singular; });
}

}  // namespace spam
