// SPDX-License-Identifier: GPL-3.0-or-later
// No source of the library takes long to compile: a first `./spam run` waits for all of them. Seconds depend on
// the machine and on what else it does, so that they are measured in the mean of all sources, which is 3.8 s on a
// quiet processor of 2025 (gcc 12, Release): 8 of them are 30 s.
#include <boost/test/unit_test.hpp>

#include <fstream>
#include <map>
#include <numeric>
#include <sstream>
#include <string>

namespace {

constexpr double most = 8.0;

/// Of each object of the library what it took when it was last made, from lines "start end mtime output hash"
/// (milliseconds).
std::map<std::string, double> compile_times(std::istream& log) {
    std::map<std::string, double> times;
    for (std::string line; std::getline(log, line);) {
        std::istringstream words(line);
        double start = 0.0, end = 0.0;
        std::string changed, output;
        if (!(words >> start >> end >> changed >> output)) continue;
        if (output.starts_with("src/CMakeFiles/spam") && output.ends_with(".o"))
            times[output] = end - start;
    }
    return times;
}

/// The longest of the times, in their mean, and whose it is.
std::pair<double, std::string> longest(const std::map<std::string, double>& times) {
    const double sum =
        std::accumulate(times.begin(), times.end(), 0.0,
                        [](double before, const auto& entry) { return before + entry.second; });
    std::pair<double, std::string> found{0.0, ""};
    for (const auto& [output, time] : times)
        found = std::max(found, {time * static_cast<double>(times.size()) / sum, output});
    return found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(no_source_of_the_library_takes_long_to_compile) {
    std::ifstream log(SPAM_NINJA_LOG);
    const auto times = compile_times(log);
    BOOST_TEST_REQUIRE(times.size() > 100u);
    const auto [share, output] = longest(times);
    BOOST_TEST(share < most, output << " takes " << share << " times the mean of all");
}

BOOST_AUTO_TEST_CASE(one_that_takes_long_is_found) {
    std::string text = "# ninja log v5\n0\t40500\t0\tsrc/CMakeFiles/spam_seldom.dir/a.cpp.o\tx\n";
    for (int n = 0; n < 200; ++n)
        text += "0\t3600\t0\tsrc/CMakeFiles/spam.dir/" + std::to_string(n) + ".cpp.o\tx\n";
    std::istringstream log(text);
    BOOST_TEST(longest(compile_times(log)).first > most);
}
