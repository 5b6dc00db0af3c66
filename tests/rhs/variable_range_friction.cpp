// SPDX-License-Identifier: GPL-3.0-or-later
// Friction and conduction of particles whose ranges follow their densities: sums over pairs with the mean of both
// weights, which keep p and E exactly; those of one range where all ranges are the same.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/core/exact_sum.hpp>
#include <spam/kernel/any_weight.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>
#include <fmt/format.h>

using namespace spam;
using namespace spam::test;

namespace {

constexpr double lambda = 0.2, eta = 0.7, kappa = 0.9;

Fluid rubbing(int dim) {
    Fluid fluid{IdealGas{dim, 1.0}, NewtonViscosity{lambda, eta}, FourierConduction{kappa}};
    fluid.by_pairs = true;
    return fluid;
}

/// The same, or the same beside another gas, by Particles::material.
template <int Dim>
std::vector<Fluid> mixture(bool of_two) {
    std::vector<Fluid> fluids{rubbing(Dim)};
    if (!of_two) return fluids;
    Fluid other{GammaGas{1.4}, NewtonViscosity{-0.3, 2.0}, FourierConduction{0.1}};
    other.by_pairs = true;
    fluids.push_back(other);
    return fluids;
}

template <int Dim>
struct Gas {
    ParticleModel<Dim> model;
    OwnRanges<Dim>& law;
    std::vector<Fluid> fluids;

    Gas(const Particles<Dim>& particles, std::vector<Fluid> of, const VariableRangeScheme& scheme)
        : model(particles),
          law(model.template add_term<OwnRanges<Dim>>(of, scheme)),
          fluids(std::move(of)) {}
    const Fluid& of(Eigen::Index i) const {
        const auto& material = model.particles().material;
        return fluids[material.empty()
                          ? 0
                          : static_cast<std::size_t>(material[static_cast<std::size_t>(i)])];
    }
};

template <int Dim>
struct Rates {
    Points<Dim> v_dot;
    Eigen::RowVectorXd e_dot;
};

/// What friction and conduction give in `model`, beside the same without.
template <int Dim, class Model>
Rates<Dim> given_by(Model& model, Model& without, const std::vector<double>& y) {
    const auto all = rates_of(model, y), rest = rates_of(without, y);
    const ConstState<Dim> a(model.layout(), all), b(without.layout(), rest);
    return {a.velocity() - b.velocity(), a.energy() - b.energy()};
}

double harmonic_mean(double a, double b) { return 2.0 * a * b / (a + b); }

/// The same by a loop over all pairs; with the weight of the first one for both where that `alone` counts.
template <int Dim>
Rates<Dim> by_hand(const Gas<Dim>& gas, const std::vector<double>& y, bool alone) {
    const ConstState<Dim> state(gas.model.layout(), y);
    const auto h = gas.law.ranges(y);
    const auto kernel = to_string(gas.law.scheme().kernel);
    const Eigen::Index n = state.position().cols();
    Rates<Dim> rates{Points<Dim>::Zero(Dim, n), Eigen::RowVectorXd::Zero(n)};
    const auto slope = [&](Eigen::Index i, double r) {
        return weight_function<Dim>(kernel, h[static_cast<std::size_t>(i)]).minus_slope_over_r(r);
    };
    const auto T = [&](Eigen::Index i) {
        return gas.of(i).state.temperature(state.density()(0, i), state.energy()(0, i));
    };
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            if (i == j) continue;
            const NewtonViscosity own = *gas.of(i).viscosity, other = *gas.of(j).viscosity;
            const double M = harmonic_mean(own.eta, other.eta),
                         L = harmonic_mean(2.0 * own.eta + own.lambda,
                                           2.0 * other.eta + other.lambda),
                         a = 3.0 * M - L, b = L - M,
                         c = harmonic_mean(gas.of(i).conduction->kappa,
                                           gas.of(j).conduction->kappa);
            const Point<Dim> r = state.position().col(j) - state.position().col(i),
                             v = state.velocity().col(j) - state.velocity().col(i);
            const double F = 0.5 * (slope(i, r.norm()) + slope(alone ? i : j, r.norm())) /
                             (state.density()(0, i) * state.density()(0, j));
            const Point<Dim> f = F * (a * v + (Dim + 2) * b * r.dot(v) / r.squaredNorm() * r);
            const double m = gas.model.particles().mass[static_cast<std::size_t>(j)];
            rates.v_dot.col(i) += m * f;
            rates.e_dot(i) += m * (0.5 * f.dot(v) + 2.0 * c * F * (T(j) - T(i)));
        }
    return rates;
}

template <int Dim>
double difference(const Rates<Dim>& a, const Rates<Dim>& b) {
    return std::max((a.v_dot - b.v_dot).norm() / b.v_dot.norm(),
                    (a.e_dot - b.e_dot).norm() / b.e_dot.norm());
}

