// SPDX-License-Identifier: GPL-3.0-or-later
// spam-view: a result folder as one page of HTML that plays the run.
#include "files.hpp"
#include "page.hpp"
#include <spam/core/error.hpp>
#include <spam/core/program.hpp>
#include <spam/core/text.hpp>

#include <fmt/format.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>

namespace {

using namespace spam;
namespace fs = std::filesystem;

constexpr const char* usage =
    R"(spam-view - looks at a run: makes one page of HTML, which needs no other file and no network

  spam-view RESULTS [--out FILE] [--max-mb NUMBER] [--open]

  RESULTS          result folder of a run; all cases in it are shown side by side
  --out FILE       the page [RESULTS/view.html]
  --max-mb NUMBER  most megabytes of the page [60]: a longer run is thinned, and the page says how
  --open           show the page in the browser (xdg-open)
  --help           this text

Exit status: 0 - the page is written; 2 - wrong input, nothing is written; 4 - it could not be written.
)";

struct Options {
    std::string results;
    std::string out;
    double max_mb = 60.0;
    bool open = false;
};

/// Throws InputError.
Options options_of(const std::vector<std::string>& words) {
    static const std::vector<std::string> known{"--out", "--max-mb", "--open", "--help"};
    Options options;
    bool only_names = false;
    for (std::size_t k = 0; k < words.size(); ++k) {
        const std::string& word = words[k];
        if (word == "--" && !only_names) {
            only_names = true;
            continue;
        }
        if (only_names || !word.starts_with('-') || word == "-") {
            if (!options.results.empty())
                throw InputError(fmt::format(
                    "RESULTS: '{}' is one folder too many; one page shows one", one_line(word)));
            if (word.empty()) throw InputError("RESULTS: the name is empty; name a result folder");
            options.results = word;
            continue;
        }
        const std::string name = word.substr(0, word.find('='));
        std::optional<std::string> value;
        if (name.size() < word.size()) value = word.substr(name.size() + 1);
        if (name == "--open" && !value) {
            options.open = true;
            continue;
        }
        if (name != "--out" && name != "--max-mb")
            throw InputError(
                fmt::format("{}: no such option{}", one_line(word), suggestion(name, known)));
        if (!value && k + 1 < words.size()) value = words[++k];
        if (!value || value->empty())
            throw InputError(fmt::format("{}: its value is missing", name));
        if (name == "--out") {
            options.out = *value;
            continue;
        }
        const auto number = number_in(*value);
        if (!number || *number < 0.5 || *number > 1000.0)
            throw InputError(fmt::format("--max-mb: '{}' is not allowed; a number from 0.5 to 1000",
                                         one_line(*value)));
        options.max_mb = *number;
    }
    if (options.results.empty())
        throw InputError("RESULTS: which folder? spam-view RESULTS (--help says more)");
    return options;
}

void show(const fs::path& opener, const fs::path& page) {
    const std::string file = fs::absolute(page).string();
    if (Command{{opener.string(), file}}.run() != 0)
        fmt::print(stderr, "spam-view: xdg-open did not show the page; open it yourself: {}\n",
                   one_line(file));
}

void make(const Options& options) {
    const fs::path opener = options.open ? find_program("xdg-open") : fs::path{};
    if (options.open && opener.empty())
        throw InputError(
            "--open: there is no xdg-open (Debian: package xdg-utils); open the page yourself");
    const fs::path folder(options.results);
    const fs::path page = options.out.empty() ? folder / "view.html" : fs::path(options.out);
    const view::Results results = view::read_results(folder);
    view::check_writable(page);
    const auto most = static_cast<std::size_t>(options.max_mb * 1e6);
    const auto check_room = [most](std::size_t bytes) {
        if (bytes > most)
            throw InputError(
                fmt::format("--max-mb: with the texts of these results a page takes {:.1f} MB; "
                            "allow as much",
                            std::ceil(static_cast<double>(bytes) / 1e5) / 10.0));
    };
    const std::size_t words = view::bytes_of_program() + view::bytes_of_text(results);
    check_room(words);
    const auto thinning = view::thinned_to(results, most - words);
    const std::string text = view::make_page(view::make_payload(results, thinning));
    check_room(text.size());
    view::write_file(page, text);
    fmt::print("{} ({:.1f} MB; {})\n", one_line(page.string()),
               static_cast<double>(text.size()) / 1e6, thinning.in_words());
    std::fflush(stdout);
    if (options.open) show(opener, page);
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit is a failed write, reported as such
    try {
        for (const std::string& word : words)
            if (word == "--help" || word == "-h") {
                fmt::print("{}", usage);
                return 0;
            }
        make(options_of(words));
        return 0;
    } catch (const InputError& error) {
        fmt::print(stderr, "spam-view: {}\n", error.what());
        return 2;
    } catch (const OutputError& error) {
        fmt::print(stderr, "spam-view: {}\n", error.what());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "spam-view: not enough memory for these results\n");
    } catch (const std::exception& error) {
        fmt::print(stderr, "spam-view: {}\n", one_line(error.what()));
    }
    return 4;
}
