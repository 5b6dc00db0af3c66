// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tube.hpp"

namespace shock_tube {

/// All five tests by both forms of the work in four sizes: comparison.csv, and errors against sizes.
void compare(Session& session, const Parameters& p);

}  // namespace shock_tube
