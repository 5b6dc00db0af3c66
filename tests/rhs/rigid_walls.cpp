// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid walls: nothing but reflections. Every law that moves particles with their own velocities keeps its
// energy and, with what the walls gave, momentum and angular momentum; and its rates are those in open space.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/diagnostics/invariants.hpp>
#include <spam/external/clamp.hpp>
#include <spam/external/gravity.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include <functional>

using namespace spam;
using namespace spam::test;

namespace {

template <int Dim>
Box<Dim> rigid_room(double low, double high) {
    Box<Dim> box;
    for (int a = 0; a < Dim; ++a) {
        box.set_wall(a, false, {WallKind::rigid, low});
        box.set_wall(a, true, {WallKind::rigid, high});
    }
    return box;
}

const double site_density = 2.0 / std::sqrt(3.0);

using Add = std::function<void(ParticleModel<2>&)>;

struct Law {
    const char* name;
    Add add;
    double dt;  ///< with which rk4 is in its order
};
const std::vector<Law> laws{
    {"solid",
     [](auto& m) {
         m.template add_term<SmoothParticles<2>>(
             ElasticSolid{0.43, 0.43}, Scheme{.density = Density::continuity,
                                              .angular_momentum = AngularMomentum::torque_pair});
     },
     0.2},
    {"total Lagrangian",
     [](auto& m) {
         m.template add_term<TotalLagrangian<2>>(StVenantKirchhoff{0.43, 0.43},
                                                 TotalLagrangianScheme{site_density});
     },
     0.2},
    {"material vectors",
     [](auto& m) {
         m.template add_term<MaterialVectors<2>>(PolynomialSolid{0.43, 0.43},
                                                 MaterialVectorScheme{site_density});
     },
     0.1},
    {"springs", [](auto& m) { m.template add_term<Springs<2>>(HarmonicSpring{}); }, 0.1},
    {"Lucy's potential", [](auto& m) { m.template add_term<WeightPotential<2>>(2.6); }, 0.05},
    {"molecules", [](auto& m) { m.template add_term<Cohesion<2>>(); }, 0.005}};

const double angles[] = {0.1, 0.25, 0.4, 0.75};

struct Outcome {
    double energy, momentum, angular_momentum, walls, beyond;
    std::size_t reflections;
    Point<2> velocity;
};

/// A body thrown obliquely against the wall on its right. Turned, for no two particles are to arrive together:
/// rounding would then decide which is turned back first.
Outcome thrown(const Add& add, double angle, double dt, double t_end, double g = 0.0) {
    Points<2> x = triangular_block(8, 5);
    x.colwise() -= x.rowwise().mean().eval();
    x = (Eigen::Rotation2D<double>(angle).toRotationMatrix() * x).eval();
    Box<2> box;
    box.set_wall(0, true, {WallKind::rigid, 4.6});
    box.set_wall(1, false, {WallKind::rigid, -4.6});
    ParticleModel<2> model(make_particles<2>(x, 1.0), box);
    add(model);
    if (g > 0.0) model.add(std::make_unique<Gravity<2>>(Point<2>(0.0, -g)));
    const auto y0 = initial_state<2>(model, site_density, 0.43,
                                     [](const Point<2>&) { return Point<2>(0.05, -0.01); });
    Motion<2> motion(model, y0, {.method = "rk4", .dt = dt});
    const auto before = measure_invariants<2>(model, motion.y());
    motion.advance_to(t_end);
    const auto after = measure_invariants<2>(model, motion.y());
    const auto state = motion.state();
    const Point<2> of_walls = Point<2>(state.field(Field::wall_impulse(0, true))) +
                              Point<2>(state.field(Field::wall_impulse(1, false)));
    return {std::abs(after.energy_balance() - before.energy_balance()) / before.kinetic,
            (after.momentum_balance() - before.momentum_balance()).norm(),
            std::abs(after.angular_momentum_balance()[0] - before.angular_momentum_balance()[0]),
            (of_walls - after.impulse - Point<2>(0.0, g * before.mass * t_end)).norm(),
            state.position().row(0).maxCoeff() - 4.6,
            model.reflections(),
            after.momentum / after.mass};
}

}  // namespace

