// SPDX-License-Identifier: GPL-3.0-or-later
// `restart` in a file of options means what --restart means on the command line.
#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

const Words intervals{"--output-every", "1", "--snapshot-every", "2", "--checkpoint-every", "2"};

/// A short run in the folder `half`, and one twice as long in `whole`.
struct Earlier : Scratch {
    Earlier() {
        for (const auto& [out, end] : {std::pair{"half", "4"}, {"whole", "8"}}) {
            Words words{"--size", "2",          "--transport", "plain", "--t-end",
                        end,      "--no-plots", "--quiet",     "--out", out};
            words.insert(words.end(), intervals.begin(), intervals.end());
            const Outcome ran = started(words);
            BOOST_REQUIRE_MESSAGE(ran.status == 0, ran.err);
        }
    }
    Outcome started(const Words& words) const {
        return Child(problem("rotating_hexagon", words), {path()}).finish(Child::Seconds(120));
    }
    Outcome with_file(const std::string& toml, const Words& more = {}) const {
        write("c.toml", toml);
        Words words{"--config", "c.toml", "--no-plots", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return started(words);
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_file_goes_on_with_an_earlier_run) {
    for (const auto& [toml, more] :
         {std::pair{std::string("restart = \"half\"\nt-end = 8\n"), Words{}},
          {"restart = \"half\"\n", {"--t-end", "8"}},
          {"t-end = 6.5\nsize = 2\nrestart = \"half/checkpoint_0.h5\"\n", {"--t-end", "8"}}}) {
        const Earlier folder;
        const Outcome ran = folder.with_file(toml, more);
        BOOST_TEST(ran.status == 0, toml << ran.err);
        BOOST_TEST(contents_of(folder / "half/invariants.csv") ==
                   contents_of(folder / "whole/invariants.csv"));
        BOOST_TEST(!std::filesystem::exists(folder / "rotating_hexagon-out"));
    }
}

BOOST_AUTO_TEST_CASE(what_contradicts_the_earlier_run_is_refused) {
    const Earlier folder;
    struct Refused {
        std::string toml;
        Words more, says;
    };
    for (const Refused& one : std::vector<Refused>{
             {"restart = \"/nonexistent\"", {}, {"c.toml line 1", "restart", "/nonexistent"}},
             {"\nrestart = \"c.toml\"", {}, {"c.toml line 2", "restart"}},
             {"restart = \"\"", {}, {"c.toml line 1", "restart", "empty"}},
             {"restart = 3", {}, {"c.toml line 1", "restart", "text in quotes"}},
             {"restart = \"half\"\nsize = 3", {}, {"c.toml line 2", "size", "3", "2"}},
             {"size = 3\nrestart = \"half\"", {}, {"c.toml line 1", "size", "3", "2"}},
             {"restart = \"half\"\nrnge = 3", {}, {"line 2", "rnge", "range"}},
             {"restart = \"half\"", {"--size", "3"}, {"size", "3", "2"}},
             {"restart = \"half\"", {"--restart", "whole"}, {"config", "leave one out"}},
             {"restart = \"half\"\nforce = true", {}, {"force", "--restart"}},
             {"restart = \"half\"\nsmoke = true", {}, {"smoke", "--restart"}},
             {"restart = \"half\"\nt-end = 2", {}, {"t-end", "2", "4"}}}) {
        folder.write("c.toml", one.toml);
        const auto before = folder.listing();
        const Outcome outcome = folder.with_file(one.toml, one.more);
        BOOST_TEST_CONTEXT(one.toml << "\n" << outcome.err) {
            BOOST_TEST(outcome.status == 2);
            BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
            for (const auto& word : one.says)
                BOOST_TEST(outcome.err.find(word) != std::string::npos, "no " << word);
            BOOST_TEST((folder.listing() == before));
        }
    }
    const Outcome study = Child(problem("turns_survived", {"--config", "c.toml"}), {folder.path()})
                              .finish(Child::Seconds(60));
    BOOST_TEST(study.status == 2);
    BOOST_TEST(study.err.find("restart") != std::string::npos, study.err);
}
