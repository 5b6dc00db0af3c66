// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../problem/recorder.hpp"
#include "held_model.hpp"
#include "process.hpp"
#include "rezoning.hpp"
#include <spam/integrate/driver.hpp>
#include <spam/problem/parted_motion.hpp>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace spam::python {

/// What a run is asked for. Functions of Python without arguments; None where there is none.
struct RunRequest {
    double t_end, every, snapshot_every;
    std::vector<std::pair<std::string, py::function>> columns;
    py::object on_row, on_snapshot, revise, enough;
    std::optional<RezoningChoice> rezone{};
};

inline std::atomic<const void*> latest_on_its_way =
    nullptr;  ///< of all Simulations, of whatever dimension

/// A model on its way, as Python drives it. The interpreter is free while it computes.
template <int Dim>
class Simulation {
  public:
    Simulation(std::shared_ptr<HeldModel<Dim>> model, const py::object& y0,
               const IntegratorOptions& options, double t0, int threads);

    double t() const { return now_->motion.t(); }
    /// The N_Vector itself; where processes share the particles, a copy of all of them that every process has.
    std::span<const double> y() const {
        refuse_earlier();
        return now_->motion.y();
    }
    /// Numbers in y of the particles that this process computes, ascending.
    std::vector<std::uint32_t> own() const;
    /// Of the present particles: another one than at first, where some were split or merged.
    const std::shared_ptr<HeldModel<Dim>>& held() const { return now_->held; }
    /// Keeps what y() is part of.
    std::shared_ptr<const void> keeper() const { return now_; }

    /// One accepted step, not past t_stop. Throws GuardStop, or what a function of Python has raised.
    double step(double t_stop);
    /// Rows until t_end. Whatever ends it, rows() are those so far, and y is the last accepted state.
    void run(const RunRequest& request);
    /// Fields that take the place of those in y; the integrator then begins anew.
    void replace(const py::dict& fields);

    py::object rows() const;   ///< (names, (rows, columns)); None before the first run
    py::list drifts() const;   ///< (name, promise, scale, limit, change, kept)
    py::list remarks() const;  ///< (t, what, value)
    py::dict statistics() const;

  private:
    /// What must hold before anything is computed.
    class Turn;
    /// f(), with the other processes, where the interpreter is free. Where it ends by an exception they hear of it.
    void together(const std::function<void()>& f);
    /// Where processes share particles: once another Simulation has been made, which of them each computes is its own.
    void refuse_earlier() const;
    void look_after(double t, class Signals& signals);
    void watch(double t);
    Observers observers(const RunRequest& request, Signals& signals);
    void prepare(const RezoningChoice& choice);
    void rezone(double t, Turn& turn);

    /// A model and its motion.
    struct OnItsWay {
        OnItsWay(std::shared_ptr<HeldModel<Dim>> model, std::span<const double> y0,
                 const IntegratorOptions& options, double t0)
            : held(std::move(model)),
              motion(*held->model, y0, options, processes(), t0) {
            latest_on_its_way = this;
        }

        std::shared_ptr<HeldModel<Dim>> held;
        PartedMotion<Dim> motion;
    };

    IntegratorOptions options_;
    int threads_;
    std::shared_ptr<OnItsWay> now_;
    std::shared_ptr<HeldModel<Dim>> made_;  ///< of the particles of the latest change
    std::shared_ptr<RezoningMemory> rezoned_ = std::make_shared<RezoningMemory>();
    std::size_t pairs_before_ = 0;  ///< of motions that are no more
    Plan<Dim> plan_;
    std::unique_ptr<Recorder<Dim>> recorder_;
    std::vector<std::pair<double, Remark>> remarks_;
};

/// From the keywords that all of them share. Throws InputError.
IntegratorOptions options_of(const std::string& method, const py::dict& options);

}  // namespace spam::python
