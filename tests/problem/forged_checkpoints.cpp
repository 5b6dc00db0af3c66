// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints with a valid seal whose contents are not what a run writes: each is refused in one line, or the run
// goes on from what it says and ends by itself. Damage without a seal is tests/io/checkpoint_damage.
#include "problem/result_files.hpp"
#include "support/hunt.hpp"
#include "support/process.hpp"
#include <spam/io/checkpoint_pair.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <sstream>

using namespace spam::test;
using spam::CheckpointReader;
using spam::CheckpointWriter;
using Words = std::vector<std::string>;

namespace {

/// Runs of milliseconds that remember different things: torques and rows, steps of an adaptive method, plastic
/// flow, several cases, lists of a flow and walls, bodies.
struct Source {
    std::string problem;
    Words words;
    std::string begun, end;  ///< where the checkpoint is, and where the restart goes
};
const std::vector<Source> sources{
    {"rotating_hexagon", {"--size", "2", "--transport", "monaghan"}, "2", "4"},
    {"rotating_hexagon",
     {"--size", "2", "--transport", "plain", "--integrator", "arkode:DORMAND_PRINCE_7_4_5"},
     "2",
     "4"},
    {"rotating_hexagon", {"--size", "1"}, "1", "2"},
    {"plastic_block", {"--columns", "6", "--rows", "4"}, "1", "2"},
    {"couette", {"--smoke"}, "1", "1.5"},
    {"fragmenting_bar", {"--smoke"}, "1", "2"}};

/// All that a checkpoint holds, by the names of src/problem/checkpoint.cpp.
struct Contents {
    std::map<std::string, std::string> texts;
    std::map<std::string, std::pair<std::vector<double>, std::size_t>> numbers;
    std::map<std::string, std::vector<std::int64_t>> integers;
    std::map<std::string, std::vector<std::byte>> bytes;

    explicit Contents(const std::filesystem::path& file) {
        const CheckpointReader reader(file);
        for (const char* name : {"/version", "/instruction_set", "/problem", "/case", "/command"})
            texts[name] = reader.text(name);
        for (const char* name : {"/counts", "/sequence"}) integers[name] = reader.integers(name);
        const auto table = [&](const std::string& name) {
            numbers[name] = {reader.numbers(name), reader.columns(name)};
        };
        table("/plans");
        for (std::int64_t k = 0; k < integers["/counts"].at(0); ++k) {
            const std::string path = "/cases/" + std::to_string(k) + "/";
            for (const char* name : {"label", "model"})
                texts[path + name] = reader.text(path + name);
            if (!reader.has(path + "t")) continue;
            texts[path + "fields"] = reader.text(path + "fields");
            std::istringstream fields(texts[path + "fields"]);
            for (std::string name; std::getline(fields, name);) table(path + "state/" + name);
            for (const char* name : {"t", "particles/mass", "particles/reference_position"})
                table(path + name);
            for (const char* name : {"particles/id", "particles/body"})
                integers[path + name] = reader.integers(path + name);
            for (const char* name : {"motion", "records"})
                bytes[path + name] = reader.bytes(path + name);
        }
    }

    void save(const std::filesystem::path& file) const {
        CheckpointWriter writer;
        for (const auto& [name, value] : texts) writer.text(name, value);
        for (const auto& [name, value] : numbers) writer.numbers(name, value.first, value.second);
        for (const auto& [name, value] : integers) writer.integers(name, value);
        for (const auto& [name, value] : bytes) writer.bytes(name, value);
        writer.save(file);
    }
};

class Forger {
  public:
    explicit Forger(unsigned seed) : random_(seed) {}

    std::size_t below(std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
    }
    void forge(Contents& all) {
        switch (below(8)) {
            case 0:
                return forge_text(one_of(all.texts).second);
            case 1:
            case 2:
                return forge_numbers(one_of(all.numbers).second);
            case 3:
                return forge_values(one_of(all.integers).second, whole_);
            case 4:
            case 5:
                return forge_bytes(one_of(all.bytes).second);
            case 6:
                return lose(all);
            default:
                return exchange(all);
        }
    }

