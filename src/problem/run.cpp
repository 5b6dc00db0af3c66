// SPDX-License-Identifier: GPL-3.0-or-later
#include "run.hpp"

#include "why_stopped.hpp"
#include <spam/core/error.hpp>
#include <spam/problem/run_in_memory.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {

namespace {

/// What a run remembers beside its motion.
template <int Dim>
void remember_all(Archive& archive, const Plan<Dim>& plan, Recorder<Dim>& recorder,
                  DriftGuard& guard, std::vector<std::pair<double, Remark>>& remarks,
                  std::vector<double>& snapshot_times) {
    recorder.remember(archive);
    archive(guard);
    archive(remarks, snapshot_times);
    for (const Observer<Dim>& observer : plan.observers)
        if (observer.memory) observer.memory(archive);
}

}  // namespace

template <int Dim>
Run<Dim>::Run(Case<Dim>& one, const IntegratorOptions& options, const RunFolder* folder,
              Parts& processes)
    : one_(one),
      promise_limit_(promise_limit(options, *one.model)),
      options_(options),
      motion_(std::make_unique<PartedMotion<Dim>>(*one.model, one.y0, options, processes)),
      recorder_(*one.model, one.plan, folder),
      guard_(one.plan.guard),
      start_(std::chrono::steady_clock::now()) {
    one.y0 = std::vector<double>();  // the motion holds it from now on (`= {}` would keep its room)
    if (const auto dt = symplectic_step(options)) recorder_.expect_swing(*dt, *one.model);
    record_.label = one.label;
    if (folder != nullptr) events_ = *folder / "events.csv";
}

