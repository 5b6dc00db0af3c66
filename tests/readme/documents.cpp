// SPDX-License-Identifier: GPL-3.0-or-later
// The documents say what is there: links and anchors lead somewhere, every picture is shown, every
// problem is in the gallery, and commands name problems and options that exist.
#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>
#include <sstream>

using namespace spam::test;
namespace fs = std::filesystem;
using Words = std::vector<std::string>;

namespace {

const fs::path root = SPAM_SOURCE;
const Words problems = split(SPAM_PROBLEM_NAMES, ',');

/// Documents and pictures of the project.
std::vector<fs::path> files_ending_in(const std::string& extension) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(root))
        if (entry.path().extension() == extension) found.push_back(entry.path());
    for (const char* folder : {".github", "include", "src", "problems", "tests"})
        for (const auto& entry : fs::recursive_directory_iterator(root / folder))
            if (entry.path().extension() == extension) found.push_back(entry.path());
    return found;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// What stands in `backquotes`, is indented by four, or fenced in a block without a language.
std::vector<std::string> code_of(const std::string& text) {
    static const std::regex span("`([^`]+)`");
    std::vector<std::string> code;
    bool fenced = false;
    for (const std::string& line : lines_of(text)) {
        if (line.starts_with("```")) {
            fenced = !fenced;
        } else if (line.starts_with("    ") && !fenced) {
            code.push_back(line.substr(4));
        } else if (!fenced) {
            for (std::sregex_iterator it(line.begin(), line.end(), span), end; it != end; ++it)
                code.push_back((*it)[1]);
        }
    }
    return code;
}

/// The anchor that a heading gets: small letters, hyphens for blanks, no punctuation.
std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (const char c : heading) {
        const auto u = static_cast<unsigned char>(c);
        if (c == ' ' || c == '-')
            anchor += '-';
        else if (std::isalnum(u) || c == '_' || u >= 128)
            anchor += static_cast<char>(std::tolower(u));
    }
    return anchor;
}

/// Words for persons that a text uses of particles and programs.
Words persons_in(const std::string& text) {
    static const std::regex person(
        "\\b([Ww]hoever|[Nn]obody|[Ss]omebody|[Aa]nybody|[Ee]verybody)\\b");
    Words found;
    for (std::sregex_iterator it(text.begin(), text.end(), person), end; it != end; ++it)
        found.push_back((*it)[1]);
    return found;
}

std::set<std::string> anchors_of(const fs::path& document) {
    std::set<std::string> anchors;
    for (const std::string& line : lines_of(contents_of(document)))
        if (line.starts_with("#"))
            anchors.insert(anchor_of(line.substr(line.find_first_not_of("# "))));
    return anchors;
}

/// Targets of links and pictures that lead nowhere from `folder`.
Words broken_links(const std::string& text, const fs::path& document) {
    static const std::regex link("\\]\\(([^)#\\s]*)(#[^)\\s]*)?\\)");
    Words broken;
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
        const std::string path = (*it)[1], anchor = (*it)[2];
        if (path.starts_with("http")) continue;
        const fs::path target = path.empty() ? document : document.parent_path() / path;
        if (!fs::exists(target) ||
            (!anchor.empty() && !anchors_of(target).contains(anchor.substr(1))))
            broken.push_back(path + anchor);
    }
    return broken;
}

/// Documents that a source names and that the repository does not hold.
Words absent_documents(const std::string& text) {
    static const std::regex name("[A-Za-z0-9_][A-Za-z0-9_/-]*\\.md\\b(?!\\()");
    Words absent;
    for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it)
        if (!fs::exists(root / it->str())) absent.push_back(it->str());
    return absent;
}

/// Option names without values, by problem, as --help lists them.
std::map<std::string, std::set<std::string>> options_of_problems() {
    static const std::regex option("--([a-z0-9-]+)");
    std::map<std::string, std::set<std::string>> all;
    for (const auto& name : problems) {
        const Outcome help = Child(problem(name, {"--help"}), {}).finish(Child::Seconds(60));
        BOOST_TEST_REQUIRE(help.status == 0);
        for (std::sregex_iterator it(help.out.begin(), help.out.end(), option), end; it != end;
             ++it)
            all[name].insert((*it)[1]);
    }
    return all;
}

Words words_of(const std::string& code) {
    std::istringstream in(code);
    Words words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

/// What the front door understands: its own verbs, and those that have a file.
std::set<std::string> verbs_of_spam() {
    std::set<std::string> verbs{"run", "view", "list", "help", "--version", "..."};
    for (const auto& entry : fs::directory_iterator(root / "src/front_door/verbs"))
        verbs.insert(entry.path().stem().string());
    return verbs;
}

/// What a piece of code names that does not exist: a verb of ./spam, a problem, an option of it (of any
/// problem where none is named).
Words unknown_in(const std::string& code,
                 const std::map<std::string, std::set<std::string>>& options) {
    static const std::set<std::string> verbs = verbs_of_spam();
    Words words = words_of(code), unknown;
    if (words.empty()) return {};
    if (words[0] == "./spam") {
        if (words.size() > 1 && words[1] != "run") {
            if (!verbs.contains(words[1])) unknown.push_back(code);
            return unknown;
        }
        words.erase(words.begin(), words.begin() + std::min<long>(2, long(words.size())));
        if (words.empty() || words[0].starts_with("<") || words[0] == "...") return {};
        if (!options.contains(words[0])) return {code};
    }
    const bool named = options.contains(words[0]);
    if (!named && !words[0].starts_with("--")) return {};
    if (words[0] == "--no-install") return {};  // of ./spam
    for (const std::string& word : words) {
        if (!word.starts_with("--")) continue;
        const std::string name = word.substr(2, word.find_first_of("=,") - 2);
        const bool known =
            named ? options.at(words[0]).contains(name)
                  : std::any_of(options.begin(), options.end(),
                                [&](const auto& one) { return one.second.contains(name); });
        if (!known) unknown.push_back(code + ": --" + name);
    }
    return unknown;
}

}  // namespace

