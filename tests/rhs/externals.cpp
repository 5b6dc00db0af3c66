// SPDX-License-Identifier: GPL-3.0-or-later
// Externals: a friction has neither force nor torque where it should not, and takes energy; whatever an
// external gives to momentum, angular momentum and energy is booked, for every model, so that what is left
// is kept as without it; what is not booked is found. The virial stress of springs is that of the elastic
// solid they make.
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
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
#include <spam/problem/run_in_memory.hpp>
#include <spam/rhs/bonded_model.hpp>
#include <spam/rhs/density_potential_model.hpp>
#include <spam/rhs/fluid_model.hpp>
#include <spam/rhs/pair_potential_model.hpp>
#include <spam/rhs/smooth_particle_model.hpp>
#include <spam/rhs/total_lagrangian_model.hpp>
#include <spam/rhs/variable_range_model.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace spam;

namespace {

constexpr double friction_gamma = 0.3;

std::unique_ptr<ParticleModel<2>> disk() {
    return std::make_unique<BondedModel<2>>(make_particles<2>(triangular_disk(4.0), 1.5),
                                            HarmonicSpring{});
}
std::unique_ptr<ParticleModel<3>> block() {
    return std::make_unique<BondedModel<3>>(make_particles<3>(square_lattice<3>({4, 3, 5}), 1.5),
                                            HarmonicSpring{});
}

/// Positions and velocities a bit off those of a body that drifts and turns.
template <int Dim>
std::vector<double> moving_state(Model<Dim>& model, double disorder) {
    auto y = initial_state<Dim>(model, 1.0, 1.0, [](const Point<Dim>& x) {
        Point<Dim> v = Point<Dim>::Constant(0.3);
        v[0] -= 0.05 * x[1];
        v[1] += 0.05 * x[0];
        return v;
    });
    std::mt19937 random(5);
    std::uniform_real_distribution<double> small(-disorder, disorder);
    const State<Dim> state(model.layout(), y);
    for (auto& number : state.position().reshaped()) number += small(random);
    for (auto& number : state.velocity().reshaped()) number += small(random);
    return y;
}

/// What one external gives, by the accounts, and the largest change it makes to a rate.
template <int Dim>
struct Effect {
    Point<Dim> force;
    Eigen::Matrix<double, Dim*(Dim - 1) / 2, 1> torque;
    double power, heat, largest;
};

template <int Dim>
Effect<Dim> effect_of(std::unique_ptr<ParticleModel<Dim>> model,
                      std::unique_ptr<ParticleModel<Dim>> plain,
                      std::unique_ptr<External<Dim>> external, double disorder) {
    const auto y_plain = moving_state<Dim>(*plain, disorder);
    model->add(std::move(external));
    const auto y = moving_state<Dim>(*model, disorder);
    std::vector<double> with(y.size()), without(y_plain.size());
    model->rates(0.0, y, with);
    plain->rates(0.0, y_plain, without);
    const State<Dim> rate(model->layout(), with), before(plain->layout(), without);
    BOOST_TEST((rate.position() == before.position()));
    return {rate.field(Field::impulse), rate.field(Field::angular_impulse),
            rate.field(Field::work)(0, 0), rate.field(Field::heat)(0, 0),
            (rate.velocity() - before.velocity()).cwiseAbs().maxCoeff()};
}

Effect<2> friction(double disorder, FrictionOf of = FrictionOf::internal_motion) {
    return effect_of<2>(disk(), disk(), std::make_unique<Friction<2>>(friction_gamma, of),
                        disorder);
}
Effect<3> friction_in_space(double disorder) {
    return effect_of<3>(block(), block(), std::make_unique<Friction<3>>(friction_gamma), disorder);
}

}  // namespace

BOOST_AUTO_TEST_CASE(friction_has_no_force_and_no_torque_and_takes_energy) {
    const Effect<2> e = friction(0.1);
    BOOST_TEST(e.force.norm() < 1e-13);
    BOOST_TEST(e.torque.norm() < 1e-12);
    BOOST_TEST(e.power < -0.01);
    BOOST_TEST(e.heat == 0.0);
    BOOST_TEST(e.largest > 0.01);
    const Effect<3> in_space = friction_in_space(0.1);
    BOOST_TEST(in_space.force.norm() < 1e-13);
    BOOST_TEST(in_space.torque.norm() < 1e-12);
    BOOST_TEST(in_space.power < -0.01);
    BOOST_TEST(in_space.largest > 0.01);
}

