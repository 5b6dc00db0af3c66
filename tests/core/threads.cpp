// SPDX-License-Identifier: GPL-3.0-or-later
// How many threads are started where no number is asked for.
#include <spam/core/threads.hpp>

#include <boost/test/unit_test.hpp>
#include <sched.h>

#include <cstdlib>
#include <thread>

using namespace spam;

BOOST_AUTO_TEST_CASE(as_many_as_are_worth_it) {
    BOOST_TEST(worthwhile_threads(0, 8) == 1);
    BOOST_TEST(worthwhile_threads(3999, 8) == 1);
    BOOST_TEST(worthwhile_threads(4000, 8) == 2);
    BOOST_TEST(worthwhile_threads(16384, 8) == 8);
    BOOST_TEST(worthwhile_threads(16384, 4) == 4);
    BOOST_TEST(worthwhile_threads(1000000, 1) == 1);
}

BOOST_AUTO_TEST_CASE(no_more_than_may_be_used) {
    unsetenv("OMP_NUM_THREADS");
    const int all = usable_cores();
    BOOST_TEST(all >= 1);
    BOOST_TEST(all <= static_cast<int>(std::thread::hardware_concurrency()));
    cpu_set_t before, one;
    BOOST_REQUIRE(sched_getaffinity(0, sizeof before, &before) == 0);
    CPU_ZERO(&one);
    for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
        if (CPU_ISSET(cpu, &before)) CPU_SET(cpu, &one);
    BOOST_REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);
    BOOST_TEST(usable_cores() == 1);
    BOOST_REQUIRE(sched_setaffinity(0, sizeof before, &before) == 0);
    BOOST_TEST(usable_cores() == all);
    setenv("OMP_NUM_THREADS", "1", 1);
    BOOST_TEST(usable_cores() == 1);
    setenv("OMP_NUM_THREADS", "4,2", 1);  // of nested teams: no number
    BOOST_TEST(usable_cores() == all);
    setenv("OMP_NUM_THREADS", "0", 1);
    BOOST_TEST(usable_cores() == 1);
    unsetenv("OMP_NUM_THREADS");
}
