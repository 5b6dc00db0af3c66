// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/integrate/interrupt.hpp>
#include <spam/problem/motion.hpp>
#include <spam/study/trial.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace spam {
namespace {

/// Waiting for a processor does not count.
double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

template <int Dim>
TrialRun integrate_trial(const Start<Dim>& start, const IntegratorOptions& options, double t_end,
                         std::size_t most_calls) {
    Motion<Dim> motion(*start.model, start.y0, options);
    TrialRun run;
    const double most =
        most_calls > 0 ? static_cast<double>(most_calls) : std::numeric_limits<double>::infinity();
    const double begun = thread_seconds();
    try {
        while (motion.t() < t_end && !run.interrupted && run.stopped.empty()) {
            motion.step(t_end);
            const auto calls = static_cast<double>(motion.statistics().rhs_evaluations);
            const double part = std::max(motion.t() / t_end, 0.25);
            if (calls > most * part && motion.t() < t_end)
                run.stopped = "too many right-hand sides";
            run.interrupted = InterruptWatch::received() != 0;
        }
    } catch (const GuardStop& stop) {
        run.stopped = stop.what();
    }
    run.seconds = thread_seconds() - begun;
    run.statistics = motion.statistics();
    run.y.assign(motion.y().begin(), motion.y().end());
    return run;
}

template <int Dim>
double least_seconds(const Start<Dim>& start, const IntegratorOptions& options, double t_end,
                     const TrialRun& first, double seconds) {
    double least = first.seconds, spent = first.seconds;
    for (int n = 1; n < 5 && spent < seconds; ++n) {
        const TrialRun again = integrate_trial<Dim>(start, options, t_end);
        if (again.interrupted) break;
        least = std::min(least, again.seconds);
        spent += again.seconds;
    }
    return least;
}

template <int Dim>
double calls_per_step(const Start<Dim>& start, const std::string& method, double dt) {
    Motion<Dim> motion(*start.model, start.y0, {.method = method, .dt = dt});
    const auto calls = [&] { return static_cast<double>(motion.statistics().rhs_evaluations); };
    motion.step(1e3 * dt);  // the first may cost more
    const double before = calls();
    constexpr int steps = 4;
    for (int n = 0; n < steps; ++n) motion.step(1e3 * dt);
    return (calls() - before) / steps;
}

template <int Dim>
ConservedScales conserved_scales(const Model<Dim>& model, std::span<const double> y0,
                                 double largest_kinetic) {
    const ConstState<Dim> state(model.layout(), y0);
    const auto x = state.position();
    const auto [mass, inertia] = exact_sums(model.particles().size(), [&](std::size_t i) {
        const double m = model.particles().mass[i];
        return std::array<double, 2>{m, m * x.col(static_cast<Eigen::Index>(i)).squaredNorm()};
    });
    const double energy = std::abs(measure_invariants<Dim>(model, y0).energy);
    return {std::sqrt(2.0 * mass * largest_kinetic), std::sqrt(2.0 * inertia * largest_kinetic),
            std::max(energy, largest_kinetic)};
}

#define SPAM_INSTANTIATE(Dim)                                                              \
    template TrialRun integrate_trial(const Start<Dim>&, const IntegratorOptions&, double, \
                                      std::size_t);                                        \
    template double least_seconds(const Start<Dim>&, const IntegratorOptions&, double,     \
                                  const TrialRun&, double);                                \
    template double calls_per_step(const Start<Dim>&, const std::string&, double);         \
    template ConservedScales conserved_scales(const Model<Dim>&, std::span<const double>, double);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