/// The mutated law of the one before, which has both; and a law of its own.
BOOST_AUTO_TEST_CASE(friction_of_all_velocity_takes_momentum_as_well) {
    const Effect<2> e = friction(0.1, FrictionOf::all_motion);
    const auto plain = disk();
    const auto now = measure_invariants<2>(*plain, moving_state<2>(*plain, 0.1));
    BOOST_TEST((e.force + friction_gamma * now.momentum).norm() < 1e-13 * now.momentum.norm());
    BOOST_TEST(std::abs(e.torque[0] + friction_gamma * now.angular_momentum[0]) <
               1e-13 * std::abs(now.angular_momentum[0]));
    BOOST_TEST(std::abs(e.power + 2.0 * friction_gamma * now.kinetic) < 1e-13 * now.kinetic);
}

BOOST_AUTO_TEST_CASE(rigid_motion_is_left_alone) {
    BOOST_TEST(friction(0.0).largest < 1e-15);
    BOOST_TEST(friction_in_space(0.0).largest < 1e-15);
}

BOOST_AUTO_TEST_CASE(a_model_says_what_acts_on_it) {
    auto model = disk();
    const auto plain = model->promises();
    const double damping = model->fastest_damping();
    BOOST_TEST(model->inseparable().empty());
    model->add(std::make_unique<Gravity<2>>(Point<2>(0.0, -0.5)));
    BOOST_TEST(model->inseparable().empty());
    model->add(std::make_unique<Friction<2>>(friction_gamma, FrictionOf::all_motion));
    BOOST_TEST((model->promises().energy == plain.energy));
    BOOST_TEST((model->promises().momentum == plain.momentum));
    BOOST_TEST(model->fastest_damping() == damping + friction_gamma);
    BOOST_TEST(!model->inseparable().empty());
    BOOST_TEST(
        model->describe().ends_with("; gravity (0, -0.5); friction gamma = 0.3 of all motion"),
        model->describe());
    BOOST_CHECK_THROW(Friction<2>(-0.1), InputError);
    BOOST_CHECK_THROW(Friction<2>(std::nan("")), InputError);
    BOOST_CHECK_THROW(Thermostat<2>(0.0, 1.0), InputError);
    BOOST_CHECK_THROW(Thermostat<2>(1.0, -1.0), InputError);
    BOOST_CHECK_THROW(Drag<2>(-1.0, 1.0), InputError);
    BOOST_CHECK_THROW(Gravity<2>(Point<2>(0.0, HUGE_VAL)), InputError);
}

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
     [] { return std::make_unique<FluidModel<2>>(strip(), Fluid{IdealGas{}}, FluidScheme{}); }},
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
    {"driven end", [](auto& m) {
         m.add(std::make_unique<Clamp<2>>(
             end_of(m), [](double t) { return Point<2>(0.01 * t, 0.02 * std::sin(t)); },
             [](double t) { return Point<2>(0.01, 0.02 * std::cos(t)); }));
     }}};

struct Kept {
    double momentum, angular_momentum, energy;  ///< largest change of what is left, over the run
    double work;                                ///< |work| + |heat| at the end
};

Kept kept(ParticleModel<2>& model, double dt, double t_end = 4.0) {
    Plan<2> plan;
    plan.t_end = t_end;
    plan.output_every = 1.0;
    IntegratorOptions rk4;
    rk4.dt = dt;
    Case<2> one{model, start_of(model), plan};
    const auto before = measure_invariants<2>(model, one.y0);
    const RunRecord run = run_in_memory<2>(std::move(one), rk4);
    BOOST_TEST_REQUIRE(run.complete);
    const auto after = measure_invariants<2>(model, run.y);
    return {(after.momentum_balance() - before.momentum_balance()).norm(),
            (after.angular_momentum_balance() - before.angular_momentum_balance()).norm(),
            std::abs(after.energy_balance() - before.energy_balance()),
            std::abs(after.work) + std::abs(after.heat)};
}

