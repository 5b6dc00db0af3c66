// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parts.hpp>
#include <spam/integrate/interrupt.hpp>
#include <spam/processes/processes.hpp>

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <string>

namespace spam {
namespace {

constexpr std::array watched{SIGINT, SIGTERM, SIGHUP};
/// What stands for INT and TERM in processes that mpirun has started (processes/processes.hpp).
constexpr std::array handed_on{SIGUSR1, SIGUSR2};

// Handlers may use them, and so may the threads of a study, which begin results all at once.
std::atomic<int> received_signal = 0, results_begun = 0, delayed = 0, at_once = 0;
std::atomic<std::int64_t> received_at = 0;  // ns; 0: not since there is this watch
static_assert(std::atomic<int>::is_always_lock_free &&
              std::atomic<std::int64_t>::is_always_lock_free);

/// Signals to a process and to its group come together: they are one.
constexpr std::int64_t together = 500'000'000;

/// Of a clock that a handler may read.
std::int64_t nanoseconds() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

/// What the handler says, one line a signal, composed beforehand: a handler may not format.
using Lines = std::array<std::string, watched.size()>;
Lines without_results, with_results;

[[noreturn]] void end_process(int signal) {
    const Lines& lines = results_begun == 0 ? without_results : with_results;
    for (std::size_t k = 0; k < watched.size(); ++k)
        if (watched[k] == signal && write(STDERR_FILENO, lines[k].data(), lines[k].size()) < 0)
            break;  // no reader is left to tell
    _exit(128 + signal);
}

extern "C" void on_signal(int signal) {
    for (std::size_t k = 0; k < handed_on.size(); ++k)
        if (signal == handed_on[k]) signal = watched[k];
    if ((results_begun == 0 && delayed == 0) || at_once != 0) end_process(signal);
    received_signal = signal;
    const std::int64_t now = nanoseconds();
    if (received_at == 0)
        received_at = now;
    else if (results_begun != 0 && now - received_at > together) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);  // comes when this returns
    }
}

}  // namespace

InterruptWatch::InterruptWatch(const std::string& program) {
    results_begun = 0;
    received_signal = 0;
    received_at = 0;
    for (std::size_t k = 0; k < watched.size(); ++k) {
        const std::string said = fmt::format("{}: interrupted by signal {}; ", program, watched[k]);
        without_results[k] = said + "there are no results yet\n";
        with_results[k] = said + "the results so far are complete\n";
        if (std::signal(watched[k], on_signal) == SIG_IGN)
            std::signal(watched[k], SIG_IGN);  // nohup and background jobs mean it
    }
    if (started_with_others())
        for (const int signal : handed_on) std::signal(signal, on_signal);
    std::signal(SIGPIPE, SIG_IGN);  // the reader of the output may leave; the run goes on
    std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit is a failed write, reported as such
}

InterruptWatch::~InterruptWatch() {
    for (const int signal : watched) std::signal(signal, SIG_DFL);
}

InterruptWatch::Delay::Delay() { delayed = 1; }

InterruptWatch::Delay::~Delay() {
    delayed = 0;
    if (received_signal != 0 && results_begun == 0) end_process(received_signal);
}

InterruptWatch::AtOnce::AtOnce() {
    at_once = 1;
    if (received_signal != 0) end_process(received_signal);
}

InterruptWatch::AtOnce::~AtOnce() { at_once = 0; }

void InterruptWatch::complete_results() { results_begun = 1; }

int InterruptWatch::received() { return received_signal; }

void InterruptWatch::check() {
    if (received_signal != 0 && Parts::here().alone()) throw Interrupted();
}

int InterruptWatch::told() {
    Parts& parts = Parts::here();
    if (parts.alone()) return received_signal;
    parts.tell(static_cast<unsigned char>(received_signal));
    return parts.told();
}

int InterruptWatch::agreed() {
    if (Parts::here().alone()) return received_signal;
    const int all = static_cast<int>(Parts::here().most(static_cast<double>(received_signal)));
    if (all != 0) received_signal = all;  // or one that came meanwhile would be lost
    return all;
}

}  // namespace spam
