// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "event_watch.hpp"
#include "fixed_grid.hpp"

#include <exception>

namespace spam {

/// An explicit Runge-Kutta method of ARKODE, adaptive or with a fixed step.
class Arkode final : public Integrator {
  public:
    Arkode(const IntegratorOptions& options, const Ode& ode, Vector& y, double t0,
           const SundialsContext& context);
    ~Arkode() override;
    double step(double t_stop) override;
    bool lands_on_stops() const override { return !dt_; }
    void reset(double t) override;
    void remember(Archive& archive) override;

  private:
    struct Calls;  // the ERKStep and ARKStep flavours of one ARKODE call

    void check(int flag, const char* call) const;
    [[noreturn]] void stop(int flag) const;
    double evolve(double t_stop);
    std::span<const double> retake(double h);
    void take_piece(double h, double t_next);
    void restart(double h);
    static int rates(double t, N_Vector y, N_Vector y_dot, void* self);
    static void remember_message(int code, const char* module, const char* function, char* message,
                                 void* self);

    void create();

    IntegratorOptions options_;
    const SundialsContext& context_;
    std::optional<double> dt_;
    FixedGrid grid_;                   ///< used where dt_ is set
    std::size_t rejected_before_ = 0;  ///< by the memory in use before
    bool retaking_ = false;            ///< ARKODE has the length of a step taken again
    Vector accepted_;  ///< y of the last accepted step: an ARKODE failure may leave y overwritten
    EventWatch watch_;
    const Calls* calls_ = nullptr;
    void* memory_ = nullptr;
    std::string message_;
    std::string spoiled_;  ///< the first rate of this step that was not finite
    std::exception_ptr error_;
};

}  // namespace spam
