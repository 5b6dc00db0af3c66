// SPDX-License-Identifier: GPL-3.0-or-later
// The page that spam-view writes: its numbers are those of the snapshots to the precision that it names, it asks
// for nothing from elsewhere, and the program refuses before it writes.
#include "view/page.hpp"

#include "written_run.hpp"
#include <spam/core/error.hpp>

#include <boost/test/unit_test.hpp>
#include <sys/stat.h>

#include <cstring>
#include <regex>

using namespace spam;
using spam::test::Scratch;
using spam::test::WrittenRun;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

std::string decoded(const std::string& text) {
    static const std::string letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned group = 0;
    int bits = 0;
    for (const char c : text) {
        if (c == '=') break;
        group = group << 6U | static_cast<unsigned>(letters.find(c));
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes.push_back(static_cast<char>(group >> static_cast<unsigned>(bits) & 0xFFU));
    }
    return bytes;
}

/// An array of a payload as the page opens it.
std::vector<double> opened(const view::Payload& payload, std::size_t number) {
    const auto& about = payload.description["arrays"][number];
    const std::string type = about["type"];
    const std::size_t n = about["n"], components = about["c"];
    if (type == "c") return std::vector<double>(n * components, about["low"].get<double>());
    const std::string bytes = decoded(payload.blocks.at(about["b"].get<std::size_t>()));
    std::vector<double> values;
    for (std::size_t i = 0; i < n * components; ++i) {
        float single = 0.0F;
        if (type == "f4") {
            std::memcpy(&single, bytes.data() + 4 * i, 4);
            values.push_back(single);
            continue;
        }
        unsigned q = static_cast<unsigned char>(bytes.at(type == "u2" ? 2 * i : i));
        if (type == "u2")
            q |= static_cast<unsigned>(static_cast<unsigned char>(bytes.at(2 * i + 1))) << 8U;
        values.push_back(about["low"][i / n].get<double>() +
                         q * about["step"][i / n].get<double>());
    }
    return values;
}

/// Largest error of a field in a payload, in units of the field's own extent.
double largest_error(const view::Results& results, const view::Thinning& thinning,
                     std::size_t field) {
    const view::Payload payload = view::make_payload(results, thinning);
    const auto& snapshots = results.cases[0].snapshots;
    const auto& shown = payload.description["cases"][0]["snapshots"];
    double error = 0.0;
    for (std::size_t k = 0; k < snapshots.size(); ++k) {
        const view::FieldArray& exact = snapshots[k].points[field];
        const auto values = opened(payload, shown[k]["points"][exact.name].get<std::size_t>());
        const auto [low, high] = std::minmax_element(exact.values.begin(), exact.values.end());
        for (std::size_t i = 0; i < values.size(); ++i)
            error = std::max(error, std::abs(values[i] - exact.values[i]) / (*high - *low));
    }
    return error;
}

std::vector<std::string> spam_view(const std::vector<std::string>& words) {
    std::vector<std::string> all{SPAM_VIEW};
    all.insert(all.end(), words.begin(), words.end());
    return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(base64_is_as_everywhere) {
    BOOST_TEST(view::base64("") == "");
    BOOST_TEST(view::base64("f") == "Zg==");
    BOOST_TEST(view::base64("fo") == "Zm8=");
    BOOST_TEST(view::base64("foobar") == "Zm9vYmFy");
    BOOST_TEST(view::base64("\xff\xff\xff") == "////");
}

BOOST_AUTO_TEST_CASE(numbers_keep_the_precision_that_the_page_names) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 3);
    const auto results = view::read_results(scratch / "out");
    const std::size_t position = 0, density = 5;
    BOOST_TEST_REQUIRE(results.cases[0].snapshots[0].points[density].name == "density");
    BOOST_TEST(largest_error(results, {4, 4, 1}, position) == 0.0);
    BOOST_TEST(largest_error(results, {2, 2, 1}, position) <= 0.51 / 65534);
    BOOST_TEST(largest_error(results, {2, 2, 1}, density) <= 0.51 / 65534);
    BOOST_TEST(largest_error(results, {2, 1, 1}, position) <= 0.51 / 65534);
    const double coarse = largest_error(results, {2, 1, 1}, density);
    BOOST_TEST(coarse <= 0.51 / 254);
    BOOST_TEST(coarse > 0.51 / 65534);
}

