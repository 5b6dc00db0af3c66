// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/integrate/interrupt.hpp>

#include <csignal>

namespace spam {
namespace {

constexpr int watched[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t received_signal = 0;

extern "C" void remember_signal(int signal) {
    received_signal = signal;
    std::signal(signal, SIG_DFL);  // the second one ends the process
}

}  // namespace

InterruptWatch::InterruptWatch() {
    for (const int signal : watched)
        if (std::signal(signal, remember_signal) == SIG_IGN)
            std::signal(signal, SIG_IGN);  // nohup and background jobs mean it
    std::signal(SIGPIPE, SIG_IGN);         // whoever reads the output may leave; the run goes on
    std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit is a failed write, reported as such
}

InterruptWatch::~InterruptWatch() {
    for (const int signal : watched) std::signal(signal, SIG_DFL);
}

int InterruptWatch::received() { return received_signal; }

}  // namespace spam
