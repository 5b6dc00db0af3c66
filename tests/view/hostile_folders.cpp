// SPDX-License-Identifier: GPL-3.0-or-later
// Result folders that come from elsewhere: whatever lies in them, spam-view ends by itself, says one line, and
// writes the page that was asked for and nothing else.
#include "view/files.hpp"
#include "view/page.hpp"
#include "written_run.hpp"

#include <boost/test/unit_test.hpp>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>

using namespace spam;
using spam::test::Scratch;
using spam::test::WrittenRun;
namespace fs = std::filesystem;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

test::Outcome look(const Scratch& scratch, const std::vector<std::string>& words,
                   const std::function<void()>& limits = nullptr) {
    std::vector<std::string> all{SPAM_VIEW};
    all.insert(all.end(), words.begin(), words.end());
    return test::Child(all, {.folder = scratch.path(), .before_exec = limits})
        .finish(test::Child::Seconds(30));
}

void check_refused(const test::Outcome& outcome, const std::string& says, int status = 2) {
    BOOST_TEST(outcome.status == status, outcome.err);
    BOOST_TEST(has(outcome.err, says), outcome.err);
    BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1, outcome.err);
    BOOST_TEST(outcome.err.size() < 500U);
}

/// Files that spam-view reads.
const std::vector<std::string> read_files{"statistics.json", "result.json",   "invariants.csv",
                                          "case.toml",       "snapshots.pvd", "snapshot_0001.vtp"};

}  // namespace

BOOST_AUTO_TEST_CASE(nothing_but_the_page_is_touched) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 2);
    for (const char* name : {"precious", "my.html.part", "out/view.html.tmp"})
        scratch.write(name, "not yours");
    for (const char* link : {"view.html.part", "view.html.part-1-0"})
        fs::create_symlink("../precious", scratch / "out" / link);
    fs::create_symlink("../absent", scratch / "out/view.html");
    auto before = scratch.listing();
    BOOST_TEST(look(scratch, {"out"}).status == 0);
    BOOST_TEST(look(scratch, {"out", "--out", "my.html"}).status == 0);
    auto after = scratch.listing();
    BOOST_TEST(!fs::is_symlink(scratch / "out/view.html"));
    for (const char* page : {"out/view.html", "my.html"}) {
        BOOST_TEST(after[page].starts_with(view::page_mark));
        before.erase(page);
        after.erase(page);
    }
    BOOST_TEST((before == after));
    // A link to what is no page is no page.
    fs::remove(scratch / "out/view.html");
    fs::create_symlink("../precious", scratch / "out/view.html");
    check_refused(look(scratch, {"out"}), "is no page of spam view");
    BOOST_TEST(test::contents_of(scratch / "precious") == "not yours");
}

BOOST_AUTO_TEST_CASE(no_library_is_taken_from_the_working_folder) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 2);
    test::put_false_libraries(SPAM_VIEW, scratch);
    BOOST_TEST(scratch.listing().size() > 5U);
    BOOST_TEST(look(scratch, {"out"}).status == 0);
}

BOOST_AUTO_TEST_CASE(what_is_no_file_is_not_opened) {
    const Scratch scratch;
    const std::vector<std::pair<std::string, std::function<void(const fs::path&)>>> kinds{
        {"pipe", [](const fs::path& path) { mkfifo(path.c_str(), 0666); }},
        {"link to itself", [](const fs::path& path) { fs::create_symlink(path.filename(), path); }},
        {"link to nothing", [](const fs::path& path) { fs::create_symlink("absent", path); }},
        {"link to a device", [](const fs::path& path) { fs::create_symlink("/dev/zero", path); }},
        {"folder", [](const fs::path& path) { fs::create_directory(path); }}};
    for (const auto& [kind, make] : kinds)
        for (const std::string& file : read_files) BOOST_TEST_CONTEXT(file << " is a " << kind) {
                const WrittenRun run(scratch / "out", 2);
                fs::remove(scratch / "out" / file);
                make(scratch / "out" / file);
                check_refused(look(scratch, {"out"}), file);
                BOOST_TEST(!fs::exists(scratch / "out/view.html"));
                fs::remove_all(scratch / "out");
            }
    const WrittenRun run(scratch / "out", 2);
    kinds[0].second(scratch / "out/view.html");
    check_refused(look(scratch, {"out"}), "is no page of spam view");
}

