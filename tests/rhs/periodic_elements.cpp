// SPDX-License-Identifier: GPL-3.0-or-later
// Finite elements across the borders of a periodic box.
#include "support/element_mesh.hpp"
#include "support/refusal.hpp"
#include <spam/diagnostics/invariants.hpp>
#include <spam/problem/motion.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <numbers>

using namespace spam;
using namespace spam::test;

namespace {

/// 6 x 5 elements, distorted, that fill a periodic box; or the same in the middle of 3 x 3 of them in free space.
std::unique_ptr<ParticleModel<2>> round_the_box(bool alone) {
    constexpr int columns = 6, rows = 5;
    const int copies = alone ? 1 : 3;
    const Box<2> box = alone ? Box<2>({double(columns), double(rows)}) : Box<2>();
    Mesh mesh = rectangle_mesh(copies * columns, copies * rows, 1.0, {alone, alone});
    const int across = copies * columns + (alone ? 0 : 1);
    for (Eigen::Index k = 0; k < mesh.node.cols(); ++k) {
        const double column = double(k % across % columns), row = double(k / across % rows);
        mesh.node(0, k) += 0.2 * std::sin(3.0 * column + 5.0 * row);
        mesh.node(1, k) += 0.2 * std::cos(2.0 * column - 7.0 * row);
    }
    MeshedBodies bodies = make_nodes({mesh}, lattice_density, 1.0, box);
    auto model = std::make_unique<ParticleModel<2>>(std::move(bodies.nodes), box);
    model->add_term<Elements>(
        std::move(bodies.element),
        std::vector<Elements::Material>{{elastic, lattice_density, {0.3, 0.2}}});
    return model;
}

/// A wave of the box in both directions.
Point<2> wave(const Point<2>& x) {
    const double p = 2.0 * std::numbers::pi * x.x() / 6.0, q = 2.0 * std::numbers::pi * x.y() / 5.0;
    return {0.1 * std::sin(p + 2.0 * q), 0.1 * std::cos(2.0 * p - q)};
}

}  // namespace

// The accelerations of a mesh in free space that goes on on all sides, whatever image of a node y holds.
BOOST_AUTO_TEST_CASE(elements_lie_across_the_borders_of_a_periodic_box) {
    const auto inside = round_the_box(true), open = round_the_box(false);
    const auto y = start_of(*inside, wave), free = start_of(*open, wave);
    const auto shifted = [&](std::vector<double> all) {
        auto x = State<2>(inside->layout(), all).position();
        for (Eigen::Index k = 0; k < x.cols(); k += 3) x.col(k) += Point<2>(6.0, -10.0);
        return all;
    };
    Motion<2> moved(*inside, y, {.method = "rk4", .dt = 0.05}),
        beyond(*inside, shifted(y), {.method = "rk4", .dt = 0.05});
    moved.advance_to(2.0);
    beyond.advance_to(2.0);
    BOOST_TEST((moved.state().velocity() - beyond.state().velocity()).norm() < 1e-12);
    const auto before = measure_invariants<2>(*inside, y),
               after = measure_invariants<2>(*inside, moved.y());
    BOOST_TEST(before.mass == 30.0 * lattice_density, boost::test_tools::tolerance(1e-14));
    BOOST_TEST((after.momentum - before.momentum).norm() < 1e-14);
    BOOST_TEST(std::abs(after.energy / before.energy - 1.0) < 1e-6);

    Motion<2> unbounded(*open, free, {.method = "rk4", .dt = 0.05}),
        stepped(*inside, y, {.method = "rk4", .dt = 0.05});
    stepped.step(1.0);
    unbounded.step(1.0);  // edges are felt four elements inside, and no further
    const auto& ids = open->particles().id;
    double worst = 0.0;
    std::size_t found = 0;
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const auto column = ids[k] % 19 - 6, row = ids[k] / 19 - 5;
        if (column < 0 || column >= 6 || row < 0 || row >= 5) continue;
        const auto& own = inside->particles().id;
        const auto at = std::find(own.begin(), own.end(), row * 6 + column) - own.begin();
        const Point<2> v = unbounded.state().velocity().col(static_cast<Eigen::Index>(k));
        worst = std::max(worst, (stepped.state().velocity().col(at) - v).norm());
        ++found;
    }
    BOOST_TEST(found == 30U);
    BOOST_TEST(worst < 1e-14);
}

BOOST_AUTO_TEST_CASE(elements_that_reach_half_round_the_box_are_refused) {
    const auto said = [](double length, int columns) {
        return refusal([&] {
            const Box<2> box({length, 20.0});
            MeshedBodies bodies =
                make_nodes({rectangle_mesh(columns, 2, 1.0, {true, false})}, 1.0, 1.0, box);
            ParticleModel<2> model(std::move(bodies.nodes), box);
            model.add_term<Elements>(std::move(bodies.element),
                                     std::vector<Elements::Material>{{elastic, 1.0, {}}});
        });
    };
    BOOST_TEST(said(3.0, 3) == "accepted");
    BOOST_TEST(said(2.0, 2).find("half round the periodic box") != std::string::npos, said(2.0, 2));
    Box<2> walls;
    walls.set_wall(0, false, {WallKind::mirror, -5.0});
    MeshedBodies bodies = make_nodes({rectangle_mesh(2, 2)}, 1.0);
    ParticleModel<2> model(std::move(bodies.nodes), walls);
    BOOST_TEST(refusal([&] {
                   model.add_term<Elements>(std::move(bodies.element),
                                            std::vector<Elements::Material>{{elastic, 1.0, {}}});
               }).find("images") != std::string::npos);
}
