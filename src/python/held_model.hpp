// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "choices.hpp"
#include <spam/rhs/particle_model.hpp>

#include <atomic>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

namespace spam::python {

/// A model as Python holds it: the library's own, and what a state of it starts from. Particles come and go in
/// the order in which they were given; inside they lie in that of the library, `id` says which is which.
template <int Dim>
class HeldModel {
  public:
    /// Makes y from velocities (Dim x N, in the order of the library) and a temperature.
    using Start =
        std::function<std::vector<double>(const Points<Dim>& velocity, double temperature)>;

    HeldModel(std::shared_ptr<ParticleModel<Dim>> its_model, Start start, SharedPending its_pending)
        : model(std::move(its_model)),
          pending(std::move(its_pending)),
          start_(std::move(start)) {}

    const std::shared_ptr<ParticleModel<Dim>> model;
    const SharedPending pending;
    /// Makes the same of other particles; empty where it cannot be.
    std::function<std::shared_ptr<HeldModel>(Particles<Dim> particles)> again{};
    const void* moved_by = nullptr;  ///< the latest Simulation: one model has one motion at a time

    std::size_t size() const { return model->particles().size(); }

    /// y at the start; velocities (N, D) in the order given by the user, or None: at rest.
    std::vector<double> start(const py::object& velocity, double temperature);
    /// Its particles were made of others in a run: there is no start, and scales are those of the model before.
    void made_in_a_run() { made_in_a_run_ = scaled_ = true; }
    /// y that the user gives. Scales for tolerances are those of start(), where it has been called.
    std::vector<double> checked(const py::object& y0);

    /// While one is alive no other thread computes with the model: a right-hand side has one memory.
    class Use {
      public:
        explicit Use(HeldModel& held);
        ~Use() {
            if (!nested_) held_.busy_ = false;
        }
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;
        /// Whether it is inside a Break.
        bool nested() const { return nested_; }

      private:
        HeldModel& held_;
        bool nested_;
    };
    /// Leave for the same thread in between: for functions of Python that a run calls between steps.
    class Break {
      public:
        explicit Break(HeldModel& held) : held_(held) {
            held_.paused_in_ = std::this_thread::get_id();
        }
        ~Break() { held_.paused_in_ = std::thread::id(); }
        Break(const Break&) = delete;
        Break& operator=(const Break&) = delete;

      private:
        HeldModel& held_;
    };

    /// dy/dt (t, y), an array of its own.
    Doubles rates(double t, const py::object& y);

  private:
    Start start_;
    bool scaled_ = false, made_in_a_run_ = false;
    std::atomic<bool> busy_{false};
    std::atomic<std::thread::id> paused_in_{};
};

}  // namespace spam::python