BOOST_AUTO_TEST_CASE(folders_that_are_none) {
    const Scratch scratch;
    fs::create_symlink("loop", scratch / "loop");
    check_refused(look(scratch, {"loop"}), "RESULTS: loop");
    check_refused(look(scratch, {"/proc"}), "RESULTS: /proc");
    // Loops among folders are not gone round.
    const WrittenRun run(scratch / "out/one", 2);
    fs::create_directory_symlink("..", scratch / "out/one/up");
    fs::create_symlink("itself", scratch / "out/itself");
    BOOST_TEST(look(scratch, {"out"}).status == 0);
}

BOOST_AUTO_TEST_CASE(values_deeper_than_anything_are_refused) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 2);
    for (const std::string open : {"[", "{\"a\":"}) {
        std::string deep;
        for (int k = 0; k < 100'000; ++k) deep += open;
        deep += "1";
        for (int k = 0; k < 100'000; ++k) deep += open == "[" ? "]" : "}";
        for (const auto& [file, text] : std::vector<std::pair<std::string, std::string>>{
                 {"statistics.json", deep},
                 {"statistics.json", "{\"invariants\": {\"energy\": " + deep + "}}"},
                 {"result.json", deep},
                 {"result.json", "[{\"name\": \"a\", \"value\": " + deep + "}]"}}) {
            const std::string whole = test::contents_of(scratch / ("out/" + file));
            scratch.write("out/" + file, text);
            check_refused(look(scratch, {"out"}), file + ": is damaged, it is nested too deeply");
            scratch.write("out/" + file, whole);
        }
    }
}

BOOST_AUTO_TEST_CASE(values_of_another_kind_are_refused) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 2);
    for (const std::string value : {"3", "null", "[]", "{}", "true"}) {
        for (const std::string name : {"problem", "version"}) {
            scratch.write("out/statistics.json", "{\"" + name + "\": " + value + "}");
            check_refused(look(scratch, {"out"}), "statistics.json: is damaged, " + name);
        }
        if (value == "null" || value == "{}") continue;
        scratch.write("out/statistics.json", value);
        check_refused(look(scratch, {"out"}), "statistics.json: is damaged");
    }
}

BOOST_AUTO_TEST_CASE(texts_that_look_like_marks_of_the_page_are_texts) {
    const std::string marks = "/* description */ <!-- blocks -->\n /* player */ <!-- title -->";
    view::Results results;
    results.problem = results.options = marks;
    const std::string page = view::make_page(view::make_payload(results, {}));
    const std::string begin = "id=\"description\">";
    const std::size_t at = page.find(begin) + begin.size();
    const auto read = nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
    BOOST_TEST(read.at("problem") == marks);
    BOOST_TEST(read.at("options") == marks);
    const std::string title = page.substr(page.find("<title>"), 200);
    BOOST_TEST(title.starts_with("<title>/* description */ &lt;!-- blocks --"), title);
}

BOOST_AUTO_TEST_CASE(text_counts_as_much_as_numbers) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 2);
    scratch.write("out/case.toml", std::string(3'000'000, '<'));
    const auto outcome = look(scratch, {"out", "--max-mb", "2"});
    BOOST_TEST(outcome.status == 0, outcome.err);
    BOOST_TEST(fs::file_size(scratch / "out/view.html") <= 2'000'000U);
    BOOST_TEST(has(test::contents_of(scratch / "out/view.html"), "3000000 bytes in all"));
    fs::remove(scratch / "out/view.html");
    for (const char* name : {"problem", "remark"}) {
        scratch.write("out/statistics.json",
                      std::string("{\"") + name + "\": \"" + std::string(3'000'000, 'a') + "\"}");
        check_refused(look(scratch, {"out", "--max-mb", "2"}), "--max-mb");
        BOOST_TEST(!fs::exists(scratch / "out/view.html"));
    }
}

BOOST_AUTO_TEST_CASE(a_page_that_does_not_fit_leaves_nothing) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 2);
    const auto before = scratch.listing();
    const auto outcome = look(scratch, {"out"}, [] {
        const rlimit limit{8192, 8192};
        setrlimit(RLIMIT_FSIZE, &limit);
    });
    check_refused(outcome, "cannot write", 4);
    BOOST_TEST((scratch.listing() == before));
}
