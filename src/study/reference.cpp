// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference.hpp"

#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam::work_precision {
namespace {

double root_mean_square(std::span<const double> x) {
    const double sum = exact_sum(x.size(), [&](std::size_t k) { return x[k] * x[k]; });
    return std::sqrt(sum / static_cast<double>(x.size()));
}

}  // namespace

FieldErrors::FieldErrors() {
    rms.fill(std::nan(""));
    largest.fill(std::nan(""));
}

double FieldErrors::worst() const {
    double most = 0.0;
    for (const double e : rms)
        if (!std::isnan(e)) most = std::max(most, e);
    return most;
}

template <int Dim>
FieldErrors compare(const Start<Dim>& start, std::span<const double> y,
                    std::span<const double> reference) {
    FieldErrors errors;
    const auto& layout = start.model->layout();
    for (std::size_t f = 0; f < fields.size(); ++f) {
        const auto* block = layout.find(fields[f]);
        if (block == nullptr) continue;
        const std::size_t size = block->size;
        const auto of = [&](std::span<const double> z) { return z.subspan(block->offset, size); };
        double scale = start.model->particles().spacing;
        if (fields[f] != Field::position)
            scale = std::max(root_mean_square(of(start.y0)), root_mean_square(of(reference)));
        if (!(scale > 0.0)) scale = block->scale;
        std::vector<double> difference(size);
        errors.largest[f] = 0.0;
        for (std::size_t k = 0; k < size; ++k) {
            difference[k] = (of(y)[k] - of(reference)[k]) / scale;
            errors.largest[f] = std::max(errors.largest[f], std::abs(difference[k]));
        }
        errors.rms[f] = root_mean_square(difference);
    }
    return errors;
}

template <int Dim>
std::string Reference<Dim>::name(std::size_t k) const {
    const IntegratorOptions& options = options_[k];
    return options.dt ? fmt::format("{}, {} steps", options.method,
                                    std::lround(trial_.t_end / *options.dt))
                      : fmt::format("{}, tolerance {:g}", options.method, options.rtol);
}

template <int Dim>
const TrialRun& Reference<Dim>::solution(std::size_t k) {
    const std::lock_guard lock(solutions_[k].mutex);
    TrialRun& run = solutions_[k].run;
    if (run.y.empty() || run.interrupted)
        run = integrate_trial<Dim>(trial_.start(), options_[k], trial_.t_end);
    return run;
}

template <int Dim>
auto Reference<Dim>::choose(const Start<Dim>& start) -> std::optional<Choice> {
    Choice best{size(), std::numeric_limits<double>::infinity()};
    for (std::size_t k = 0; k < size(); k += 2) {
        const TrialRun &one = solution(k), &other = solution(k + 1);
        if (one.interrupted || other.interrupted) return {};
        if (!one.stopped.empty() || !other.stopped.empty()) continue;
        const double floor = std::max(1e-16, compare<Dim>(start, other.y, one.y).worst());
        if (floor < best.floor) best = {k, floor};
    }
    if (best.number == size())
        throw GuardStop(fmt::format("{}: no reference reaches the end; {}", trial_.name,
                                    solution(0).stopped + solution(1).stopped));
    return best;
}

template FieldErrors compare(const Start<1>&, std::span<const double>, std::span<const double>);
template FieldErrors compare(const Start<2>&, std::span<const double>, std::span<const double>);
template FieldErrors compare(const Start<3>&, std::span<const double>, std::span<const double>);
SPAM_COMPILED(template class Reference);

}  // namespace spam::work_precision
