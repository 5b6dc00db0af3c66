// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that are computed row by row and survive being stopped.
#include "support/process.hpp"
#include "support/refusal.hpp"
#include <spam/core/error.hpp>
#include <spam/io/csv.hpp>
#include <spam/io/study_table.hpp>

#include <boost/test/unit_test.hpp>

#include <atomic>

using namespace spam;
using spam::test::contents_of;
using spam::test::Scratch;

namespace {

const std::vector<std::string> columns{"name", "square", "words"};

/// Rows 0 to n - 1; `computed` counts; `limit` of them can be computed before a signal comes.
std::vector<StudyTask> squares(int n, std::atomic<int>& computed, int limit = 1000) {
    std::vector<StudyTask> tasks;
    for (int k = 0; k < n; ++k)
        tasks.push_back({"row " + std::to_string(k),
                         [k, &computed, limit]() -> std::optional<std::vector<std::string>> {
                             if (computed >= limit) return {};
                             ++computed;
                             return std::vector<std::string>{std::to_string(k * k),
                                                             "with, comma and \"marks\""};
                         }});
    return tasks;
}

struct Folder : Scratch {
    RunFolder folder = RunFolder::reopen(path());
    std::string text(const char* name) const { return contents_of(path() / name); }
    bool has(const char* name) const { return std::filesystem::exists(path() / name); }
};

void ignore(std::size_t) {}

/// Leaves a study of which so many rows are known.
void begin(const Folder& f, int rows) {
    std::atomic<int> computed{0};
    StudyTable(f.folder, "study", columns).run(squares(rows + 1, computed, rows), 1, ignore);
}

/// What the table says when it is read.
std::string refusal(const Folder& f) {
    return test::refusal([&] { StudyTable(f.folder, "study", columns); });
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_whole_study_leaves_one_table_in_order) {
    const Folder f;
    std::atomic<int> computed{0};
    const auto tasks = squares(20, computed);
    StudyTable table(f.folder, "study", columns);
    BOOST_TEST(table.run(tasks, 2, ignore));
    BOOST_TEST(computed == 20);
    BOOST_TEST(!f.has("study.part.csv"));
    std::string expected = csv_line(columns);
    for (int k = 0; k < 20; ++k)
        expected += csv_line(
            {"row " + std::to_string(k), std::to_string(k * k), "with, comma and \"marks\""});
    BOOST_TEST(f.text("study.csv") == expected);
}

BOOST_AUTO_TEST_CASE(a_stopped_study_goes_on_and_repeats_nothing) {
    const Folder f;
    std::atomic<int> computed{0}, more{0};
    {
        StudyTable table(f.folder, "study", columns);
        BOOST_TEST(!table.run(squares(20, computed, 7), 2, ignore));
        BOOST_TEST(!f.has("study.csv"));
        BOOST_TEST(StudyTable::unfinished(f.path(), "study"));
    }
    const int before = computed;
    StudyTable table(f.folder, "study", columns);
    BOOST_TEST(table.known() == static_cast<std::size_t>(before));
    BOOST_TEST(table.run(squares(20, more), 2, ignore));
    BOOST_TEST(more + before == 20);
    BOOST_TEST(!StudyTable::unfinished(f.path(), "study"));
    BOOST_TEST(table.rows(squares(20, more)).size() == 20u);
}

BOOST_AUTO_TEST_CASE(a_torn_last_line_does_not_count) {
    for (const char* torn : {"row 3,9", "row 3,9,words without an end", "row 3,9,\"open", "\n"}) {
        const Folder f;
        begin(f, 1);
        f.write("study.part.csv", f.text("study.part.csv") + torn);
        std::atomic<int> computed{0};
        StudyTable table(f.folder, "study", columns);
        BOOST_TEST(table.known() == 1u, "after '" << torn << "'");
        BOOST_TEST(table.run(squares(5, computed), 1, ignore));
        BOOST_TEST(computed == 4);
        BOOST_TEST(f.text("study.csv").find("\nrow 0,0,") != std::string::npos);
    }
}

BOOST_AUTO_TEST_CASE(an_empty_or_torn_header_begins_anew) {
    for (const char* text : {"", "name,squ"}) {
        const Folder f;
        f.write("study.part.csv", text);
        StudyTable table(f.folder, "study", columns);
        BOOST_TEST(table.known() == 0u);
        BOOST_TEST(f.text("study.part.csv") == "name,square,words,check\n");
    }
}

BOOST_AUTO_TEST_CASE(a_table_with_other_columns_is_refused) {
    const Folder f;
    f.write("study.part.csv", "name,cube\n");
    BOOST_CHECK_THROW(StudyTable(f.folder, "study", columns), InputError);
    BOOST_TEST(f.text("study.part.csv") == "name,cube\n");
}

BOOST_AUTO_TEST_CASE(a_damaged_table_is_refused_with_line_and_column) {
    const Folder f;
    begin(f, 4);
    const std::string whole = f.text("study.part.csv");
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = whole;
        text.replace(text.find(from), from.size(), to);
        f.write("study.part.csv", text);
        const std::string why = refusal(f);
        BOOST_TEST(why.find("study.part.csv") != std::string::npos, why);
        BOOST_TEST(f.text("study.part.csv") == text);
        return why;
    };
    BOOST_TEST(changed("row 2,4,", "row 2,x,").find("line 4: column 'square'") !=
               std::string::npos);
    BOOST_TEST(changed("row 1,1,", "row 1,,").find("line 3: column 'square'") != std::string::npos);
    BOOST_TEST(changed("row 3,9,", "row 3,9,9,").find("line 5: column 'words'") !=
               std::string::npos);
    BOOST_TEST(changed("row 0,", "row 7,").find("line 2: column 'name'") != std::string::npos);
    BOOST_TEST(changed("row 2", "row 2\n").find("line 4") != std::string::npos);
    BOOST_TEST(changed(",square", ",sqare").find("line 1: has other columns") != std::string::npos);
    const std::string line = whole.substr(whole.find("row 1"));
    f.write("study.part.csv", whole + line);
    BOOST_TEST(refusal(f).find("line 6: holds 'row 1' a second time") != std::string::npos);
}

