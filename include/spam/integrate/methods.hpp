// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace spam {

/// A method as --integrator names it, and what it can do.
struct IntegrationMethod {
    std::string name;
    /// Global errors with fixed steps fall like dt^order; of a multistep method, the highest order.
    int order;
    bool adaptive, fixed;    ///< chooses its steps by tolerances; takes steps of --dt
    bool separable = false;  ///< only where Ode::inseparable is empty
    bool multistep =
        false;  ///< goes on from earlier steps: no step can be taken again, so no events
};

/// Every method that this build can run, in the order of help texts: our own, ARKODE's explicit
/// tables, CVODE's, GSL's. The one place that knows them all.
const std::vector<IntegrationMethod>& integration_methods();

/// The method of that name (arkode:ARKODE_X is arkode:X). Throws InputError where there is none, with
/// the reason where it is known.
const IntegrationMethod& integration_method(std::string_view name);

/// Names of the step controllers that ARKODE's adaptive methods accept.
const std::vector<std::string>& arkode_controllers();

}  // namespace spam
