// SPDX-License-Identifier: GPL-3.0-or-later
// In place of src/processes/mpi where there is no MPI.
#include <spam/core/error.hpp>
#include <spam/processes/processes.hpp>

namespace spam {

std::string why_one_process() {
    return "this build has no MPI; install it (Debian: libopenmpi-dev, openmpi-bin) and build "
           "again, or run on one process";
}

/// Where mpirun has started several all the same, each of them would do the whole.
std::unique_ptr<Parts> join_processes() { throw InputError("ranks: " + why_one_process()); }

}  // namespace spam
