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
    const RootFound found = find_root(
        [&](std::span<const double> x, std::span<double> F) { return free.residual(x, F); },
        free.positions(), {.tolerance = tolerance, .longest_step = 1e3});
    Equilibrium rest;
    std::vector<double> F(found.x.size());
    free.residual(found.x, F);
    for (const double force : F) rest.largest_force = std::max(rest.largest_force, std::abs(force));
    rest.y = free.y();
    rest.newton_steps = found.steps;
    rest.rhs_evaluations = free.rhs_evaluations();
    return rest;
}

template Equilibrium equilibrium<1>(Model<1>&, std::span<const double>, const std::vector<bool>&,
                                    double, double);
template Equilibrium equilibrium<2>(Model<2>&, std::span<const double>, const std::vector<bool>&,
                                    double, double);
template Equilibrium equilibrium<3>(Model<3>&, std::span<const double>, const std::vector<bool>&,
                                    double, double);

}  // namespace spam
