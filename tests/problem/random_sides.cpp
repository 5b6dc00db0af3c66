// SPDX-License-Identifier: GPL-3.0-or-later
// Flows between sides taken at random. Whatever they are, a run ends with status 0, 2 or 3; with 0 every promise
// is kept by the rows of invariants.csv, from which it is computed here anew.
#include "problem/refused.hpp"
#include "support/hunt.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <random>

using namespace spam::test;
namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

struct Flow {
    std::string program;
    Words small;                 ///< makes its smoke run a matter of a second
    Words sides;                 ///< its options of sides
    std::vector<Words> choices;  ///< options, each with some values
};

const Words two{"left", "right"}, four{"left", "right", "bottom", "top"};
const Words friction{"friction", "pairs", "gradients"}, density{"density", "continuity", "summed"},
    kernel{"kernel", "lucy", "w4", "w5", "w6"};
const Words transport{"transport", "plain", "plain", "shifting"};

const std::vector<Flow> flows{
    {"couette", {"--cells", "8"}, four, {friction, density, kernel}},
    {"poiseuille", {"--cells", "8"}, four, {friction, density, kernel}},
    {"cavity", {"--cells", "10"}, four, {friction, density, kernel, transport}},
    {"taylor_green", {"--cells", "12"}, four, {friction, density, kernel, transport}},
    {"rayleigh_benard", {}, four, {friction, density, kernel, {"rayleigh", "1000", "20000"}}},
    {"shock_tube", {}, two, {kernel, {"density", "summed", "continuity"}, {"gamma", "1.4", "2"}}},
    {"free_expansion", {"--dimension", "1"}, two, {kernel, {"walls", "periodic", "mirror"}}},
    {"free_expansion", {"--cells", "12"}, four, {kernel, {"walls", "periodic", "mirror"}}},
    {"water_column",
     {},
     {"left", "right", "bottom"},
     {{"core", "0", "0.1"}, {"width", "8", "10"}}}};

class Draw {
  public:
    explicit Draw(unsigned seed) : random_(seed) {}
    bool chance(double p) { return std::uniform_real_distribution<double>()(random_) < p; }
    std::size_t below(std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
    }
    const std::string& of(const Words& words, std::size_t first = 0) {
        return words[first + below(words.size() - first)];
    }

  private:
    std::mt19937 random_;
};

/// A side in words, now and then one that makes no sense.
std::string side(Draw& draw) {
    static const Words kinds{
        "open",     "mirror",        "mirror",      "no-slip",     "no-slip",    "rigid",
        "rigid",    "moving:0.05",   "moving:-0.2", "no-slip@1.5", "mirror@0.5", "moving:0.1@2",
        "periodic", "moving:1e-300", "no-slip@1e6", "moving:5",    "moving:1000"};
    return draw.of(kinds, 0);
}

Words command_of(const Flow& flow, Draw& draw) {
    Words words = flow.small;
    words.insert(words.end(), {"--smoke", "--no-plots", "--out", "out"});
    for (std::size_t k = 0; k < flow.sides.size(); k += 2) {
        const bool both = k + 1 < flow.sides.size();
        if (draw.chance(0.25)) {
            for (std::size_t n = k; n < k + (both ? 2U : 1U); ++n)
                words.insert(words.end(), {"--" + flow.sides[n], "periodic"});
            continue;
        }
        for (std::size_t n = k; n < k + (both ? 2U : 1U); ++n)
            if (draw.chance(0.75)) words.insert(words.end(), {"--" + flow.sides[n], side(draw)});
    }
    for (const Words& choice : flow.choices)
        if (draw.chance(0.35))
            words.insert(words.end(), {"--" + choice.front(), draw.of(choice, 1)});
    return words;
}

/// Of the columns `name`, `name`_x, ... the largest change, less what was `given`.
double change_in(const Csv& rows, const std::string& name, const Words& given) {
    double largest = 0.0;
    for (const char* axis : {"", "_x", "_y", "_z"}) {
        const auto has = [&](const std::string& column) {
            return std::count(rows.names.begin(), rows.names.end(), column) > 0;
        };
        if (!has(name + axis)) continue;
        auto balance = rows.column(name + axis);
        for (const std::string& account : given) {
            if (!has(account + axis)) continue;
            const auto from_outside = rows.column(account + axis);
            for (std::size_t k = 0; k < balance.size(); ++k) balance[k] -= from_outside[k];
        }
        for (const double b : balance) {
            BOOST_TEST(std::isfinite(b));
            largest = std::max(largest, std::abs(b - balance.front()));
        }
    }
    return largest;
}

