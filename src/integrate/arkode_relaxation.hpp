// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/integrate/integrator.hpp>

namespace spam {

/// Throws InputError where the method cannot rescale its steps: it is not ARKODE's, SUNDIALS is too old,
/// steps are fixed, the order is 1, or a weight of the table is negative.
/// Precondition: options.method is the name of a method.
void require_relaxation(const IntegratorOptions& options);

/// The same for an ode without energy.
void require_energy(const Ode& ode);

/// Whether this ARKODE flag says that no rescaled step could be found.
bool is_failed_relaxation(int flag);

}  // namespace spam