/// Whatever a byte becomes: a row that is taken is one that was written, or the file is refused and left.
BOOST_AUTO_TEST_CASE(no_changed_byte_of_a_table_is_believed) {
    const Folder f;
    begin(f, 3);
    std::atomic<int> computed{0};
    const auto tasks = squares(3, computed);
    const auto rows = StudyTable(f.folder, "study", columns).rows(tasks);
    const std::string whole = f.text("study.part.csv");
    std::size_t refused = 0, tried = 0;
    for (std::size_t k = 0; k < whole.size(); ++k)
        for (const char* in_place : {"", "0", "7", "a", ",", "\"", "\n", " ", "\xff"}) {
            std::string text = whole;
            text.replace(k, 1, in_place);
            if (text == whole) continue;
            ++tried;
            f.write("study.part.csv", text);
            try {
                const StudyTable table(f.folder, "study", columns);
                for (const auto& row : table.rows(tasks))
                    BOOST_TEST((std::find(rows.begin(), rows.end(), row) != rows.end()),
                               "byte " << k << " as '" << in_place << "' is believed");
            } catch (const InputError&) {
                ++refused;
                BOOST_TEST(f.text("study.part.csv") == text);
            }
        }
    BOOST_TEST(refused > tried * 19 / 20);  // the others tear the last line
}

BOOST_AUTO_TEST_CASE(an_exception_of_a_task_ends_the_study_with_its_rows_kept) {
    const Folder f;
    std::atomic<int> computed{0};
    auto tasks = squares(10, computed);
    tasks[4].compute = []() -> std::optional<std::vector<std::string>> {
        throw InputError("this one cannot be done");
    };
    StudyTable table(f.folder, "study", columns);
    BOOST_CHECK_THROW(table.run(tasks, 1, ignore), InputError);
    BOOST_TEST(table.known() == 4u);
    BOOST_TEST(StudyTable(f.folder, "study", columns).known() == 4u);
}

BOOST_AUTO_TEST_CASE(so_does_an_exception_where_progress_is_reported) {
    const Folder f;
    std::atomic<int> computed{0};
    StudyTable table(f.folder, "study", columns);
    const auto full = [](std::size_t) { throw OutputError("cannot write 'run.log'"); };
    BOOST_CHECK_THROW(table.run(squares(10, computed), 2, full), OutputError);
}
