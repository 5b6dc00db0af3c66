// SPDX-License-Identifier: GPL-3.0-or-later
#include "gsl_fixed.hpp"

#include <utility>

namespace spam {

void GslFixed::advance(double h) {
    N_VScale(1.0, y_.get(), z_.get());
    if (stepper_.attempt(t_, h, z_.span(), std::as_const(y_dot_).span().data())) return;
    if (const std::string reason = ode_.failure(); !reason.empty())
        stop(reason, stepper_.failed_at());
    // A state that is not finite is the guard's to name.
}

}  // namespace spam
