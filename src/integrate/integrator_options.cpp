// SPDX-License-Identifier: GPL-3.0-or-later
#include "arkode_relaxation.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/integrate/integrator.hpp>
#include <spam/integrate/methods.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

void require_positive(const std::string& option, double value, const char* fix) {
    if (!(value > 0.0) || !std::isfinite(value))
        throw InputError(fmt::format("{}: {} is not a positive number; {}", option, value, fix));
}

void validate_steps(const IntegratorOptions& options, const IntegrationMethod& method) {
    if (options.dt) require_positive("dt", *options.dt, "give a positive time step");
    if (!method.fixed && options.dt)
        throw InputError(
            fmt::format("dt: {} chooses its order and its steps by the tolerances and has no fixed "
                        "step; leave --dt out",
                        method.name));
    if (!method.adaptive && !options.dt)
        throw InputError(
            method.name.starts_with("arkode:")
                ? fmt::format("integrator: {} has no embedded error estimate and cannot choose its "
                              "steps; add --dt",
                              method.name)
                : fmt::format("dt: {} needs a fixed step, e.g. --dt 0.1{}", method.name,
                              method.separable ? ", and forces that depend on positions alone "
                                                 "(springs, total Lagrangian, material vectors, "
                                                 "potentials of the density)"
                                               : ""));
}

void validate_tolerances(const IntegratorOptions& options) {
    require_positive("rtol", options.rtol, "try --rtol 1e-8");
    require_positive("atol", options.atol, "try --atol 1e-10");
    for (const auto& [field, atol] : options.field_atol)
        require_positive("atol-" + field, atol, "give an absolute tolerance in the field's unit");
    if (options.rtol < 1e-15)
        throw InputError(
            fmt::format("rtol: {} is finer than double precision; the least is 1e-15, try 1e-10",
                        options.rtol));
    if (options.rtol >= 1.0)
        throw InputError(fmt::format("rtol: {} must be below 1; try --rtol 1e-8", options.rtol));
}

void validate_control(const IntegratorOptions& options) {
    const auto& names = arkode_controllers();
    if (!options.controller.empty() && std::ranges::find(names, options.controller) == names.end())
        throw InputError(fmt::format("controller: '{}' is unknown{} There are: {}",
                                     options.controller, suggestion(options.controller, names),
                                     fmt::join(names, ", ")));
    if (options.safety && !(*options.safety > 0.0 && *options.safety < 1.0))
        throw InputError(fmt::format("safety: {} must be above 0 and below 1; try --safety 0.9",
                                     *options.safety));
    if (options.min_step) require_positive("min-step", *options.min_step, "try --min-step 1e-12");
    for (const auto& [option, value] : {std::pair{"max-step", options.max_step},
                                        std::pair{"initial-step", options.initial_step}}) {
        if (!value) continue;
        require_positive(option, *value, "give a time");
        if (options.min_step && *value < *options.min_step)
            throw InputError(fmt::format("{}: {} is below --min-step {}; make one of them fit",
                                         option, *value, *options.min_step));
    }
    if (options.max_step && options.initial_step && *options.initial_step > *options.max_step)
        throw InputError(
            fmt::format("initial-step: {} is above --max-step {}; make one of them fit",
                        *options.initial_step, *options.max_step));
    if (options.max_steps && *options.max_steps == 0)
        throw InputError("max-steps: 0 allows no step at all; give at least 1");
}

}  // namespace

bool IntegratorOptions::adaptive() const { return integration_method(method).adaptive && !dt; }

double IntegratorOptions::absolute_tolerance(std::string_view field, double scale) const {
    for (const FieldTolerance& one : field_atol)
        if (one.field == field) return one.atol;
    return atol * scale;
}

void IntegratorOptions::validate() const {
    if (relaxation) require_relaxation(*this);
    validate_steps(*this, integration_method(method));
    validate_tolerances(*this);
    validate_control(*this);
}

std::string IntegratorOptions::describe() const {
    const std::string most = max_steps ? fmt::format(", at most {} steps", *max_steps) : "";
    if (dt) return fmt::format("{}, fixed step dt = {:g}{}", method, *dt, most);
    std::string more;
    if (!controller.empty()) more += ", controller " + controller;
    if (safety) more += fmt::format(", safety {:g}", *safety);
    if (initial_step) more += fmt::format(", first step {:g}", *initial_step);
    if (min_step) more += fmt::format(", least step {:g}", *min_step);
    if (max_step) more += fmt::format(", longest step {:g}", *max_step);
    if (relaxation) more += ", rescaled to keep the energy";
    return fmt::format("{}, adaptive, rtol = {:g}, atol = {:g} x field scale{}{}", method, rtol,
                       atol, more, most);
}

}  // namespace spam
