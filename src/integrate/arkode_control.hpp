// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sundials/sundials_context.h>

#include <memory>
#include <string>

namespace spam {

/// Rejections in a row after which an adaptive method gives up, if the least step was not reached before.
constexpr int most_rejections = 20;

/// Why it did, and `limited` by what.
std::string rejected_too_often(double h, double min_step, const std::string& limited);

/// Keeps a controller alive where ARKODE does not.
using KeptController = std::shared_ptr<void>;

// Sets the controller of that name (arkode_controllers(); empty: pid) and returns ARKODE's flag.
// From SUNDIALS 7 on the first, before it one of the others.
int set_arkode_controller(void* memory, const std::string& name, SUNContext, KeptController&);
int set_erkstep_controller(void* memory, const std::string& name, SUNContext, KeptController&);
int set_arkstep_controller(void* memory, const std::string& name, SUNContext, KeptController&);

}  // namespace spam
