// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever an external gives to momentum, angular momentum and energy is booked, for every law of
// particles, so that what is left is kept as without it; what is not booked is found.
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/external/clamp.hpp>
#include <spam/external/drag.hpp>
#include <spam/external/friction.hpp>
#include <spam/external/gravity.hpp>
#include <spam/external/load.hpp>
#include <spam/external/thermostat.hpp>
#include <spam/integrate/integrator.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/material/yielding_solid.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/density_potentials.hpp>
#include <spam/rhs/elements.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>
#include <spam/setup/meshes.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;

namespace {

constexpr int columns = 9, rows = 5;
const double site_density = 2.0 / std::sqrt(3.0);

Particles<2> strip() { return make_particles<2>(triangular_block(columns, rows), 1.0); }

/// Every law of particles there is, small.
const std::vector<std::pair<std::string, std::function<std::unique_ptr<ParticleModel<2>>()>>> laws{
    {"solid",
     [] {
         return std::make_unique<SmoothParticleModel<2>>(strip(), ElasticSolid{0.43, 0.43},
                                                         Scheme{});
     }},
    {"solid, averaged velocity and balanced torques",
     [] {
         Scheme scheme;
         scheme.transport = Transport::average;
         scheme.angular_momentum = AngularMomentum::torque_pair;
         return std::make_unique<SmoothParticleModel<2>>(strip(), ElasticSolid{0.43, 0.43}, scheme);
     }},
    {"fluid",
     [] {
         return std::make_unique<FluidModel<2>>(strip(), Fluid{IdealGas{}},
                                                Scheme{.density = Density::summed});
     }},
    {"ranges by density",
     [] {
         return std::make_unique<VariableRangeModel<2>>(strip(), Fluid{IdealGas{}},
                                                        VariableRangeScheme{});
     }},
    {"density potential",
     [] {
         DensityPotentials potentials;
         potentials.state = EmbeddedAtom{1.0, site_density};
         return std::make_unique<DensityPotentialModel<2>>(strip(), potentials);
     }},
    {"pair potential", [] { return std::make_unique<PairPotentialModel<2>>(strip(), 3.0); }},
    {"total Lagrangian",
     [] {
         return std::make_unique<TotalLagrangianModel<2>>(strip(), StVenantKirchhoff{0.43, 0.43},
                                                          TotalLagrangianScheme{site_density});
     }},
    {"elements",
     [] {
         MeshedBodies bodies = make_nodes({rectangle_mesh(columns - 1, rows - 1)}, site_density);
         bodies.nodes.reference_position.colwise() += Point<2>(0.5 * (columns - 1), 0.0);
         auto model = std::make_unique<ParticleModel<2>>(std::move(bodies.nodes));
         model->add_term<Elements>(
             std::move(bodies.element),
             std::vector<Elements::Material>{
                 {YieldingSolid(PlaneVonMises{0.43, 0.43}, LinearHardening{0.01}),
                  site_density,
                  {0.1, 0.1}}});
         return model;
     }},
    {"springs", [] { return std::make_unique<BondedModel<2>>(strip(), HarmonicSpring{}); }}};

std::vector<double> start_of(ParticleModel<2>& model) {
    const Points<2> x = model.particles().reference_position;
    Points<2> v(2, x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        v(0, i) = x(0, i) < 1.2 ? 0.0 : 0.02 * std::sin(0.7 * x(0, i)) - 0.01 * x(1, i);
        v(1, i) = x(0, i) < 1.2 ? 0.0 : 0.01 * x(0, i) + 0.02 * std::cos(0.9 * x(1, i));
    }
    if (auto* fluid = dynamic_cast<FluidModel<2>*>(&model)) return fluid->state(x, v, 0.2);
    if (auto* ranges = dynamic_cast<VariableRangeModel<2>*>(&model))
        return ranges->state(x, v, 0.2);
    auto y = initial_state<2>(model, site_density, 0.43,
                              [](const Point<2>&) { return Point<2>::Zero().eval(); });
    State<2>(model.layout(), y).velocity() = v;
    return y;
}

Group end_of(const ParticleModel<2>& model) {
    return select<2>(model.particles(), [](const Point<2>& x) { return x.x() < 1.2; });
}

using Add = std::function<void(ParticleModel<2>&)>;
const std::vector<std::pair<std::string, Add>> externals{
    {"gravity", [](auto& m) { m.add(std::make_unique<Gravity<2>>(Point<2>(0.003, -0.01))); }},
    {"friction", [](auto& m) { m.add(std::make_unique<Friction<2>>(0.1)); }},
    {"drag", [](auto& m) { m.add(std::make_unique<Drag<2>>(0.5, 1.0, Point<2>(0.1, 0.0))); }},
    {"thermostat", [](auto& m) { m.add(std::make_unique<Thermostat<2>>(1e-3, 0.3)); }},
    {"load",
     [](auto& m) {
         m.add(std::make_unique<Load<2>>(
             [](double t) { return Point<2>(0.01 * std::sin(t), 0.02 * std::cos(2.0 * t)); },
             select<2>(m.particles(), [](const Point<2>& x) { return x.x() > 6.0; })));
     }},
    {"clamped end under its own weight",
     [](auto& m) {
         m.add(std::make_unique<Gravity<2>>(Point<2>(0.0, -0.01)));
         m.add(std::make_unique<Clamp<2>>(end_of(m)));
     }},
    {"end driven along an axis",
     [](auto& m) {
         auto clamp = std::make_unique<Clamp<2>>(
             end_of(m), [](double t) { return Point<2>(0.01 * t, 0.02 * std::sin(t)); },
             [](double t) { return Point<2>(0.01, 0.02 * std::cos(t)); });
         clamp->only_along(0);
         m.add(std::move(clamp));
     }},
    {"driven end", [](auto& m) {
         m.add(std::make_unique<Clamp<2>>(
             end_of(m), [](double t) { return Point<2>(0.01 * t, 0.02 * std::sin(t)); },
             [](double t) { return Point<2>(0.01, 0.02 * std::cos(t)); }));
     }}};

/// How fast what should be kept changes at a state on the way: the derivatives of p - impulse,
/// L - angular impulse and E - work - heat along the rates, by differences of fourth order (exact for p
/// and L, which are of second degree in y).
struct Drift {
    double momentum, angular_momentum, energy;
};

Drift drift_of(ParticleModel<2>& model) {
    IntegratorOptions rk4;
    rk4.dt = 0.05;
    Motion<2> motion(model, start_of(model), rk4);
    motion.advance_to(1.0);
    const std::vector<double> y(motion.y().begin(), motion.y().end());
    std::vector<double> y_dot(y.size());
    model.rates(1.0, y, y_dot);
    BOOST_TEST_REQUIRE(model.failure().empty());
    const auto at = [&](double h) {
        std::vector<double> z = y;
        for (std::size_t k = 0; k < z.size(); ++k) z[k] += h * y_dot[k];
        return measure_invariants<2>(model, z);
    };
    constexpr double h = 1e-3;
    const auto a = at(h), b = at(-h), c = at(2.0 * h), d = at(-2.0 * h);
    const auto slope = [&](const auto& f) {
        return (8.0 * (f(a) - f(b)) - (f(c) - f(d))) / (12.0 * h);
    };
    return {std::hypot(slope([](const auto& i) { return i.momentum_balance()[0]; }),
                       slope([](const auto& i) { return i.momentum_balance()[1]; })),
            std::abs(slope([](const auto& i) { return i.angular_momentum_balance()[0]; })),
            std::abs(slope([](const auto& i) { return i.energy_balance(); }))};
}

/// A force that nobody books.
class Secret final : public External<2> {
  public:
    void add(const Now&, Eigen::Index, Eigen::Index) const override {}
    bool potential() const override { return true; }
    std::string describe() const override { return "nothing"; }
};

}  // namespace