BOOST_AUTO_TEST_CASE(one_particle_is_turned_back) {
    Box<2> box;
    box.set_wall(0, true, {WallKind::rigid, 1.0});
    Particles<2> one = make_particles<2>(Points<2>(Point<2>(0.5, 0.0)), 1.0);
    one.mass[0] = 3.0;
    ParticleModel<2> model(one, box);
    std::vector<double> y(model.layout().size(), 0.0);
    State<2>(model.layout(), y).position()(0, 0) = 0.5;
    State<2>(model.layout(), y).velocity().col(0) = Point<2>(0.25, 0.5);
    Motion<2> motion(model, y, {.method = "rk4", .dt = 0.25});
    motion.advance_to(8.0);
    const auto state = motion.state();
    BOOST_TEST((state.velocity().col(0) == Point<2>(-0.25, 0.5)));
    BOOST_TEST(model.reflections() == 1U);
    BOOST_TEST((state.field(Field::wall_impulse(0, true)) == Point<2>(-1.5, 0.0)));
    BOOST_TEST((state.field(Field::impulse) == Point<2>(-1.5, 0.0)));
    // Where it is at the end of the step in which it has passed: at most that far off the exact path.
    const double exact = 1.0 - 0.25 * (8.0 - 2.0);
    BOOST_TEST(std::abs(state.position()(0, 0) - exact) <= 2.0 * 0.25 * 0.25);

    // One that is driven passes.
    ParticleModel<2> driven(one, box);
    driven.add(std::make_shared<Clamp<2>>(
        Group{}, [](double) { return Point<2>(0.25, 0.5); },
        [](double) { return Point<2>(Point<2>::Zero()); }));
    y.resize(driven.layout().size(), 0.0);
    Motion<2> through(driven, y, {.method = "rk4", .dt = 0.25});
    through.advance_to(8.0);
    BOOST_TEST((through.state().velocity().col(0) == Point<2>(0.25, 0.5)));
    BOOST_TEST(through.state().position()(0, 0) == 2.5);
    BOOST_TEST(driven.reflections() == 0U);
}

BOOST_AUTO_TEST_CASE(bodies_bounce_and_keep_what_they_promise) {
    for (const Law& law : laws) BOOST_TEST_CONTEXT(law.name) {
            // A particle is turned back at the end of the step in which it has passed, so that a run with half the
            // step goes another way, and its error falls by more or less than the order says: sums of several.
            double energy[2] = {}, angular_momentum[2] = {};
            for (const double angle : angles)
                for (const bool fine : {false, true}) {
                    const auto one = thrown(law.add, angle, fine ? 0.5 * law.dt : law.dt, 60.0);
                    BOOST_TEST(one.reflections > 4U);
                    BOOST_TEST(one.momentum < 1e-11);
                    BOOST_TEST(one.angular_momentum < 1e-4);
                    BOOST_TEST(one.energy < 1e-4);
                    BOOST_TEST(one.walls < 1e-11);
                    BOOST_TEST(one.beyond < 0.05);
                    BOOST_TEST(one.velocity.x() < 0.0);
                    energy[fine] += one.energy, angular_momentum[fine] += one.angular_momentum;
                }
            BOOST_TEST(energy[1] < energy[0] / 6.0);
            BOOST_TEST(angular_momentum[1] < angular_momentum[0] / 12.0);
            const auto falling = thrown(law.add, angles[0], 0.5 * law.dt, 60.0, 0.002);
            BOOST_TEST(falling.energy < 1e-5);
            BOOST_TEST(falling.walls < 1e-10);
        }
}

