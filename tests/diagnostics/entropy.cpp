// SPDX-License-Identifier: GPL-3.0-or-later
// The entropy of a gas, [HH01] eq 22: against a sum over all particles; what it must do when a gas
// expands, streams and mixes; and laws that are wrong in one place, which must fail.
#include "free_expansion/entropy.hpp"

#include <spam/kernel/lucy.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <random>

using namespace spam;

namespace {

/// D, e, (<v^2> - <v>^2)/2, <v^2>/2, rho -> s.
using Law = std::function<double(int dim, double e, double fluctuation, double all, double rho)>;

double right(int dim, double e, double fluctuation, double, double rho) {
    return 0.5 * dim * std::log((e + fluctuation) / std::pow(rho, 2.0 / dim));
}
double printed(int dim, double e, double fluctuation, double all, double rho) {
    return -right(dim, e, fluctuation, all, rho);
}
double without_fluctuation(int dim, double e, double, double, double rho) {
    return right(dim, e, 0.0, 0.0, rho);
}
double with_all_motion(int dim, double e, double, double all, double rho) {
    return right(dim, e, all, 0.0, rho);
}

/// Gas in a periodic box of side 4, range 1.5; energies and masses of its own.
template <int Dim>
struct Gas {
    Lucy<Dim> w{1.5};
    Box<Dim> box;
    std::vector<double> mass, density, energy;
    Points<Dim> x, v;

    explicit Gas(Eigen::Index n) : x(Dim, n), v(Dim, n) {
        std::array<double, Dim> side;
        side.fill(4.0);
        box = Box<Dim>(side);
        std::mt19937_64 random(8);
        std::uniform_real_distribution<double> u(0.0, 1.0);
        for (double& c : x.reshaped()) c = 12.0 * u(random) - 4.0;
        for (double& c : v.reshaped()) c = 2.0 * u(random) - 0.2;
        for (Eigen::Index i = 0; i < n; ++i) {
            mass.push_back(0.5 + u(random));
            energy.push_back(3.0 + u(random));
        }
        for (Eigen::Index i = 0; i < n; ++i) density.push_back(at(x.col(i))[0]);
    }
    GasEntropy<Dim> entropy() const { return {w, mass, x, v, density, energy, box}; }

