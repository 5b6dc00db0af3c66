// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../io/cost_of_rates.hpp"
#include "checkpoint.hpp"
#include "recorder.hpp"
#include <spam/integrate/driver.hpp>
#include <spam/integrate/methods.hpp>
#include <spam/problem/parted_motion.hpp>
#include <spam/rhs/particle_model.hpp>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

namespace spam {

/// One case on its way: rows, remarks, statistics. What else is to be done at snapshots and steps comes
/// from outside.
template <int Dim>
class Run {
  public:
    /// `folder`: where invariants.csv and events.csv go; null for none. `processes`: among which its particles are
    /// parted.
    Run(Case<Dim>& one, const IntegratorOptions& options, const RunFolder* folder,
        Parts& processes = Parts::alone_here());

    struct Watchers {
        std::function<void(double t)> snapshot, step;
        /// Writes what going on from here later needs, at a time of the schedule; where empty the run
        /// makes no barriers.
        std::function<void(CaseMemory&&)> checkpoint;
        /// The same at the end of a run that ends off the schedule.
        std::function<void(CaseMemory&&)> last;
        std::function<void(double t, const Remark&)> remark;
        /// There are other particles, and the case has another model.
        std::function<void()> rezoned;
        std::function<void(double t, const std::string& text)> warning;
    };
    /// To the end, a signal, or a guard; only OutputError is thrown, with record() up to date.
    /// Returns why a guard stopped the run, else nothing.
    std::string drive(const Watchers& watchers);

    /// What going on from here later needs.
    CaseMemory memory();
    /// Before drive(), which then goes on. Precondition: state_of(memory, model) is no error.
    void recall(const CaseMemory& memory);
    /// What the run has cost up to where it is now, before it was gone on with, for each right-hand side.
    void recall_cost(const CostOfRates& before);
    /// When snapshots were taken.
    const std::vector<double>& snapshot_times() const { return snapshot_times_; }

    std::span<const double> y() { return motion_->y(); }
    const Integrator::Statistics& statistics() const { return motion_->statistics(); }
    /// The field that kept the latest step short; empty where none did.
    std::string limiting() const;
    double seconds() const;
    /// Until `t_end`, as fast as since this start.
    double seconds_left(double t_end) const;
    std::vector<Drift> drifts() const { return recorder_.drifts(promise_limit_); }
    /// Complete after drive().
    RunRecord& record() { return record_; }

  private:
    void remember(double t, const Remark& remark);
    void watch(double t, const Watchers& watchers);
    void snapshot(double t, const Watchers& watchers);
    void checkpoint(const Watchers& watchers);
    void rezone(double t, const Watchers& watchers);
    void remember_records(Archive& archive);
    void rewrite_events();
    std::vector<RunStatistics::Limit> limits() const;
    void guard(double t, const Watchers& watchers);
    bool revise(double t);
    void complete();
    std::size_t pair_interactions() { return pairs_before_ + motion_->pair_interactions(); }

    Case<Dim>& one_;
    double promise_limit_;
    RunRecord record_;
    IntegratorOptions options_;
    std::unique_ptr<PartedMotion<Dim>> motion_;
    Recorder<Dim> recorder_;
    DriftGuard guard_;
    std::optional<std::filesystem::path> events_;
    std::chrono::steady_clock::time_point start_;
    double began_ = 0.0;           ///< t of the start or the restart
    double seconds_before_ = 0.0;  ///< a restart
    std::size_t pairs_before_ = 0;
    std::vector<double> snapshot_times_;
    bool resumed_ = false;
};

/// Reads what rows and observers remember, as Run::recall() will. Throws InputError where that is of another case: to
/// be asked before anything is written.
template <int Dim>
void check_records(const Case<Dim>& one, const CaseMemory& memory);

/// The step of a method that keeps an energy of its own: those that advance velocity and position in turn.
inline std::optional<double> symplectic_step(const IntegratorOptions& options) {
    return integration_method(options.method).separable ? options.dt : std::nullopt;
}

/// The change that 'to integrator error' allows. With fixed steps a method keeps its order only where
/// rates are smooth; and where externals drive or damp the motion, steps are chosen for what it comes to,
/// not for the rough start that the balance of energy and work remembers. Rigid walls of a box are none of these:
/// they turn velocities back, which costs no energy.
template <int Dim>
double promise_limit(const IntegratorOptions& options, const Model<Dim>& model) {
    if (options.adaptive()) return std::max(1e-12, 1e3 * std::max(options.rtol, options.atol));
    const auto* const particles = dynamic_cast<const ParticleModel<Dim>*>(&model);
    const bool left_alone =
        particles != nullptr && particles->externals().empty() && !model.box().has_images();
    return model.smooth() && (left_alone || !model.layout().has(Field::work)) ? 1e-6 : 1e-4;
}

}  // namespace spam
