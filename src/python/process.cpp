// SPDX-License-Identifier: GPL-3.0-or-later
#include "process.hpp"

#include "bindings.hpp"
#include <spam/core/error.hpp>
#include <spam/core/instruction_set.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/threads.hpp>
#include <spam/processes/processes.hpp>

#include <fmt/format.h>
#include <omp.h>
#include <pthread.h>

#include <atomic>
#include <memory>
#include <stdexcept>

namespace py = pybind11;

namespace spam::python {
namespace {

// Loops of fewer particles than a block of 512 are never parallel (core/parallel.hpp).
constexpr std::size_t never_parallel = 256;

std::atomic<bool> has_threads{false};  ///< of OpenMP, in this process or the one it was forked from
std::atomic<bool> lost_threads{false};  ///< they stayed in the parent

std::unique_ptr<Parts> joined;

/// Others may be at an exchange that this script never comes to: they end there.
void leave_processes() {
    if (!joined) return;
    const py::gil_scoped_release others;
    joined->leave("the script of another process has come to its end");
    joined.reset();
}

void note_fork() {
    if (has_threads) lost_threads = true;
}

}  // namespace

void enter(std::size_t particles, int threads) {
    if (lost_threads && particles > never_parallel)
        throw std::runtime_error(
            "this process was forked after a parallel run, whose threads stayed behind; start it by "
            "multiprocessing.get_context('spawn'), or fork before the first run");
    const int used = threads > 0 ? set_threads(threads) : omp_get_max_threads();
    if (used > 1 && particles > never_parallel) has_threads = true;
}

Parts& processes() {
    if (!joined && started_with_others()) {
        joined = join_processes();
        py::module_::import("atexit").attr("register")(py::cpp_function(&leave_processes));
    }
    return joined ? *joined : Parts::alone_here();
}

int checked_threads(int threads) {
    if (threads < 0 || threads > 4096)
        throw InputError(
            fmt::format("threads: {} is not allowed; use 1 to 4096, or 0 for as many as there "
                        "are cores",
                        threads));
    return threads;
}

void Signals::ask() {
    const py::gil_scoped_acquire interpreter;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void bind_process(py::module_& module) {
    pthread_atfork(nullptr, nullptr, &note_fork);
    module.def("usable_cores", &usable_cores, "Cores that this process may use.");
    module.def(
        "rank", [] { return processes().own(); },
        "Which of the processes this one is, from 0 on, where mpirun has started several: they share the particles of\n"
        "every Simulation, and all of them must make the same calls. 0 where there is one.");
    module.def(
        "ranks", [] { return processes().count(); }, "How many processes there are.");
}

}  // namespace spam::python
