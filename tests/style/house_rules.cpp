// SPDX-License-Identifier: GPL-3.0-or-later
// Rules of the house that a compiler does not check: a room includes only rooms before it, SUNDIALS
// is called in two places, every source carries its licence, files stay readable.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> rooms{"core",    "processes", "kernel", "material",  "neighbors",
                                     "physics", "external",  "rhs",    "integrate", "diagnostics",
                                     "setup",   "analysis",  "io",     "picture",   "problem",
                                     "study",   "view",      "python"};

/// kernel and material are neighbours on one floor: both include only core.
/// integrate knows vectors and callables, not particles: core, and processes for the signals of a run on several.
const std::map<std::string, std::set<std::string>> special{
    {"kernel", {"core"}}, {"material", {"core"}}, {"integrate", {"core", "processes"}}};

bool is_room(const std::string& name) {
    return std::find(rooms.begin(), rooms.end(), name) != rooms.end();
}

bool allowed(const std::string& from, const std::string& to) {
    if (from == to) return true;
    if (const auto it = special.find(from); it != special.end()) return it->second.contains(to);
    const auto level = [](const std::string& r) {
        return std::find(rooms.begin(), rooms.end(), r);
    };
    return level(to) < level(from);
}

/// What others wrote stays as they wrote it.
bool is_from_elsewhere(const fs::path& path) { return path.parent_path().filename() == "vendor"; }

std::vector<fs::path> sources(const std::vector<std::string>& folders) {
    std::vector<fs::path> result;
    for (const auto& folder : folders)
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(SPAM_SOURCE) / folder))
            if (const auto e = entry.path().extension();
                e == ".hpp" || e == ".cpp" || e == ".py" || e == ".pyi" ||
                (e == ".js" && !is_from_elsewhere(entry.path())))
                result.push_back(entry.path());
    return result;
}