/// A force that nobody books.
class Secret final : public External<2> {
  public:
    void add(const Now&, Eigen::Index, Eigen::Index) const override {}
    bool potential() const override { return true; }
    std::string describe() const override { return "nothing"; }
};

}  // namespace

/// p - impulse to rounding, E - work - heat and L - angular impulse to the integrator's error: it falls
/// as its order when steps are halved, unless it is rounding already.
BOOST_AUTO_TEST_CASE(accounts_close_for_every_law_and_every_external) {
    for (const auto& [law, make] : laws)
        for (const auto& [external, add] : externals) BOOST_TEST_CONTEXT(law << ", " << external) {
                const auto of = [&](double dt) {
                    const auto model = make();
                    add(*model);
                    return kept(*model, dt);
                };
                const Kept coarse = of(0.1), fine = of(0.05);
                BOOST_TEST(coarse.momentum < 1e-12);
                BOOST_TEST(fine.energy < std::max(coarse.energy / 8.0, 1e-11));
                const bool keeps_L = make()->promises().angular_momentum != Promise::not_kept;
                if (keeps_L)
                    BOOST_TEST(fine.angular_momentum <
                               std::max(coarse.angular_momentum / 8.0, 1e-11));
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
    const Kept of = kept(*model, 0.05);
    BOOST_TEST(of.momentum < 1e-12);
    BOOST_TEST(of.energy > 1e-3);
}

BOOST_AUTO_TEST_CASE(driven_particles_follow_their_motion) {
    const auto model = laws.back().second();
    externals.back().second(*model);
    const Group end = end_of(*model);
    Plan<2> plan;
    plan.t_end = 2.0;
    plan.output_every = 1.0;
    IntegratorOptions options;
    options.method = "arkode:DORMAND_PRINCE_7_4_5";
    options.rtol = 1e-10;
    const RunRecord run = run_in_memory<2>({*model, start_of(*model), plan}, options);
    const ConstState<2> state(model->layout(), run.y);
    int driven = 0;
    for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
        if (!is_in(end, i)) continue;
        ++driven;
        const Point<2> X = model->particles().reference_position.col(i);
        const Point<2> expected = X + Point<2>(0.01 * 2.0, 0.02 * (1.0 - std::cos(2.0)));
        BOOST_TEST((state.position().col(i) - expected).norm() < 1e-9);
    }
    BOOST_TEST(driven > 4);
    BOOST_TEST(std::abs(measure_invariants<2>(*model, run.y).work) > 1e-5);
}

BOOST_AUTO_TEST_CASE(a_thermostat_reaches_its_temperature_and_its_heat_is_booked) {
    const auto model = laws.back().second();
    model->add(std::make_unique<Thermostat<2>>(0.01, 1.0));
    Plan<2> plan;
    plan.t_end = 40.0;
    plan.output_every = 40.0;
    IntegratorOptions rk4;
    rk4.dt = 0.05;
    const RunRecord run = run_in_memory<2>({*model, start_of(*model), plan}, rk4);
    const auto after = measure_invariants<2>(*model, run.y);
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
    Plan<2> plan;
    plan.t_end = 50.0;
    plan.output_every = 50.0;
    IntegratorOptions leapfrog;
    leapfrog.method = "leapfrog";
    leapfrog.dt = 0.1;
    const auto y0 = start_of(*model);
    const auto before = measure_invariants<2>(*model, y0);
    const RunRecord run = run_in_memory<2>({*model, y0, plan}, leapfrog);
    const auto after = measure_invariants<2>(*model, run.y);
    BOOST_TEST(after.momentum.norm() > 1.0);
    BOOST_TEST((after.momentum_balance() - before.momentum_balance()).norm() < 1e-12);
    BOOST_TEST((after.angular_momentum_balance() - before.angular_momentum_balance()).norm() <
               1e-10);
    BOOST_TEST(std::abs(after.energy_balance() - before.energy_balance()) < 1e-3 * after.kinetic);
}

