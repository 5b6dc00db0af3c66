// SPDX-License-Identifier: GPL-3.0-or-later
#include "gauss_forces.hpp"

#include <algorithm>

namespace spam {
namespace {

Vec<2> vector_at(const double* field, std::size_t i) { return {{field[2 * i], field[2 * i + 1]}}; }

}  // namespace

void GaussForces::measure(const Groups& groups, const double* x, const double* u, const double* v) {
    sums_.assign(groups.count, Sums{});
    const auto each = [&](const auto& body) {
        for (std::size_t i = 0; i < groups.mass.size(); ++i)
            body(i, groups.mass[i], sums_[static_cast<std::size_t>(groups.group[i])]);
    };
    each([&](std::size_t i, double m, Sums& s) {
        s.mass += m;
        for (std::size_t a = 0; a < 2; ++a) {
            s.x[a] += m * x[2 * i + a];
            s.u[a] += m * u[2 * i + a];
            s.v[a] += m * v[2 * i + a];
        }
    });
    each([&](std::size_t i, double m, Sums& s) {
        const Vec<2> r = vector_at(x, i) - s.centre(), w = vector_at(v, i) - s.velocity();
        s.inertia += m * dot(r, r);
        s.L += m * cross(r, w);
        s.twice_K += m * dot(w, w);
    });
}

void GaussForces::constrain(const Groups& groups, const double* x, const double* u, const double* v,
                            double* v_dot) {
    measure(groups, x, u, v);
    for (std::size_t i = 0; i < groups.mass.size(); ++i) {
        Sums& s = sums_[static_cast<std::size_t>(groups.group[i])];
        const Vec<2> r = vector_at(x, i) - s.centre(), r_dot = vector_at(u, i) - s.transport(),
                     w = vector_at(v, i) - s.velocity();
        s.L_dot += groups.mass[i] * (cross(r_dot, w) + cross(r, vector_at(v_dot, i)));
    }
    multipliers_.clear();
    for (const Sums& s : sums_)
        multipliers_.push_back(gauss_multipliers(s.inertia, s.L, s.twice_K, s.L_dot));
    for (std::size_t i = 0; i < groups.mass.size(); ++i) {
        const auto g = static_cast<std::size_t>(groups.group[i]);
        const Sums& s = sums_[g];
        const Vec<2> r = vector_at(x, i) - s.centre(), w = vector_at(v, i) - s.velocity();
        v_dot[2 * i] -= multipliers_[g].alpha * w[0] + multipliers_[g].beta * r[1];
        v_dot[2 * i + 1] -= multipliers_[g].alpha * w[1] - multipliers_[g].beta * r[0];
    }
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
