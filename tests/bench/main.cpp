// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/instruction_set.hpp>
#include <spam/core/parallel.hpp>

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

/// Google Benchmark's main, on one thread unless OMP_NUM_THREADS says otherwise. Ten million
/// particles only where they are asked for.
int main(int argc, char** argv) {
    try {
        benchmark::AddCustomContext("instruction set",
                                    std::string(spam::to_string(spam::instruction_set())));
    } catch (const spam::InputError& error) {
        std::fprintf(stderr, "spam_bench: %s\n", error.what());
        return 2;
    }
    if (std::getenv("OMP_NUM_THREADS") == nullptr) spam::set_threads(1);
    std::vector<char*> arguments(argv, argv + argc);
    static char but_the_huge[] = "--benchmark_filter=-10000000";
    bool filtered = false;
    for (int k = 1; k < argc; ++k)
        filtered = filtered || std::strncmp(argv[k], "--benchmark_filter", 18) == 0;
    if (!filtered) arguments.push_back(but_the_huge);
    auto count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
