// SPDX-License-Identifier: GPL-3.0-or-later
// Liquids that part from their vapour, or fly apart, as a user runs them; and parts of these problems by themselves.
#include "phase_separation/separation.hpp"

#include "problem/found.hpp"
#include "problem/refused.hpp"

using namespace spam::test;
using phase_separation::contour_length;

namespace {

const spam::Box<2> box({20.0, 30.0});

/// A field on a grid of nodes `spacing` apart.
template <class F>
std::vector<double> field(const spam::FieldGrid<2>& grid, const F& f) {
    std::vector<double> values;
    const auto points = grid.points();
    for (Eigen::Index k = 0; k < points.cols(); ++k)
        values.push_back(f(points(0, k), points(1, k)));
    return values;
}

}  // namespace

BOOST_AUTO_TEST_CASE(lengths_of_contours) {
    using std::numbers::pi;
    const auto grid = spam::FieldGrid<2>::over(box, {40, 60});
    const auto stripes =
        field(grid, [](double, double y) { return std::cos(2.0 * pi * (y - 0.3) / 30.0); });
    BOOST_TEST(std::abs(contour_length(grid, stripes, 0.2) - 40.0) < 1e-9);
    const auto disk = field(grid, [](double x, double y) {
        return box.nearest(spam::Point<2>(x - 1.3, y - 2.1)).norm();
    });
    BOOST_TEST(std::abs(contour_length(grid, disk, 7.0) / (14.0 * pi) - 1.0) < 2e-3);
    BOOST_TEST(contour_length(grid, disk, 100.0) == 0.0);
}

/// Growth rates of the modes of 40 x 40 particles by a separate program: sums over the lattice.
BOOST_AUTO_TEST_CASE(waves_grow_as_sums_over_the_lattice_say) {
    const std::vector<double> rates{0.09180, 0.16985, 0.22201, 0.23876, 0.21227, 0.12479, 0.0, 0.0};
    for (std::size_t k = 0; k < rates.size(); ++k) {
        const std::string mode = std::to_string(k + 1);
        const Words words{"--wave", mode, "--kernel", "lucy", "--t-end", "12"};
        const char* claimed = rates[k] > 0.0 ? "growth_rate" : "largest_amplitude";
        const Results found("phase_separation", words, claimed);
        BOOST_TEST(found.claims == 1U, mode);
        BOOST_TEST(std::abs(found.value.at("rate_of_lattice") - rates[k]) < 1e-5, mode);
        if (rates[k] > 0.0)
            BOOST_TEST(std::abs(found.value.at("growth_rate") / rates[k] - 1.0) < 1e-4, mode);
        if (k == 0) BOOST_TEST(std::abs(found.value.at("rate_of_continuum") - 0.08895) < 1e-5);
    }
}

/// On the way only; where it ends --compare says.
BOOST_AUTO_TEST_CASE(a_small_isolated_fluid_warms_up_and_keeps_its_energy) {
    const Results found("phase_separation", {"--isolated", "--cells", "16", "--t-end", "40"},
                        "temperature");
    BOOST_TEST(found.value.at("temperature") > 0.5);
    BOOST_TEST(found.value.at("energy_change_per_particle") < 1e-6);
    BOOST_TEST(found.claims == 0U);
}

BOOST_AUTO_TEST_CASE(a_drop_holds_or_breaks) {
    const Results slow("cavitating_drop", {"--radius", "8", "--rate", "0.02"}, "pieces");
    BOOST_TEST(slow.value.at("pieces") == 1.0);
    BOOST_TEST(slow.value.at("vapour") == 0.0);
    const Results fast("cavitating_drop", {"--radius", "8", "--rate", "1"}, "pieces");
    BOOST_TEST(fast.value.at("vapour") > 0.9);
}

BOOST_AUTO_TEST_CASE(fluids_that_do_not_part_are_refused) {
    check_refused(std::vector<RefusedCall>{
        {"phase_separation",
         {"--temperature", "1"},
         {"temperature", "less than the critical temperature"}},
        {"phase_separation", {"--density", "0.3"}, {"density", "stable", "between 0.581 and 1.49"}},
        {"phase_separation", {"--density", "3"}, {"density", "1/b = 3", "give less"}},
        {"phase_separation", {"--conductivity", "1"}, {"conductivity", "--isolated", "full law"}},
        {"phase_separation", {"--isolated", "--damping", "0.1"}, {"damping", "keeps its energy"}},
        {"phase_separation", {"--wave", "20"}, {"wave", "no more than 19"}},
        {"phase_separation", {"--cells", "8"}, {"cells", "twice the range 4"}},
        {"cavitating_drop",
         {"--temperature", "1.5"},
         {"temperature", "less than the critical temperature"}},
        {"cavitating_drop", {"--range", "0.5"}, {"range", "spacing 0.707"}},
        {"cavitating_drop", {"--compare", "--rate", "1"}, {"rate", "six rates"}},
    });
}