/// Thinned out to one side, moving and hot at random.
template <int Dim>
std::vector<double> start(ParticleModel<Dim>& model, OwnRanges<Dim>& law) {
    const auto& x = model.particles().reference_position;
    std::mt19937_64 random(99);
    std::normal_distribution<double> g;
    Points<Dim> v(Dim, x.cols());
    for (auto& c : v.reshaped()) c = g(random);
    auto y = law.start(x, v, 1.3);
    for (auto& e : State<Dim>(model.layout(), y).energy().reshaped())
        e *= 1.0 + 0.3 * std::tanh(g(random));
    return y;
}

template <int Dim>
void check(int cells) {
    for (const bool of_two : {false, true}) {
        const VariableRangeScheme scheme{2.4, Kernel::w5};
        auto particles = jittered_particles<Dim>(cells, 91, 0.15, {});
        for (auto x : particles.reference_position.colwise()) x[0] *= 1.0 + 0.04 * x[0];
        if (of_two)
            for (std::size_t i = 0; i < particles.size(); ++i)
                particles.material.push_back(i % 3 == 0 ? 1 : 0);
        auto inviscid = mixture<Dim>(of_two);
        for (Fluid& fluid : inviscid) fluid = {fluid.state};
        Gas<Dim> gas(particles, mixture<Dim>(of_two), scheme), without(particles, inviscid, scheme);
        const auto y = start(gas.model, gas.law);
        const auto found = given_by<Dim>(gas.model, without.model, y);
        BOOST_TEST(difference(found, by_hand(gas, y, false)) < 1e-12);
        BOOST_TEST(difference(found, by_hand(gas, y, true)) > 1e-3);

        const ConstState<Dim> state(gas.model.layout(), y);
        const auto all = rates_of(gas.model, y);
        const ConstState<Dim> rate(gas.model.layout(), all);
        for (const auto& rates : {found, Rates<Dim>{rate.velocity(), rate.energy()}}) {
            ExactSum energy;
            Point<Dim> momentum = Point<Dim>::Zero();
            for (Eigen::Index i = 0; i < rates.e_dot.cols(); ++i) {
                const double m = particles.mass[static_cast<std::size_t>(i)];
                energy += m * rates.e_dot(i);
                energy += m * state.velocity().col(i).dot(rates.v_dot.col(i));
                momentum += m * rates.v_dot.col(i);
            }
            BOOST_TEST(std::abs(energy) < 1e-13 * rates.e_dot.cwiseAbs().sum());
            BOOST_TEST(momentum.norm() < 1e-13 * rates.v_dot.cwiseAbs().sum());
        }
        BOOST_TEST((gas.model.promises().angular_momentum == Promise::not_kept) == (Dim > 1));
        BOOST_TEST((without.model.promises().angular_momentum == Promise::integrator_error));
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_line) { check<1>(30); }
BOOST_AUTO_TEST_CASE(in_the_plane) { check<2>(9); }
BOOST_AUTO_TEST_CASE(in_space) { check<3>(6); }

/// A square lattice, where all ranges are the same.
BOOST_AUTO_TEST_CASE(of_one_range_it_is_that_of_smooth_particles) {
    const Box<2> box({12.0, 12.0});
    const auto particles = make_particles<2>(square_lattice<2>({12, 12}), 1.0, 1.0, box);
    VariableRangeModel<2> model(particles, rubbing(2), {3.0, Kernel::w4}, box),
        without(particles, {IdealGas{2, 1.0}}, {3.0, Kernel::w4}, box);
    const auto y = start(model, model.law);
    const auto h = model.ranges(y);
    const Scheme scheme{.kernel = Kernel::w4, .range = h[0]};
    FluidModel<2> usual(particles, rubbing(2), scheme, box),
        inviscid(particles, {IdealGas{2, 1.0}}, scheme, box);
    BOOST_TEST(difference(given_by<2>(model, without, y), given_by<2>(usual, inviscid, y)) < 1e-12);
    BOOST_TEST(model.fastest_damping(y) > 0.0);
    BOOST_TEST(std::abs(model.fastest_damping(y) / usual.fastest_damping(y) - 1.0) < 0.01);
    BOOST_TEST(without.fastest_damping(y) == 0.0);
}

BOOST_AUTO_TEST_CASE(what_is_refused) {
    const auto particles = jittered_particles<2>(8, 96);
    const auto refused = [&](const Fluid& fluid, const char* word) {
        const std::string said = refusal([&] { VariableRangeModel<2>(particles, fluid, {3.0}); });
        BOOST_TEST(said.find(word) != std::string::npos, said);
    };
    Fluid fluid = rubbing(2);
    fluid.by_pairs = false;
    refused(fluid, "by_pairs");
    fluid = rubbing(2);
    fluid.viscosity->lambda = 2.0 * eta;
    refused(fluid, "lambda");
    fluid = rubbing(2);
    fluid.state = LucyGas{};
    refused(fluid, "temperature");
}

BOOST_AUTO_TEST_CASE(a_particle_without_temperature_is_named) {
    const auto particles = jittered_particles<2>(8, 96);
    VariableRangeModel<2> model(particles, rubbing(2), {3.0});
    auto y = start(model, model.law);
    State<2>(model.layout(), y).energy()(0, 5) = -1e-3;
    rates_of(model, y);
    const std::string named = fmt::format("of particle {} are outside", particles.id[5]);
    BOOST_TEST(model.failure().find(named) != std::string::npos, model.failure());
}
