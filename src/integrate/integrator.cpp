// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/parts.hpp>
#include <spam/integrate/integrator.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

/// z.size() where all are finite.
std::size_t first_not_finite(std::span<const double> z) {
    // Without branches: a NaN or an infinity survives in the sum of x - x. In many sums, or each
    // addition would wait for the one before.
    constexpr std::size_t sums = 16;
    double not_finite[sums] = {};
    std::size_t k = 0;
    for (; k + sums <= z.size(); k += sums)
        for (std::size_t l = 0; l < sums; ++l) not_finite[l] += z[k + l] - z[k + l];
    for (; k < z.size(); ++k) not_finite[0] += z[k] - z[k];
    if (std::all_of(not_finite, not_finite + sums, [](double s) { return s == 0.0; }))
        return z.size();
    const auto bad = std::find_if(z.begin(), z.end(), [](double x) { return !std::isfinite(x); });
    return static_cast<std::size_t>(bad - z.begin());
}

const char* what_it_is(double x) { return std::isnan(x) ? "nan" : "infinite"; }

}  // namespace

Integrator::Integrator(const Ode& ode, Vector& y, double t0)
    : ode_(ode),
      y_(y),
      t_(t0),
      size_(Parts::here().total(y.size())) {}

double Integrator::step(double t_stop) {
    if (most_steps_ && statistics_.steps >= *most_steps_)
        throw GuardStop(
            fmt::format("too many steps: {} have come to t = {:.6g}, --max-steps allows "
                        "no more",
                        statistics_.steps, t_));
    const double t = take_step(t_stop);
    if (ode_.settle && ode_.settle(t, y_.span())) reset(t);
    return t;
}

/// In several parts of a run the first that has found one speaks for all.
std::string Integrator::not_finite(const char* of, std::span<const double> z, double t) const {
    const std::size_t k = first_not_finite(z);
    return Parts::here().first_of(
        k == z.size() ? ""
                      : fmt::format("{}{} became {} at t = {:.6g}; a smaller step may help", of,
                                    ode_.entry_name(k), what_it_is(z[k]), t));
}

std::string Integrator::non_finite_entry(std::span<const double> z, double t) const {
    return not_finite("", z, t);
}

void Integrator::guard(std::span<const double> z, double t) const {
    if (auto reason = non_finite_entry(z, t); !reason.empty()) throw GuardStop(reason);
}

std::string Integrator::non_finite_rate(std::span<const double> y_dot, double t) const {
    return not_finite("the rate of ", y_dot, t);
}

void Integrator::remember(Archive& archive) {
    archive(t_, statistics_);
    for (const Event& event : ode_.events)
        if (event.remember) event.remember(archive);
}

}  // namespace spam
