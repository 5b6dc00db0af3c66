// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/integrate/interrupt.hpp>

#include <csignal>

namespace spam {
namespace {

volatile std::sig_atomic_t received_signal = 0;

extern "C" void remember_signal(int signal) {
    received_signal = signal;
    std::signal(signal, SIG_DFL);  // the second one ends the process
}

}  // namespace

InterruptWatch::InterruptWatch() {
    std::signal(SIGINT, remember_signal);
    std::signal(SIGTERM, remember_signal);
    std::signal(SIGPIPE, SIG_IGN);  // whoever reads the output may leave; the run goes on
}

InterruptWatch::~InterruptWatch() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

int InterruptWatch::received() { return received_signal; }

}  // namespace spam
