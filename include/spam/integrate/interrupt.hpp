// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace spam {

/// While alive, SIGINT, SIGTERM and SIGHUP are remembered instead of ending the process, so that a run can
/// complete its results; a second signal ends it at once.
class InterruptWatch {
  public:
    InterruptWatch();
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    /// The signal received, 0 if none.
    static int received();
};

}  // namespace spam