    /// rho, <e>, (<v^2> - <v>^2)/2 and <v^2>/2 by looking at every particle.
    std::array<double, 4> at(const Point<Dim>& place) const {
        double rho = 0.0, e = 0.0, v2 = 0.0;
        Point<Dim> mean = Point<Dim>::Zero();
        for (Eigen::Index j = 0; j < x.cols(); ++j) {
            Point<Dim> s = place - x.col(j);
            for (double& c : s) c -= 4.0 * std::round(c / 4.0);
            const auto k = static_cast<std::size_t>(j);
            const double mw = mass[k] * w.value(s.norm());
            rho += mw;
            e += mw * energy[k];
            v2 += mw * v.col(j).squaredNorm();
            mean += mw * v.col(j);
        }
        return {rho, e / rho, 0.5 * (v2 / rho - (mean / rho).squaredNorm()), 0.5 * v2 / rho};
    }
    double particles_by(const Law& law) const {
        double sum = 0.0, total = 0.0;
        for (Eigen::Index i = 0; i < x.cols(); ++i) {
            const auto k = static_cast<std::size_t>(i);
            const auto [rho, e, fluctuation, all] = at(x.col(i));
            sum += mass[k] * law(Dim, energy[k], fluctuation, all, density[k]);
            total += mass[k];
        }
        return sum / total;
    }
    double grid_by(const FieldGrid<Dim>& grid, const Law& law) const {
        double sum = 0.0, total = 0.0;
        const Points<Dim> places = grid.points();
        for (const auto& place : places.colwise()) {
            const auto [rho, e, fluctuation, all] = at(place);
            if (rho > 0.0) sum += rho * law(Dim, e, fluctuation, all, rho);
        }
        for (const double m : mass) total += m;
        return sum * grid.spacing.prod() / total;
    }
};

template <int Dim>
void check_against_everything(Eigen::Index n) {
    const Gas<Dim> gas(n);
    const auto entropy = gas.entropy();
    std::array<int, Dim> nodes;
    nodes.fill(9);
    const auto grid = FieldGrid<Dim>::over(gas.box, nodes);
    BOOST_TEST_CONTEXT(Dim << "d") {
        const double sum = entropy.of_particles(Heat::fluctuation);
        const double integral = entropy.on_grid(grid, Heat::fluctuation);
        BOOST_TEST(std::abs(sum - gas.particles_by(right)) < 1e-12);
        BOOST_TEST(std::abs(integral - gas.grid_by(grid, right)) < 1e-12);
        for (const Law& wrong : {Law(printed), Law(without_fluctuation), Law(with_all_motion)}) {
            BOOST_TEST(std::abs(sum - gas.particles_by(wrong)) > 1e-2);
            BOOST_TEST(std::abs(integral - gas.grid_by(grid, wrong)) > 1e-2);
        }
        BOOST_TEST(std::abs(entropy.of_particles(Heat::all_motion) -
                            gas.particles_by(with_all_motion)) < 1e-12);
        BOOST_TEST(std::abs(entropy.on_grid(grid, Heat::all_motion) -
                            gas.grid_by(grid, with_all_motion)) < 1e-12);
        const Law cold = [](int dim, double, double fluctuation, double all, double rho) {
            return right(dim, 0.5 * rho, fluctuation, all, rho);
        };
        const auto energy = [](double rho) { return 0.5 * rho; };
        BOOST_TEST(std::abs(entropy.on_grid(grid, Heat::fluctuation, energy) -
                            gas.grid_by(grid, cold)) < 1e-12);
    }
}

/// n^Dim particles of mass 1, density and energy even, at `spacing` in a periodic box.
template <int Dim>
std::pair<double, double> even_gas(double spacing, double e, double stream) {
    std::array<int, Dim> cells, nodes;
    cells.fill(12);
    nodes.fill(18);
    std::array<double, Dim> side;
    side.fill(12.0 * spacing);
    const Box<Dim> box(side);
    const Points<Dim> x = square_lattice<Dim>(cells, spacing);
    const auto n = static_cast<std::size_t>(x.cols());
    const std::vector<double> ones(n, 1.0), rho(n, std::pow(spacing, -Dim)), energy(n, e);
    const Points<Dim> v = Points<Dim>::Constant(Dim, x.cols(), stream);
    const GasEntropy<Dim> gas(Lucy<Dim>(4.0 * spacing), ones, x, v, rho, energy, box);
    return {gas.of_particles(Heat::fluctuation),
            gas.on_grid(FieldGrid<Dim>::over(box, nodes), Heat::fluctuation)};
}

}  // namespace

BOOST_AUTO_TEST_CASE(it_is_the_sum_over_all) {
    check_against_everything<1>(30);
    check_against_everything<2>(100);
    check_against_everything<3>(200);
}

/// At the same energy ln 2 for every doubling of the room; along P dV = -dE, and with the wind, nothing.
BOOST_AUTO_TEST_CASE(room_makes_entropy_and_streaming_does_not) {
    const auto check = [](auto dim) {
        constexpr int D = decltype(dim)::value;
        const auto [sum, integral] = even_gas<D>(1.0, 0.5, 0.0);
        const double wider = std::pow(2.0, 1.0 / D);
        const auto [free_sum, free_integral] = even_gas<D>(wider, 0.5, 0.0);
        BOOST_TEST(std::abs(free_sum - sum - std::log(2.0)) < 1e-12);
        BOOST_TEST(std::abs(free_integral - integral - std::log(2.0)) < 1e-5);
        const double cooled = 0.5 * std::pow(wider, -2.0);  // T V^(2/D) = const
        const auto [slow_sum, slow_integral] = even_gas<D>(wider, cooled, 0.0);
        BOOST_TEST(std::abs(slow_sum - sum) < 1e-12);
        BOOST_TEST(std::abs(slow_integral - integral) < 1e-5);
        const auto [moved_sum, moved_integral] = even_gas<D>(1.0, 0.5, 3.0);
        BOOST_TEST(std::abs(moved_sum - sum) < 1e-12);
        BOOST_TEST(std::abs(moved_integral - integral) < 1e-12);
    };
    check(std::integral_constant<int, 1>{});
    check(std::integral_constant<int, 2>{});
    check(std::integral_constant<int, 3>{});
}

