// SPDX-License-Identifier: GPL-3.0-or-later
#include "gauss_forces.hpp"

#include <algorithm>

namespace spam {
namespace {

template <int Dim>
Vec<Dim> vector_at(const double* field, std::size_t i) {
    return numbers_at<Vec<Dim>>(field + Dim * i);
}

}  // namespace

template <int Dim>
void GaussForces<Dim>::constrain(const Groups& groups, const double* x, const double* u,
                                 const double* v, double* v_dot) {
    const auto first = first_.of(groups.group, groups.count, [&](std::size_t i) {
        const double m = groups.mass[i];
        std::array<double, 1 + 3 * Dim> terms{m};
        for (std::size_t a = 0; a < Dim; ++a) {
            terms[1 + a] = m * x[Dim * i + a];
            terms[1 + Dim + a] = m * u[Dim * i + a];
            terms[1 + 2 * Dim + a] = m * v[Dim * i + a];
        }
        return terms;
    });
    means_.clear();
    for (const auto& s : first) {
        Means& mean = means_.emplace_back();
        mean.mass = s[0];
        for (std::size_t a = 0; a < Dim; ++a) {
            mean.centre.c[a] = s[1 + a] / s[0];
            mean.transport.c[a] = s[1 + Dim + a] / s[0];
            mean.velocity.c[a] = s[1 + 2 * Dim + a] / s[0];
        }
    }
    const auto means_of = [&](std::size_t i) -> const Means& {
        return means_[static_cast<std::size_t>(groups.group[i])];
    };
    const auto moments = moments_.of(groups.group, groups.count, [&](std::size_t i) {
        const Means& mean = means_of(i);
        // A particle alone is its own centre, where (m x)/m may be beside x by rounding: nothing is to be kept.
        if (mean.mass == groups.mass[i])
            return Law::terms(mean.mass, {}, {}, {}, vector_at<Dim>(v_dot, i));
        return Law::terms(groups.mass[i], vector_at<Dim>(x, i) - mean.centre,
                          vector_at<Dim>(u, i) - mean.transport,
                          vector_at<Dim>(v, i) - mean.velocity, vector_at<Dim>(v_dot, i));
    });
    multipliers_.clear();
    for (const auto& sums : moments) multipliers_.push_back(Law::multipliers(sums));
    parallel_for(groups.mass.size(), [&](std::size_t i) {
        const Means& mean = means_of(i);
        const Vec<Dim> change = Law::acceleration(
            multipliers_[static_cast<std::size_t>(groups.group[i])],
            vector_at<Dim>(x, i) - mean.centre, vector_at<Dim>(v, i) - mean.velocity);
        for (std::size_t a = 0; a < Dim; ++a) v_dot[Dim * i + a] += change.c[a];
    });
}

template <int Dim>
double GaussForces<Dim>::health() const {
    double smallest = 1.0;
    for (const auto& m : multipliers_) smallest = std::min(smallest, m.health);
    return smallest;
}

template <int Dim>
bool GaussForces<Dim>::singular() const {
    return std::ranges::any_of(multipliers_, [](const auto& m) { return m.singular; });
}

template class GaussForces<2>;
template class GaussForces<3>;

}  // namespace spam
