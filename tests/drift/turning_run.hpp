// SPDX-License-Identifier: GPL-3.0-or-later
// What a body that turns keeps on its way.
#pragma once

#include <spam/diagnostics/history.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/shape.hpp>
#include <spam/integrate/driver.hpp>
#include <spam/problem/motion.hpp>
#include <spam/setup/initial_state.hpp>

#include <cmath>

namespace spam::test {

/// Columns t, shape_error, closest_pair, and changes relative to the first row: p (by mass), L and energy.
template <int Dim>
History run(Model<Dim>& model, const VelocityField<Dim>& velocity, const IntegratorOptions& options,
            double t_end, double every) {
    const auto y0 = initial_state<Dim>(model, 1.0, 1.0, velocity);
    Motion<Dim> motion(model, y0, options);
    const auto start = measure_invariants(model, motion.y());
    History history({"t", "shape_error", "closest_pair", "p", "L", "energy"});
    Observers observers;
    observers.output = [&](double t) {
        const auto now = measure_invariants(model, motion.y());
        const Points<Dim> x = motion.state().position();
        double L = 0.0, L0 = 0.0;
        for (Eigen::Index k = 0; k < start.angular_momentum.size(); ++k) {
            L += std::pow(now.angular_momentum[k] - start.angular_momentum[k], 2);
            L0 += std::pow(start.angular_momentum[k], 2);
        }
        history.add({t, shape_error<Dim>(model.particles().reference_position, x, 1.0),
                     closest_pair<Dim>(x, 1.0, {}),
                     (now.momentum - start.momentum).norm() / now.mass, std::sqrt(L / L0),
                     std::abs(now.energy / start.energy - 1.0)});
    };
    drive(motion.integrator(), {t_end, every, t_end}, observers);
    return history;
}

}  // namespace spam::test
