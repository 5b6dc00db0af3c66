// SPDX-License-Identifier: GPL-3.0-or-later
// Ranges within which particles have few neighbours, down to the shortest that problems take: the default step follows,
// so that what is promised is kept.
#include "problem/found.hpp"
#include "support/effort.hpp"

#include <boost/test/unit_test.hpp>

using namespace spam::test;

namespace {

Outcome run_short(const char* program, const char* range, Words more = {}) {
    const Scratch folder;
    more.insert(more.end(), {"--smoke", "--quiet", "--range", range});
    return run_in(folder, program, more);
}

}  // namespace

BOOST_AUTO_TEST_CASE(promises_are_kept_with_few_neighbours) {
    const Words all{"1.1", "1.2", "1.4", "1.7"};
    std::size_t number = 0, done = 0;
    for (const char* program :
         {"plane_wave", "sheared_square", "fragmenting_bar", "drop", "counter_rotating",
          "string_phase", "pierced_bar", "cavitating_drop"})
        for (const std::string& range : all) {
            if (number++ % 3 != 0 && !long_runs()) continue;
            const Outcome outcome = run_short(program, range.c_str());
            BOOST_TEST((outcome.status == 0 || outcome.status == 2),
                       program << " --range " << range << ": " << outcome.err);
            done += outcome.status == 0;
        }
    BOOST_TEST(done > number / 6);
}

/// The step of longer ranges would not do.
BOOST_AUTO_TEST_CASE(the_usual_step_is_too_long_for_them) {
    BOOST_TEST(run_short("plane_wave", "1.2", {"--dt", "0.1"}).status == 1);
}
