// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>

namespace spam::test {

/// Options that a problem must refuse, and what it must say of them.
struct Refused {
    std::vector<std::string> arguments, says;
};
/// The same of several problems.
struct RefusedCall {
    std::string program;
    std::vector<std::string> arguments, says;
};

/// Status 2, one line with all these words, and no file.
inline void check_refused(const std::string& program, const std::vector<std::string>& arguments,
                          const std::vector<std::string>& says) {
    BOOST_TEST_CONTEXT(program << " " << arguments.front() << " " << arguments.back()) {
        const Scratch folder;
        const Outcome outcome =
            Child(problem(program, arguments), {folder.path()}).finish(Child::Seconds(240));
        BOOST_TEST(outcome.status == 2);
        BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
        for (const auto& word : says)
            BOOST_TEST(outcome.err.find(word) != std::string::npos, outcome.err);
        BOOST_TEST(folder.listing().empty());
    }
}

inline void check_refused(const std::string& program, const std::vector<Refused>& all) {
    for (const Refused& bad : all) check_refused(program, bad.arguments, bad.says);
}
inline void check_refused(const std::vector<RefusedCall>& all) {
    for (const RefusedCall& bad : all) check_refused(bad.program, bad.arguments, bad.says);
}

}  // namespace spam::test
