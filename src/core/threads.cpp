// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/threads.hpp>

#include <fmt/format.h>

#include <latch>
#include <system_error>
#include <thread>
#include <vector>

namespace spam {
namespace {

/// Why not: as many at once as OpenMP will want. Empty where they could be started.
std::string why_not(int threads) {
    std::latch all_there(1);
    std::vector<std::jthread> trial;
    std::string reason;
    try {
        for (int k = 1; k < threads; ++k) trial.emplace_back([&] { all_there.wait(); });
    } catch (const std::system_error& error) {
        reason = fmt::format("only {} ({})", trial.size() + 1, error.code().message());
    }
    all_there.count_down();
    return reason;
}

}  // namespace

void start_threads(int threads) {
    if (const auto reason = why_not(threads); !reason.empty())
        throw InputError(fmt::format(
            "threads: {} cannot be started, {}; give fewer, or raise the limits on processes and "
            "memory (ulimit -u, -v)",
            threads, reason));
    set_threads(threads);
    const auto n = static_cast<std::size_t>(threads);
    parallel_for(
        n, [](std::size_t) {}, parallel_threshold);  // OpenMP keeps its threads
}

}  // namespace spam