  private:
    template <class Map>
    typename Map::value_type& one_of(Map& map) {
        return *std::next(map.begin(), static_cast<std::ptrdiff_t>(below(map.size())));
    }
    template <class T>
    void forge_values(std::vector<T>& values, const std::vector<T>& extremes) {
        const std::size_t kind = below(5);
        if (kind == 0) values.resize(below(values.size() + 3));
        if (values.empty() || kind == 0) return;
        if (kind == 1) values[below(values.size())] = extremes[below(extremes.size())];
        if (kind == 2) std::fill(values.begin(), values.end(), extremes[below(extremes.size())]);
        if (kind == 3) std::swap(values[below(values.size())], values[below(values.size())]);
        if (kind == 4) values.push_back(values[below(values.size())]);
    }
    void forge_numbers(std::pair<std::vector<double>, std::size_t>& table) {
        auto& [values, columns] = table;
        forge_values(values, real_);
        if (below(6) == 0) columns = 1 + below(4);
        values.resize(values.size() / columns * columns);
    }
    void forge_text(std::string& text) {
        static const Words words{"",      "\n", "0",  "-1",    "nan",
                                 "1e308", "=",  "\"", "[x]\n", "a = [[["};
        const std::string& word = words[below(words.size())];
        const std::size_t at = below(text.size() + 1);
        if (below(3) == 0)
            text = word;
        else
            text.replace(at, below(8), word);
        if (below(20) == 0) text = std::string(100'000, 'a');
        if (below(20) == 0) text.insert(text.begin(), '\0');
    }
    /// An archive: sizes of 64 bits, numbers, flags.
    void forge_bytes(std::vector<std::byte>& bytes) {
        const std::size_t kind = below(5);
        if (kind == 0) bytes.resize(below(bytes.size() + 20));
        if (bytes.size() < 9 || kind == 0) return;
        const auto put = [&](std::size_t at, std::uint64_t number) {
            std::memcpy(&bytes[at], &number, sizeof number);
        };
        if (kind == 1) bytes[below(bytes.size())] ^= static_cast<std::byte>(1U << below(8));
        if (kind == 2) {
            static const std::vector<std::uint64_t> sizes{
                0, 1, 3, 1U << 20U, 1ULL << 40U, 1ULL << 61U, 1ULL << 63U, ~0ULL};
            put(below(bytes.size() - 8), sizes[below(sizes.size())]);
        }
        if (kind == 3) {
            std::uint64_t number = 0;
            const double value = real_[below(real_.size())];
            std::memcpy(&number, &value, sizeof number);
            put(below((bytes.size() - 1) / 8) * 8, number);
        }
        if (kind == 4) {
            const std::size_t at = below(bytes.size()), n = below(bytes.size() - at);
            bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                        bytes.begin() + static_cast<std::ptrdiff_t>(at + n));
        }
    }
    void lose(Contents& all) {
        const std::size_t kind = below(4);
        const auto drop = [&](auto& map) { map.erase(one_of(map).first); };
        if (kind == 0) drop(all.texts);
        if (kind == 1) drop(all.numbers);
        if (kind == 2) drop(all.integers);
        if (kind == 3) drop(all.bytes);
    }
    /// One thing under the name of another, of its kind or not.
    void exchange(Contents& all) {
        const std::string name = one_of(all.numbers).first;
        if (below(2) == 0) {
            std::swap(all.numbers[name], one_of(all.numbers).second);
        } else if (all.numbers.erase(name); below(2) == 0) {
            all.integers[name] = {1, 2, 3};
        } else {
            all.texts[name] = "numbers";
        }
    }

