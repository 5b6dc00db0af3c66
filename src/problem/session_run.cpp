// SPDX-License-Identifier: GPL-3.0-or-later
#include "../io/cost_of_rates.hpp"
#include "checkpoint.hpp"
#include "draw_invariants.hpp"
#include "duration.hpp"
#include "run.hpp"
#include <spam/core/error.hpp>
#include <spam/integrate/driver.hpp>
#include <spam/integrate/interrupt.hpp>
#include <spam/io/snapshot.hpp>
#include <spam/problem/session.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace spam {
namespace {

/// Promises and limits before anything has moved.
std::vector<Drift> drifts_at_start(const Promises& p, int dim, double integrator_limit) {
    std::vector<Drift> drifts;
    const auto add = [&](const char* name, Promise promise) {
        drifts.push_back({name, promise, 0.0, allowed_change(promise, integrator_limit)});
    };
    add("mass", p.mass);
    add("momentum", p.momentum);
    if (dim > 1) add("angular momentum", p.angular_momentum);
    add("energy", p.energy);
    return drifts;
}

}  // namespace

/// Ends and intervals of the case of that number: as given, else those of the run that is gone on with,
/// else the case's own, else parts of its length. Never those of another case.
template <int Dim>
void Session::settle_plan(Plan<Dim>& plan, std::size_t number) {
    const auto& common = problem_.common_;
    const SessionMemory* before = problem_.earlier_.get();
    std::optional<PlanMemory> earlier;
    if (before != nullptr && number < before->plans.size()) earlier = before->plans[number];
    const auto settled = [&](const std::optional<double>& given, double PlanMemory::*remembered,
                             double own, double otherwise) {
        return given ? *given : earlier ? (*earlier).*remembered : own > 0.0 ? own : otherwise;
    };
    plan.t_end = settled(plan.own_end ? std::nullopt : common.t_end, &PlanMemory::t_end, plan.t_end,
                         plan.t_end);
    if (!(plan.t_end > 0.0) || !std::isfinite(plan.t_end))
        throw InputError(fmt::format("t-end: {} must be a number above 0", plan.t_end));
    // Times closer than this would not be told apart, or never be reached.
    const auto limit = [&](const char* name, double interval, const char* what) {
        if (!(plan.t_end / interval <= most_steps))
            throw InputError(
                fmt::format("{}: {}{} would take {:.0e} {} to t = {:g}; choose a larger one", name,
                            interval, given(name) ? "" : ", which this case chooses,",
                            plan.t_end / interval, what, plan.t_end));
    };
    spam::refuse_endless(integrator_of(plan), plan.t_end);
    if (given("dt") && integrator_.dt && *integrator_.dt > plan.t_end)
        throw InputError(
            fmt::format("dt: {:g} is longer than the run, which ends at t = {:g}; give a "
                        "shorter step",
                        *integrator_.dt, plan.t_end));
    plan.output_every = settled(common.output_every, &PlanMemory::output_every, plan.output_every,
                                plan.t_end / 240.0);
    plan.snapshot_every = settled(common.snapshot_every, &PlanMemory::snapshot_every,
                                  plan.snapshot_every, plan.t_end / 12.0);
    const double twelfth = plan.t_end / 12.0 / plan.snapshot_every;  // in snapshots
    plan.checkpoint_every = settled(
        common.checkpoint_every, &PlanMemory::checkpoint_every, plan.checkpoint_every,
        std::min(plan.t_end, std::max(1.0, std::ceil(twelfth - 1e-9)) * plan.snapshot_every));
    limit("output-every", plan.output_every, "rows");
    limit("snapshot-every", plan.snapshot_every, "files");
    limit("checkpoint-every", plan.checkpoint_every, "files");
    memory_->plans.push_back(
        {plan.t_end, plan.output_every, plan.snapshot_every, plan.checkpoint_every});
    plan.guard = common.guard;
    if (Dim == 1 && common.guard.angular_momentum)
        throw InputError(
            "limit-angular-momentum: there is no angular momentum in one dimension; leave it out");
}

