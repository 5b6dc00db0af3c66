// SPDX-License-Identifier: GPL-3.0-or-later
// What spam-view reads of a result folder is what the library wrote into it; whatever the bytes of a
// snapshot are, reading ends with numbers or with one line.
#include "support/element_mesh.hpp"
#include "support/refusal.hpp"
#include "view/results.hpp"
#include "written_run.hpp"
#include <spam/core/error.hpp>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace spam;
using spam::test::Scratch;
using spam::test::WrittenRun;

namespace {

const view::FieldArray& field(const std::vector<view::FieldArray>& fields,
                              const std::string& name) {
    const auto it = std::find_if(fields.begin(), fields.end(),
                                 [&](const auto& one) { return one.name == name; });
    if (it == fields.end()) throw std::runtime_error("no " + name);
    return *it;
}

/// Place of every particle of the model in the order of ids.
std::vector<std::size_t> places(const Model<2>& model) {
    std::vector<std::size_t> place(model.particles().size());
    const auto& id = model.particles().id;
    for (std::size_t i = 0; i < place.size(); ++i)
        place[i] = static_cast<std::size_t>(
            std::count_if(id.begin(), id.end(), [&](auto other) { return other < id[i]; }));
    return place;
}

std::string refusal(const std::filesystem::path& folder) {
    return test::refusal([&] { view::read_results(folder); });
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

}  // namespace

BOOST_AUTO_TEST_CASE(snapshots_are_read_as_they_were_written) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 3);
    const view::Results results = view::read_results(scratch / "out");
    BOOST_TEST_REQUIRE(results.cases.size() == 1U);
    BOOST_TEST(results.dimensions == 2);
    const auto& snapshots = results.cases[0].snapshots;
    BOOST_TEST_REQUIRE(snapshots.size() == 3U);
    const Model<2>& model = *run.system->model;
    const auto place = places(model);
    const std::size_t n = place.size();
    for (std::size_t k = 0; k < 3; ++k) {
        const ConstState<2> state(model.layout(), run.states[k]);
        BOOST_TEST(snapshots[k].t == static_cast<double>(k));
        BOOST_TEST(std::is_sorted(snapshots[k].id.begin(), snapshots[k].id.end()));
        const auto& x = field(snapshots[k].points, "position");
        const auto& v = field(snapshots[k].points, "velocity");
        const auto& sigma = field(snapshots[k].points, "stress");
        BOOST_TEST_REQUIRE((x.components == 2 && sigma.components == 3));
        for (std::size_t i = 0; i < n; ++i) {
            const auto column = static_cast<Eigen::Index>(i);
            for (Eigen::Index c = 0; c < 2; ++c) {
                const std::size_t at = static_cast<std::size_t>(c) * n + place[i];
                BOOST_TEST(x.values[at] == static_cast<float>(state.position()(c, column)));
                BOOST_TEST(v.values[at] == static_cast<float>(state.velocity()(c, column)));
            }
            for (int a = 0, c = 0; a < 2; ++a)
                for (int b = a; b < 2; ++b, ++c)
                    BOOST_TEST(
                        sigma.values[static_cast<std::size_t>(c) * n + place[i]] ==
                        static_cast<float>(state.stress()(symmetric_index(2, a, b), column)));
        }
    }
    const view::Table& rows = results.cases[0].invariants;
    BOOST_TEST_REQUIRE(rows.names.size() == 3U);
    BOOST_TEST(rows.columns[0][2] == 2.0);
    BOOST_TEST(rows.columns[1][1] == 0.5);
    BOOST_TEST(std::isnan(rows.columns[2][1]));
    BOOST_TEST(results.checks.size() == 1U);
}

BOOST_AUTO_TEST_CASE(elements_have_their_corners_and_fields) {
    const Scratch scratch;
    const auto model = test::model_of({test::distorted_mesh(4, 3)}, test::elastic);
    const auto y = test::random_elements(*model, 0.1);
    {
        const RunFolder folder(scratch / "out", false);
        const UnitNames named{.length = "mm", .mass = "g", .time = "µs"};  // in the arrays' tags
        SnapshotSeries<2>(folder, *model, named).add(0.0, y);
    }
    const view::Results results = view::read_results(scratch / "out");
    const view::Snapshot& snapshot = results.cases.at(0).snapshots.at(0);
    const auto place = places(*model);
    BOOST_TEST_REQUIRE(snapshot.corners.size() == 48U);
    for (std::size_t e = 0; e < 12; ++e)
        for (std::size_t c = 0; c < 4; ++c)
            BOOST_TEST(snapshot.corners[4 * e + c] == place[model->quadrilaterals()[e][c]]);
    const auto stress = ConstState<2>(model->layout(), y).elements().stress();
    const auto& sigma = field(snapshot.cells, "stress");
    for (std::size_t e = 0; e < 12; ++e)
        BOOST_TEST(sigma.values[e] == static_cast<float>(stress(0, static_cast<Eigen::Index>(e))));
}

