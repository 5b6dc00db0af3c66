// SPDX-License-Identifier: GPL-3.0-or-later
// A gas that expands between mirrors is a quarter of one in a periodic box of twice the side that begins
// symmetrically: both have the same entropy, which two gases of other random offsets do not have.
#include "free_expansion/entropy.hpp"
#include "free_expansion/gas.hpp"
#include "support/effort.hpp"
#include <spam/core/parallel.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>

using namespace spam;
using namespace spam::test;
using free_expansion::Gas;
using free_expansion::Walls;

namespace {

Gas<2> gas(int cells, Walls walls, int seed) {
    Options options("test", "a test");
    const Sides sides(options, {"walls", "walls", "walls", "walls"});
    free_expansion::Parameters p;
    p.sides = &sides;
    p.walls = walls;
    p.seed = seed;
    return free_expansion::make_gas<2>(cells, p);
}

/// Its four images as particles of their own, in their periodic box.
struct Whole {
    std::unique_ptr<FluidModel<2>> model;
    std::vector<double> y0;

    explicit Whole(const Gas<2>& half) {
        const double side = 2.0 * half.side();
        const Points<2> of_half = ConstState<2>(half.model->layout(), half.y0).position();
        const Eigen::Index n = of_half.cols();
        Points<2> x(2, 4 * n);
        for (int image = 0; image < 4; ++image)
            for (int a = 0; a < 2; ++a)
                if (image >> a & 1)
                    x.row(a).segment(image * n, n) = side - of_half.row(a).array();
                else
                    x.row(a).segment(image * n, n) = of_half.row(a);
        const Box<2> box({side, side});
        model = std::make_unique<FluidModel<2>>(
            make_particles<2>(x, 1.0, 1.0, box), Fluid{free_expansion::law_of(2)},
            Scheme{.density = Density::summed, .range = half.weight.range()}, box);
        y0 = model->state(model->particles().reference_position, Points<2>::Zero(2, 4 * n));
    }
};

/// By particles and on the grid; of N particles, in N ln 4.
std::array<double, 2> entropies(const Gas<2>& gas, const Model<2>& model,
                                std::span<const double> y) {
    const ConstState<2> state(model.layout(), y);
    const auto rho = model.density(y);
    std::vector<double> e;
    const auto law = free_expansion::law_of(2);
    for (const double r : rho) e.push_back(law.cold_energy(r));
    const GasEntropy<2> entropy(gas.weight, model.particles().mass, state.position(),
                                state.velocity(), rho, e, model.box());
    // Nodes in the middle of cells: where those of the images are.
    const double side = model.box().periodic() ? model.box().length(0) : gas.side();
    const int nodes = static_cast<int>(side / 2.0);
    FieldGrid<2> grid = FieldGrid<2>::over(Box<2>({side, side}), {nodes, nodes});
    grid.origin += 0.5 * grid.spacing;
    const double ln4 = 2.0 * std::numbers::ln2;
    return {entropy.of_particles(Heat::fluctuation) / ln4,
            entropy.on_grid(grid, Heat::fluctuation, [&](double r) { return law.cold_energy(r); }) /
                ln4};
}

/// Curves of entropy on the way to 1.5 n.
using Entropies = std::vector<std::array<double, 2>>;
Entropies curve_of(const Gas<2>& gas, Model<2>& model, const std::vector<double>& y0) {
    Motion<2> motion(model, y0, {.method = "rk4", .dt = 0.25});
    const auto start = entropies(gas, model, motion.y());
    Entropies curve;
    for (int k = 1; k <= 24; ++k) {
        motion.advance_to(k / 16.0 * gas.cells);
        auto now = entropies(gas, model, motion.y());
        for (int c : {0, 1}) now[static_cast<std::size_t>(c)] -= start[static_cast<std::size_t>(c)];
        curve.push_back(now);
    }
    return curve;
}

/// Largest difference up to row `rows`.
double apart(const Entropies& a, const Entropies& b, std::size_t rows) {
    double largest = 0.0;
    for (std::size_t k = 0; k < rows; ++k)
        for (const std::size_t c : {0U, 1U})
            largest = std::max(largest, std::abs(a[k][c] - b[k][c]));
    return largest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_gas_between_mirrors_is_a_quarter_of_a_symmetric_one) {
    set_threads(1);
    for (const int cells : effort(std::vector{20, 36}, std::vector{14})) {
        auto half = gas(cells, Walls::mirror, 4);
        Whole whole(half);
        const Entropies mirrors = curve_of(half, *half.model, half.y0),
                        periods = curve_of(half, *whole.model, whole.y0);
        BOOST_TEST(mirrors.back()[0] > 0.5);
        BOOST_TEST_MESSAGE(cells << ": up to n/2 " << apart(mirrors, periods, 8) << ", n "
                                 << apart(mirrors, periods, 16) << ", 1.5 n "
                                 << apart(mirrors, periods, 24));
        BOOST_TEST(apart(mirrors, periods, 24) < 1e-3);
        BOOST_TEST(apart(mirrors, periods, 16) < 1e-9);
        // What it is measured by: another gas is not so near.
        auto other = gas(cells, Walls::mirror, 5);
        BOOST_TEST(apart(curve_of(other, *other.model, other.y0), periods, 24) > 1e-3);
    }
}