template <int Dim>
void Session::describe(const Case<Dim>& one) {
    const auto& particles = one.model->particles();
    const Promises p = one.model->promises();
    const IntegratorOptions own = integrator_of(one.plan);
    terminal_.say("");
    if (!one.label.empty()) terminal_.say(fmt::format("case        {}", one.label));
    terminal_.say(fmt::format("particles   {} in {} bod{}, {} numbers in y", particles.size(),
                              particles.bodies(), particles.bodies() == 1 ? "y" : "ies",
                              one.model->layout().size()));
    terminal_.say(fmt::format("model       {}", one.model->describe()));
    terminal_.say(fmt::format("promise     mass {}, momentum {}, angular momentum {}, energy {}",
                              to_string(p.mass), to_string(p.momentum),
                              to_string(p.angular_momentum), to_string(p.energy)));
    terminal_.say(fmt::format("integrator  {}, to t = {:.6g}", own.describe(), one.plan.t_end));
    terminal_.say(
        fmt::format("checkpoints every {:.6g}, and at the end", one.plan.checkpoint_every));
    terminal_.say(fmt::format("guard       {}", one.plan.guard.describe(drifts_at_start(
                                                    p, Dim, promise_limit(own, *one.model)))));
    if (std::isinf(one.model->reach()) && particles.size() > 20000 && !one.y0.empty()) {
        std::vector<double> y_dot(one.y0.size());
        one.model->rates(0.0, one.y0, y_dot);  // makes its list
        const auto begin = std::chrono::steady_clock::now();
        one.model->rates(0.0, one.y0, y_dot);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        terminal_.say(fmt::format(
            "note        all {:.1e} pairs act on each other: a right-hand side takes {:.1f} s here",
            0.5 * std::pow(static_cast<double>(particles.size()), 2), took.count()));
    }
    if (symplectic_step(own) && !one.plan.guard.energy)
        terminal_.say(
            "note        the energy swings by what the step makes of accelerations, which goes "
            "with dt^2; the guard of the energy waits for twice that much");
    for (const auto& [name, interval] : {std::pair{"output-every", one.plan.output_every},
                                         std::pair{"snapshot-every", one.plan.snapshot_every}})
        if (given(name) && interval > one.plan.t_end)
            terminal_.say(fmt::format(
                "note        --{} {:g} is longer than the run: only its start and end are recorded",
                name, interval));
    if (own.adaptive()) {
        std::string tolerances;
        for (const auto& block : one.model->layout().blocks())
            if (block.field.role() == Role::integrated)
                tolerances +=
                    fmt::format("{}{} {:.1e}", tolerances.empty() ? "" : ", ", block.field.name(),
                                own.absolute_tolerance(block.field.name(), block.scale));
        terminal_.say(fmt::format("atol        {}", tolerances));
        const auto& blocks = one.model->layout().blocks();
        if (std::any_of(blocks.begin(), blocks.end(),
                        [](const auto& block) { return block.field.role() == Role::history; }))
            terminal_.say(
                "note        what is settled after each step (plastic flow) has an error of first "
                "order in the step, which tolerances do not control");
    }
}

template <int Dim>
RunRecord Session::run(Model<Dim>& model, std::vector<double> y0, Plan<Dim> plan) {
    std::vector<Case<Dim>> cases;
    cases.push_back({kept_elsewhere(model), std::move(y0), std::move(plan)});
    return std::move(run_all(std::move(cases)).front());
}

