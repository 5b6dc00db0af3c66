// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/integrate/integrator.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

double Integrator::step(double t_stop) {
    if (most_steps_ && statistics_.steps >= *most_steps_)
        throw GuardStop(
            fmt::format("too many steps: {} have come to t = {:.6g}, --max-steps allows "
                        "no more",
                        statistics_.steps, t_));
    return take_step(t_stop);
}

void Integrator::guard(std::span<const double> z, double t) const {
    // One pass without branches: a NaN or an infinity survives in the sum of x - x.
    double spoiled = 0.0;
    for (const double x : z) spoiled += x - x;
    if (spoiled == 0.0) return;
    for (std::size_t k = 0; k < z.size(); ++k) {
        if (std::isfinite(z[k])) continue;
        throw GuardStop(fmt::format("{} became {} at t = {:.6g}; a smaller step may help",
                                    ode_.entry_name(k), std::isnan(z[k]) ? "nan" : "infinite", t));
    }
}

void Integrator::remember(Archive& archive) {
    archive(t_, statistics_);
    for (const Event& event : ode_.events)
        if (event.remember) event.remember(archive);
}

}  // namespace spam
