// SPDX-License-Identifier: GPL-3.0-or-later
// In place of src/processes/mpi where there is no MPI.
#include <spam/processes/processes.hpp>

namespace spam {

std::string why_one_process() {
    return "this build has no MPI; install it (Debian: libopenmpi-dev, openmpi-bin) and build again, or leave --ranks "
           "out";
}

bool started_with_others() { return false; }

std::unique_ptr<Parts> join_processes() { return nullptr; }

}  // namespace spam
