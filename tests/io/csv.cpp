// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of comma-separated cells: what is written reads back, and what cannot be read is refused by file,
// line and column.
#include "support/refusal.hpp"
#include <spam/core/error.hpp>
#include <spam/io/csv.hpp>
#include <spam/io/study_table.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;

namespace {

const CsvRules of_runs{.option = "out", .remedy = "begin anew", .whole = true};
const CsvRules by_hand{.option = "outline", .remedy = "write two numbers, x,y", .free = true};

/// The message of what is refused in rows of numbers under a header.
std::string refusal(const std::string& text, const CsvRules& rules) {
    return test::refusal([&] {
        CsvReader rows(text, "a.csv", rules);
        if (rows.next()) rows.keep_as_header();
        while (rows.next())
            for (std::size_t c = 0; c < rows.cells().size(); ++c) (void)rows.number(c);
    });
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_line_of_csv_reads_back) {
    const std::vector<std::string> cells{"plain", "a,b", "say \"yes\"", "", "two\nlines"};
    std::string line = csv_line(cells);
    BOOST_TEST(line.back() == '\n');
    line.pop_back();
    const auto back = csv_cells(line);
    BOOST_TEST_REQUIRE(back.size() == cells.size());
    for (std::size_t k = 0; k + 1 < cells.size(); ++k) BOOST_TEST(back[k] == cells[k]);
    BOOST_TEST(back.back() == "two lines");
}

BOOST_AUTO_TEST_CASE(a_table_of_numbers_reads_back) {
    CsvReader rows("t,energy\n0,1.5\n1,\n2,-2e-300\n3,0.", "a.csv", of_runs);
    BOOST_TEST_REQUIRE(rows.next());
    rows.keep_as_header();
    BOOST_TEST(rows.names()[1] == "energy");
    std::vector<double> t, energy;
    while (rows.next()) {
        t.push_back(rows.number(0));
        energy.push_back(rows.number(1));
    }
    // The half row of a writer that was killed is none.
    BOOST_TEST_REQUIRE(t.size() == 3U);
    BOOST_TEST(rows.line() == 4);
    BOOST_TEST(energy[0] == 1.5);
    BOOST_TEST(std::isnan(energy[1]));
    BOOST_TEST(energy[2] == -2e-300);
}

BOOST_AUTO_TEST_CASE(a_refusal_names_file_line_and_column) {
    BOOST_TEST(refusal("t,energy\n0,1\n1,one\n", of_runs) ==
               "out: 'a.csv' line 3: column energy: 'one' is no number; begin anew");
    BOOST_TEST(refusal("t,energy\n0,1,2\n", of_runs) ==
               "out: 'a.csv' line 2: has 3 cells in place of 2; begin anew");
    BOOST_TEST(refusal("t,energy\n0\n", of_runs) ==
               "out: 'a.csv' line 2: has 1 cells in place of 2; begin anew");
    for (const char* word : {"inf", "nan", "1e999", "0x1p", "1 2", "\"1\"\"\""})
        BOOST_TEST(refusal(std::string("t\n0\n") + word + "\n", of_runs).find("line 3: column t") !=
                   std::string::npos);
    BOOST_TEST(refusal("t,energy\n0,1\n1,2\n", of_runs) == "accepted");
}

BOOST_AUTO_TEST_CASE(tables_by_hand_may_have_blanks_and_comments) {
    for (const char* line : {"1,2", "1 2", " 1 , 2 ", "1\t2", "1 ,2", "1, 2\r"}) {
        CsvReader rows(std::string("# corners\n\n") + line, "a.csv", by_hand);
        BOOST_TEST_REQUIRE(rows.next());
        BOOST_TEST(rows.line() == 3);
        BOOST_TEST_REQUIRE(rows.cells().size() == 2U);
        BOOST_TEST(rows.number(0) == 1.0);
        BOOST_TEST(rows.number(1) == 2.0);
        BOOST_TEST(!rows.next());
    }
    for (const char* line : {"1 2 3", "1,,2", "1,2,", ",1,2"}) {
        CsvReader rows(line, "a.csv", by_hand);
        BOOST_TEST(rows.next());
        BOOST_TEST(rows.cells().size() == 3U);
    }
    CsvReader empty("1,\n", "a.csv", by_hand);
    BOOST_TEST(empty.next());
    BOOST_CHECK_THROW((void)empty.number(1), InputError);
}

BOOST_AUTO_TEST_CASE(numbers_of_studies_are_found_by_name) {
    const std::vector<std::string> columns{"case", "turns", "error"};
    const StudyTable::Row row{"one", "12.5", ""};
    BOOST_TEST(number_of(row, columns, "turns") == 12.5);
    BOOST_TEST(std::isnan(number_of(row, columns, "error")));
    BOOST_CHECK_THROW(cell_of(row, columns, "seconds"), std::out_of_range);
    BOOST_CHECK_EXCEPTION(
        (void)number_of(row, columns, "case"), InputError, [](const InputError& error) {
            return std::string(error.what()).find("row 'one': 'one' is no number") !=
                   std::string::npos;
        });
}
