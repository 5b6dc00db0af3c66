// SPDX-License-Identifier: GPL-3.0-or-later
// No model holds another one to hand its functions on: a function that such a wrapper forgets falls back to
// the default without a word. What acts from outside is an external, laws add up as terms, and several
// populations are terms among parts of the particles. Looks at the classes themselves, in all sources.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

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

const std::string wrapper = R"(
class Halved final : public Model<2> {
  public:
    void rates(double t, Span y, Span y_dot) override { model_->rates(t, y, y_dot); }
    double reach() const override { return 1.0; }
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

BOOST_AUTO_TEST_CASE(no_model_holds_another) {
    int models = 0;
    for (const char* folder : {"include", "src", "problems"})  // models of tests may
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(SPAM_SOURCE) / folder)) {
            const auto extension = entry.path().extension();
            if (extension != ".hpp" && extension != ".cpp") continue;
            for (const Class& one : models_in(text_of(entry.path()))) {
                ++models;
                BOOST_TEST(!holds_a_model(one),
                           entry.path().string()
                               << ": " << one.name
                               << " holds a model; make it a term, an external, or terms among "
                                  "parts of the particles");
            }
        }
    BOOST_TEST(models >= 5);
}

BOOST_AUTO_TEST_CASE(a_wrapper_is_found) {
    const auto models = models_in(wrapper);
    BOOST_TEST_REQUIRE(models.size() == 2u);
    BOOST_TEST(holds_a_model(models[0]));
    BOOST_TEST(!holds_a_model(models[1]));
}
