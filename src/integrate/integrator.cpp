// SPDX-License-Identifier: GPL-3.0-or-later
#include "arkode.hpp"
#include "rk4.hpp"
#include <spam/core/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

void require_positive(const char* option, double value, const char* fix) {
    if (!(value > 0.0) || !std::isfinite(value))
        throw InputError(fmt::format("{}: {} is not a positive number; {}", option, value, fix));
}

/// z.size() where all are finite.
std::size_t first_not_finite(std::span<const double> z) {
    // One pass without branches: a NaN or an infinity survives in the sum of x - x.
    double spoiled = 0.0;
    for (const double x : z) spoiled += x - x;
    if (spoiled == 0.0) return z.size();
    const auto bad = std::find_if(z.begin(), z.end(), [](double x) { return !std::isfinite(x); });
    return static_cast<std::size_t>(bad - z.begin());
}

const char* what_it_is(double x) { return std::isnan(x) ? "nan" : "infinite"; }

}  // namespace

void IntegratorOptions::validate() const {
    if (method == "rk4") {
        require_positive("dt", dt.value_or(0.0), "rk4 needs a fixed step, e.g. --dt 0.1");
    } else if (!method.starts_with("arkode:")) {
        throw InputError(
            fmt::format("integrator: '{}' is unknown; use rk4 or arkode:<table>, e.g. "
                        "arkode:DORMAND_PRINCE_7_4_5",
                        method));
    }
    if (dt) require_positive("dt", *dt, "give a positive time step");
    require_positive("rtol", rtol, "try --rtol 1e-8");
    require_positive("atol", atol, "try --atol 1e-10");
    if (rtol < 1e-15)
        throw InputError(fmt::format(
            "rtol: {} is finer than double precision; the least is 1e-15, try 1e-10", rtol));
    if (rtol >= 1.0)
        throw InputError(fmt::format("rtol: {} must be below 1; try --rtol 1e-8", rtol));
}

std::string IntegratorOptions::describe() const {
    if (dt) return fmt::format("{}, fixed step dt = {:g}", method, *dt);
    return fmt::format("{}, adaptive, rtol = {:g}, atol = {:g} x field scale", method, rtol, atol);
}

void Integrator::guard(std::span<const double> z, double t) const {
    const std::size_t k = first_not_finite(z);
    if (k == z.size()) return;
    throw GuardStop(fmt::format("{} became {} at t = {:.6g}; a smaller step may help",
                                ode_.entry_name(k), what_it_is(z[k]), t));
}

std::string Integrator::spoiled_rate(std::span<const double> y_dot, double t) const {
    const std::size_t k = first_not_finite(y_dot);
    if (k == y_dot.size()) return {};
    return fmt::format("the rate of {} became {} at t = {:.6g}; a smaller step may help",
                       ode_.entry_name(k), what_it_is(y_dot[k]), t);
}

void Integrator::remember(Archive& archive) {
    archive(t_, statistics_);
    for (const Event& event : ode_.events)
        if (event.remember) event.remember(archive);
}

std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options, const Ode& ode,
                                            Vector& y, double t0, const SundialsContext& context) {
    options.validate();
    if (options.method == "rk4") return std::make_unique<Rk4>(ode, y, t0, *options.dt);
    return std::make_unique<Arkode>(options, ode, y, t0, context);
}

}  // namespace spam