BOOST_AUTO_TEST_CASE(accounts_close_for_every_law_and_every_external) {
    for (const auto& [law, make] : laws)
        for (const auto& [external, add] : externals) BOOST_TEST_CONTEXT(law << ", " << external) {
                const auto model = make();
                add(*model);
                const Drift change = drift_of(*model);
                BOOST_TEST(change.momentum < 1e-11);
                BOOST_TEST(change.energy < 1e-9);
                if (model->promises().angular_momentum != Promise::not_kept)
                    BOOST_TEST(change.angular_momentum < 1e-10);
            }
}

/// The mutated law: as if gravity had a potential of its own and forgot it.
BOOST_AUTO_TEST_CASE(what_is_not_booked_is_missed) {
    class Forgetful final : public External<2> {
      public:
        void add(const Now& now, Eigen::Index first, Eigen::Index last) const override {
            now.rate.velocity().row(1).segment(first, last - first).array() -= 0.01;
        }
        bool potential() const override { return true; }  // but no energy
        std::string describe() const override { return "forgetful gravity"; }
    };
    const auto model = laws.front().second();
    model->add(std::make_unique<Forgetful>());
    const Drift change = drift_of(*model);
    BOOST_TEST(change.momentum < 1e-11);
    BOOST_TEST(change.energy > 1e-4);
}

