// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace spam {

/// Leaves the body of a problem once a dry run has said what it would do.
struct DryRunDone {};

}  // namespace spam
