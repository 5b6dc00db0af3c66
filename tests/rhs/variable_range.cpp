// SPDX-License-Identifier: GPL-3.0-or-later
// Particles whose ranges follow their densities: densities and ranges that belong to each other, forces that
// derive from the energy, everything kept; and what is lost where the gradients of the range are left
// out, as older codes do.
#include "support/random_state.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/kernel/any_weight.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/isentropic_gas.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

/// Thinned out towards the right: densities of one to about a half of it.
template <int Dim>
Points<Dim> thinned(const Points<Dim>& x) {
    Points<Dim> y = x;
    for (Eigen::Index i = 0; i < y.cols(); ++i) y(0, i) *= 1.0 + 0.04 * x(0, i);
    return y;
}

template <int Dim>
VariableRangeModel<Dim> gas(int cells, const Fluid& fluid, VariableRangeScheme scheme,
                            const Box<Dim>& box = {}) {
    auto particles = jittered_particles<Dim>(cells, 91, 0.15, box);
    if (!box.periodic()) particles.reference_position = thinned<Dim>(particles.reference_position);
    return {std::move(particles), fluid, scheme, box};
}

template <int Dim>
std::vector<double> start(VariableRangeModel<Dim>& model, unsigned seed) {
    const auto& x = model.particles().reference_position;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> g;
    Points<Dim> v(Dim, x.cols());
    for (auto& c : v.reshaped()) c = g(random);
    return model.state(x, v, 1.3);
}

/// |d/dt sum m (e + v^2/2)| and |d/dt sum m v|, relative to the sizes of their parts.
template <int Dim>
std::pair<double, double> unbalanced(VariableRangeModel<Dim>& model, const std::vector<double>& y) {
    const auto y_dot = rates_of(model, y);
    const ConstState<Dim> state(model.layout(), y), rate(model.layout(), y_dot);
    ExactSum energy;
    Point<Dim> momentum = Point<Dim>::Zero();
    double size = 0.0, push = 0.0;
    for (Eigen::Index i = 0; i < state.energy().cols(); ++i) {
        const double m = model.particles().mass[static_cast<std::size_t>(i)];
        const double power = m * state.velocity().col(i).dot(rate.velocity().col(i));
        energy += m * rate.energy()(0, i);
        energy += power;
        size += std::abs(m * rate.energy()(0, i)) + std::abs(power);
        momentum += m * rate.velocity().col(i);
        push += m * rate.velocity().col(i).norm();
    }
    return {std::abs(energy) / size, momentum.norm() / push};
}

/// The largest |v_dot_i + (1/m_i) d/dr_i sum m e(rho)| relative to the largest v_dot, over some i, with
/// densities solved anew: what the forces should be the derivatives of.
template <int Dim>
double force_error(VariableRangeModel<Dim>& model, std::vector<double> y) {
    const auto y_dot = rates_of(model, y);
    const ConstState<Dim> rate(model.layout(), y_dot);
    const Points<Dim> x = ConstState<Dim>(model.layout(), y).position();
    const auto& m = model.particles().mass;
    const auto potential = [&](const Points<Dim>& at) {
        ExactSum sum;
        const auto rho = model.solve_densities(at);
        for (std::size_t i = 0; i < rho.size(); ++i)
            sum += m[i] * model.fluid().state.cold_energy(rho[i]);
        return static_cast<double>(sum);
    };
    double worst = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); i += 7)
        for (int a = 0; a < Dim; ++a) {
            const auto moved = [&](double d) {
                Points<Dim> at = x;
                at(a, i) += d;
                return potential(at);
            };
            const double d = 2e-3;
            const double slope =
                (8.0 * (moved(d) - moved(-d)) - (moved(2.0 * d) - moved(-2.0 * d))) / (12.0 * d);
            worst = std::max(
                worst, std::abs(m[static_cast<std::size_t>(i)] * rate.velocity()(a, i) + slope));
        }
    return worst / rate.velocity().cwiseAbs().maxCoeff();
}

