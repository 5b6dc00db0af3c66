// SPDX-License-Identifier: GPL-3.0-or-later
#include "free_particles.hpp"
#include <spam/integrate/root.hpp>
#include <spam/study/equilibrium.hpp>

#include <algorithm>
#include <cmath>

namespace spam {

template <int Dim>
Equilibrium equilibrium(Model<Dim>& model, std::span<const double> y, const std::vector<bool>& held,
                        double tolerance, double t) {
    FreeParticles<Dim> free(model, y, held, t);
    free.require_potential("equilibrium");
    // Lengths in spacings, and forces in what makes the tolerance the same in all units.
    constexpr double least = 1e-10;
    const double length = model.particles().spacing, force = tolerance / least;
    std::vector<double> start = free.positions(), F(start.size());
    for (double& x : start) x /= length;
    std::vector<double> place(start.size());
    const auto residual = [&](std::span<const double> x, std::span<double> to) {
        std::ranges::transform(x, place.begin(), [&](double one) { return one * length; });
        const bool meaning = free.residual(place, to);
        for (double& one : to) one /= force;
        return meaning;
    };
    const RootFound found = find_root(residual, start, {.tolerance = least, .longest_step = 1e3});
    Equilibrium rest;
    residual(found.x, F);
    for (double& one : F) one *= force;
    for (const double one : F) rest.largest_force = std::max(rest.largest_force, std::abs(one));
    rest.y = free.y();
    rest.newton_steps = found.steps;
    rest.rhs_evaluations = free.rhs_evaluations();
    return rest;
}

#define SPAM_INSTANTIATE(D)                                                 \
    template Equilibrium equilibrium<D>(Model<D>&, std::span<const double>, \
                                        const std::vector<bool>&, double, double);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
