// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/parts.hpp>
#include <spam/integrate/driver.hpp>
#include <spam/io/results.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/particle_model.hpp>

#include <memory>
#include <vector>

namespace spam {

/// Observers that are called between steps with the state of the whole run, without communication.
Observers of_the_whole(Observers observers);

/// A Motion whose particles may be parted among processes, with the bits of one that is not.
///
///     every process:  model of the whole run, which rows, snapshots and checkpoints look at, and y of it
///                     part of the model, moved by a Motion of its own      <- numbers of its particles
///     y()             gathers the parts' y for all processes               <- at rows, snapshots, checkpoints
///
/// Every process then finds the same rows, and makes the same decisions, without further communication. Particles are
/// redistributed where the whole y is gathered in any case and the integrator starts anew, or has no memory: at
/// checkpoints, with fixed steps at rows as well.
template <int Dim>
class PartedMotion {
  public:
    /// `processes` is here() where there are several (whose whole model `model` is) or one that is alone. Throws
    /// InputError where laws or methods cannot be parted. Of one that is alone nothing is kept: the motion may go on in
    /// another thread.
    PartedMotion(Model<Dim>& model, std::span<const double> y0, const IntegratorOptions& options,
                 Parts& processes, double t0 = 0.0);

    /// What the constructor refuses, before anything is written.
    static void refuse(const Model<Dim>& model, const IntegratorOptions& options, Parts& processes);

    double t() const { return motion_->t(); }
    /// Of the whole; all processes must ask for it together. It stays in its place as long as the motion.
    std::span<const double> y();
    bool edit(const std::function<bool(std::span<double> y)>& change);
    const Integrator::Statistics& statistics() const { return motion_->statistics(); }
    /// Of all processes, which must ask for it together.
    std::size_t pair_interactions();
    const Ode& ode() const { return motion_->ode(); }
    /// It may be another one after y() and remember().
    Integrator& integrator() {
        if (looked_at_) tell_part();
        return motion_->integrator();
    }
    /// Model::watch() of the state reached.
    std::vector<Remark> watch();
    /// As Motion::remember(); the memory of the whole, whatever the parts.
    void remember(Archive& archive);

    Parts& processes() const { return alone_ ? Parts::alone_here() : processes_; }
    /// By the memory of its integrator.
    void go_on_from(PartedMotion& before);
    /// Since the motion was made; all processes must ask for it together.
    RunStatistics::Ranks exchanges() const;
    /// How particles are shared out: the most images at a row of a run with fixed steps, periodic ones of a part's own
    /// among them, by the number of particles; pairs that the busiest process has summed over, by their mean; particles
    /// that go to another process at a new partition, as a part of all. All processes must ask for it together.
    struct Sharing {
        double images = 0.0, load = 1.0, moved = 0.0;
    };
    Sharing sharing() const;

  private:
    struct State {
        double t;
        std::size_t steps;
        bool operator==(const State&) const = default;
    };
    bool alone() const { return alone_; }
    State now() const { return {t(), statistics().steps}; }
    void part(double t);
    void part_anew();
    std::vector<double> own_y() const;
    void tell_whole();
    void tell_part();
    bool mixed();
    void count_moved(const std::vector<std::vector<std::uint32_t>>& parts);

    Model<Dim>& whole_;
    IntegratorOptions options_;
    Parts& processes_;
    bool alone_;
    std::unique_ptr<ParticleModel<Dim>> part_;  ///< null where there is one process
    std::unique_ptr<Motion<Dim>> motion_;
    std::vector<double> y_;                ///< of the whole
    std::vector<std::byte> known_memory_;  ///< what it and the part have remembered alike
    // Whether either may remember more than that: observers were shown the whole, or the part was watched.
    bool looked_at_ = false, watched_ = false;
    State known_{};  ///< where y_ is known
    Parts::Traffic before_;
    std::size_t images_ = 0, pairs_before_ = 0, most_images_ = 0;
    bool events_ = false;                     ///< the model has some
    std::vector<std::size_t> owner_{};        ///< of every particle
    std::size_t partitions_ = 0, moved_ = 0;  ///< behind the first one
};

}  // namespace spam