/// Two gases that stream through each other with +-u are as hot as one with u^2/2 more energy.
BOOST_AUTO_TEST_CASE(what_streams_through_itself_is_hot) {
    const Points<1> x = square_lattice<1>({40}, 0.5);
    Points<1> v(1, 40);
    for (Eigen::Index i = 0; i < 40; ++i) v(0, i) = i % 2 == 0 ? 0.6 : -0.6;
    const std::vector<double> ones(40, 1.0), rho(40, 2.0), energy(40, 0.5);
    const GasEntropy<1> gas(Lucy<1>(6.0), ones, x, v, rho, energy, Box<1>({20.0}));
    const double expected = 0.5 * std::log((0.5 + 0.18) / 4.0);
    BOOST_TEST(std::abs(gas.of_particles(Heat::fluctuation) - expected) < 1e-4);
    BOOST_TEST(std::abs(gas.of_particles(Heat::all_motion) - expected) < 1e-12);
}

BOOST_AUTO_TEST_CASE(empty_room_has_none) {
    const Points<2> x = square_lattice<2>({2, 2});
    const std::vector<double> ones(4, 1.0), rho(4, 1.0), energy(4, 0.5);
    const GasEntropy<2> gas(Lucy<2>(2.0), ones, x, Points<2>::Zero(2, 4), rho, energy,
                            Box<2>({20.0, 20.0}));
    const auto grid = FieldGrid<2>::over(Box<2>({20.0, 20.0}), {40, 40});
    BOOST_TEST(std::isfinite(gas.on_grid(grid, Heat::fluctuation)));
    const auto energy_of = [](double density) { return 0.5 * density; };
    // e/rho = 1/2 wherever there is gas: one number everywhere, and the grid holds all the mass.
    BOOST_TEST(std::abs(gas.on_grid(grid, Heat::fluctuation, energy_of) + std::log(2.0)) < 1e-3);
}

// A node that sees one particle alone: <v^2> - <v>^2 is rounding, of either sign, and where the gas is thin
// more than e. Each of many such pairs of numbers must leave an entropy.
BOOST_AUTO_TEST_CASE(a_particle_alone_has_no_fluctuation) {
    const double side = 100.0, thin = 1e-20;
    const Box<2> box({side, side});
    Points<2> x = square_lattice<2>({20, 20});
    x *= 5.0;  // farther apart than they see
    x.array() += 0.5 * side;
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    Points<2> v = x;
    for (double& c : v.reshaped()) c = u(random);
    const std::vector<double> mass(400, 1.0), rho(400, Lucy<2>(2.0).value(0.0)), e(400, thin);
    const GasEntropy<2> entropy(Lucy<2>{2.0}, mass, x, v, rho, e, box);
    const auto grid = FieldGrid<2>::over(box, {150, 150});
    const double s = entropy.on_grid(grid, Heat::fluctuation, [=](double) { return thin; });
    // ln e and no more, up to what rounding may add to it
    BOOST_TEST(std::isfinite(s));
    BOOST_TEST(s > std::log(thin) - 1.0);
    BOOST_TEST(s < std::log(1e-14));
    BOOST_TEST(std::isfinite(entropy.of_particles(Heat::fluctuation)));
}
