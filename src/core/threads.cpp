// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/text.hpp>
#include <spam/core/threads.hpp>

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace spam {
namespace {

/// Processors of which no two are threads of one core. Where nothing is said of cores, every processor is
/// one.
int cores_of_affinity() {
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0)
        return static_cast<int>(std::thread::hardware_concurrency());
    std::set<std::string> cores;
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
        if (!CPU_ISSET(cpu, &allowed)) continue;
        std::ifstream in(
            fmt::format("/sys/devices/system/cpu/cpu{}/topology/thread_siblings_list", cpu));
        std::string siblings;
        if (!std::getline(in, siblings)) siblings = fmt::format("{}", cpu);
        cores.insert(siblings);
    }
    return static_cast<int>(cores.size());
}

/// "200000 100000": microseconds of processor time in each period; "max" for no quota.
double quota() {
    std::ifstream in("/sys/fs/cgroup/cpu.max");
    double time = 0.0, period = 0.0;
    return in >> time >> period && time > 0.0 && period > 0.0 ? time / period : 1e9;
}

}  // namespace

int usable_cores() {
    int cores = static_cast<int>(std::min<double>(cores_of_affinity(), std::floor(quota())));
    if (const char* wanted = std::getenv("OMP_NUM_THREADS"))
        if (const auto threads = whole_number_in(wanted)) cores = std::min(cores, *threads);
    return std::max(1, cores);
}

int worthwhile_threads(std::size_t particles, int cores) {
    constexpr std::size_t worth_a_thread = 2000;
    return static_cast<int>(std::clamp<std::size_t>(particles / worth_a_thread, 1,
                                                    static_cast<std::size_t>(std::max(1, cores))));
}

}  // namespace spam
