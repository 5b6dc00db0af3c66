// SPDX-License-Identifier: GPL-3.0-or-later
// Tests with random inputs. Each input is made from a seed, which is printed where a test fails. The ordinary
// suite takes the seeds 1, 2, ...; a hunt (spam_hunt() in tests/CMakeLists.txt) new ones, as long as it lasts.
#pragma once

#include <boost/test/results_collector.hpp>
#include <boost/test/unit_test.hpp>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <random>
#include <string>

namespace spam::test {

inline std::string hunt_setting(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// Whether this is a hunt and no test of the ordinary suite.
inline bool hunting() { return !hunt_setting("SPAM_HUNT_MINUTES").empty(); }

/// Calls round(seed) so many times; in a hunt for SPAM_HUNT_MINUTES. SPAM_HUNT_SEED=<seed> in the environment
/// repeats one round. Ends early where more than a few rounds fail.
template <class Round>
void hunt(unsigned rounds, const Round& round) {
    namespace unit = boost::unit_test;
    using Minutes = std::chrono::duration<double, std::ratio<60>>;
    const auto start = std::chrono::steady_clock::now();
    const std::string minutes = hunt_setting("SPAM_HUNT_MINUTES"),
                      only = hunt_setting("SPAM_HUNT_SEED");
    const auto failures = [] {
        return unit::results_collector.results(unit::framework::current_test_case().p_id)
            .p_assertions_failed.get();
    };
    const auto more = [&](unsigned done) {
        if (!only.empty()) return done < 1;
        if (failures() > 9) return false;
        return minutes.empty()
                   ? done < rounds
                   : Minutes(std::chrono::steady_clock::now() - start).count() < std::stod(minutes);
    };
    std::random_device fresh;
    unsigned done = 0;
    for (; more(done); ++done) {
        const unsigned seed = !only.empty() ? static_cast<unsigned>(std::stoul(only))
                              : hunting()   ? fresh()
                                            : done + 1;
        BOOST_TEST_CONTEXT("SPAM_HUNT_SEED=" << seed << " repeats this round") {
            try {
                round(seed);
            } catch (const std::exception& error) {  // which would leave the context unsaid
                BOOST_ERROR(error.what());
            }
        }
    }
    if (hunting()) BOOST_TEST_MESSAGE(done << " rounds");
}

}  // namespace spam::test