std::vector<std::string> lines_of(const fs::path& path) {
    std::ifstream in(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

bool is_cpp(const fs::path& path) {
    return path.extension() == ".hpp" || path.extension() == ".cpp";
}

/// The room a file of include/spam or src lives in, empty outside.
std::string room_of(const fs::path& path) {
    const auto relative = fs::relative(path, SPAM_SOURCE).generic_string();
    static const std::regex pattern("^(?:include/spam|src)/([a-z]+)/.*");
    std::smatch match;
    return std::regex_match(relative, match, pattern) ? match[1].str() : std::string{};
}

/// Includes of `lines` that break the direction, for a file of `room`.
std::vector<std::string> wrong_includes(const std::string& room,
                                        const std::vector<std::string>& lines) {
    static const std::regex pattern(
        "^\\s*#\\s*include\\s*[<\"](?:(?:\\.\\./)+(?:src/|include/)?)?(?:spam/)?([a-z]+)/.*");
    std::vector<std::string> wrong;
    std::smatch match;
    for (const auto& line : lines)
        if (std::regex_match(line, match, pattern) && is_room(match[1]) && !allowed(room, match[1]))
            wrong.push_back(line);
    return wrong;
}

}  // namespace

BOOST_AUTO_TEST_CASE(rooms_include_only_rooms_before_them) {
    int checked = 0;
    for (const auto& path : sources({"include", "src"})) {
        const auto room = room_of(path);
        if (room.empty() || !is_cpp(path)) continue;  // tools in other languages include nothing
        BOOST_TEST(is_room(room), path << " is in no known room");
        for (const auto& line : wrong_includes(room, lines_of(path)))
            BOOST_TEST(false, path << ": " << room << " must not know: " << line);
        ++checked;
    }
    BOOST_TEST(checked > 40);
}

BOOST_AUTO_TEST_CASE(the_direction_check_can_fail) {
    BOOST_TEST(wrong_includes("core", {"#include <spam/kernel/lucy.hpp>"}).size() == 1U);
    BOOST_TEST(wrong_includes("integrate", {"#include <spam/rhs/model.hpp>"}).size() == 1U);
    BOOST_TEST(wrong_includes("material", {"#include \"spam/kernel/lucy.hpp\""}).size() == 1U);
    BOOST_TEST(wrong_includes("core", {"#include \"../rhs/sweeps.hpp\""}).size() == 1U);
    BOOST_TEST(wrong_includes("core", {"#include \"../../src/rhs/sweeps.hpp\""}).size() == 1U);
    BOOST_TEST(wrong_includes("rhs", {"#include <spam/physics/record.hpp>"}).empty());
    BOOST_TEST(wrong_includes("rhs", {"#include \"../core/levels.hpp\""}).empty());
    BOOST_TEST(wrong_includes("core", {"#include <sundials/sundials_types.h>"}).empty());
}

BOOST_AUTO_TEST_CASE(mpi_is_called_in_one_place) {
    static const std::regex pattern("^\\s*#\\s*include\\s*<mpi\\.h>.*");
    std::size_t places = 0;
    for (const auto& path : sources({"include", "src", "problems"}))
        for (const auto& line : lines_of(path))
            if (std::regex_match(line, pattern)) {
                ++places;
                BOOST_TEST(fs::relative(path, SPAM_SOURCE).generic_string() ==
                           "src/processes/mpi/mpi_processes.cpp");
            }
    BOOST_TEST(places == 1U);
}

BOOST_AUTO_TEST_CASE(sundials_is_called_in_two_places) {
    static const std::regex pattern(
        "^\\s*#\\s*include\\s*<(sundials|nvector|arkode|cvode|sunmatrix|sunlinsol|sunnonlinsol)/"
        ".*");
    for (const auto& path : sources({"include", "src", "problems"})) {
        const auto relative = fs::relative(path, SPAM_SOURCE).generic_string();
        if (room_of(path) == "integrate" || relative.find("core/nvector") != std::string::npos)
            continue;
        for (const auto& line : lines_of(path))
            BOOST_TEST(!std::regex_match(line, pattern), relative << ": " << line);
    }
}

namespace {

/// Sums that depend on the order of their terms. Those over a particle's neighbours, over laws or walls have names of
/// what they are the sum of.
bool is_plain_sum(const std::string& line) {
    static const std::regex declared(
        "double [^;(]*\\b(sum|sums|total|squares|inertia)\\b[^;(]* = 0(\\.0)?[;,].*"),
        called("std::(accumulate|reduce)\\(.*0\\.0|reduction\\(|wise\\(\\)\\.(sum|mean)\\(");
    return std::regex_search(line, declared) || std::regex_search(line, called);
}

}  // namespace

BOOST_AUTO_TEST_CASE(sums_over_particles_are_exact) {
    // Not over particles (neighbours of a point, points of a fit, blocks of y, whole numbers), or once at set-up.
    const std::set<std::string> others{"src/diagnostics/field_interpolation.cpp",
                                       "src/diagnostics/convergence.cpp",
                                       "src/integrate/error_shares.cpp",
                                       "src/core/exact_sum_digits.lanes.cpp",
                                       "src/diagnostics/outline.cpp",
                                       "src/study/example_systems.cpp",
                                       "include/spam/setup/lattices.hpp"};
    const std::set<std::string> rooms_with_sums{"core",        "external", "rhs",  "integrate",
                                                "diagnostics", "setup",    "study"};
    for (const auto& path : sources({"include", "src"})) {
        const auto relative = fs::relative(path, SPAM_SOURCE).generic_string();
        if (!rooms_with_sums.contains(room_of(path)) || others.contains(relative)) continue;
        for (const auto& line : lines_of(path))
            BOOST_TEST(!is_plain_sum(line), relative << ": take an ExactSum: " << line);
    }
    BOOST_TEST(is_plain_sum("    double mass = 0.0, inertia = 0.0;"));
    BOOST_TEST(is_plain_sum("    motion.from = from.rowwise().mean();"));
    BOOST_TEST(is_plain_sum("    return std::accumulate(mass.begin(), mass.end(), 0.0);"));
    BOOST_TEST(!is_plain_sum("    double energy = 0.0;"));
}

namespace {

/// What only the room `neighbors` does: make lists that right-hand sides sweep, find nearest images, refresh images.
bool is_of_neighbors(const std::string& line) {
    static const std::regex does(
        R"(ClusterList<\w+> +\w+[;({_]|<ClusterList<|nearest_image\(|\blist\w*\.refresh\()");
    return std::regex_search(line, does);
}

}  // namespace

BOOST_AUTO_TEST_CASE(lists_and_images_belong_to_neighbors) {
    // Has a list whose skin follows the steps, and no records.
    const std::set<std::string> others{"include/spam/physics/closest_approach.hpp",
                                       "src/physics/closest_approach.cpp"};
    for (const auto& path : sources({"include", "src", "problems"})) {
        const auto relative = fs::relative(path, SPAM_SOURCE).generic_string();
        if (room_of(path) == "neighbors" || others.contains(relative)) continue;
        for (const auto& line : lines_of(path))
            BOOST_TEST(!is_of_neighbors(line), relative << ": " << line);
    }
    BOOST_TEST(is_of_neighbors("    ClusterList<Dim> list_;"));
    BOOST_TEST(is_of_neighbors("    ClusterList<2> list(range, 0.0, box, 1);"));
    BOOST_TEST(is_of_neighbors("    list_.refresh(records.data(), kinds, from);"));
    BOOST_TEST(is_of_neighbors("    r[a] = box.nearest_image(a, r[a]);"));
    BOOST_TEST(!is_of_neighbors("    const ClusterList<Dim>& list = this->list();"));
}

// What else a law is, it says as data (Term::Nature).
BOOST_AUTO_TEST_CASE(a_law_has_at_most_eight_functions) {
    static const std::regex function("^\\s*virtual (?!~)");
    int functions = 0;
    for (const auto& line : lines_of(fs::path(SPAM_SOURCE) / "include/spam/rhs/term.hpp"))
        functions += std::regex_search(line, function) ? 1 : 0;
    BOOST_TEST(functions >= 2);
    BOOST_TEST(functions <= 8);
}

BOOST_AUTO_TEST_CASE(every_source_carries_its_licence) {
    for (const auto& path : sources({"include", "src", "problems", "tests"})) {
        const auto lines = lines_of(path);
        const auto e = path.extension();
        const std::string comment = e == ".py" || e == ".pyi" ? "#" : "//";
        BOOST_TEST((!lines.empty() &&
                    lines.front() == comment + " SPDX-License-Identifier: GPL-3.0-or-later"),
                   path << " lacks its SPDX line");
    }
}

/// Columns of a line of UTF-8.
std::ptrdiff_t columns(const std::string& line) {
    return std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; });
}

