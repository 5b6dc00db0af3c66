// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "checkpoint.hpp"
#include "recorder.hpp"
#include <spam/integrate/driver.hpp>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

namespace spam {

/// What integrators see of a model. `pair_interactions` counts.
template <int Dim>
Ode as_ode(Model<Dim>& model, const IntegratorOptions& options, std::size_t& pair_interactions);

/// One case on its way: rows, remarks, statistics. What else is to be done at snapshots and steps comes
/// from outside.
template <int Dim>
class Run {
  public:
    /// `folder`: where invariants.csv and events.csv go; null for none.
    Run(Case<Dim>& one, const IntegratorOptions& options, const RunFolder* folder);

    struct Watchers {
        std::function<void(double t)> snapshot, step;
        /// Writes what going on from here later needs; where empty the run makes no barriers.
        std::function<void(CaseMemory)> checkpoint;
        std::function<void(double t, const Remark&)> remark;
        std::function<void(double t, const std::string& text)> warning;
    };
    /// To the end, a signal, or a guard; only OutputError is thrown, with record() up to date.
    /// Returns why a guard stopped the run, else nothing.
    std::string drive(const Watchers& watchers);

    /// What going on from here later needs.
    CaseMemory memory();
    /// Before drive(), which then goes on. Precondition: state_of(memory, model) is no error.
    void recall(const CaseMemory& memory);
    /// When snapshots were taken.
    const std::vector<double>& snapshot_times() const { return snapshot_times_; }

    std::span<double> y() { return y_.span(); }
    const Integrator::Statistics& statistics() const { return integrator_->statistics(); }
    /// The field that kept the latest step short; empty where none did.
    std::string limiting() const;
    double seconds() const;
    std::vector<Drift> drifts() const { return recorder_.drifts(promise_limit_); }
    /// Complete after drive().
    RunRecord& record() { return record_; }

  private:
    void remember(double t, const Remark& remark);
    void watch(double t, const Watchers& watchers);
    void snapshot(double t, const Watchers& watchers);
    void checkpoint(const Watchers& watchers);
    void remember_motion(Archive& archive);
    void remember_records(Archive& archive);
    void rewrite_events();
    std::vector<RunStatistics::Limit> limits() const;
    void guard(double t, const Watchers& watchers);
    void complete();

    Case<Dim>& one_;
    double promise_limit_;
    RunRecord record_;
    SundialsContext context_;
    Vector y_;
    Ode ode_;
    std::unique_ptr<Integrator> integrator_;
    Recorder<Dim> recorder_;
    DriftGuard guard_;
    std::optional<std::filesystem::path> events_;
    std::chrono::steady_clock::time_point start_;
    double seconds_before_ = 0.0;  ///< a restart
    std::vector<double> snapshot_times_;
    bool resumed_ = false;
    std::string ended_;  ///< by a guard, before a restart that only finishes it
};

/// The change that 'to integrator error' allows.
double promise_limit(const IntegratorOptions& options);

}  // namespace spam
