// SPDX-License-Identifier: GPL-3.0-or-later
#include "work_precision.hpp"
#include <spam/picture/draw.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam::work_precision {
namespace {

/// Above this order hardly any steps are left between those too large and round-off.
constexpr int highest_claimed = 6;

ConvergenceFit order_of(const Branch& branch, double floor, const ConvergenceRule& rule) {
    std::vector<double> step, error;
    for (const Sample& sample : branch.samples) {
        step.push_back(sample.dt);
        error.push_back(sample.error);
    }
    return fit_convergence(step, error, floor, rule);
}

/// Orders of the methods with fixed steps: a table in words, orders.csv, and checks.
void report_orders(Session& session, const std::vector<TrialWords>& trials,
                   const std::vector<StudyMethod>& methods, const std::vector<Branch>& branches) {
    auto& terminal = session.terminal();
    std::string csv =
        "problem,method,nominal,order,order_error,smallest_dt,largest_dt,points,claim\n";
    terminal.say("");
    const char* line = "{:<17}{:<22}{:>7}  {:<15}{}";
    terminal.say(
        fmt::format(fmt::runtime(line), "problem", "fixed steps", "nominal", "observed", "for dt"));
    for (const Branch& branch : branches) {
        if (!branch.fixed) continue;
        const TrialWords& trial = trials[branch.trial];
        const StudyMethod& method = methods[branch.method];
        const bool smooth = trial.rough.empty();
        const bool claimed = smooth && method.order <= highest_claimed;
        const auto rule = smooth ? ConvergenceRule::smooth() : ConvergenceRule::rough();
        const ConvergenceFit fit = order_of(branch, trial.floor, rule);
        csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", trial.name, method.name, method.order,
                           fit.known() ? fmt::format("{:.4f}", fit.order) : "",
                           fit.known() ? fmt::format("{:.4f}", fit.order_error) : "",
                           fit.smallest_step, fit.largest_step, fit.points,
                           claimed ? "within 0.1" : "no claim");
        terminal.say(fmt::format(
            fmt::runtime(line), trial.name, method.title(),
            fmt::format(fmt::runtime(claimed ? "{}" : "({})"), method.order),
            fit.known() ? fmt::format("{:.2f} +- {:.2f}", fit.order, fit.order_error) : "no range",
            fit.known() ? fmt::format("{:.2g} to {:.2g}", fit.smallest_step, fit.largest_step)
                        : ""));
        if (!fit.known()) continue;
        Check check{trial.name + "_order_" + method.word(),
                    fit.order,
                    {},
                    0.0,
                    smooth ? "measured: few steps between too large and round-off" : trial.rough};
        if (claimed)
            check = {
                check.name, fit.order, static_cast<double>(method.order), 0.1,
                fmt::format("nominal; errors {:g} floors to {:g}", rule.above_floor, rule.below)};
        session.check(check);
    }
    session.folder().write("orders.csv", csv);
}

/// For three errors: which curve reaches it with the fewest right-hand sides.
void report_cheapest(Session& session, const std::vector<TrialWords>& trials,
                     const std::vector<StudyMethod>& methods, const std::vector<Branch>& branches) {
    auto& terminal = session.terminal();
    terminal.say("");
    terminal.say(fmt::format("{:<17}{:<7}{:<42}{:>6}  {}", "problem", "error",
                             "fewest right-hand sides", "calls", "/ t"));
    for (std::size_t t = 0; t < trials.size(); ++t)
        for (const double error : {1e-3, 1e-6, 1e-9}) {
            const Branch* best = nullptr;
            double least = HUGE_VAL;
            for (const Branch& branch : branches) {
                if (branch.trial != t) continue;
                const double calls = work_for(branch, error, &Sample::calls);
                if (calls < least) {
                    least = calls;
                    best = &branch;
                }
            }
            if (best == nullptr) continue;
            const std::string name = fmt::format("{}, {} steps", methods[best->method].name,
                                                 best->fixed ? "fixed" : "adaptive");
            terminal.say(fmt::format("{:<17}{:<7.0e}{:<42}{:>6.0f}  {:.3g}", trials[t].name, error,
                                     name, least, least / trials[t].t_end));
            session.measure(fmt::format("{}_calls_for_{:.0e}", trials[t].name, error), least,
                            "fewest: " + name);
        }
}

void report_floor(Session& session, const TrialWords& trial, double smallest, double largest) {
    Check floor{trial.name + "_reference_error", trial.floor, {}, 0.0, "measured: two references"};
    if (trial.rough.empty())
        floor = {floor.name, trial.floor, 0.0, 1e-10, "two references by different methods"};
    session.check(floor);
    session.measure(trial.name + "_decades_of_error", std::log10(largest / smallest),
                    "measured, of errors that are known");
}

void draw(Session& session, const TrialWords& trial, std::size_t t,
          const std::vector<StudyMethod>& methods, const std::vector<Branch>& branches) {
    LogLogPanel calls{"", "right-hand sides", "error", {}, trial.floor, {}};
    LogLogPanel seconds{"", "seconds", "error", {}, trial.floor, {}};
    calls.words = fmt::format("dotted: error of the reference, {:.0e}", trial.floor);
    for (const Branch& branch : branches) {
        if (branch.trial != t) continue;
        LogLogCurve one{branch.method, branch.fixed, {}, {}};
        LogLogCurve other = one;
        for (const Sample& sample : branch.samples) {
            if (sample.error < 2.0 * trial.floor) break;  // from here on it tells nothing
            if (!(sample.error <= 1.0)) continue;
            one.x.push_back(sample.calls);
            other.x.push_back(sample.seconds);
            one.y.push_back(sample.error);
            other.y.push_back(sample.error);
        }
        calls.curves.push_back(std::move(one));
        seconds.curves.push_back(std::move(other));
    }
    LogLogPicture picture{
        fmt::format("{}, {} particles, to t = {:.4g}", trial.title, trial.particles, trial.t_end),
        {std::move(calls), std::move(seconds)},
        2,
        {},
        "Filled, full lines: steps chosen by the method. Open, dashed: fixed steps. In brackets: "
        "nominal "
        "order."};
    for (const StudyMethod& method : methods) picture.key.push_back(method.title());
    session.note_drawn(draw_log_log(session.plots_folder(), "accuracy_" + trial.name, picture));
}

}  // namespace

double work_for(const Branch& branch, double error, double Sample::*work) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < branch.samples.size(); ++k) {
        const Sample &a = branch.samples[k], &b = branch.samples[k + 1];
        if (!b.known || !(a.error >= error && error >= b.error)) continue;
        const double part =
            a.error == b.error ? 0.0 : std::log(a.error / error) / std::log(a.error / b.error);
        least = std::min(least, a.*work * std::pow(b.*work / a.*work, part));
    }
    return least;
}

void report(Session& session, const std::vector<TrialWords>& trials,
            const std::vector<StudyMethod>& methods, const std::vector<Branch>& branches) {
    for (std::size_t t = 0; t < trials.size(); ++t) {
        double smallest = 1.0, largest = trials[t].floor;
        for (const Branch& branch : branches)
            for (const Sample& sample : branch.samples) {
                if (branch.trial != t || !sample.known || sample.error > 1.0) continue;
                smallest = std::min(smallest, sample.error);
                largest = std::max(largest, sample.error);
            }
        report_floor(session, trials[t], smallest, largest);
    }
    report_orders(session, trials, methods, branches);
    report_cheapest(session, trials, methods, branches);
    if (session.plots())
        for (std::size_t t = 0; t < trials.size(); ++t)
            draw(session, trials[t], t, methods, branches);
}

}  // namespace spam::work_precision