BOOST_AUTO_TEST_CASE(a_smaller_budget_thins_in_the_order_that_the_page_names) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 9);
    const auto results = view::read_results(scratch / "out");
    const auto most = [&](int bytes, int fields, std::size_t every) {
        return view::bytes_in_page(results, {bytes, fields, every});
    };
    const auto words = [&](std::size_t budget) {
        return view::thinned_to(results, budget).in_words();
    };
    BOOST_TEST(words(most(4, 4, 1)) == "numbers in single precision");
    BOOST_TEST(has(words(most(4, 4, 1) - 1), "fields in 16 bits"));
    BOOST_TEST(has(words(most(2, 2, 1) - 1), "fields in 8 bits"));
    BOOST_TEST(has(words(most(2, 1, 1) - 1), "every 2. snapshot"));
    BOOST_TEST(has(words(most(2, 1, 4)), "every 4. snapshot"));
    BOOST_CHECK_THROW(words(most(2, 1, 9) - 1), InputError);
    // What was promised is kept, and the last snapshot is always there.
    for (const std::size_t every : {1U, 2U, 4U}) {
        const auto payload = view::make_payload(results, {2, 1, every});
        std::size_t size = payload.description.dump().size();
        for (const auto& block : payload.blocks) size += block.size();
        BOOST_TEST(size <= most(2, 1, every));
        BOOST_TEST(payload.description["cases"][0]["snapshots"].back()["t"] == 8.0);
        BOOST_TEST(payload.description["cases"][0]["snapshots"].size() == 8 / every + 1);
    }
}

BOOST_AUTO_TEST_CASE(a_page_asks_for_nothing_and_keeps_its_tags) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 2);
    const auto results = view::read_results(scratch / "out");
    const std::string page = view::make_page(view::make_payload(results, {}));
    BOOST_TEST(has(page, "default-src 'none'"));
    // The name of the problem is hostile: as text it must appear nowhere.
    BOOST_TEST(!has(page, "<b>problem"));
    for (const char* tag : {"<link", "<script", "<img", "@import", "url("}) {
        for (std::size_t at = 0; (at = page.find(tag, at)) != page.npos; ++at) {
            const std::string here = page.substr(at, 90);
            if (has(here, "github.com/leeoniya")) continue;  // where uPlot says what it is
            BOOST_TEST((!has(here.substr(0, here.find('>')), "src=") && !has(here, "http")), here);
        }
    }
    BOOST_TEST(has(page, "The MIT License"));
}

BOOST_AUTO_TEST_CASE(the_program_writes_one_page_beside_the_results) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 2);
    const auto before = scratch.listing();
    const test::Outcome outcome = test::run(spam_view({"out"}), {.folder = scratch.path()});
    BOOST_TEST(outcome.status == 0, outcome.err);
    BOOST_TEST(has(outcome.out, "out/view.html"), outcome.out);
    auto after = scratch.listing();
    BOOST_TEST(after.at("out/view.html").size() < 1'000'000U);
    after.erase("out/view.html");
    BOOST_TEST((before == after));
    // Again, and elsewhere: a page of ours is replaced.
    BOOST_TEST(test::run(spam_view({"out"}), {.folder = scratch.path()}).status == 0);
    BOOST_TEST(
        test::run(spam_view({"--out", "p.html", "out"}), {.folder = scratch.path()}).status == 0);
    BOOST_TEST(std::filesystem::exists(scratch / "p.html"));
}

BOOST_AUTO_TEST_CASE(wrong_input_is_one_line_and_nothing_is_written) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 2);
    scratch.write("mine.html", "<p>not yours</p>");
    scratch.write("empty/x", "");
    const auto before = scratch.listing();
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
        {{}, "which folder"},
        {{"out", "--ouy", "a"}, "did you mean --out?"},
        {{"out", "out"}, "one folder too many"},
        {{"out", "--max-mb", "-3"}, "0.5 to 1000"},
        {{"out", "--max-mb=nan"}, "0.5 to 1000"},
        {{"out", "--max-mb"}, "its value is missing"},
        {{"out", "--out", "mine.html"}, "no page of spam view"},
        {{"out", "--out", "empty"}, "is a folder"},
        {{"out", "--out", "absent/p.html"}, "cannot write"},
        {{"empty"}, "no result folder"},
        {{"absent"}, "no such folder"},
        {{"out", "--open=3"}, "no such option"}};
    for (const auto& [words, says] : wrong) {
        const test::Outcome outcome = test::run(spam_view(words), {.folder = scratch.path()});
        BOOST_TEST(outcome.status == 2, says);
        BOOST_TEST(has(outcome.err, says), outcome.err);
        BOOST_TEST(outcome.err.find('\n') == outcome.err.size() - 1, outcome.err);
        BOOST_TEST(outcome.out.empty());
    }
    BOOST_TEST((scratch.listing() == before));
}

BOOST_AUTO_TEST_CASE(a_folder_that_may_not_be_written_is_refused) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 2);
    std::filesystem::permissions(scratch.path(), std::filesystem::perms(0755));
    std::filesystem::permissions(scratch / "out", std::filesystem::perms(0555));
    const test::Outcome outcome =
        test::run(spam_view({"out"}), {.folder = scratch.path(), .before_exec = [] {
                                           if (geteuid() == 0 && setuid(65534) != 0) _exit(126);
                                       }});
    std::filesystem::permissions(scratch / "out", std::filesystem::perms(0755));
    BOOST_TEST(outcome.status == 2, outcome.err);
    BOOST_TEST(has(outcome.err, "name a file elsewhere: --out FILE"), outcome.err);
    BOOST_TEST(!std::filesystem::exists(scratch / "out/view.html"));
}
