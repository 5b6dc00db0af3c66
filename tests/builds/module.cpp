// SPDX-License-Identifier: GPL-3.0-or-later
// A module as an interpreter loads it: a shared object that holds all of libspam and runs a little of it.
#include "support/small_hexagons.hpp"
#include <spam/integrate/driver.hpp>

/// Largest change of any entry of y in one time unit; every layer from lists to ARKODE is in it.
extern "C" double spam_module_run() {
    using namespace spam;
    const auto system = test::smooth_hexagon(1, 0.3);
    const SundialsContext context;
    Vector y = test::start_of(*system, context);
    const std::vector<double> start(y.span().begin(), y.span().end());
    IntegratorOptions options;
    options.method = "arkode:DORMAND_PRINCE_7_4_5";
    const auto integrator = make_integrator(options, system->ode, y, 0.0, context);
    drive(*integrator, {1.0, 1.0, 1.0}, {});
    return test::largest_difference(start, {y.span().begin(), y.span().end()});
}
