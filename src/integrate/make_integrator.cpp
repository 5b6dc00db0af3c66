// SPDX-License-Identifier: GPL-3.0-or-later
#include "arkode.hpp"
#include "arkode_relaxation.hpp"
#include "cvode.hpp"
#include "gsl_adaptive.hpp"
#include "gsl_fixed.hpp"
#include "leapfrog.hpp"
#include "rk4.hpp"
#include "sprk.hpp"
#include <spam/core/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {
namespace {

/// A tolerance for what is not there would do nothing.
void require_fields(const IntegratorOptions& options, const Ode& ode) {
    for (const auto& one : options.field_atol)
        if (std::none_of(ode.blocks.begin(), ode.blocks.end(),
                         [&](const Ode::Block& block) { return block.name == one.field; }))
            throw InputError(
                fmt::format("atol-{}: y holds no {} with this model and scheme; leave it out",
                            one.field, one.field));
}

std::unique_ptr<Integrator> make(const IntegratorOptions& options, const Ode& ode, Vector& y,
                                 double t0, const SundialsContext& context) {
    const std::string family = options.method.substr(0, options.method.find(':'));
    if (family == "rk4") return std::make_unique<Rk4>(ode, y, t0, *options.dt);
    if (family == "leapfrog") return std::make_unique<Leapfrog>(ode, y, t0, *options.dt);
    if (family == "sprk") return std::make_unique<Sprk>(options, ode, y, t0);
    if (family == "cvode") return std::make_unique<Cvode>(options, ode, y, t0, context);
    if (family == "gsl" && options.dt) return std::make_unique<GslFixed>(options, ode, y, t0);
    if (family == "gsl") return std::make_unique<GslAdaptive>(options, ode, y, t0);
    return std::make_unique<Arkode>(options, ode, y, t0, context);
}

}  // namespace

std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options, const Ode& ode,
                                            Vector& y, double t0, const SundialsContext& context) {
    options.validate();
    require_fields(options, ode);
    const IntegrationMethod& method = integration_method(options.method);
    if (method.multistep && ode.settle && !ode.settles_seldom)
        throw InputError(fmt::format(
            "integrator: {} makes steps from earlier ones, which are worthless where the state is "
            "changed between steps (a material that yields or breaks, a wall that reflects); use a "
            "one-step method such as rk4 or arkode:DORMAND_PRINCE_7_4_5",
            method.name));
    if (method.multistep && !ode.events.empty())
        throw InputError(
            fmt::format("integrator: {} builds on earlier steps and cannot end one at {}, which "
                        "makes them invalid; use rk4 or arkode:DORMAND_PRINCE_7_4_5",
                        method.name, ode.events.front().name));
    if (options.relaxation) require_energy(ode);
    IntegratorOptions resolved = options;
    resolved.method = method.name;
    if (!resolved.min_step)  // what is asked for goes first
        resolved.min_step =
            std::min({1e-12 * ode.time_scale, options.max_step.value_or(ode.time_scale),
                      options.initial_step.value_or(ode.time_scale)});
    auto integrator = make(resolved, ode, y, t0, context);
    if (options.max_steps) integrator->allow_steps(*options.max_steps);
    return integrator;
}

}  // namespace spam
