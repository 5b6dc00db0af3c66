// SPDX-License-Identifier: GPL-3.0-or-later
// Loops that threads share: every index once, whichever thread comes to it; exceptions, loops within loops, loops
// of several threads at once, and a child of fork(), where no thread but one is left.
#include <spam/core/parallel.hpp>

#include <boost/test/unit_test.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace spam;

namespace {

/// Whether each index of [0, n) is met once.
bool each_once(std::size_t n) {
    std::vector<int> met(n, 0);
    parallel_for(
        n, [&](std::size_t i) { ++met[i]; }, parallel_threshold);
    return std::all_of(met.begin(), met.end(), [](int times) { return times == 1; });
}

constexpr std::size_t some = 20000;

}  // namespace

BOOST_AUTO_TEST_CASE(every_index_is_met_once) {
    for (const int threads : {1, 2, 3, 7, 16, 5, 2}) {
        BOOST_TEST(set_threads(threads) == threads);
        for (const std::size_t n : {0U, 1U, 2U, 3U, 8U, 13U, 100U, 4097U, 20000U})
            for (int again = 0; again < 50; ++again)
                BOOST_REQUIRE_MESSAGE(each_once(n), n << " on " << threads << " threads");
    }
    BOOST_TEST(set_threads(0) == 2);
}

// Also where it has been asked for the number since.
BOOST_AUTO_TEST_CASE(one_thread_is_the_one_that_calls) {
    set_threads(3);
    BOOST_TEST(each_once(some));
    set_threads(1);
    BOOST_TEST(set_threads(0) == 1);
    const auto caller = std::this_thread::get_id();
    std::atomic<int> elsewhere = 0;
    parallel_for(some, [&](std::size_t) { elsewhere += std::this_thread::get_id() != caller; });
    BOOST_TEST(elsewhere == 0);
}

BOOST_AUTO_TEST_CASE(ranges_and_counts) {
    set_threads(3);
    std::mutex one;
    std::set<std::pair<std::size_t, std::size_t>> ranges;
    parallel_ranges(some, [&](std::size_t first, std::size_t last) {
        const std::lock_guard lock(one);
        ranges.insert({first, last});
    });
    std::size_t at = 0;
    for (const auto& [first, last] : ranges) {
        BOOST_TEST(first == at);
        BOOST_TEST(last > first);
        at = last;
    }
    BOOST_TEST(at == some);
    BOOST_TEST(ranges.size() > 3U);
    BOOST_TEST(parallel_count(some, [](std::size_t i) { return i % 3; }) ==
               3U * (some / 3) + (some % 3 == 2 ? 1U : 0U));
}

// No more than a range each waits for a thread that another program keeps from its core.
BOOST_AUTO_TEST_CASE(threads_that_are_late_are_helped) {
    set_threads(2);
    const auto caller = std::this_thread::get_id();
    std::atomic<int> of_caller = 0, of_other = 0;
    parallel_ranges(some, [&](std::size_t, std::size_t) {
        const bool other = std::this_thread::get_id() != caller;
        ++(other ? of_other : of_caller);
        std::this_thread::sleep_for(std::chrono::milliseconds(other ? 300 : 10));
    });
    BOOST_TEST(of_caller + of_other == 8);
    BOOST_TEST(of_caller > 4);
}

BOOST_AUTO_TEST_CASE(the_first_exception_is_thrown_again) {
    for (const int threads : {1, 4}) {
        set_threads(threads);
        for (const std::size_t wrong : {std::size_t{0}, some / 2, some - 1})
            BOOST_CHECK_THROW(parallel_for(some,
                                           [=](std::size_t i) {
                                               if (i == wrong) throw std::runtime_error("no");
                                           }),
                              std::runtime_error);
        BOOST_TEST(each_once(some));
    }
}

BOOST_AUTO_TEST_CASE(loops_within_loops_and_of_several_threads) {
    set_threads(3);
    std::atomic<int> wrong = 0;
    parallel_for(
        12, [&](std::size_t) { wrong += each_once(some) ? 0 : 1; }, parallel_threshold);
    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k)
        threads.emplace_back([&] {
            set_threads(3);
            for (int again = 0; again < 20; ++again) wrong += each_once(some) ? 0 : 1;
        });
    for (auto& thread : threads) thread.join();
    BOOST_TEST(wrong == 0);
}

BOOST_AUTO_TEST_CASE(a_child_of_fork_has_threads_of_its_own) {
    set_threads(3);
    BOOST_TEST(each_once(some));
    const pid_t child = fork();
    if (child == 0) _exit(each_once(some) && each_once(some) ? 0 : 1);
    int status = -1;
    BOOST_TEST(waitpid(child, &status, 0) == child);
    BOOST_TEST(status == 0);
    BOOST_TEST(each_once(some));
}
