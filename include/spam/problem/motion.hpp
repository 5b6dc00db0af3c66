// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/integrate/integrator.hpp>
#include <spam/rhs/model.hpp>

#include <functional>
#include <memory>

namespace spam {

/// What integrators see of a model, which must outlive it; `pair_interactions` counts.
template <int Dim>
Ode as_ode(Model<Dim>& model, const IntegratorOptions& options, std::size_t& pair_interactions);

/// A model on its way through time, step by step, for callers that drive it themselves:
///     Motion<2> motion(model, y0, {.method = "rk4", .dt = 0.1});
///     while (motion.t() < 10.0) motion.step(10.0);
/// Runs, studies of integrators and tests are made of it. Events of the model are applied.
template <int Dim>
class Motion {
  public:
    /// From `y0` (as long as model.layout().size()) at `t0`. The model must outlive the motion, and have
    /// one at a time. Throws InputError as make_integrator().
    Motion(Model<Dim>& model, std::span<const double> y0, const IntegratorOptions& options,
           double t0 = 0.0);
    Motion(const Motion&) = delete;  // the integrator refers to it
    Motion& operator=(const Motion&) = delete;

    /// Time reached.
    double t() const { return integrator_->t(); }
    /// The state there, model().layout().size() numbers; valid as long as the motion, changed by every step.
    std::span<const double> y() const { return y_.span(); }
    /// Fields of y by name.
    ConstState<Dim> state() const { return {model_.layout(), y_.span()}; }
    /// The model that moves.
    Model<Dim>& model() { return model_; }

    /// One accepted step, not past `t_stop`; returns the new time. Throws GuardStop with the reason where
    /// there is no way on (integrator.hpp): the motion then stands at the last accepted state.
    double step(double t_stop = 1e100) { return integrator_->step(t_stop); }
    /// Steps until t() is `t`; the last one is shortened where it must be. Throws Interrupted after a signal.
    void advance_to(double t);
    /// Changes y between two steps. `change` returns whether it did: the integrator then begins anew.
    bool edit(const std::function<bool(std::span<double> y)>& change);

    /// Steps, rejected steps and right-hand sides so far.
    const Integrator::Statistics& statistics() const { return integrator_->statistics(); }
    /// Pairs that all right-hand sides so far have summed over.
    std::size_t pair_interactions() const { return pairs_; }
    /// What the integrator sees of the model.
    const Ode& ode() const { return ode_; }
    /// The method itself.
    Integrator& integrator() { return *integrator_; }

    /// What model and integrator know beyond y; reading, they go on from y as the archive's did.
    void remember(Archive& archive);

  private:
    Model<Dim>& model_;
    std::size_t pairs_ = 0;
    SundialsContext context_;
    Vector y_;
    Ode ode_;
    std::unique_ptr<Integrator> integrator_;
};

SPAM_COMPILED(extern template class Motion);

}  // namespace spam
