// SPDX-License-Identifier: GPL-3.0-or-later
#include "gsl_stepper.hpp"

#include <gsl/gsl_errno.h>

#include <algorithm>
#include <new>
#include <utility>

namespace spam {
namespace {

const gsl_odeiv2_step_type* type_of(const std::string& method) {
    const gsl_odeiv2_step_type* const types[] = {gsl_odeiv2_step_rk2,   gsl_odeiv2_step_rk4,
                                                 gsl_odeiv2_step_rkf45, gsl_odeiv2_step_rkck,
                                                 gsl_odeiv2_step_rk8pd, gsl_odeiv2_step_msadams};
    const std::string name = method.substr(method.find(':') + 1);
    const auto* const found = std::find_if(std::begin(types), std::end(types),
                                           [&](const auto* type) { return name == type->name; });
    return *found;  // the name is known
}

/// GSL's handler aborts; its return values are looked at instead. It is one for the whole process.
void switch_error_handler_off() {
    static const bool done = (gsl_set_error_handler_off(), true);
    static_cast<void>(done);
}

}  // namespace

GslStepper::GslStepper(const std::string& method, const Ode& ode, double rtol,
                       std::size_t& evaluations)
    : ode_(ode),
      evaluations_(evaluations),
      system_{&GslStepper::rates, nullptr, ode.absolute_tolerance.size(), this},
      error_(ode.absolute_tolerance.size()) {
    switch_error_handler_off();
    // D_k = 1 * atol_k + rtol * (1 |y_k| + 0 |h y_dot_k|); the driver's own first step is not used.
    driver_.reset(gsl_odeiv2_driver_alloc_scaled_new(&system_, type_of(method), 1.0, 1.0, rtol, 1.0,
                                                     0.0, ode.absolute_tolerance.data()));
    if (!driver_) throw std::bad_alloc();
}

int GslStepper::rates(double t, const double y[], double y_dot[], void* self) {
    auto& me = *static_cast<GslStepper*>(self);
    ++me.evaluations_;
    try {
        const std::size_t n = me.system_.dimension;
        me.ode_.rates(t, {y, n}, {y_dot, n});
        if (me.ode_.failure().empty()) return GSL_SUCCESS;
        me.failed_at_ = t;
        return GSL_EDOM;
    } catch (...) {
        me.thrown_ = std::current_exception();
        return GSL_EBADFUNC;
    }
}

bool GslStepper::attempt(double t, double h, std::span<double> y, const double* y_dot) {
    const int flag =
        gsl_odeiv2_step_apply(driver_->s, t, h, y.data(), error_.data(), y_dot, nullptr, &system_);
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    double not_finite = 0.0;  // a NaN or an infinity survives in the sum of x - x
    for (const double e : error_) not_finite += e - e;
    for (const double value : y) not_finite += value - value;
    return flag == GSL_SUCCESS && not_finite == 0.0;
}

bool GslStepper::accepts(std::span<const double> y, double& h) {
    // The rates have no weight; any vector of the size will do.
    const int change =
        gsl_odeiv2_control_hadjust(driver_->c, driver_->s, y.data(), error_.data(), y.data(), &h);
    return change != GSL_ODEIV_HADJ_DEC;
}

void GslStepper::reset() { gsl_odeiv2_step_reset(driver_->s); }

}  // namespace spam