BOOST_AUTO_TEST_CASE(rates_do_not_depend_on_the_number_of_threads) {
    auto model = std::make_unique<BondedModel<2>>(make_particles<2>(triangular_hexagon(30), 1.0),
                                                  HarmonicSpring{});
    model->add(std::make_unique<Friction<2>>(0.2));
    model->add(std::make_unique<Gravity<2>>(Point<2>(0.0, -0.01)));
    const auto y = moving_state<2>(*model, 0.1);
    std::vector<double> one(y.size()), three(y.size());
    const int threads = set_threads(1);
    model->rates(0.0, y, one);
    set_threads(3);
    model->rates(0.0, y, three);
    set_threads(threads);
    BOOST_TEST(one == three, boost::test_tools::per_element());
}

/// Adaptive steps do not depend on accounts.
BOOST_AUTO_TEST_CASE(accounts_have_no_say_in_steps) {
    const auto steps = [](bool booked) {
        const auto model = laws.back().second();
        if (booked) model->add(std::make_unique<Secret>());
        Plan<2> plan;
        plan.t_end = 5.0;
        plan.output_every = 5.0;
        IntegratorOptions options;
        options.method = "arkode:DORMAND_PRINCE_7_4_5";
        return run_in_memory<2>({*model, start_of(*model), plan}, options).statistics.steps;
    };
    const auto with = static_cast<double>(steps(true)), without = static_cast<double>(steps(false));
    BOOST_TEST(std::abs(with - without) <= 2.0);  // N in the norm is larger by five
}

BOOST_AUTO_TEST_CASE(what_is_held_is_not_reflected) {
    Scheme scheme;
    scheme.closest_approach = 0.5;
    const auto with = [&](const Group& group) {
        auto model =
            std::make_unique<SmoothParticleModel<2>>(strip(), ElasticSolid{0.43, 0.43}, scheme);
        model->add(std::make_unique<Clamp<2>>(group.empty() ? group : end_of(*model)));
        return model;
    };
    BOOST_TEST(with({})->events().empty());  // nothing moves
    BOOST_CHECK_THROW(with(Group(1))->events(), InputError);
}

BOOST_AUTO_TEST_CASE(virial_stress_is_that_of_the_elastic_solid) {
    BondedModel<2> model(make_particles<2>(triangular_disk(4.0), 1.0), HarmonicSpring{});
    const double e = 1e-6, xx = 3.0 * e, yy = 0.5 * e, xy = 2.0 * e;
    std::vector<double> y(model.layout().size(), 0.0);
    auto x = State<2>(model.layout(), y).position();
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const Point<2> X = model.particles().reference_position.col(i);
        x.col(i) << X.x() + xx * X.x() + xy * X.y(), X.y() + xy * X.x() + yy * X.y();
    }
    Mat<2> strain;
    strain(0, 0) = xx, strain(1, 1) = yy, strain(0, 1) = strain(1, 0) = xy;
    const auto expected = ElasticSolid::triangular_lattice().stress_rate(strain, SymTensor<2>{});
    const auto stress = model.stress(y, std::sqrt(0.75));
    for (std::size_t i = 0; i < stress.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        if (model.particles().reference_position.col(at).norm() > 3.0) continue;  // six bonds
        for (std::size_t k = 0; k < 3; ++k)
            BOOST_TEST(stress[i].c[k] == expected.c[k], boost::test_tools::tolerance(1e-4));
    }
}

BOOST_AUTO_TEST_CASE(disks_hold_every_site_within_their_radius) {
    BOOST_TEST(triangular_disk(0.0).cols() == 1);
    BOOST_TEST(triangular_disk(1.0).cols() == 7);
    BOOST_TEST(triangular_disk(std::sqrt(3.0)).cols() == 13);
    BOOST_TEST(triangular_disk(8.0).cols() == 241);  // the ball of [HH07]
    BOOST_TEST(triangular_disk(16.0, 2.0).cols() == 241);
    BOOST_TEST(triangular_disk(12.3).colwise().norm().maxCoeff() <= 12.3);
}
