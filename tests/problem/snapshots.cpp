// SPDX-License-Identifier: GPL-3.0-or-later
// What ParaView opens: the .pvd lists exactly the .vtp files there are, and these hold the state.
#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <set>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

constexpr double speed = 0.1;
constexpr int size = 3;  // of the hexagon: 37 particles

/// Size 3 until t = 10: rows at every 1, configurations at 0, 5 and 10.
struct Run {
    Scratch folder;
    Csv csv;
    std::vector<std::pair<double, std::string>> listed;

    explicit Run(const Words& options)
        : csv((start(folder, options), folder / "out/invariants.csv")),
          listed(collection(folder / "out/snapshots.pvd")) {}
    Vtp snapshot(std::size_t k) const { return Vtp(folder / ("out/" + listed.at(k).second)); }

  private:
    static void start(const Scratch& folder, Words arguments) {
        arguments.insert(arguments.end(), {"--size", "3", "--t-end", "10", "--output-every", "1",
                                           "--snapshot-every", "5", "--out", "out", "--no-plots"});
        const Outcome outcome = run(problem("rotating_hexagon", arguments), {folder.path()});
        BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
    }
};

void check_names_and_sizes(const Vtp& vtp, const std::map<std::string, int>& components) {
    BOOST_TEST((vtp.components == components));
    BOOST_TEST(vtp.points == 37u);
    BOOST_TEST(vtp.vertices == 37u);
    auto ids = vtp.arrays.at("id");
    std::sort(ids.begin(), ids.end());
    for (std::size_t i = 0; i < 37; ++i) {
        const auto k = static_cast<double>(i);
        BOOST_TEST(ids[i] == k);
        BOOST_TEST(vtp.arrays.at("connectivity")[i] == k);
        BOOST_TEST(vtp.arrays.at("offsets")[i] == k + 1);
        BOOST_TEST(vtp.arrays.at("mass")[i] == 1.0);
        BOOST_TEST(vtp.arrays.at("particle_spacing")[i] == 1.0);
        BOOST_TEST(vtp.arrays.at("body")[i] == 0.0);
    }
}

/// Momentum, angular momentum and kinetic energy of a configuration against the row of its time.
void check_against_row(const Vtp& vtp, const Csv& csv, std::size_t row) {
    const auto& v = vtp.arrays.at("velocity");
    const auto& x = vtp.arrays.at("Points");
    double px = 0.0, py = 0.0, L = 0.0, kinetic = 0.0;
    for (std::size_t i = 0; i < 3 * vtp.points; i += 3) {
        px += v[i];
        py += v[i + 1];
        L += x[i] * v[i + 1] - x[i + 1] * v[i];
        kinetic += 0.5 * (v[i] * v[i] + v[i + 1] * v[i + 1]);
        BOOST_TEST(x[i + 2] == 0.0);
        BOOST_TEST(v[i + 2] == 0.0);
    }
    BOOST_TEST(std::abs(px - csv.column("momentum_x")[row]) <= 1e-12);
    BOOST_TEST(std::abs(py - csv.column("momentum_y")[row]) <= 1e-12);
    BOOST_TEST(std::abs(L - csv.column("angular_momentum")[row]) <= 1e-12);
    BOOST_TEST(std::abs(kinetic - csv.column("kinetic")[row]) <= 1e-12);
    if (!vtp.arrays.contains("energy")) return;
    double internal = 0.0;
    for (const double e : vtp.arrays.at("energy")) internal += e;
    BOOST_TEST(std::abs(internal - csv.column("internal")[row]) <= 1e-12);
}

/// Rigid rotation, free of stress.
void check_start(const Vtp& vtp) {
    const auto& v = vtp.arrays.at("velocity");
    const auto& x = vtp.arrays.at("Points");
    for (std::size_t i = 0; i < 3 * vtp.points; i += 3) {
        BOOST_TEST(std::abs(v[i] + speed / size * x[i + 1]) <= 1e-15);
        BOOST_TEST(std::abs(v[i + 1] - speed / size * x[i]) <= 1e-15);
        BOOST_TEST(std::hypot(x[i], x[i + 1]) <= size + 1e-12);
    }
    if (!vtp.arrays.contains("stress")) return;
    for (const double s : vtp.arrays.at("stress")) BOOST_TEST(s == 0.0);
    for (const double e : vtp.arrays.at("energy")) BOOST_TEST(e == 0.0);
}

