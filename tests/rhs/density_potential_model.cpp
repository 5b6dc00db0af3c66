// SPDX-License-Identifier: GPL-3.0-or-later
// Potentials of the density as a right-hand side: the rates are those of two sums over all pairs in
// double, and minus the slope of the energy, for every potential alone and for all together; what it
// keeps; threads; states and cases without meaning.
#include "support/model_ode.hpp"
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/core/parallel.hpp>
#include <spam/kernel/any_weight.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/physics/curvature_strength.hpp>
#include <spam/physics/embedded_energy.hpp>
#include <spam/physics/surface_tension.hpp>
#include <spam/rhs/density_potentials.hpp>

#include <boost/test/unit_test.hpp>
#include <fmt/format.h>

using namespace spam;
using namespace spam::test;

namespace {

constexpr double range = 2.3;

/// The law of a model, as EmbeddedEnergy knows it.
struct SameLaw {
    AnyEquationOfState any;
    double pressure(double rho, double e) const { return any.pressure(rho, e); }
    double sound_speed_squared(double, double) const { return 0.0; }
    double cold_energy(double rho) const { return any.cold_energy(rho); }
    std::string describe() const { return any.describe(); }
};

/// Every potential alone, and all that there are.
template <int Dim>
std::vector<DensityPotentials> cases() {
    std::vector<DensityPotentials> all(6);
    all[0].state = EmbeddedAtom{1.3, 0.9};
    all[1].state = LucyGas{};
    all[1].kernel = Kernel::monaghan;
    all[2].surface_tension = 0.3;
    all[3].core = {0.7, 1.3};
    all[4] = {EmbeddedAtom{1.3, 0.9}, 0.3, 0.0, {0.7, 1.3}, Kernel::lucy};
    all[5] = {EmbeddedAtom{1.3, 0.9}, 0.3, Dim > 1 ? 0.2 : 0.0, {0.7, 1.3}, Kernel::w5};
    if (Dim > 1) all.push_back({{}, 0.0, 0.2, {0.0, 0.0}, Kernel::w4});
    for (auto& p : all) p.range = range;
    return all;
}
/// All of them, last but one: curvature alone is the last.
template <int Dim>
DensityPotentials everything() {
    return cases<Dim>()[5];
}

/// Two sums over pairs in double. `Tension`, `Strength`: the potentials, or ones with an error.
template <int Dim, class Tension = SurfaceTension, class Strength = CurvatureStrength>
EnergyAndForces<Dim> oracle(const Particles<Dim>& particles, const DensityPotentials& p,
                            const Box<Dim>& box, const Points<Dim>& x) {
    const AnyWeight<Dim> w = weight_function<Dim>(to_string(p.kernel), p.range);
    const PairList<Dim> pairs(x, p.range, box);
    const ListedParticles<Dim> near{x, particles.mass, pairs, box};
    EnergyAndForces<Dim> sum =
        energy_and_forces<Dim>(CorePotential{p.core.e_c, std::max(p.core.s, 0.1)}, near);
    if (p.state) sum += energy_and_forces<Dim>(EmbeddedEnergy<SameLaw>{SameLaw{*p.state}}, w, near);
    Tension tension;
    tension.s_g = p.surface_tension;
    if (p.surface_tension > 0.0) sum += energy_and_forces<Dim>(tension, w, near);
    if constexpr (Dim > 1) {
        Strength strength;
        strength.s_c = p.strength;
        if (p.strength > 0.0) sum += energy_and_forces<Dim>(strength, w, near);
    }
    return sum;
}

template <int Dim>
Points<Dim> forces(const Model<Dim>& model, std::span<const double> y_dot) {
    Points<Dim> F = ConstState<Dim>(model.layout(), y_dot).velocity();
    for (Eigen::Index i = 0; i < F.cols(); ++i)
        F.col(i) *= model.particles().mass[static_cast<std::size_t>(i)];
    return F;
}

/// Largest |F - F_oracle| relative to the largest force.
template <int Dim, class... Mutated>
double force_error(DensityPotentialModel<Dim>& model, std::span<const double> y) {
    const Points<Dim> x = ConstState<Dim>(model.layout(), y).position();
    const auto exact =
        oracle<Dim, Mutated...>(model.particles(), model.law.potentials(), model.box(), x);
    return (forces(model, rates_of(model, y)) - exact.force).cwiseAbs().maxCoeff() /
           exact.force.cwiseAbs().maxCoeff();
}

/// dPhi/dt along the velocities, by differences of fourth order, against the power of the forces.
template <int Dim>
double power_error(DensityPotentialModel<Dim>& model, const std::vector<double>& y) {
    const Points<Dim> v = ConstState<Dim>(model.layout(), y).velocity();
    const auto energy = [&](double t) {
        auto moved = y;
        State<Dim>(model.layout(), moved).position() += t * v;
        return model.internal_energy(moved);
    };
    const double h = 1e-4;
    const double change =
        (8.0 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12.0 * h);
    const double power = forces(model, rates_of(model, y)).cwiseProduct(v).sum();
    return std::abs(change + power) / std::abs(power);
}

template <int Dim>
void check(const DensityPotentials& p, int cells, const Box<Dim>& box) {
    BOOST_TEST_CONTEXT(p.describe()
                       << ", " << Dim << "d, " << (box.periodic() ? "periodic" : "free")) {
        DensityPotentialModel<Dim> model(jittered_particles<Dim>(cells, 81, 0.2, box), p, box);
        auto y = random_state(model, 82);
        const State<Dim> state(model.layout(), y);
        state.position().array() += 37.3;  // wherever the images are
        BOOST_TEST(force_error(model, y) < 1e-12);
        const auto y_dot = rates_of(model, y);
        BOOST_TEST((ConstState<Dim>(model.layout(), y_dot).position() == state.velocity()));
        const Points<Dim> x = state.position();
        const double energy = oracle<Dim>(model.particles(), p, box, x).energy;
        BOOST_TEST(std::abs(model.internal_energy(y) - energy) < 1e-12 * energy);
        BOOST_TEST(power_error(model, y) < 1e-5);

        const Points<Dim> F = forces(model, y_dot);
        const double size = F.cwiseAbs().maxCoeff() * static_cast<double>(F.cols());
        BOOST_TEST(F.rowwise().sum().norm() < 1e-14 * size);
        const Eigen::Matrix<double, Dim, Dim> moment = x * F.transpose();
        if (!box.periodic()) BOOST_TEST((moment - moment.transpose()).norm() < 1e-12 * size);
    }
}

// ---- with one thing wrong ----

/// Forgets that a gradient changes sign with the direction.
struct EvenGradient : SurfaceTension {
    static constexpr double parity = 1.0;
};
/// Forgets the term along the line of centres, in which w''' is.
struct NoThirdDerivative : CurvatureStrength {
    template <int Dim>
    static Vec<Dim> pull(const SymTensor<Dim>& G, const WeightAt<Dim>& at) {
        return (2.0 * at.second_over_r) * (G * at.n);
    }
};
/// A law that ends at a density of 2.
struct NarrowLaw : EmbeddedAtom {
    double pressure(double rho, double e) const {
        return only_where(rho < 2.0, EmbeddedAtom::pressure(rho, e));
    }
};

template <int Dim>
std::string why_refused(const DensityPotentials& p, const Box<Dim>& box = {}) {
    return refusal([&] { DensityPotentialModel<Dim>(jittered_particles<Dim>(7, 83), p, box); });
}
bool says(const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_line) {
    for (const auto& p : cases<1>()) {
        check<1>(p, 60, {});
        check<1>(p, 60, periodic<1>(60.0));
    }
}
BOOST_AUTO_TEST_CASE(in_the_plane) {
    for (const auto& p : cases<2>()) {
        check<2>(p, 12, {});
        check<2>(p, 24, Box<2>({24.0, 24.0 * std::sqrt(0.75)}));
        check<2>(p, 12, Box<2>({12.0, 0.0}));
    }
}
BOOST_AUTO_TEST_CASE(in_space) {
    for (const auto& p : cases<3>()) {
        check<3>(p, 6, {});
        check<3>(p, 7, periodic<3>(7.0));
    }
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_noticed) {
    DensityPotentialModel<2> model(jittered_particles<2>(12, 84), everything<2>());
    const auto y = random_state(model, 85);
    BOOST_TEST((force_error<2>(model, y)) < 1e-12);
    BOOST_TEST((force_error<2, EvenGradient, CurvatureStrength>(model, y)) > 1e-3);
    BOOST_TEST((force_error<2, SurfaceTension, NoThirdDerivative>(model, y)) > 1e-3);
}

BOOST_AUTO_TEST_CASE(densities_are_sums_over_neighbours) {
    DensityPotentialModel<2> model(jittered_particles<2>(8, 86), everything<2>());
    const auto y = random_state(model, 87);
    const Points<2> x = ConstState<2>(model.layout(), y).position();
    const PairList<2> pairs(x, range, {});
    const Box<2> open;
    const AnyWeight<2> w = weight_function<2>("w5", range);
    const EmbeddedEnergy<EmbeddedAtom> any{EmbeddedAtom{}};
    const auto rho =
        density_fields<2>(any, w, ListedParticles<2>{x, model.particles().mass, pairs, open});
    BOOST_TEST(relative_difference(model.density(y), rho) < 1e-14);
}

BOOST_AUTO_TEST_CASE(one_two_and_three_threads_give_the_same_bits) {
    const auto particles = jittered_particles<2>(40, 88);
    BOOST_TEST(particles.size() > parallel_threshold);
    const auto y = random_state(DensityPotentialModel<2>(particles, everything<2>()), 89);
    std::vector<std::vector<double>> results;
    for (const int threads : {1, 2, 3}) {
        set_threads(threads);
        DensityPotentialModel<2> model(particles, everything<2>());
        results.push_back(rates_of(model, y));
    }
    set_threads(1);
    BOOST_TEST((results[0] == results[1]));
    BOOST_TEST((results[0] == results[2]));
}

BOOST_AUTO_TEST_CASE(lists_grow_old_without_a_trace) {
    const Box<2> box({24.0, 12.0 * std::sqrt(3.0)});
    const auto particles = jittered_particles<2>(24, 90, 0.15, box);
    DensityPotentialModel<2> flow(particles, everything<2>(), box);
    auto y = random_state(flow, 91);
    std::mt19937_64 random(92);
    std::uniform_real_distribution<double> u(-0.1, 0.1);
    for (int step = 0; step < 40; ++step) {
        for (auto& x : State<2>(flow.layout(), y).position().reshaped()) x += u(random);
        DensityPotentialModel<2> fresh(particles, everything<2>(), box);
        BOOST_TEST(relative_difference(rates_of(flow, y), rates_of(fresh, y)) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(energy_is_kept_to_fourth_order_and_momenta_to_round_off) {
    std::vector<double> drifts;
    for (const double dt : {0.02, 0.01}) {
        auto model = std::make_unique<DensityPotentialModel<2>>(jittered_particles<2>(8, 93, 0.1),
                                                                everything<2>());
        auto start = random_state(*model, 94);
        State<2>(model->layout(), start).velocity() *= 0.2;
        System system(std::move(model), start);
        const SundialsContext context;
        Vector y = start_of(system, context);
        const auto rk4 = make_integrator({.dt = dt}, system.ode, y, 0.0, context);
        while (rk4->t() < 2.0) rk4->step(2.0);
        drifts.push_back(std::abs(total_energy(*system.model, y.span()) -
                                  total_energy(*system.model, system.y0)));
        const auto turning = [&](std::span<const double> z) {
            const ConstState<2> s(system.model->layout(), z);
            Eigen::Vector3d p = Eigen::Vector3d::Zero();
            for (Eigen::Index i = 0; i < s.position().cols(); ++i) {
                const Point<2> r = s.position().col(i), v = s.velocity().col(i);
                p += system.model->particles().mass[static_cast<std::size_t>(i)] *
                     Eigen::Vector3d(v.x(), v.y(), r.x() * v.y() - r.y() * v.x());
            }
            return p;
        };
        const Eigen::Vector3d change = turning(y.span()) - turning(system.y0);
        BOOST_TEST(change.head<2>().norm() < 1e-12);
        BOOST_TEST(std::abs(change[2]) < 1e-5);  // to the integrator's error
    }
    BOOST_TEST_MESSAGE("energy drift " << drifts[0] << ", with half the step " << drifts[1]);
    BOOST_TEST(drifts[0] < 1e-4);
    BOOST_TEST(drifts[1] < drifts[0] / 12.0);
}

BOOST_AUTO_TEST_CASE(particles_at_one_place_exert_no_infinite_force) {
    DensityPotentialModel<2> model(jittered_particles<2>(6, 95), everything<2>());
    auto y = random_state(model, 96);
    const State<2> state(model.layout(), y);
    state.position().col(5) = state.position().col(4);
    for (const double rate : rates_of(model, y)) BOOST_TEST(std::isfinite(rate));
    BOOST_TEST(std::isfinite(model.internal_energy(y)));
}

BOOST_AUTO_TEST_CASE(states_without_meaning_are_named) {
    DensityPotentials p = everything<2>();
    p.state = NarrowLaw{};
    DensityPotentialModel<2> model(make_particles<2>(triangular_block(6, 6), 1.0), p);
    auto y = random_state(model, 97);
    rates_of(model, y);
    BOOST_TEST(model.failure().empty(), model.failure());
    const State<2> state(model.layout(), y);
    state.position().col(5) = state.position().col(4) = state.position().col(9);
    const auto rates = rates_of(model, y);
    BOOST_TEST(std::isnan(rates[0]));
    const auto rho = model.density(y);
    const auto first = std::find_if(rho.begin(), rho.end(), [](double r) { return r >= 2.0; });
    const auto expected =
        fmt::format("density {} of particle {} is outside the law 'embedded atom", *first,
                    model.particles().id[static_cast<std::size_t>(first - rho.begin())]);
    BOOST_TEST(says(model.failure(), expected.c_str()), model.failure());
    y[0] = std::numeric_limits<double>::infinity();
    rates_of(model, y);
    BOOST_TEST(says(model.failure(), "a position is not finite"));
    BOOST_TEST(std::isnan(model.internal_energy(y)));
    y = random_state(model, 97);
    rates_of(model, y);
    BOOST_TEST(model.failure().empty());
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    const auto with = [](const auto& change) {
        DensityPotentials p = everything<2>();
        change(p);
        return why_refused<2>(p);
    };
    BOOST_TEST(says(why_refused<2>({}), "potentials: none acts"));
    BOOST_TEST(says(with([](auto& p) { p.state = IdealGas{}; }), "use a cold law"));
    BOOST_TEST(says(with([](auto& p) { p.kernel = Kernel::lucy; }), "use w4 or smoother"));
    BOOST_TEST(says(with([](auto& p) { p.kernel = Kernel::w2; }), "a gradient potential needs"));
    BOOST_TEST(says(with([](auto& p) { p.range = 0.9; }), "range: 0.9"));
    BOOST_TEST(says(with([](auto& p) { p.core.s = 2.4; }), "core-range: 2.4"));
    BOOST_TEST(says(with([](auto& p) { p.core.e_c = -0.1; }), "core: -0.1"));
    BOOST_TEST(says(with([](auto& p) { p.surface_tension = NAN; }), "surface-tension: nan"));
    BOOST_TEST(says(with([](auto& p) { p.strength = -1.0; }), "strength: -1"));
    BOOST_TEST(says(why_refused<2>(everything<2>(), Box<2>({0.45, 4.5})), "box: periodic length"));
    DensityPotentials curved = everything<1>();
    curved.strength = 0.1;
    BOOST_TEST(says(why_refused<1>(curved), "a curvature potential is always zero in 1 dimension"));
    BOOST_TEST(
        everything<2>().describe() ==
        "embedded atom, B0 = 1.3, rho0 = 0.9; surface tension 0.3; strength 0.2; core 0.7 of "
        "range 1.3; w5 weight of range 2.3");
}