template <int Dim>
void check(int cells, double length) {
    std::array<double, Dim> lengths;
    lengths.fill(length);
    for (const Kernel kernel : {Kernel::lucy, Kernel::monaghan, Kernel::w5})
        for (const Box<Dim>& box : {Box<Dim>{}, Box<Dim>(lengths)})
            for (const Fluid& fluid : {Fluid{LucyGas{}}, Fluid{IdealGas{Dim, 1.0}},
                                       Fluid{IsentropicGas{0.7, 1.1, 1.4}}}) {
                auto model = gas<Dim>(cells, fluid, {2.4, kernel}, box);
                const auto y = start(model, 92);
                const auto [energy, momentum] = unbalanced(model, y);
                BOOST_TEST(energy < 1e-13);
                BOOST_TEST(momentum < 1e-13);
            }
    auto model = gas<Dim>(cells, {IsentropicGas{0.7, 1.1, 1.4}}, {2.4, Kernel::w5});
    const auto y = start(model, 92);
    BOOST_TEST(force_error(model, y) < 1e-7);
    auto without = gas<Dim>(cells, {IsentropicGas{0.7, 1.1, 1.4}}, {2.4, Kernel::w5, true});
    BOOST_TEST(force_error(without, y) > 1e-3);
    BOOST_TEST(unbalanced(without, y).first < 1e-13);  // energy is kept all the same
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_line) { check<1>(30, 30.0); }
BOOST_AUTO_TEST_CASE(in_the_plane) { check<2>(9, 9.0); }
BOOST_AUTO_TEST_CASE(in_space) { check<3>(6, 6.0); }

BOOST_AUTO_TEST_CASE(densities_and_ranges_belong_to_each_other) {
    auto model = gas<2>(12, {LucyGas{}}, {2.4, Kernel::monaghan});
    const auto y = start(model, 93);
    const ConstState<2> state(model.layout(), y);
    const auto h = model.ranges(y);
    double smallest = h[0], largest = h[0];
    for (std::size_t i = 0; i < h.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        const auto w = weight_function<2>("monaghan", h[i]);
        double rho = 0.0;
        for (Eigen::Index j = 0; j < state.position().cols(); ++j)
            rho += model.particles().mass[static_cast<std::size_t>(j)] *
                   w.value((state.position().col(k) - state.position().col(j)).norm());
        BOOST_TEST(std::abs(rho - state.density()(0, k)) < 1e-13 * rho);
        smallest = std::min(smallest, h[i]);
        largest = std::max(largest, h[i]);
    }
    BOOST_TEST(largest > 1.3 * smallest);
}

BOOST_AUTO_TEST_CASE(the_density_that_is_integrated_follows_the_solved_one) {
    auto model = gas<2>(10, {LucyGas{}}, {2.4, Kernel::w5});
    const auto y = start(model, 94), y_dot = rates_of(model, y);
    const ConstState<2> state(model.layout(), y), rate(model.layout(), y_dot);
    const double d = 1e-4;
    const auto later = model.solve_densities(state.position() + d * state.velocity());
    const auto earlier = model.solve_densities(state.position() - d * state.velocity());
    for (std::size_t i = 0; i < later.size(); ++i)
        BOOST_TEST(std::abs((later[i] - earlier[i]) / (2.0 * d) -
                            rate.density()(0, static_cast<Eigen::Index>(i))) < 1e-5);
}