template <int Dim>
double Run<Dim>::seconds() const {
    return seconds_before_ +
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

template <int Dim>
double Run<Dim>::seconds_left(double t_end) const {
    const double t = motion_->t();
    return (seconds() - seconds_before_) * (t_end - t) / (t - began_);
}

/// The file comes into being with the first event.
template <int Dim>
void Run<Dim>::remember(double t, const Remark& remark) {
    if (events_) {
        std::ofstream out(*events_, std::ios::app);
        if (record_.remarks.empty()) out << "t,event,value\n";
        out << fmt::format("{:.17g},{},{:.17g}\n", t, remark.what, remark.value);
        if (!out.flush())
            throw OutputError(fmt::format("cannot write '{}' (disk full?)", events_->string()));
    }
    record_.remarks.emplace_back(t, remark);
}

template <int Dim>
void Run<Dim>::snapshot(double t, const Watchers& watchers) {
    if (!snapshot_times_.empty() && snapshot_times_.back() == t) return;
    snapshot_times_.push_back(t);
    if (watchers.snapshot) watchers.snapshot(t);
    for (const Observer<Dim>& observer : one_.plan.observers)
        if (observer.on_snapshot) observer.on_snapshot(t, *one_.model, motion_->y());
}

/// Not in the checkpoint: its bytes are those of the motion, the same on every machine and on any ranks.
template <int Dim>
void Run<Dim>::recall_cost(const CostOfRates& before) {
    const auto evaluations = static_cast<double>(statistics().rhs_evaluations);
    seconds_before_ = evaluations * before.seconds;
    pairs_before_ = static_cast<std::size_t>(std::llround(evaluations * before.pairs));
}

template <int Dim>
void Run<Dim>::remember_records(Archive& archive) {
    remember_all(archive, one_.plan, recorder_, guard_, record_.remarks, snapshot_times_);
}

template <int Dim>
void check_records(const Case<Dim>& one, const CaseMemory& memory) {
    Recorder<Dim> recorder(*one.model, one.plan, nullptr);
    DriftGuard guard(one.plan.guard);
    std::vector<std::pair<double, Remark>> remarks;
    std::vector<double> snapshot_times;
    Archive records(memory.records);
    remember_all(records, one.plan, recorder, guard, remarks, snapshot_times);
    records.expect_end();
}

template <int Dim>
CaseMemory Run<Dim>::memory() {
    CaseMemory memory = case_memory<Dim>(*one_.model, motion_->y(), motion_->t());
    memory.label = one_.label;
    Archive motion, records;
    motion_->remember(motion);
    memory.motion = motion.take();
    remember_records(records);
    memory.records = records.take();
    if (one_.plan.rezoning) {  // the model may be gone when it is written
        memory.material = one_.model->particles().material;
        memory.keep();
    }
    return memory;
}

template <int Dim>
void Run<Dim>::recall(const CaseMemory& memory) {
    const auto y = state_of(memory, *one_.model);
    motion_->edit([&](std::span<double> now) {
        std::ranges::copy(y, now.begin());
        return true;
    });
    Archive motion(memory.motion), records(memory.records);
    motion_->remember(motion);
    motion.expect_end();
    remember_records(records);
    records.expect_end();
    if (events_) rewrite_events();
    began_ = motion_->t();
    resumed_ = true;
}

/// What is written now can be gone on from later. Here the run does so itself, so that it goes the same
/// way as one that was restarted.
template <int Dim>
void Run<Dim>::checkpoint(const Watchers& watchers) {
    CaseMemory written = memory();
    Archive back(written.motion);
    motion_->remember(back);
    watchers.checkpoint(std::move(written));
}

/// Other particles: all that goes on is what a checkpoint would hold, in a model and an integrator made of it.
/// They take the place of those before within this run, so that rows, events, snapshots, accounts and the schedule are
/// one; a restart before the change comes to it by the same way, and one behind it finds the particles in its
/// checkpoint (revive).
template <int Dim>
void Run<Dim>::rezone(double t, const Watchers& watchers) {
    auto next = one_.plan.rezoning->change(*one_.model, motion_->y());
    if (!next) return;
    auto motion = std::make_unique<PartedMotion<Dim>>(*next->model, next->y, options_,
                                                      motion_->processes(), t);
    motion->go_on_from(*motion_);
    pairs_before_ += motion_->pair_interactions();
    motion_ = std::move(motion);
    one_.model = std::move(next->model);
    recorder_.go_on_with(*one_.model);
    if (watchers.rezoned) watchers.rezoned();
    for (const Remark& remark : next->remarks) {
        remember(t, remark);
        if (watchers.remark) watchers.remark(t, remark);
    }
}

template <int Dim>
void Run<Dim>::rewrite_events() {
    std::error_code ignored;
    std::filesystem::remove(*events_, ignored);
    auto remarks = std::move(record_.remarks);
    record_.remarks.clear();
    for (const auto& [t, remark] : remarks) remember(t, remark);
}

template <int Dim>
void Run<Dim>::watch(double t, const Watchers& watchers) {
    for (const Remark& remark : motion_->watch()) {
        remember(t, remark);
        if (watchers.remark) watchers.remark(t, remark);
        if (remark.stop)
            throw GuardStop(fmt::format("{} ({:.3g}) at t = {:.6g}", remark.what, remark.value, t));
    }
}

/// After a row: is a number missing, has an invariant left its limit?
template <int Dim>
void Run<Dim>::guard(double t, const Watchers& watchers) {
    for (const std::string& name : recorder_.newly_empty()) {
        remember(t, {name + " is not a number; its cells are left empty", 0.0});
        if (watchers.warning)
            watchers.warning(t, fmt::format("{} is no number at t = {:.6g}, its "
                                            "cells are left empty",
                                            name, t));
    }
    if (guard_.action() == DriftAction::off) return;
    for (const auto& beyond : guard_.newly_exceeded(recorder_.latest_drifts(promise_limit_))) {
        remember(t, {beyond.name + " beyond its limit", beyond.change});
        const std::string text = fmt::format("{} at t = {:.6g}", beyond.describe(), t);
        if (guard_.action() == DriftAction::stop) throw GuardStop(text);
        if (watchers.warning) watchers.warning(t, text);
    }
}

template <int Dim>
std::string Run<Dim>::limiting() const {
    const auto block = statistics().limiting;
    return block && *block < motion_->ode().blocks.size() ? motion_->ode().blocks[*block].name
                                                          : std::string{};
}

/// Nothing for fixed steps.
template <int Dim>
std::vector<RunStatistics::Limit> Run<Dim>::limits() const {
    std::vector<RunStatistics::Limit> limits;
    const auto& s = statistics();
    if (std::ranges::all_of(s.limited_by, [](auto n) { return n == 0; })) return limits;
    for (std::size_t b = 0; b < std::min(motion_->ode().blocks.size(), s.limited_by.size()); ++b)
        limits.push_back({motion_->ode().blocks[b].name, s.limited_by[b], s.error_share[b]});
    return limits;
}

template <int Dim>
void Run<Dim>::complete() {
    RunStatistics& s = record_.statistics;
    s.particles = one_.model->particles().size();
    s.t_end = motion_->t();
    s.pair_interactions = pair_interactions();
    s.steps = statistics().steps;
    s.rejected_steps = statistics().rejected_steps;
    s.rhs_evaluations = statistics().rhs_evaluations;
    s.events = statistics().events;
    s.limited_by = limits();
    s.wall_seconds = seconds();
    s.ranks = motion_->exchanges();
    record_.history = recorder_.history();
    record_.drifts = s.invariants = drifts();
    record_.y.assign(motion_->y().begin(), motion_->y().end());
}

template <int Dim>
bool Run<Dim>::revise(double t) {
    return motion_->edit([&](std::span<double> y) {
        bool changed = false;
        for (const Observer<Dim>& observer : one_.plan.observers)
            if (observer.revise && observer.revise(t, *one_.model, y)) changed = true;
        return changed;
    });
}

template <int Dim>
std::string Run<Dim>::drive(const Watchers& watchers) {
    const Plan<Dim>& plan = one_.plan;
    Observers observers;
    observers.output = [&](double t) {
        const auto& rows = recorder_.history().rows();
        if (!rows.empty() && rows.back().front() == t) return;
        for (const Observer<Dim>& observer : plan.observers)
            if (observer.on_row) observer.on_row(t, *one_.model, motion_->y());
        recorder_.add(t, statistics().last_step, motion_->y());
        guard(t, watchers);
    };
    observers.snapshot = [&](double t) { snapshot(t, watchers); };
    if (watchers.checkpoint) observers.checkpoint = [&](double) { checkpoint(watchers); };
    if (watchers.last) observers.last = [&](double) { watchers.last(memory()); };
    observers.step = [&](double t) {
        watch(t, watchers);
        if (watchers.step) watchers.step(t);
    };
    if (plan.rezoning) observers.change = [&](double t) { return rezone(t, watchers); };
    if (plan.may_change()) observers.revise = [&](double t) { return revise(t); };
    observers.enough = [&](double) {
        return std::ranges::any_of(plan.observers, [&](const auto& one) {
            return one.enough && one.enough(recorder_.history());
        });
    };

    std::string reason;
    try {
        Schedule schedule{plan.t_end, plan.output_every, plan.snapshot_every,
                          plan.checkpoint_every};
        schedule.change_every = plan.rezoning ? plan.rezoning->every : 0.0;
        schedule.resumed = resumed_;
        const Parts::Here here(motion_->processes());
        const int signal = spam::drive([&]() -> Integrator& { return motion_->integrator(); },
                                       schedule, of_the_whole(observers));
        record_.complete = signal == 0;
        if (signal != 0) record_.statistics.stopped = fmt::format("signal {}", signal);
    } catch (const OutputError& error) {
        record_.statistics.stopped = error.what();
        motion_->processes().leave(error.what());  // it is one process that could not write
        if (motion_->processes().alone()) complete();
        throw;
    } catch (...) {
        reason = record_.statistics.stopped = why_a_run_stops();
        if (reason.empty()) throw;
        if (!motion_->processes().alone() && is_for_want_of_memory()) {
            motion_->processes().leave(reason);
            throw;
        }
    }
    complete();
    return reason;
}

template <int Dim>
RunRecord run_in_memory(Case<Dim> one, const IntegratorOptions& integrator) {
    if (one.plan.rezoning) one.plan.rezoning->check(*one.model);
    Run<Dim> run(one, integrator, nullptr);
    run.drive({});
    return std::move(run.record());
}

SPAM_COMPILED(template class Run);
#define SPAM_INSTANTIATE(D)                                         \
    template void check_records(const Case<D>&, const CaseMemory&); \
    template RunRecord run_in_memory(Case<D>, const IntegratorOptions&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
