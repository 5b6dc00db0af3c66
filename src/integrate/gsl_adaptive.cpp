// SPDX-License-Identifier: GPL-3.0-or-later
#include "gsl_adaptive.hpp"

#include "arkode_control.hpp"
#include <spam/core/error.hpp>
#include <spam/integrate/methods.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace spam {

GslAdaptive::GslAdaptive(const IntegratorOptions& options, const Ode& ode, Vector& y, double t0)
    : Integrator(ode, y, t0),
      options_(options),
      multistep_(integration_method(options.method).multistep),
      stepper_(options.method, ode, options.rtol, statistics_.rhs_evaluations),
      shares_(ode.blocks, ErrorShares::Norm::largest),
      watch_(ode),
      z_(y.clone()),
      y_dot_(y.clone()) {}

/// Rates at (t, y), which every attempt from there shares; those of a multistep method are its own
/// affair but for the first.
void GslAdaptive::begin() {
    if (multistep_ && h_ > 0.0) return;
    ++statistics_.rhs_evaluations;
    ode_.rates(t_, std::as_const(y_).span(), y_dot_.span());
    const std::string reason = ode_.failure();
    if (!reason.empty()) throw GuardStop(fmt::format("{} at t = {:.6g}", reason, t_));
    if (h_ == 0.0) h_ = options_.initial_step.value_or(first_step());
}

/// A hundredth of the time in which y would change by its own size, both measured by what is allowed
/// to their entries: careful, and the control lets it grow at once.
double GslAdaptive::first_step() {
    const auto y = std::as_const(y_).span(), f = std::as_const(y_dot_).span();
    double size = 0.0, rate = 0.0;
    for (std::size_t k = 0; k < y.size(); ++k) {
        const double allowed = options_.rtol * std::abs(y[k]) + ode_.absolute_tolerance[k];
        size = std::max(size, std::abs(y[k]) / allowed);
        rate = std::max(rate, std::abs(f[k]) / allowed);
    }
    const double h = size > 0.0 && rate > 0.0 ? 0.01 * size / rate : 1e-6 * ode_.time_scale;
    return std::max(multistep_ ? 0.01 * h : h, *options_.min_step);
}

void GslAdaptive::estimate_errors() {
    if (ode_.blocks.empty()) return;
    shares_.measure([&, e = stepper_.error(), z = std::as_const(z_).span()](std::size_t k) {
        return e[k] / (options_.rtol * std::abs(z[k]) + ode_.absolute_tolerance[k]);
    });
}

/// After a step of length `tried` that does not count: h_ is what to try next, or nothing is.
void GslAdaptive::reject(bool meaningful, double tried) {
    ++statistics_.rejected_steps;
    if (!meaningful) h_ = 0.5 * tried;
    if (h_ >= *options_.min_step && h_ < tried) return;
    const std::string reason = ode_.failure();
    if (!reason.empty()) throw GuardStop(fmt::format("{} at t = {:.6g}", reason, t_));
    if (!meaningful) guard(std::as_const(z_).span(), t_ + tried);
    estimate_errors();
    throw GuardStop(fmt::format("{} at t = {:.6g} (GSL)",
                                rejected_too_often(h_, *options_.min_step, shares_.in_words()),
                                t_));
}

/// Takes a step from (t, y) into z, as long as the control allows.
GslAdaptive::Accepted GslAdaptive::accepted_step(double t_stop) {
    while (true) {
        const double longest = std::min(h_, options_.max_step.value_or(h_));
        const bool to_stop = t_ + longest * (1.0 + 1e-9) >= t_stop;
        const double h = to_stop ? t_stop - t_ : longest;
        N_VScale(1.0, y_.get(), z_.get());
        const bool meaningful = stepper_.attempt(
            t_, h, z_.span(), multistep_ ? nullptr : std::as_const(y_dot_).span().data());
        double next = h;
        if (meaningful && stepper_.accepts(std::as_const(z_).span(), next)) {
            // A step cut short by a stop says little of what the next could be.
            h_ = to_stop ? std::max(next, longest) : next;
            return {h, to_stop ? t_stop : t_ + h};
        }
        h_ = next;
        reject(meaningful, h);
    }
}

/// Another step from where the accepted one began, of length h.
std::span<const double> GslAdaptive::retake(double h) {
    N_VScale(1.0, y_.get(), z_.get());
    if (!stepper_.attempt(t_, h, z_.span(), std::as_const(y_dot_).span().data()))
        if (const std::string reason = ode_.failure(); !reason.empty())
            throw GuardStop(fmt::format("{} at t = {:.6g}", reason, stepper_.failed_at()));
    guard(z_.span(), t_ + h);
    return z_.span();
}

double GslAdaptive::take_step(double t_stop) {
    watch_.begin(t_, std::as_const(y_).span());
    begin();
    const Accepted step = accepted_step(t_stop);
    if (errors_due()) {
        estimate_errors();
        shares_.count(statistics_);
    }
    const auto [length, due] = watch_.first_piece(step.length, std::as_const(z_).span(),
                                                  [this](double other) { return retake(other); });
    if (length > 0.0) N_VScale(1.0, z_.get(), y_.get());
    t_ = length == step.length ? step.to : std::min(t_ + length, step.to);
    if (due) statistics_.events += watch_.apply(t_, y_.span());
    ++statistics_.steps;
    statistics_.last_step = step.length;
    return t_;
}

/// A multistep method begins anew with order 1, which needs a shorter step than the next.
void GslAdaptive::reset(double t) {
    t_ = t;
    stepper_.reset();
    if (multistep_) h_ = 0.0;
}

void GslAdaptive::remember(Archive& archive) {
    Integrator::remember(archive);
    archive(watch_, h_);
    if (archive.reading()) reset(t_);
}

}  // namespace spam
