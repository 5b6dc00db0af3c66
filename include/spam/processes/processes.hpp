// SPDX-License-Identifier: GPL-3.0-or-later
// A run on several processes: what starts them, and their exchanges. MPI is known to src/processes/mpi alone.
#pragma once

#include <spam/core/parts.hpp>

#include <memory>
#include <string>

namespace spam {

/// Why this build runs on one process alone, and what to do; empty where it has MPI.
std::string why_one_process();

/// Whether mpirun, or what serves for it, has started this process as one of several.
bool started_with_others();

/// Joins the others, once in a program: Parts whose exchanges are messages. They part for good with its end, which all
/// must come to. Throws InputError where this build has no MPI. Precondition: started_with_others().
std::unique_ptr<Parts> join_processes();

/// The number that `--ranks` of a command line says; 1 where there is none or it is no number (the options say so).
std::size_t ranks_asked_for(int argc, const char* const* argv);

/// Starts this program with its arguments `count` times, by mpirun, and waits for it: the exit status of the first
/// (report_status). INT, TERM and HUP are passed on: mpirun hands on USR1 and USR2 in time, and would end all processes
/// at any other. Throws InputError where there is no mpirun.
int start_processes(std::size_t count, char** argv);

/// The exit status of a run on several processes, as start_processes() is to return it. Returns what this process is to
/// end with: 0 where that waits for it.
int report_status(int status);

}  // namespace spam