template <int Dim>
std::vector<RunRecord> Session::run_all(std::vector<Case<Dim>> cases) {
    integrator();  // first of all, where its options mean nothing
    for (auto& one : cases) settle_plan(one.plan, memory_->plans.size());
    refuse_idle_balance(cases);
    for (const auto& one : cases) {
        if (one.plan.rezoning) one.plan.rezoning->check(*one.model);
        refuse_unstable(one);
        refuse_endless(one);
    }
    for (auto& one : cases) {  // finds out about what cannot be before anything is written
        Recorder<Dim>(*one.model, one.plan, nullptr);  // columns of one name
        // Vectors as long as y show that there is room for them; a dry run does without.
        std::size_t unused = 0, numbers = one.model->layout().size();
        const SundialsContext context;
        Vector y(problem_.common_.dry_run ? 1 : numbers, context);
        const IntegratorOptions own = integrator_of(one.plan);
        PartedMotion<Dim>::refuse(*one.model, own, problem_.processes());
        if (own.dt != integrator_.dt) leave_out_of_case({"dt"});
        Ode ode = as_ode(*one.model, own, unused);
        ode.absolute_tolerance.resize(std::min(y.size(), ode.absolute_tolerance.size()));
        make_integrator(own, ode, y, 0.0, context);
    }
    check_restart(cases);
    if (problem_.common_.dry_run) {
        terminal_.say(fmt::format("{}: {}", problem_.name_, problem_.summary_));
        say_units();
        for (const auto& one : cases) describe(one);
        end_dry_run();
    }
    for (const auto& one : cases) choose_threads(one.model->particles().size());
    {
        const InterruptWatch::Delay delay;
        open_folder();
        save_first();
    }
    std::vector<RunRecord> records;
    for (auto& one : cases) {
        const Parts::Here all(problem_.processes());
        if (!records.empty() && InterruptWatch::agreed() != 0) break;
        const Parts::Here here(Parts::alone_here());
        if (one.start && !records.back().complete) break;
        describe(one);
        if (one.start) one.y0 = one.start(records.back());
        records.push_back(run_one(one, one.label.empty() ? *folder_ : folder_->inside(one.label)));
        report(records.back());
    }
    return records;
}

/// Whether the checkpoint is one of these cases: before anything is written. Cases then have its particles.
template <int Dim>
void Session::check_restart(std::vector<Case<Dim>>& cases) const {
    for (std::size_t k = 0; k < cases.size(); ++k) {
        const CaseMemory* earlier = earlier_case(memory_->cases.size() + k);
        if (earlier == nullptr) continue;
        if (earlier->label != cases[k].label)
            throw InputError(
                fmt::format("restart: the checkpoint holds the case '{}' in place of '{}'",
                            earlier->label, cases[k].label));
        revive(cases[k], *earlier);
        state_of(*earlier, *cases[k].model);
        check_records(cases[k], *earlier);
        if (earlier->t > cases[k].plan.t_end)
            throw InputError(
                fmt::format("t-end: {} lies before the checkpoint's t = {}; give a later "
                            "one",
                            cases[k].plan.t_end, earlier->t));
    }
}

/// Of a case that was begun and stopped before its first checkpoint nothing stays in the folder.
template <int Dim>
void Session::begin_anew(const RunFolder& folder, SnapshotSeries<Dim>& snapshots) {
    if (!problem_.reopened_) return;
    std::error_code ignored;
    std::filesystem::remove(folder / "events.csv", ignored);
    snapshots.resume({});
}

/// Rows, events and snapshots up to the checkpoint, also in a folder of another name.
template <int Dim>
void Session::resume(Run<Dim>& run, CaseMemory& earlier, const RunFolder& folder,
                     SnapshotSeries<Dim>& snapshots) {
    const auto from =
        std::filesystem::path(problem_.common_.restart).parent_path() / run.record().label;
    run.recall(earlier);
    run.recall_cost(cost_of_rates(from));
    snapshots.resume(run.snapshot_times());
    memory_->cases.back() = std::move(earlier);  // until this run comes to a checkpoint of its own
    if (problem_.reopened_ || problem_.muted()) return;
    for (const auto& name : snapshots.names()) {
        std::error_code error;  // where they are gone the list of snapshots begins later
        std::filesystem::copy_file(from / name, folder / name, error);
    }
    if (problem_.restarted_ && !problem_.restarted_->is_there())
        throw OutputError(fmt::format(
            "cannot copy the earlier snapshots: another run has moved '{}' aside; start again from "
            "where it is now, in another --out",
            problem_.restarted_->path().string()));
}

