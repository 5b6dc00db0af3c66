// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>

namespace spam {

/// Holds a folder for this process, so that no two runs write into it. The system lets go of it when
/// the process ends, however it ends: nothing is left on the disk. The lock is on the folder itself and
/// moves with it when it is renamed. Copies share the lock; the last one releases it.
class FolderLock {
  public:
    /// Throws InputError ("out: a run is still at work in ...") where another process holds it and does not
    /// let go of it within `patience`. File systems that cannot lock a folder (some network ones) are
    /// taken as free.
    explicit FolderLock(const std::filesystem::path& folder,
                        std::chrono::milliseconds patience = {});

    /// For all copies; is_of() goes on to tell this folder from others.
    void release() const;

    /// Whether `folder` still names the folder that is locked; another process may have moved it
    /// between finding and locking it.
    bool is_of(const std::filesystem::path& folder) const;

  private:
    struct Held;
    std::shared_ptr<const Held> held_;
};

}  // namespace spam
