// SPDX-License-Identifier: GPL-3.0-or-later
// A model that holds another model must hand on every virtual function of Model, or say why it does
// not: one that is forgotten falls back to the default without a word. Looks at the classes themselves,
// in all sources, so that a new wrapper or a new virtual function is found without being listed here.
//
// A function that is not handed on for a reason is named in a comment of the class:
//     // Not forwarded: events(). Particles that do not move never meet.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

std::string text_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string without_comments(const std::string& text) {
    static const std::regex comment("//[^\n]*");
    return std::regex_replace(text, comment, "");
}

/// From the first brace at or after `at` to the one that closes it.
std::string block_at(const std::string& text, std::size_t at) {
    const std::size_t open = text.find('{', at);
    if (open == std::string::npos) return {};
    int depth = 0;
    for (std::size_t k = open; k < text.size(); ++k) {
        depth += text[k] == '{' ? 1 : text[k] == '}' ? -1 : 0;
        if (depth == 0) return text.substr(open, k - open + 1);
    }
    return {};
}

/// A block without the blocks inside it: what a class declares.
std::string outer_level(const std::string& block) {
    std::string outer;
    int depth = 0;
    for (const char c : block) {
        if (c == '}') outer += --depth == 1 ? ";" : "";
        if (depth == 1 && c != '}') outer += c;
        if (c == '{') ++depth;
    }
    return outer;
}

struct Class {
    std::string name;
    std::string body;  ///< comments included
};

/// Classes that derive from a model.
std::vector<Class> models_in(const std::string& text) {
    static const std::regex head(
        "(?:class|struct)\\s+(\\w+)\\s*(?:final\\s*)?:\\s*(?:public\\s+)?(?:\\w+::)*\\w*Model\\b"
        "[^;{}]*\\{");
    std::vector<Class> all;
    for (std::sregex_iterator it(text.begin(), text.end(), head), end; it != end; ++it)
        all.push_back({(*it)[1], block_at(text, static_cast<std::size_t>(it->position()))});
    return all;
}

/// Whether a member of the class is a model, or holds or points at one.
bool holds_a_model(const Class& one) {
    static const std::regex member("^[^()=]*\\b\\w*Model\\b[^()=]*[\\s&*>]\\w+\\s*$");
    const std::string outer = outer_level(without_comments(one.body));
    for (std::size_t from = 0; from < outer.size();) {
        const std::size_t end = std::min(outer.find(';', from), outer.size());
        std::string line = outer.substr(from, end - from);
        from = end + 1;
        std::replace(line.begin(), line.end(), '\n', ' ');
        if (line.find("using ") != line.npos || line.find("friend ") != line.npos) continue;
        if (std::regex_match(line, member)) return true;
    }
    return false;
}

Names virtual_functions(const std::string& header) {
    static const std::regex declared("\\bvirtual\\s[^;{}]*?\\b(\\w+)\\s*\\(");
    const std::string text = without_comments(header);
    Names names;
    for (std::sregex_iterator it(text.begin(), text.end(), declared), end; it != end; ++it)
        if (text.substr(static_cast<std::size_t>(it->position()), 60).find('~') > 20)
            names.insert((*it)[1]);
    return names;
}

/// Functions that the class neither overrides with a call of the same function of what it holds, nor
/// names as not forwarded with a reason. `source`: the file, and the one of its definitions.
Names forgotten(const Class& one, const std::string& source, const Names& functions) {
    const std::string outer = outer_level(without_comments(one.body)),
                      code = without_comments(source);
    Names missing;
    for (const auto& name : functions) {
        const std::regex overridden("\\b" + name + "\\s*\\([^;]*\\boverride\\b"),
            forwarded("(?:->|\\.)" + name + "\\s*\\("),
            excused("Not forwarded: " + name + "\\(\\)\\. \\w[^\n]{10,}");
        const bool handed_on =
            std::regex_search(outer, overridden) && std::regex_search(code, forwarded);
        if (!handed_on && !std::regex_search(one.body, excused)) missing.insert(name);
    }
    return missing;
}

Names functions_of_model() {
    const auto path = fs::path(SPAM_SOURCE) / "include/spam/rhs/model.hpp";
    const std::string text = text_of(path);
    return virtual_functions(block_at(text, text.find("class Model")));
}

const std::string forgetful = R"(
class Halved final : public Model<2> {
  public:
    void rates(double t, Span y, Span y_dot) override { model_->rates(t, y, y_dot); }
    // Not forwarded: watch(). There is nothing to see here.
    double reach() const override { return 1.0; }  // model_->reach()
  private:
    std::unique_ptr<Model<2>> model_;
};
template <int Dim>
struct Whole final : spam::Model<Dim> {
    Whole(const Model<Dim>& start) : x_(start.x()) {}
    void rates(double t, Span y, Span y_dot) override;
    std::vector<double> x_;
};
)";

}  // namespace

BOOST_AUTO_TEST_CASE(wrappers_of_models_forward_every_virtual_function) {
    const Names functions = functions_of_model();
    BOOST_TEST(functions.size() >= 13u);
    for (const char* known : {"rates", "events", "watch", "fastest_damping", "remember"})
        BOOST_TEST(functions.contains(known), known);
    int wrappers = 0;
    for (const char* folder : {"include", "src", "problems"})  // models of tests may do less
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(SPAM_SOURCE) / folder)) {
            const auto extension = entry.path().extension();
            if (extension != ".hpp" && extension != ".cpp") continue;
            std::string source = text_of(entry.path());
            const auto models = models_in(source);
            if (models.empty()) continue;
            // include/spam/rhs/x.hpp is defined in src/rhs/x.cpp, any other beside itself
            std::string beside = fs::path(entry.path()).replace_extension(".cpp");
            if (const auto at = beside.find("include/spam"); at != beside.npos)
                beside.replace(at, 12, "src");
            if (extension == ".hpp" && fs::exists(beside)) source += text_of(beside);
            for (const Class& one : models) {
                if (!holds_a_model(one)) continue;
                ++wrappers;
                for (const auto& name : forgotten(one, source, functions))
                    BOOST_TEST(false, entry.path().string()
                                          << ": " << one.name << " holds a model and forgets "
                                          << name << "()");
            }
        }
    BOOST_TEST(wrappers >= 1);
}

BOOST_AUTO_TEST_CASE(a_forgetful_wrapper_is_found) {
    const auto models = models_in(forgetful);
    BOOST_TEST_REQUIRE(models.size() == 2u);
    BOOST_TEST(holds_a_model(models[0]));
    BOOST_TEST(!holds_a_model(models[1]));
    const auto missing = forgotten(models[0], forgetful, {"rates", "watch", "reach", "events"});
    BOOST_TEST((missing == Names{"reach", "events"}));
    BOOST_TEST((virtual_functions("struct A { virtual ~A() = default; virtual int f() const = 0;\n"
                                  "virtual std::vector<B> g(const C& c); int h(); };") ==
                Names{"f", "g"}));
}