    std::mt19937_64 random_;
    std::vector<double> real_{0.0,
                              -0.0,
                              1.0,
                              -1.0,
                              1e-308,
                              1e308,
                              -1e308,
                              1e-320,
                              1e15,
                              std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity(),
                              std::nan("")};
    std::vector<std::int64_t> whole_{0,
                                     1,
                                     -1,
                                     2,
                                     1 << 20,
                                     std::numeric_limits<std::int64_t>::min(),
                                     std::numeric_limits<std::int64_t>::max(),
                                     std::int64_t{1} << 32U};
};

/// Enough for every case here, and far from what a size that was believed would take.
void limit_memory() {
    if (SPAM_SANITIZED) return;
    const rlimit limit{4'000'000'000, 4'000'000'000}, none{0, 0};
    setrlimit(RLIMIT_AS, &limit);
    setrlimit(RLIMIT_CORE, &none);
}

struct Begun {
    Source source;
    Contents contents;
};

std::vector<Begun> begin(const Scratch& folder) {
    std::vector<Begun> all;
    for (const Source& source : sources) {
        const std::string out = "run" + std::to_string(all.size());
        Words words = source.words;
        words.insert(words.end(), {"--t-end", source.begun, "--out", out, "--no-plots", "--quiet"});
        const Outcome outcome = run(problem(source.problem, words), {folder.path()});
        BOOST_TEST_REQUIRE(outcome.status == 0, source.problem << ": " << outcome.err);
        all.push_back({source, Contents(spam::newest_checkpoint(folder / out).value())});
    }
    return all;
}

void check_ended(const Outcome& outcome) {
    // One, but for what says that another version or processor has written it.
    auto lines = std::ptrdiff_t{0};
    for (const auto& line : split(outcome.err, '\n'))
        lines += !line.empty() && !line.ends_with("last digits may differ");
    BOOST_TEST(outcome.signal == 0, outcome.err);
    // 1: checks of a run from another state fail. 3: such a state may have no meaning.
    BOOST_TEST((outcome.status >= 0 && outcome.status <= 3), outcome.status << outcome.err);
    if (outcome.status == 2 || outcome.status == 3) BOOST_TEST(lines == 1, outcome.err);
    BOOST_TEST(outcome.err.find("HDF5") == std::string::npos, outcome.err);
}

Outcome go_on(const Scratch& folder, const Source& source, const std::string& file) {
    return Child(problem(source.problem, {"--restart", file, "--t-end", source.end, "--out", "on",
                                          "--no-plots", "--quiet", "--threads", "1",
                                          // Adaptive steps from such a state may be very short.
                                          "--max-steps", "20000"}),
                 {.folder = folder.path(), .before_exec = limit_memory})
        .finish(Child::Seconds(SPAM_SANITIZED ? 600 : 60));
}

}  // namespace

BOOST_AUTO_TEST_CASE(forged_contents_are_refused_or_gone_on_with) {
    const Scratch folder;
    const auto begun = begin(folder);
    for (const Begun& one : begun) {  // as they are, they go on
        one.contents.save(folder / "same.h5");
        const Outcome outcome = go_on(folder, one.source, "same.h5");
        BOOST_TEST(outcome.status == 0, one.source.problem << ": " << outcome.err);
        std::filesystem::remove_all(folder / "on");
    }
    std::map<int, int> ends;
    hunt(SPAM_SANITIZED ? 40 : 200, [&](unsigned seed) {
        Forger forger(seed);
        const Begun& one = begun[forger.below(begun.size())];
        Contents contents = one.contents;
        for (std::size_t k = 1 + forger.below(2); k > 0; --k) forger.forge(contents);
        contents.save(folder / "forged.h5");
        const Outcome outcome = go_on(folder, one.source, "forged.h5");
        check_ended(outcome);
        ++ends[outcome.status];
        std::filesystem::remove_all(folder / "on");
    });
    for (const auto& [status, number] : ends)
        BOOST_TEST_MESSAGE("exit status " << status << ": " << number);
}