template <int Dim>
typename Run<Dim>::Watchers Session::watchers_of(Run<Dim>& run, const Case<Dim>& one,
                                                 SnapshotSeries<Dim>& snapshots) {
    const std::size_t number = memory_->cases.size() - 1;
    typename Run<Dim>::Watchers watchers;
    watchers.snapshot = [&run, &snapshots, writes = !problem_.muted()](double t) {
        const auto y = run.y();
        if (writes) snapshots.add(t, y);
    };
    watchers.checkpoint = [this, number](CaseMemory&& state) {
        memory_->cases[number] = std::move(state);
        if (!problem_.muted()) save_checkpoint();
    };
    watchers.last = [this, number](CaseMemory&& state) {
        if (!problem_.muted()) save_last(number, std::move(state));
    };
    watchers.rezoned = [&one, &snapshots] { snapshots.go_on_with(*one.model); };
    const bool adaptive = integrator_of(one.plan).adaptive();
    watchers.step = [this, &run, adaptive, t_end = one.plan.t_end](double t) {
        const double fraction = t / t_end;
        if (!terminal_.progress_due(fraction)) return;
        std::string drifts;
        for (const Drift& drift : run.drifts())
            if (drift.name == "energy" || drift.name == "angular momentum")
                drifts +=
                    fmt::format("  d{} {:.0e}", drift.name == "energy" ? "E" : "L", drift.change);
        const auto& s = run.statistics();
        std::string steps;  // fixed ones are in the banner
        if (adaptive)
            steps = fmt::format("  dt {:.3g}  rejected {}", s.last_step, s.rejected_steps);
        if (const std::string limiting = run.limiting(); !limiting.empty())
            steps += "  limit " + limiting;
        terminal_.progress(fraction,
                           fmt::format("{:3.0f} %  t {:.5g}  left {}{}{}", 100.0 * fraction, t,
                                       duration(run.seconds_left(t_end)), drifts, steps));
    };
    watchers.remark = [this](double t, const Remark& remark) {
        const auto text = fmt::format("t = {:.6g}: {}, {:.3g}", t, remark.what, remark.value);
        remark.warning ? terminal_.say("warning     " + text) : terminal_.log(text);
    };
    watchers.warning = [this](double, const auto& text) { terminal_.say("warning     " + text); };
    return watchers;
}

template <int Dim>
RunRecord Session::run_one(Case<Dim>& one, const RunFolder& folder) {
    CaseMemory* earlier = earlier_case(memory_->cases.size());
    memory_->cases.emplace_back().label = one.label;
    Run<Dim> run(one, integrator_of(one.plan), &folder, problem_.processes());
    run.record().statistics.problem = problem_.name_;
    run.record().statistics.units = problem_.units_;
    run.record().statistics.dim = Dim;
    SnapshotSeries<Dim> snapshots(folder, *one.model, problem_.units_);
    if (earlier != nullptr)
        resume(run, *earlier, folder, snapshots);
    else
        begin_anew(folder, snapshots);
    const auto watchers = watchers_of(run, one, snapshots);
    terminal_.begin_progress();
    RunRecord& record = run.record();
    try {
        const std::string reason = run.drive(watchers);
        if (guard_reason_.empty()) guard_reason_ = reason;
        memory_->cases.back().keep();
    } catch (const OutputError&) {
        try {  // there may be room for this much
            write_statistics(folder, record.statistics);
        } catch (const OutputError&) {
        }
        throw;
    }
    terminal_.end_progress();
    if (!record.complete) terminal_.say(fmt::format("stopped     {}", record.statistics.stopped));
    if (!record.remarks.empty())
        terminal_.say(fmt::format("events      {} in events.csv, the first at t = {:.6g}: {}",
                                  record.remarks.size(), record.remarks.front().first,
                                  record.remarks.front().second.what));
    write_statistics(folder, record.statistics);
    statistics_.push_back(record.statistics);
    if (plots())
        note_drawn(draw_invariants(folder.inside("plots"), record.history,
                                   problem_.name_ + (one.label.empty() ? "" : ": " + one.label),
                                   problem_.units_, Dim));
    return std::move(record);
}

#define SPAM_INSTANTIATE(D)                                                   \
    template RunRecord Session::run(Model<D>&, std::vector<double>, Plan<D>); \
    template std::vector<RunRecord> Session::run_all(std::vector<Case<D>>);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