BOOST_AUTO_TEST_CASE(driven_particles_follow_their_motion) {
    const auto model = laws.back().second();
    externals.back().second(*model);
    const Group end = end_of(*model);
    IntegratorOptions options;
    options.method = "arkode:DORMAND_PRINCE_7_4_5";
    options.rtol = 1e-10;
    Motion<2> motion(*model, start_of(*model), options);
    motion.advance_to(2.0);
    const ConstState<2> state = motion.state();
    int driven = 0;
    for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
        if (!is_in(end, i)) continue;
        ++driven;
        const Point<2> X = model->particles().reference_position.col(i);
        const Point<2> expected = X + Point<2>(0.01 * 2.0, 0.02 * (1.0 - std::cos(2.0)));
        BOOST_TEST((state.position().col(i) - expected).norm() < 1e-9);
    }
    BOOST_TEST(driven > 4);
    BOOST_TEST(std::abs(measure_invariants<2>(*model, motion.y()).work) > 1e-5);
}

BOOST_AUTO_TEST_CASE(a_thermostat_reaches_its_temperature_and_its_heat_is_booked) {
    const auto model = laws.back().second();
    model->add(std::make_unique<Thermostat<2>>(0.01, 1.0));
    IntegratorOptions rk4;
    rk4.dt = 0.05;
    Motion<2> motion(*model, start_of(*model), rk4);
    motion.advance_to(40.0);
    const auto after = measure_invariants<2>(*model, motion.y());
    const auto n = static_cast<double>(model->particles().size());
    const double mean = 0.5 * after.momentum.squaredNorm() / n;  // of masses 1
    BOOST_TEST(std::abs((after.kinetic - mean) / (n - 1.0) / 0.01 - 1.0) < 0.3);
    BOOST_TEST(after.heat > 0.3 * after.kinetic);
    BOOST_TEST(after.work == 0.0);
}

/// Leapfrog and its relatives keep p and L with a force from outside, too.
BOOST_AUTO_TEST_CASE(accounts_take_the_kicks_of_velocities) {
    const auto model = laws.back().second();
    model->add(std::make_unique<Gravity<2>>(Point<2>(0.003, -0.01)));
    IntegratorOptions leapfrog;
    leapfrog.method = "leapfrog";
    leapfrog.dt = 0.1;
    Motion<2> motion(*model, start_of(*model), leapfrog);
    const auto before = measure_invariants<2>(*model, motion.y());
    motion.advance_to(50.0);
    const auto after = measure_invariants<2>(*model, motion.y());
    BOOST_TEST(after.momentum.norm() > 1.0);
    BOOST_TEST((after.momentum_balance() - before.momentum_balance()).norm() < 1e-12);
    BOOST_TEST((after.angular_momentum_balance() - before.angular_momentum_balance()).norm() <
               1e-10);
    BOOST_TEST(std::abs(after.energy_balance() - before.energy_balance()) < 1e-3 * after.kinetic);
}

/// Adaptive steps do not depend on accounts.
BOOST_AUTO_TEST_CASE(accounts_have_no_say_in_steps) {
    const auto steps = [](bool booked) {
        const auto model = laws.back().second();
        if (booked) model->add(std::make_unique<Secret>());
        IntegratorOptions options;
        options.method = "arkode:DORMAND_PRINCE_7_4_5";
        Motion<2> motion(*model, start_of(*model), options);
        motion.advance_to(5.0);
        return motion.statistics().steps;
    };
    const auto with = static_cast<double>(steps(true)), without = static_cast<double>(steps(false));
    BOOST_TEST(std::abs(with - without) <= 2.0);  // N in the norm is larger by five
}
