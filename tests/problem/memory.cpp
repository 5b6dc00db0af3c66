// SPDX-License-Identifier: GPL-3.0-or-later
// What a run needs of memory, at its peak and by particle: set-up, steps, snapshots, checkpoint.
// The system counts the pages of a process of its own.
#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>
#include <sys/resource.h>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

/// Bytes resident at the peak of a run that ends well.
[[maybe_unused]] double peak(const Scratch& folder, const std::string& name,
                             const Words& arguments) {
    const auto command = problem(name, arguments);
    std::vector<char*> words;
    for (const auto& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    std::signal(SIGCHLD, SIG_DFL);
    const pid_t child = fork();
    if (child == 0) {
        // What is freed goes back at once: pages that the allocator keeps between what is in use depend on the order
        // of frees, not on what the program needs.
        setenv("MALLOC_MMAP_THRESHOLD_", "131072", 1);
        if (chdir(folder.path().c_str()) != 0 || freopen("/dev/null", "w", stdout) == nullptr)
            _exit(126);
        execv(words.front(), words.data());
        _exit(127);
    }
    int status = -1;
    rusage used{};
    wait4(child, &status, 0, &used);
    BOOST_TEST_REQUIRE(WIFEXITED(status));
    BOOST_TEST_REQUIRE(WEXITSTATUS(status) == 0);
    return 1024.0 * static_cast<double>(used.ru_maxrss);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_particle_of_a_solid_needs_no_more_than_1100_bytes) {
#if SPAM_SANITIZED
    return;  // sanitizers need several times as much
#else
    const Words few{"--size", "3"}, many{"--size", "100"};
    constexpr double particles = 30'301.0 - 37.0;
    for (const Words& scheme : {Words{"--transport", "plain"}, Words{"--transport", "monaghan"},
                                Words{"--formulation", "total_lagrangian"}})
        BOOST_TEST_CONTEXT(scheme.back()) {
            const Scratch folder;
            const auto run_of = [&](Words words, const char* out) {
                words.insert(words.end(), scheme.begin(), scheme.end());
                words.insert(words.end(), {"--t-end", "0.2", "--no-plots", "--out", out});
                return peak(folder, "rotating_hexagon", words);
            };
            const double nothing = run_of(few, "few");
            const double whole = (run_of(many, "many") - nothing) / particles;
            BOOST_TEST_MESSAGE(whole << " bytes a particle");
            BOOST_TEST(whole < 1100.0);  // the search of lists takes 50 to 100 of them
            BOOST_TEST(whole > 500.0, "y, four rates and what is between them are 430 alone");
        }
#endif
}

/// Within seconds of processor time, whatever the size: no row is measured, no vector made for stages.
BOOST_AUTO_TEST_CASE(a_dry_run_computes_nothing) {
    for (const Words& words :
         {Words{"free_expansion", "--cells", "400"},
          Words{"rotating_hexagon", "--size", "300", "--transport", "plain"},
          Words{"drop", "--cells", "400"}, Words{"sheared_square", "--cells", "400"},
          Words{"string_phase", "--particles", "100000"},
          Words{"relaxation", "--particles", "100000"},
          Words{"diffusion_waves", "--cells", "400"}}) {
        Words arguments(words.begin() + 1, words.end());
        arguments.emplace_back("--dry-run");
        Launch launch;
        launch.before_exec = [] {
            constexpr rlim_t most = SPAM_SANITIZED ? 100 : 10;
            const rlimit seconds{most, most};
            setrlimit(RLIMIT_CPU, &seconds);
        };
        const Outcome outcome = run(problem(words.front(), arguments), launch);
        BOOST_TEST(outcome.status == 0, words.front() << ": " << outcome.signal << outcome.err);
    }
}
