// SPDX-License-Identifier: GPL-3.0-or-later
// The folder of a small run with random damage: spam-view makes a page of it or refuses it, a restart goes on in
// it or refuses it, each in one line; and nothing beside the folder is touched.
#include "support/hunt.hpp"
#include "support/process.hpp"
#include "view/page.hpp"
#include <spam/core/error.hpp>

#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <random>

using namespace spam::test;
namespace fs = std::filesystem;
using Words = std::vector<std::string>;

namespace {

/// What disks, programs and people do to a file.
class Damage {
  public:
    explicit Damage(unsigned seed) : random_(seed) {}

    std::size_t below(std::size_t n) {
        return n == 0 ? 0 : std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
    }

    /// Half of it in the first kilobyte, where a byte means more.
    std::string bytes(std::string text, const std::string& other) {
        static const Words words{"nan",
                                 "-1",
                                 "1e999",
                                 "99999999999999999999",
                                 "null",
                                 "[[[[",
                                 "{\"a\":",
                                 "\"",
                                 "<",
                                 "</a>",
                                 "\n",
                                 ",,,",
                                 "../../etc/passwd",
                                 "0",
                                 "\\u",
                                 "\xff\xfe",
                                 "=",
                                 "",
                                 "<!--x",
                                 "/* description */"};
        const std::size_t end =
            below(2) == 0 ? std::min<std::size_t>(text.size(), 1024) : text.size();
        const std::size_t at = below(end), n = 1 + below(40);
        switch (below(8)) {
            case 0:
                text.resize(at);
                break;
            case 1:
                text.erase(at, 1 + below(300));
                break;
            case 2:
                text.insert(at, words[below(words.size())]);
                break;
            case 3:
                text.replace(at, std::min(n, text.size() - at), words[below(words.size())]);
                break;
            case 4:
                text.insert(at, text.substr(below(text.size()), 1 + below(300)));
                break;
            case 5:
                text.replace(at, std::min(n, text.size() - at),
                             other.substr(below(other.size()), n));
                break;
            case 6:
                text = other;
                break;
            default:
                for (std::size_t k = 0; k < n && !text.empty(); ++k)
                    text[(at + below(60)) % text.size()] = static_cast<char>(random_());
        }
        return text;
    }

    /// Something else in place of a file or beside the others.
    void thing(const fs::path& path) {
        std::error_code ignored;
        fs::remove_all(path, ignored);
        switch (below(6)) {
            case 0:
                break;
            case 1:
                mkfifo(path.c_str(), 0666);
                break;
            case 2:
                fs::create_symlink(path.filename(), path);
                break;
            case 3:
                fs::create_symlink("../precious", path);
                break;
            case 4:
                fs::create_symlink("../absent", path);
                break;
            default:
                fs::create_directory(path);
        }
    }

  private:
    std::mt19937_64 random_;
};

/// A run in `out`, and what may be done to it.
class Victim {
  public:
    Victim() {
        scratch_.write("precious", "not yours");
        const Outcome outcome =
            run(problem("rotating_hexagon",
                        {"--size", "2", "--transport", "monaghan", "--angular-momentum",
                         "torque_pair", "--t-end", "2", "--output-every", "0.2", "--out", "out",
                         "--snapshot-every", "1", "--no-plots", "--quiet"}),
                {scratch_.path()});
        BOOST_TEST_REQUIRE(outcome.status == 0, outcome.err);
        for (const auto& [name, text] : scratch_.listing())
            if (name.starts_with("out/")) whole_[name] = text;
        for (const auto& [name, text] : whole_) names_.push_back(name);
        BOOST_TEST_REQUIRE(names_.size() > 9u);
    }

    void restore() const {
        fs::remove_all(scratch_ / "out");
        for (const auto& [name, text] : whole_) scratch_.write(name, text);
    }
    void damage(Damage& damage) const {
        const auto some = [&] { return names_[damage.below(names_.size())]; };
        for (std::size_t k = 1 + damage.below(3); k > 0; --k) {
            const std::string name = some();
            const fs::path path = scratch_ / name;
            std::error_code ignored;
            if (damage.below(5) == 0)
                damage.thing(damage.below(4) == 0 ? scratch_ / (name + ".tmp") : path);
            else if (fs::is_regular_file(fs::symlink_status(path, ignored)))
                scratch_.write(name, damage.bytes(whole_.at(name), whole_.at(some())));
        }
    }
    /// Nothing came into being beside the folder, and what lies there is as it was.
    void check_rest() const {
        BOOST_TEST(contents_of(scratch_ / "precious") == "not yours");
        for (const auto& entry : fs::directory_iterator(scratch_.path())) {
            const std::string name = entry.path().filename();
            BOOST_TEST((name == "out" || name == "precious"), name);
        }
    }
    Outcome call(const Words& words) const {
        return Child(words, {scratch_.path()}).finish(Child::Seconds(SPAM_SANITIZED ? 300 : 60));
    }
    fs::path results() const { return scratch_ / "out"; }

  private:
    Scratch scratch_;
    std::map<std::string, std::string> whole_;
    Words names_;
};

void check_one_line(const std::string& text) {
    BOOST_TEST(std::count(text.begin(), text.end(), '\n') == 1, text);
    BOOST_TEST(text.size() < 1000u, text);
}

void check_ended(const Outcome& outcome) {
    BOOST_TEST(outcome.signal == 0, outcome.err);
    BOOST_TEST((outcome.status == 0 || outcome.status == 2 || outcome.status == 4),
               outcome.status << outcome.err);
    if (outcome.status != 0) check_one_line(outcome.err);
    BOOST_TEST(outcome.err.find("defect") == std::string::npos, outcome.err);
}

}  // namespace

BOOST_AUTO_TEST_CASE(damaged_folders_are_shown_or_refused) {
    const Victim victim;
    int pages = 0, refusals = 0;
    hunt(2000, [&](unsigned seed) {
        Damage damage(seed);
        victim.restore();
        victim.damage(damage);
        try {
            const auto results = spam::view::read_results(victim.results());
            const auto thinning = spam::view::thinned_to(results, 10'000'000);
            const auto page = spam::view::make_page(spam::view::make_payload(results, thinning));
            BOOST_TEST(page.starts_with("<!DOCTYPE html>"));
            ++pages;
        } catch (const spam::InputError& refusal) {
            check_one_line(refusal.what() + std::string("\n"));
            ++refusals;
        }
    });
    BOOST_TEST_MESSAGE(pages << " pages, " << refusals << " refusals");
    victim.check_rest();
}

BOOST_AUTO_TEST_CASE(programs_end_by_themselves_on_damaged_folders) {
    const Victim victim;
    std::map<int, int> ends;
    hunt(SPAM_SANITIZED ? 30 : 100, [&](unsigned seed) {
        Damage damage(seed + 1'000'000);
        victim.restore();
        victim.damage(damage);
        check_ended(victim.call({SPAM_VIEW, "out"}));
        const Outcome outcome = victim.call(problem(
            "rotating_hexagon", {"--restart", "out", "--t-end", "4", "--no-plots", "--quiet"}));
        check_ended(outcome);
        ++ends[outcome.status];
        victim.check_rest();
    });
    for (const auto& [status, number] : ends)
        BOOST_TEST_MESSAGE("restarts with exit status " << status << ": " << number);
}