/// Symmetric tensors of the plane, some of them not zero.
void check_stress(const Vtp& vtp) {
    const auto& s = vtp.arrays.at("stress");
    double largest = 0.0;
    for (std::size_t i = 0; i < s.size(); i += 9) {
        BOOST_TEST(s[i + 1] == s[i + 3]);
        for (const std::size_t out_of_plane : {2U, 5U, 6U, 7U, 8U})
            BOOST_TEST(s[i + out_of_plane] == 0.0);
        for (std::size_t c = 0; c < 9; ++c) largest = std::max(largest, std::abs(s[i + c]));
    }
    BOOST_TEST(largest > 1e-5);
    BOOST_TEST(largest < 0.1);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_list_is_what_is_there) {
    const Run run({"--transport", "monaghan"});
    std::set<std::string> there, listed;
    for (const auto& [name, contents] : run.folder.listing())
        if (name.ends_with(".vtp")) there.insert(name.substr(std::string("out/").size()));
    std::vector<double> times;
    for (const auto& [t, name] : run.listed) {
        times.push_back(t);
        listed.insert(name);
    }
    BOOST_TEST(there == listed, boost::test_tools::per_element());
    BOOST_TEST(times == (std::vector<double>{0.0, 5.0, 10.0}), boost::test_tools::per_element());
    BOOST_TEST(run.listed.front().second == "snapshot_0000.vtp");
}

BOOST_AUTO_TEST_CASE(smooth_particles) {
    for (const char* density : {"continuity", "summed"}) {
        const Run run({"--transport", "monaghan", "--density", density});
        for (std::size_t k = 0; k < 3; ++k) {
            const Vtp vtp = run.snapshot(k);
            check_names_and_sizes(vtp, {{"id", 1},
                                        {"body", 1},
                                        {"mass", 1},
                                        {"particle_spacing", 1},
                                        {"velocity", 3},
                                        {"density", 1},
                                        {"stress", 9},
                                        {"energy", 1},
                                        {"Points", 3},
                                        {"connectivity", 1},
                                        {"offsets", 1}});
            check_against_row(vtp, run.csv, 5 * k);
            if (k > 0) check_stress(vtp);
            for (const double rho : vtp.arrays.at("density")) BOOST_TEST((rho > 0.4 && rho < 1.4));
        }
        check_start(run.snapshot(0));
    }
}

/// 2 x 2 elements, each a polygon of four of nine points, with its fields as cell arrays.
BOOST_AUTO_TEST_CASE(elements_are_polygons) {
    const Scratch folder;
    const Outcome outcome =
        run(problem("mesh_modes", {"--elements", "2", "--t-end", "2", "--speed", "1e-3",
                                   "--hourglass-stiffness", "0.1", "--out", "out", "--no-plots"}),
            {folder.path()});
    BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
    const auto listed = collection(folder / "out/butterfly_resisted/snapshots.pvd");
    const Vtp vtp(folder / ("out/butterfly_resisted/" + listed.back().second));
    BOOST_TEST(vtp.points == 9u);
    BOOST_TEST(vtp.vertices == 0u);  // every point is a corner
    BOOST_TEST(vtp.polygons == 4u);
    const std::map<std::string, int> components{{"id", 1},
                                                {"body", 1},
                                                {"mass", 1},
                                                {"velocity", 3},
                                                {"Points", 3},
                                                {"particle_spacing", 1},
                                                {"connectivity", 1},
                                                {"offsets", 1},
                                                {"element_element", 1},
                                                {"element_stress", 9},
                                                {"element_energy", 1},
                                                {"element_hourglass_force", 3},
                                                {"polygon_connectivity", 1},
                                                {"polygon_offsets", 1}};
    BOOST_TEST((vtp.components == components));
    BOOST_TEST((vtp.arrays.at("polygon_offsets") == std::vector<double>{4, 8, 12, 16}));
    BOOST_TEST((vtp.arrays.at("element_element") == std::vector<double>{0, 1, 2, 3}));
    const auto& corners = vtp.arrays.at("polygon_connectivity");
    const auto& x = vtp.arrays.at("Points");
    double area = 0.0;
    for (std::size_t k = 0; k < 16; ++k) {
        const auto i = static_cast<std::size_t>(corners[k]),
                   j = static_cast<std::size_t>(corners[k - k % 4 + (k + 1) % 4]);
        area += 0.5 * (x[3 * i] * x[3 * j + 1] - x[3 * j] * x[3 * i + 1]);
    }
    BOOST_TEST(std::abs(area - 4.0) < 0.1);  // counterclockwise
    const Csv csv(folder / "out/butterfly_resisted/invariants.csv");
    double internal = 0.0;
    for (const double e : vtp.arrays.at("element_energy")) internal += std::sqrt(4.0 / 3.0) * e;
    BOOST_TEST(internal > 0.0);
    BOOST_TEST(std::abs(internal / csv.column("internal").back() - 1.0) < 1e-12);
}