// A square and a cube of gas.
BOOST_AUTO_TEST_CASE(gas_in_a_rigid_box_keeps_its_energy) {
    const auto run = []<int Dim>(std::integral_constant<int, Dim>, double dt, double t_end) {
        std::array<int, Dim> edge;
        edge.fill(6);
        Points<Dim> x = square_lattice<Dim>(edge);
        x.colwise() += Point<Dim>::Constant(0.5) - Point<Dim>(x.rowwise().minCoeff());
        FluidModel<Dim> model(make_particles<Dim>(x, 1.0), Fluid{IdealGas{}},
                              {.density = Density::continuity, .range = 2.5},
                              rigid_room<Dim>(0.0, 6.0));
        std::mt19937_64 random(12);
        std::normal_distribution<double> g(0.0, 0.7);
        Points<Dim> v(Dim, x.cols());
        for (auto& c : v.reshaped()) c = g(random);
        const auto y0 = model.state(model.particles().reference_position, v, 1.0);
        Motion<Dim> motion(model, y0, {.method = "rk4", .dt = dt});
        const auto before = measure_invariants<Dim>(model, motion.y());
        motion.advance_to(t_end);
        const auto after = measure_invariants<Dim>(model, motion.y());
        BOOST_TEST(model.reflections() > 50U);
        const auto at = motion.state().position();
        BOOST_TEST(at.minCoeff() > -0.5);
        BOOST_TEST(at.maxCoeff() < 6.5);
        BOOST_TEST((after.momentum_balance() - before.momentum_balance()).norm() < 1e-10);
        BOOST_TEST((after.angular_momentum_balance() - before.angular_momentum_balance()).norm() <
                   1e-6);
        return std::abs(after.energy_balance() - before.energy_balance()) / before.energy;
    };
    const std::integral_constant<int, 2> plane;
    const double coarse = run(plane, 0.04, 8.0), fine = run(plane, 0.02, 8.0);
    BOOST_TEST(coarse < 1e-5);
    BOOST_TEST(fine < coarse / 8.0);
    BOOST_TEST(run(std::integral_constant<int, 3>{}, 0.04, 4.0) < 1e-5);
}

/// No images: the bits of the rates are those in open space, and L is promised as there.
BOOST_AUTO_TEST_CASE(rates_are_those_of_open_space) {
    for (const Law& law : laws) BOOST_TEST_CONTEXT(law.name) {
            const auto particles = jittered_particles<2>(7, 3);
            ParticleModel<2> walled(particles, rigid_room<2>(-10.0, 10.0)), open(particles);
            law.add(walled), law.add(open);
            const auto y = random_state(open, 4);
            std::vector<double> z(walled.layout().size(), 0.0);
            std::copy(y.begin(), y.end(), z.begin());  // accounts are last
            auto found = rates_of(walled, z);
            found.resize(y.size());
            BOOST_TEST((found == rates_of(open, y)));
            BOOST_TEST((walled.promises().angular_momentum == open.promises().angular_momentum));
        }
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    const auto says = [](const std::string& text, std::string_view what) {
        return text.find(what) != std::string::npos && text.find('\n') == std::string::npos;
    };
    Box<2> box;
    BOOST_TEST(says(refusal([&] {
                        box.set_wall(0, true, {WallKind::rigid, 5.0, {0, 0}, 1.0});
                    }),
                    "nothing behind it that could be warm"));
    BOOST_TEST(says(refusal([&] {
                        box.set_wall(0, true, {WallKind::rigid, 5.0, {0, 0.3}, {}});
                    }),
                    "only no-slip walls can move"));
    const auto particles = jittered_particles<2>(5, 1);
    Box<2> narrow;
    narrow.set_wall(0, true, {WallKind::rigid, 0.0});
    BOOST_TEST(says(refusal([&] { ParticleModel<2>(particles, narrow); }),
                    "is beyond the rigid wall at 0; move the body or the wall"));
    for (const auto transport : {Transport::average, Transport::monaghan}) {
        const Scheme averaged{.density = Density::continuity, .transport = transport, .range = 2.5};
        BOOST_TEST(says(refusal([&] {
                            SmoothParticleModel<2>(particles, ElasticSolid{0.7, 0.4}, averaged,
                                                   rigid_room<2>(-10.0, 10.0));
                        }),
                        "go on through it; use a mirror, or --transport plain"));
    }
    // Closer to each other than the range: without images there is nothing without end.
    Points<2> x = square_lattice<2>({2, 12});
    const FluidModel<2> slit(make_particles<2>(x, 1.0), Fluid{IdealGas{}}, {.range = 2.5},
                             rigid_room<2>(-20.0, 20.0));
    Box<2> close;
    close.set_wall(0, false, {WallKind::rigid, x.row(0).minCoeff() - 0.1});
    close.set_wall(0, true, {WallKind::rigid, x.row(0).maxCoeff() + 0.1});
    BOOST_TEST(refusal([&] {
                   FluidModel<2>(make_particles<2>(x, 1.0), Fluid{IdealGas{}}, {.range = 2.5},
                                 close);
               }) == "accepted");
}