struct Account {
    const char *invariant, *column;
    Words given;
};
const std::vector<Account> accounts{{"mass", "mass", {}},
                                    {"momentum", "momentum", {"impulse"}},
                                    {"angular momentum", "angular_momentum", {"angular_impulse"}},
                                    {"energy", "energy", {"work", "heat"}}};

/// What the program says of the invariants of one case is what its rows say.
void check_promises(const fs::path& folder) {
    const Csv rows(folder / "invariants.csv");
    const auto told = json_of(folder / "statistics.json").at("invariants");
    for (const Account& one : accounts) {
        if (!told.contains(one.invariant)) continue;
        const auto& drift = told.at(one.invariant);
        BOOST_TEST_CONTEXT(one.invariant << " " << drift.dump()) {
            BOOST_REQUIRE(drift.at("scale").is_number());
            const double change =
                change_in(rows, one.column, one.given) / drift.at("scale").get<double>();
            BOOST_TEST(std::abs(drift.at("change").get<double>() - change) <= 1e-9 * change);
            if (drift.at("promise") == "not kept") continue;
            BOOST_TEST(change <= drift.at("limit").get<double>());
            BOOST_TEST(drift.at("kept") == true);
        }
    }
    const auto kinetic = rows.column("kinetic");
    const double size = std::max(std::abs(rows.column("energy").front()),
                                 *std::max_element(kinetic.begin(), kinetic.end()));
    BOOST_TEST(told.at("energy").at("scale").get<double>() >= size * (1.0 - 1e-12));
}

void check_flow(const Flow& flow, unsigned seed) {
    Draw draw(seed);
    const Words words = command_of(flow, draw);
    std::string shown = flow.program;
    for (const auto& word : words) shown += " " + word;
    BOOST_TEST_CONTEXT(shown) {
        const Scratch folder;
        const Outcome outcome =
            Child(problem(flow.program, words), {folder.path()}).finish(Child::Seconds(240));
        BOOST_TEST((outcome.status == 0 || outcome.status == 2 || outcome.status == 3),
                   "status " << outcome.status << "\n"
                             << outcome.out << outcome.err);
        if (outcome.status == 2) BOOST_TEST(folder.listing().empty());
        if (outcome.status == 2 || outcome.status == 3)
            BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1, outcome.err);
        if (outcome.status != 0) return;
        std::size_t cases = 0;
        for (const auto& entry : fs::recursive_directory_iterator(folder / "out"))
            if (entry.path().filename() == "invariants.csv") {
                check_promises(entry.path().parent_path());
                ++cases;
            }
        BOOST_TEST(cases > 0U);
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(promises_are_kept_between_sides_taken_at_random) {
    hunt(45, [](unsigned seed) { check_flow(flows[seed % flows.size()], seed); });
}

/// A row that is not what it was is found.
BOOST_AUTO_TEST_CASE(rows_that_break_a_promise_are_seen) {
    const Scratch folder;
    const Words words{"--smoke", "--no-plots", "--out", "out", "--cells", "8"};
    BOOST_REQUIRE(Child(problem("couette", words), {folder.path()}).finish().status == 0);
    const Csv rows(folder / "out/invariants.csv");
    const auto told = json_of(folder / "out/statistics.json").at("invariants");
    for (const Account& one : accounts) {
        if (!told.contains(one.invariant) || told.at(one.invariant).at("promise") == "not kept")
            continue;
        Csv broken = rows;
        const auto at = std::find_if(rows.names.begin(), rows.names.end(), [&](const auto& name) {
            return name.starts_with(one.column);
        });
        const double scale = told.at(one.invariant).at("scale").get<double>();
        auto& cell = broken.cells[1][static_cast<std::size_t>(at - rows.names.begin())];
        cell = std::to_string(Csv::number(cell) + scale);
        BOOST_TEST(change_in(broken, one.column, one.given) > 0.5 * scale);
    }
}