// clang-format breaks code, and leaves lines of comments as they are.
BOOST_AUTO_TEST_CASE(comments_stay_within_their_columns) {
    BOOST_TEST(columns("// \u03b3t") == 5);
    for (const auto& path : sources({"include", "src", "problems", "tests"})) {
        const auto lines = lines_of(path);
        for (std::size_t k = 0; k < lines.size(); ++k)
            if (is_cpp(path) && lines[k].find_first_not_of(' ') == lines[k].find("//"))
                BOOST_TEST(columns(lines[k]) <= 120, path << ':' << k + 1);
    }
}

BOOST_AUTO_TEST_CASE(files_stay_readable) {
    for (const auto& path : sources({"include", "src", "problems", "tests"}))
        BOOST_TEST(lines_of(path).size() <= 350U, path << " is longer than 350 lines");
    const auto front = lines_of(fs::path(SPAM_SOURCE) / "README.md").size();
    BOOST_TEST(front <= 150U, "README.md has " << front << " lines: more than five minutes");
}

/// One that no list names is never built, and nothing fails.
BOOST_AUTO_TEST_CASE(every_test_is_in_a_list) {
    std::string lists;
    for (const char* file : {"tests/tests.cmake", "tests/problem/tests.cmake"})
        for (const auto& line : lines_of(fs::path(SPAM_SOURCE) / file)) lists += line + "\n";
    for (const auto& path : sources({"tests"})) {
        const auto lines = lines_of(path);
        if (path.extension() != ".cpp" || std::ranges::none_of(lines, [](const auto& line) {
                return line.starts_with("BOOST_AUTO_TEST_CASE");
            }))
            continue;
        const std::string room = path.parent_path().filename(), name = path.stem();
        const std::regex listed("(" + room + "/|foreach\\(test [^)]*)" + name + "[^a-z0-9_]");
        BOOST_TEST(std::regex_search(lists, listed), room << "/" << name << " is in no list");
    }
}