BOOST_AUTO_TEST_CASE(links_and_anchors_lead_somewhere) {
    const auto documents = files_ending_in(".md");
    BOOST_TEST(documents.size() > 5U);
    for (const auto& document : documents)
        for (const auto& target : broken_links(contents_of(document), document))
            BOOST_TEST(false, document << ": no " << target);
}

BOOST_AUTO_TEST_CASE(sources_cite_documents_that_exist) {
    std::size_t sources = 0;
    for (const char* extension : {".hpp", ".cpp", ".cmake"})
        for (const auto& source : files_ending_in(extension)) {
            ++sources;
            if (source.filename() == "documents.cpp") continue;  // has wrong ones, see below
            for (const auto& name : absent_documents(contents_of(source)))
                BOOST_TEST(false, source << ": no " << name);
        }
    BOOST_TEST(sources > 100U);
}

BOOST_AUTO_TEST_CASE(particles_and_programs_are_not_called_persons) {
    for (const auto& document : files_ending_in(".md"))
        for (const auto& word : persons_in(contents_of(document)))
            BOOST_TEST(false, document << ": '" << word << "'");
    for (const char* ending : {".hpp", ".cpp"})
        for (const auto& source : files_ending_in(ending))
            for (const std::string& line : lines_of(contents_of(source)))
                if (const auto comment = line.find("//"); comment != std::string::npos)
                    for (const auto& word : persons_in(line.substr(comment)))
                        BOOST_TEST(false, source << ": '" << word << "' in: " << line);
}

BOOST_AUTO_TEST_CASE(every_picture_is_shown) {
    std::string all;
    for (const auto& document : files_ending_in(".md")) all += contents_of(document);
    const auto pictures = files_ending_in(".png");
    BOOST_TEST(pictures.size() > 5U);
    for (const auto& picture : pictures)
        BOOST_TEST((all.find(picture.filename().string() + ")") != std::string::npos),
                   picture << " is shown nowhere");
}

BOOST_AUTO_TEST_CASE(every_problem_is_in_the_gallery) {
    const auto code = code_of(contents_of(root / "problems/README.md"));
    for (const auto& name : problems)
        BOOST_TEST(std::any_of(code.begin(), code.end(),
                               [&](const std::string& piece) {
                                   const Words words = words_of(piece);
                                   return std::find(words.begin(), words.end(), name) !=
                                          words.end();
                               }),
                   "problems/README.md does not show " << name);
}

BOOST_AUTO_TEST_CASE(commands_name_what_exists) {
    auto options = options_of_problems();
    options["my_plate"];  // what README.md adds to the problems
    options["spam-view"] = {"out", "max-mb", "open"};
    std::size_t commands = 0;
    for (const auto& document : files_ending_in(".md"))
        for (const std::string& code : code_of(contents_of(document))) {
            commands += code.starts_with("./spam run") ? 1 : 0;
            for (const std::string& what : unknown_in(code, options))
                BOOST_TEST(false, document << ": " << what);
        }
    BOOST_TEST(commands > 5U);
}

BOOST_AUTO_TEST_CASE(the_checks_can_fail) {
    const fs::path document = root / "README.md";
    BOOST_TEST(broken_links("[a](nowhere.md) [b](src/README.md#rooms)", document).size() == 1U);
    BOOST_TEST(broken_links("[a](src/README.md#no-such-heading)", document).size() == 1U);
    BOOST_TEST(absent_documents("as README.md and notes.md say").size() == 1U);
    BOOST_TEST(persons_in("Whoever is near, and nobody's neighbours").size() == 2U);
    BOOST_TEST(anchor_of("Sources, licence, how to cite") == "sources-licence-how-to-cite");
    const std::map<std::string, std::set<std::string>> options{{"drop", {"cells"}}};
    BOOST_TEST(unknown_in("./spam run drop --cells 3", options).empty());
    BOOST_TEST(unknown_in("./spam run drip", options).size() == 1U);
    BOOST_TEST(unknown_in("./spam fun", options).size() == 1U);
    BOOST_TEST(unknown_in("drop --cell 3", options).size() == 1U);
    BOOST_TEST(unknown_in("--cell", options).size() == 1U);
    BOOST_TEST(code_of("say `drop --cells` or\n\n    ./spam list\n").size() == 2U);
}
