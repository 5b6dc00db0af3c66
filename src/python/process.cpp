// SPDX-License-Identifier: GPL-3.0-or-later
#include "process.hpp"

#include "bindings.hpp"
#include <spam/core/error.hpp>
#include <spam/core/instruction_set.hpp>
#include <spam/core/threads.hpp>
#include <spam/processes/processes.hpp>

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

namespace py = pybind11;

namespace spam::python {
namespace {

std::unique_ptr<Parts> joined;

/// Others may be at an exchange that this script never comes to: they end there.
void leave_processes() {
    if (!joined) return;
    const py::gil_scoped_release others;
    joined->leave("the script of another process has come to its end");
    joined.reset();
}

}  // namespace

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
    module.def("usable_cores", &usable_cores, "Cores that this process may use.");
    module.def(
        "rank", [] { return processes().own(); },
        "Which of the processes this one is, from 0 on, where mpirun has started several: they share the particles of\n"
        "every Simulation, and all of them must make the same calls. 0 where there is one.");
    module.def(
        "ranks", [] { return processes().count(); }, "How many processes there are.");
}

}  // namespace spam::python