BOOST_AUTO_TEST_CASE(bits) {
    auto model = gas<2>(48, {IdealGas{2, 1.0}}, {3.0, Kernel::lucy}, Box<2>({48.0, 48.0}));
    const auto y = start(model, 95);
    set_threads(1);
    const auto alone = rates_of(model, y);
    set_threads(3);
    BOOST_TEST((rates_of(model, y) == alone));
    set_threads(1);
    // Equal and opposite to the last bit: two particles, seen from both.
    Points<2> two(2, 2);
    two << 0.0, 0.83, 0.0, 0.41;
    auto particles = make_particles<2>(two, 1.0);
    VariableRangeModel<2> pair(particles, {LucyGas{}}, {2.4, Kernel::w5});
    auto z = pair.state(two, Points<2>::Zero(2, 2));
    State<2>(pair.layout(), z).density() << 0.31, 0.77;
    const auto z_dot = rates_of(pair, z);
    const auto v_dot = ConstState<2>(pair.layout(), z_dot).velocity();
    BOOST_TEST((v_dot.col(0) == -v_dot.col(1)));
    BOOST_TEST(v_dot.col(0).norm() > 0.01);
}

// Between two lists particles come nearer and ranges grow: no particle within a range is missed.
BOOST_AUTO_TEST_CASE(lists_reach_as_far_as_ranges_that_grow) {
    const auto particles = jittered_particles<2>(24, 101);
    const VariableRangeScheme scheme{2.4, Kernel::w2};
    VariableRangeModel<2> used(particles, {LucyGas{}}, scheme);
    auto y = start(used, 102);
    const auto mass =
        Eigen::RowVectorXd::Map(particles.mass.data(), Eigen::Index(particles.size()));
    State<2>(used.layout(), y).density() = mass;  // the same range for all
    rates_of(used, y);
    std::mt19937_64 random(103);
    std::uniform_real_distribution<double> angle(0.0, 6.283185307179586);
    for (double growth = 1.01; growth < 1.25; growth += 0.01) {
        auto z = y;
        const State<2> state(used.layout(), z);
        state.density() = mass / (growth * growth);
        auto x = state.position();
        for (Eigen::Index i = 0; i < x.cols(); ++i) {
            const double a = angle(random);
            x.col(i) += 0.08 * Point<2>(std::cos(a), std::sin(a));
        }
        VariableRangeModel<2> fresh(particles, {LucyGas{}}, scheme);
        BOOST_TEST(relative_difference(rates_of(used, z), rates_of(fresh, z)) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(ranges_of_nearly_half_of_a_periodic_box) {
    for (const double length : {9.0, 9.5, 10.0, 11.0}) {
        const Box<2> box({length, length});
        auto model = gas<2>(9, {LucyGas{}}, {2.4}, box);
        auto y = start(model, 104);
        const auto h = model.ranges(y);
        const double longest = *std::max_element(h.begin(), h.end());
        // The longest becomes 0.48 of the box.
        State<2>(model.layout(), y).density() *= std::pow(longest / (0.48 * length), 2);
        const auto y_dot = rates_of(model, y);
        BOOST_TEST(model.failure().empty(), model.failure());
        BOOST_TEST(std::isfinite(y_dot.back()));
    }
}

// As a run that writes a checkpoint goes on, and one that begins there.
BOOST_AUTO_TEST_CASE(after_reading_what_was_remembered_rates_are_those_of_a_model_made_anew) {
    const Box<2> box({24.0, 24.0});
    const auto particles = jittered_particles<2>(24, 105, 0.15, box);
    const VariableRangeScheme scheme{2.4, Kernel::lucy};
    VariableRangeModel<2> used(particles, {LucyGas{}}, scheme, box);
    VariableRangeModel<2> fresh(particles, {LucyGas{}}, scheme, box);
    std::mt19937_64 random(107);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    const auto mixed = [&](Points<2> x, double by) {
        for (auto& c : x.reshaped()) c += by * u(random);
        return used.state(x, Points<2>::Random(2, x.cols()), 1.0);
    };
    // In no order: the list is sorted into strips, by where the particles are then.
    const auto before = mixed(particles.reference_position, 20.0);
    const auto y = mixed(ConstState<2>(used.layout(), before).position(), 0.05);
    rates_of(used, before);
    BOOST_TEST((rates_of(used, y) == rates_of(fresh, y)));
    Archive written;
    used.remember(written);
    Archive reading(written.bytes());
    used.remember(reading);
    BOOST_TEST((rates_of(used, y) == rates_of(fresh, y)));
}

/// A lattice goes on behind mirrors as in a periodic box; without images first rows would be a third too thin.
BOOST_AUTO_TEST_CASE(densities_at_the_start_know_of_walls) {
    Box<2> mirrors;
    for (const int a : {0, 1})
        for (const bool upper : {false, true})
            mirrors.set_wall(a, upper, {WallKind::mirror, upper ? 8.0 : 0.0});
    const auto particles = make_particles<2>(cell_centres<2>({8, 8}), 1.0);
    const auto densities = [&](const Box<2>& box) {
        return VariableRangeModel<2>(particles, {IdealGas{2, 1.0}}, {3.0}, box)
            .solve_densities(particles.reference_position);
    };
    const auto walled = densities(mirrors), periodic = densities(Box<2>({8.0, 8.0})),
               open = densities({});
    double worst = 0.0, without = 0.0;
    for (std::size_t i = 0; i < walled.size(); ++i) {
        worst = std::max(worst, std::abs(walled[i] - periodic[i]));
        without = std::max(without, std::abs(open[i] - periodic[i]));
    }
    BOOST_TEST(worst < 1e-12);
    BOOST_TEST(without > 0.3);
}

/// Particles that are closer than their spacing have shorter ranges, and friction finds room between walls that are
/// nearer to each other than the usual range; how fast it acts is what it is where there is more room.
BOOST_AUTO_TEST_CASE(friction_between_near_walls) {
    const auto damping = [](int rows) {
        Box<2> box({8.0, 0.0});
        box.set_wall(1, false, {WallKind::mirror, 0.0});
        box.set_wall(1, true, {WallKind::mirror, 0.5 * rows});
        Points<2> x = cell_centres<2>({16, rows});
        x *= 0.5;
        Fluid water{IdealGas{2, 1.0}, NewtonViscosity{0.05, 0.1}};
        water.by_pairs = true;
        VariableRangeModel<2> model(make_particles<2>(x, 1.0), water, {3.0}, box);
        const auto y = model.state(x, Points<2>::Zero(2, x.cols()), 1.0);
        const auto y_dot = rates_of(model, y);
        BOOST_TEST(model.failure().empty(), model.failure());
        return model.fastest_damping(y);
    };
    const double near = damping(5), far = damping(16);
    BOOST_TEST(far > 0.1);
    BOOST_TEST(std::abs(near / far - 1.0) < 0.1);
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    const auto particles = jittered_particles<2>(8, 96);
    using Model = VariableRangeModel<2>;
    BOOST_CHECK_THROW(Model(particles, {LucyGas{}}, {1.2}), InputError);
    BOOST_CHECK_THROW(Model(particles, {LucyGas{}, NewtonViscosity{0.0, 1.0}}, {3.0}), InputError);
    auto narrow = gas<2>(8, {LucyGas{}}, {4.5}, Box<2>({8.0, 8.0}));
    BOOST_CHECK_THROW(start(narrow, 97), InputError);
    auto model = gas<2>(9, {IdealGas{2, 1.0}}, {3.0}, Box<2>({9.0, 9.0}));
    auto y = start(model, 98);
    State<2>(model.layout(), y).density()(0, 5) = 0.2;
    rates_of(model, y);
    BOOST_TEST(model.failure().find("half of the periodic box") != std::string::npos,
               model.failure());
    State<2>(model.layout(), y).density()(0, 5) = -1.0;
    rates_of(model, y);
    BOOST_TEST(model.failure().find("not positive") != std::string::npos, model.failure());
    y = start(model, 98);
    BOOST_TEST(std::isfinite(rates_of(model, y).front()));
    BOOST_TEST(model.failure().empty(), model.failure());
    y = start(model, 98);
    State<2>(model.layout(), y).energy()(0, 5) = -1.0;
    rates_of(model, y);
    BOOST_TEST(model.failure().find("outside the law") != std::string::npos, model.failure());
}