BOOST_AUTO_TEST_CASE(cases_are_found_in_their_folders) {
    const Scratch scratch;
    const WrittenRun one(scratch / "out/plain", 2), other(scratch / "out/md", 3);
    const view::Results results = view::read_results(scratch / "out");
    BOOST_TEST_REQUIRE(results.cases.size() == 2U);
    BOOST_TEST(results.cases[0].name == "md");
    BOOST_TEST(results.cases[1].name == "plain");
    BOOST_TEST(results.checks.is_null());  // the study has none: it has not ended
}

BOOST_AUTO_TEST_CASE(what_is_no_result_is_refused) {
    const Scratch scratch;
    std::filesystem::create_directory(scratch / "empty");
    BOOST_TEST(has(refusal(scratch / "empty"), "is empty"));
    BOOST_TEST(has(refusal(scratch / "absent"), "no such folder"));
    scratch.write("foreign/letter.txt", "Dear");
    BOOST_TEST(has(refusal(scratch / "foreign"), "no result folder of spam"));
    BOOST_TEST(has(refusal(scratch / "foreign/letter.txt"), "is no folder"));
    scratch.write("young/case.toml", "");
    BOOST_TEST(has(refusal(scratch / "young"), "no snapshots"));
    scratch.write("away/snapshots.pvd", "<DataSet file=\"../../etc/passwd.vtp\"/></VTKFile>");
    BOOST_TEST(has(refusal(scratch / "away"), "no snapshot beside it"));
    scratch.write("none/snapshots.pvd", "<VTKFile></VTKFile>");
    BOOST_TEST(has(refusal(scratch / "none"), "without any snapshot"));
}

BOOST_AUTO_TEST_CASE(half_a_folder_is_refused_by_the_name_of_the_file) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 3);
    const auto damaged = [&](const std::string& name, const std::string& text,
                             const std::string& says) {
        const auto file = scratch / ("out/" + name);
        const std::string whole = test::contents_of(file);
        scratch.write("out/" + name, text);
        const std::string line = refusal(scratch / "out");
        BOOST_TEST(has(line, name), line);
        BOOST_TEST(has(line, says), line);
        BOOST_TEST(!has(line, "\n"));
        scratch.write("out/" + name, whole);
        BOOST_TEST(refusal(scratch / "out") == "accepted");
    };
    const std::string whole = test::contents_of(scratch / "out/snapshot_0001.vtp");
    damaged("snapshot_0001.vtp", "", "ends before");
    damaged("snapshot_0001.vtp", whole.substr(0, whole.size() / 2), "ends too early");
    damaged("snapshot_0001.vtp", whole.substr(0, 400), "ends before");
    damaged("snapshot_0001.vtp", test::contents_of(scratch / "out/snapshot_0000.vtp"), "not later");
    std::string newer = whole;
    newer.replace(newer.find("version=\"1.0\" byte"), 13, "version=\"2.0\"");
    damaged("snapshot_0001.vtp", newer, "format that this spam-view does not know");
    damaged("snapshots.pvd", "<VTKFile>", "ends too early");
    damaged("invariants.csv", "t,energy\n0,1\n1\n", "line 3");
    damaged("invariants.csv", "t,energy\n0,one\n", "column energy");
    damaged("result.json", "[{", "no JSON");
    damaged("result.json", "{\"a\": 1}", "no list of checks");
    std::filesystem::remove(scratch / "out/snapshot_0002.vtp");
    BOOST_TEST(has(refusal(scratch / "out"), "cannot be read (No such file"));
}

BOOST_AUTO_TEST_CASE(half_a_row_of_a_run_that_was_killed_is_left_out) {
    const Scratch scratch;
    scratch.write("rows.csv", "t,energy\n0,1\n1,2\n2,0.");
    BOOST_TEST(view::read_table(scratch / "rows.csv").columns[1].size() == 2U);
}

BOOST_AUTO_TEST_CASE(damaged_bytes_end_in_numbers_or_in_one_line) {
    const Scratch scratch;
    const WrittenRun run(scratch / "out", 1);
    const std::string whole = test::contents_of(scratch / "out/snapshot_0000.vtp");
    const std::size_t head = whole.find("<AppendedData");
    std::mt19937_64 random(11);
    int refused = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        std::string text = whole;
        // Half of them in the head, where a byte means more; parts cut out, bytes changed.
        const std::size_t end = trial % 2 == 0 ? head : text.size(), at = random() % end;
        if (trial % 5 == 0)
            text.erase(at, 1 + random() % 200);
        else
            for (int k = 0; k < 1 + trial % 4; ++k)
                text[(at + random() % 20) % end] = static_cast<char>(random());
        scratch.write("one.vtp", text);
        try {
            const view::Snapshot snapshot = view::read_snapshot(scratch / "one.vtp");
            for (const auto& one : snapshot.points)
                BOOST_TEST(one.values.size() == one.components * snapshot.id.size());
        } catch (const InputError& error) {
            ++refused;
            BOOST_TEST(!has(error.what(), "\n"), error.what());
        }
    }
    BOOST_TEST(refused > 300);
}