BOOST_AUTO_TEST_CASE(molecular_dynamics_has_no_density_and_no_stress) {
    const Run run({"--model", "md"});
    for (std::size_t k = 0; k < 3; ++k) {
        check_names_and_sizes(run.snapshot(k), {{"id", 1},
                                                {"body", 1},
                                                {"mass", 1},
                                                {"particle_spacing", 1},
                                                {"velocity", 3},
                                                {"Points", 3},
                                                {"connectivity", 1},
                                                {"offsets", 1}});
        check_against_row(run.snapshot(k), run.csv, 5 * k);
    }
    check_start(run.snapshot(0));
}

namespace {

std::vector<double> numbers_of(const std::string& words) {
    std::vector<double> all;
    for (const auto& word : split(words, ' ')) all.push_back(Csv::number(word));
    return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(time_and_extent_in_free_space) {
    const Run run({"--transport", "monaghan"});
    for (std::size_t k = 0; k < 3; ++k) {
        const Vtp vtp = run.snapshot(k);
        BOOST_TEST(numbers_of(vtp.about.at("TimeValue")).at(0) == 5.0 * static_cast<double>(k));
        BOOST_TEST(vtp.about.at("periodic") == "0 0 0");
        const auto low = numbers_of(vtp.about.at("box_low")),
                   high = numbers_of(vtp.about.at("box_high"));
        const auto& x = vtp.arrays.at("Points");
        for (std::size_t a = 0; a < 3; ++a) {
            double least = x[a], most = x[a];
            for (std::size_t i = a; i < x.size(); i += 3) {
                least = std::min(least, x[i]);
                most = std::max(most, x[i]);
            }
            BOOST_TEST(low.at(a) == least);
            BOOST_TEST(high.at(a) == most);
        }
    }
}

/// Gas between walls that it has not reached yet: they are where the box ends, not the particles. Without the upper
/// one the last particle is.
BOOST_AUTO_TEST_CASE(a_box_ends_at_its_walls) {
    const Scratch folder;
    const Outcome outcome =
        run(problem("free_expansion", {"--cells", "8", "--range", "3", "--walls", "mirror", "--top",
                                       "open", "--t-end", "1", "--no-plots", "--out", "out"}),
            {folder.path()});
    BOOST_REQUIRE_MESSAGE(outcome.status <= 1, outcome.out << outcome.err);
    const Vtp vtp(folder / "out/snapshot_0000.vtp");
    BOOST_TEST(vtp.about.at("box_low") == "0 0 0");
    const auto high = numbers_of(vtp.about.at("box_high"));
    BOOST_TEST(high.at(0) == 16.0);
    double top = 0.0;
    const auto& x = vtp.arrays.at("Points");
    for (std::size_t i = 1; i < x.size(); i += 3) top = std::max(top, x[i]);
    BOOST_TEST(high.at(1) == top);
    BOOST_TEST(top < 15.0);
}

/// Gas that leaves its box on all sides.
BOOST_AUTO_TEST_CASE(inside_the_box_where_it_is_periodic) {
    const Scratch folder;
    const Outcome outcome =
        run(problem("free_expansion", {"--cells", "8", "--range", "3", "--t-end", "12",
                                       "--snapshot-every", "4", "--no-plots", "--out", "out"}),
            {folder.path()});
    BOOST_REQUIRE_MESSAGE(outcome.status <= 1, outcome.out << outcome.err);
    const auto listed = collection(folder / "out/snapshots.pvd");
    BOOST_TEST(listed.size() == 4u);
    for (const auto& [t, name] : listed) {
        const Vtp vtp(folder / ("out/" + name));
        BOOST_TEST(numbers_of(vtp.about.at("TimeValue")).at(0) == t);
        BOOST_TEST(vtp.about.at("box_low") == "0 0 0");
        BOOST_TEST(vtp.about.at("box_high") == "16 16 0");
        BOOST_TEST(vtp.about.at("periodic") == "1 1 0");
        const auto& x = vtp.arrays.at("Points");
        for (std::size_t i = 0; i < x.size(); ++i)
            BOOST_TEST((x[i] >= 0.0 && (i % 3 == 2 ? x[i] == 0.0 : x[i] < 16.0)));
        auto ids = vtp.arrays.at("id");
        std::sort(ids.begin(), ids.end());
        for (std::size_t i = 0; i < ids.size(); ++i) BOOST_TEST(ids[i] == static_cast<double>(i));
    }
}
