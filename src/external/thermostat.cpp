// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parts.hpp>
#include <spam/core/rigid_motion.hpp>
#include <spam/external/thermostat.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

template <int Dim>
Thermostat<Dim>::Thermostat(double kT_0, double gamma) : kT_0_(kT_0),
                                                         gamma_(gamma) {
    if (!(kT_0 > 0.0) || !std::isfinite(kT_0) || !(gamma > 0.0) || !std::isfinite(gamma))
        throw InputError(fmt::format("thermostat: kT = {} and rate {} must be finite and positive",
                                     kT_0, gamma));
}

template <int Dim>
void Thermostat<Dim>::prepare(const typename External<Dim>::Now& now) {
    const auto v = now.state.velocity();
    const auto& mass = now.particles.mass;
    V_ = mean_by_mass<Dim>(mass, v);
    const double twice_kinetic = exact_sum(mass.size(), [&](std::size_t i) {
        return mass[i] * (v.col(static_cast<Eigen::Index>(i)) - V_).squaredNorm();
    });
    const auto n = static_cast<double>(Parts::here().total(mass.size()));
    const double kT = twice_kinetic / (Dim * (n - 1.0));
    // Nothing that is at rest can be warmed by its own velocities.
    factor_ = kT > 0.0 ? -0.5 * gamma_ * (1.0 - kT_0_ / kT) : 0.0;
}

template <int Dim>
std::string Thermostat<Dim>::describe() const {
    return fmt::format("thermostat kT = {:g}, rate {:g}", kT_0_, gamma_);
}

SPAM_COMPILED(template class Thermostat);

}  // namespace spam
