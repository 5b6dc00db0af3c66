// SPDX-License-Identifier: GPL-3.0-or-later
// Walls by images: mirrors are half of a symmetric periodic box, whatever the formulation; gas between them
// keeps its energy, and what walls give closes the accounts of every other.
#include "support/every_potential.hpp"
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/diagnostics/invariants.hpp>
#include <spam/external/gravity.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/material/smooth_hencky_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/rhs/total_lagrangian.hpp>

#include <boost/test/unit_test.hpp>

#include <functional>

using namespace spam;
using namespace spam::test;

namespace {

constexpr int cells = 6;

/// Mirrors around [0, size]^Dim.
template <int Dim>
Box<Dim> mirrors(double size, WallKind kind = WallKind::mirror) {
    Box<Dim> box;
    for (int a = 0; a < Dim; ++a) {
        box.set_wall(a, false, {kind, 0.0});
        box.set_wall(a, true, {kind, size});
    }
    return box;
}

template <int Dim>
Particles<Dim> jittered(int n, unsigned seed) {
    std::array<int, Dim> edge;
    edge.fill(n);
    Points<Dim> x = square_lattice<Dim>(edge);
    x.colwise() -= x.rowwise().minCoeff().eval();
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(-0.2, 0.2);
    for (auto& c : x.reshaped()) c += 0.5 + u(random);
    auto particles = make_particles<Dim>(x, 1.0);
    for (double& m : particles.mass) m += u(random);
    return particles;
}

/// The sign of component c of a field in an image behind mirrors across the directions in `flipped`.
double sign_of(Field field, int dim, int c, unsigned flipped) {
    const auto of = [&](int a) { return flipped >> a & 1U ? -1.0 : 1.0; };
    if (field == Field::position || field == Field::velocity) return of(c);
    if (field == Field::stress)
        for (int a = 0; a < dim; ++a)
            for (int b = a + 1; b < dim; ++b)
                if (symmetric_index(dim, a, b) == c) return of(a) * of(b);
    return 1.0;
}

template <int Dim>
using Build = std::function<std::unique_ptr<Model<Dim>>(Particles<Dim>, const Box<Dim>&)>;

/// Largest difference of any rate between mirrors and the symmetric whole, relative to the largest; or of anything in
/// y after that many steps of time 0.02.
template <int Dim>
double against_symmetric_whole(const Build<Dim>& build, int steps = 0) {
    constexpr unsigned images = 1U << Dim;
    const auto half = jittered<Dim>(cells, 3);
    const auto n = half.reference_position.cols();
    Particles<Dim> all = half;
    all.reference_position.resize(Dim, n * images);
    all.mass.clear(), all.id.clear();
    for (unsigned image = 0; image < images; ++image) {
        for (int a = 0; a < Dim; ++a)
            all.reference_position.row(a).segment(image * n, n) =
                sign_of(Field::position, Dim, a, image) * half.reference_position.row(a);
        all.mass.insert(all.mass.end(), half.mass.begin(), half.mass.end());
        for (const auto id : half.id) all.id.push_back(id + image * n);
    }
    all.body.assign(all.mass.size(), 0);
    std::array<double, Dim> twice;
    twice.fill(2.0 * cells);
    auto walled = build(half, mirrors<Dim>(cells));
    auto whole = build(all, Box<Dim>(twice));
    auto y = random_state(*walled, 5);
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> aside(-0.05, 0.05);
    for (auto& x : State<Dim>(walled->layout(), y).position().reshaped()) x += aside(random);
    if (steps > 0) State<Dim>(walled->layout(), y).velocity() *= 0.1;  // none reaches a mirror
    std::vector<double> Y(whole->layout().size(), 0.0);
    const State<Dim> small(walled->layout(), y), large(whole->layout(), Y);
    if (small.has(Field::energy))
        for (auto& e : small.energy().reshaped()) e = std::abs(e) + 0.5;
    for (const auto& block : whole->layout().blocks())
        for (unsigned image = 0; image < images; ++image)
            for (Eigen::Index c = 0; c < static_cast<Eigen::Index>(block.components); ++c)
                large.field(block.field).row(c).segment(image * n, n) =
                    sign_of(block.field, Dim, static_cast<int>(c), image) *
                    small.field(block.field).row(c);
    const auto later = [&](Model<Dim>& model, const std::vector<double>& from) {
        if (steps == 0) return rates_of(model, from);
        Motion<Dim> motion(model, from, {.method = "rk4", .dt = 0.02});
        motion.advance_to(0.02 * steps);
        return std::vector<double>(motion.y().begin(), motion.y().end());
    };
    const auto rates = later(*walled, y), expected = later(*whole, Y);
    const ConstState<Dim> found(walled->layout(), rates), right(whole->layout(), expected);
    double worst = 0.0;
    for (const auto& block : whole->layout().blocks()) {
        const auto of_half = right.field(block.field).leftCols(n);
        const double size = of_half.cwiseAbs().maxCoeff();
        const double apart = (found.field(block.field) - of_half).cwiseAbs().maxCoeff();
        worst = std::max(worst, std::isnan(apart) ? HUGE_VAL : apart / size);
    }
    return worst;
}

const Fluid gas{IdealGas{}}, water{IdealGas{}, NewtonViscosity{0.3, 0.1}, FourierConduction{0.4}};

bool says(const std::string& text, std::string_view what) {
    return text.find(what) != std::string::npos;
}

/// Warm gas between walls after some time: what has changed of energy and momentum, accounts taken off.
template <int Dim>
struct Outcome {
    double energy, momentum;
    std::size_t reflections;
    bool inside;
};
template <int Dim>
Outcome<Dim> run(const Fluid& fluid, const Box<Dim>& box, std::optional<double> dt, double t_end,
                 const std::string& method = "rk4") {
    FluidModel<Dim> model(jittered<Dim>(cells, 11), fluid,
                          {.density = Density::continuity, .range = 2.5}, box);
    Points<Dim> v(Dim, model.particles().reference_position.cols());
    std::mt19937_64 random(12);
    std::normal_distribution<double> g(0.0, 0.7);
    for (auto& c : v.reshaped()) c = g(random);
    const auto y0 = model.state(model.particles().reference_position, v, 1.0);
    Motion<Dim> motion(model, y0, {.method = method, .dt = dt, .rtol = 1e-10, .atol = 1e-12});
    const auto before = measure_invariants<Dim>(model, motion.y());
    motion.advance_to(t_end);
    const auto after = measure_invariants<Dim>(model, motion.y());
    const auto x = ConstState<Dim>(model.layout(), motion.y()).position();
    return {std::abs(after.energy_balance() - before.energy_balance()) / before.energy,
            (after.momentum_balance() - before.momentum_balance()).norm(), model.reflections(),
            x.minCoeff() > -0.1 && x.maxCoeff() < cells + 0.1};
}

}  // namespace

BOOST_AUTO_TEST_CASE(mirrors_are_half_of_a_symmetric_whole) {
    for (const auto density : {Density::continuity, Density::summed, Density::chain_rule})
        for (const auto transport : {Transport::plain, Transport::average, Transport::monaghan})
            for (const double viscosity : {0.0, 0.3}) {
                if (density == Density::chain_rule && transport == Transport::plain) continue;
                const Scheme scheme{.density = density,
                                    .transport = transport,
                                    .viscosity = viscosity,
                                    .range = 2.7};
                const Build<2> solid = [&](Particles<2> particles, const Box<2>& box) {
                    return std::make_unique<SmoothParticleModel<2>>(
                        std::move(particles), ElasticSolid{0.7, 0.4}, scheme, box);
                };
                BOOST_TEST(against_symmetric_whole<2>(solid) < 1e-13, scheme.describe());
                if (density != Density::continuity) continue;
                Fluid rubbing = water;
                rubbing.by_pairs = true;
                rubbing.viscosity = NewtonViscosity{0.1, 0.3};
                for (const Fluid& fluid : {gas, water, rubbing}) {
                    if (fluid.by_pairs && (transport != Transport::plain || viscosity > 0.0))
                        continue;
                    const Build<2> flow = [&](Particles<2> particles, const Box<2>& box) {
                        return std::make_unique<FluidModel<2>>(std::move(particles), fluid, scheme,
                                                               box);
                    };
                    BOOST_TEST(against_symmetric_whole<2>(flow) < 1e-13, scheme.describe());
                }
            }
    for (const auto density : {Density::continuity, Density::summed})
        for (const bool by_pairs : {false, true}) {
            Fluid cold{EmbeddedAtom{}, NewtonViscosity{0.1, 0.3}};
            cold.by_pairs = by_pairs;
            const Scheme scheme{.density = density, .transport = Transport::shifting, .range = 2.7};
            const Build<2> shifted = [&](Particles<2> particles, const Box<2>& box) {
                return std::make_unique<FluidModel<2>>(std::move(particles), cold, scheme, box);
            };
            BOOST_TEST(against_symmetric_whole<2>(shifted) < 1e-13, scheme.describe());
        }
    const DensityPotentials everything = every_potential();
    const Build<2> of_density = [&](Particles<2> particles, const Box<2>& box) {
        return std::make_unique<DensityPotentialModel<2>>(std::move(particles), everything, box);
    };
    BOOST_TEST(against_symmetric_whole<2>(of_density) < 1e-13);
    const Build<3> lucy = [](Particles<3> particles, const Box<3>& box) {
        return std::make_unique<PairPotentialModel<3>>(std::move(particles), 2.9, box);
    };
    BOOST_TEST(against_symmetric_whole<3>(lucy) < 1e-13);
    const Build<3> space = [](Particles<3> particles, const Box<3>& box) {
        return std::make_unique<FluidModel<3>>(
            std::move(particles), water, Scheme{.density = Density::continuity, .range = 2.2}, box);
    };
    BOOST_TEST(against_symmetric_whole<3>(space) < 1e-13);
    const Build<2> own = [](Particles<2> particles, const Box<2>& box) {
        return std::make_unique<VariableRangeModel<2>>(std::move(particles), gas,
                                                       VariableRangeScheme{.range = 2.2}, box);
    };
    BOOST_TEST(against_symmetric_whole<2>(own) < 1e-13);
}

template <int Dim>
void bodies_with_neighbours_for_good() {
    const TotalLagrangianScheme scheme{.density = 1.0, .range = 2.6, .penalty = 0.3};
    const Build<Dim> solid = [&](Particles<Dim> particles, const Box<Dim>& box) {
        return std::make_unique<TotalLagrangianModel<Dim>>(
            std::move(particles), StVenantKirchhoff{0.7, 0.4}, scheme, box);
    };
    const Build<Dim> springs = [](Particles<Dim> particles, const Box<Dim>& box) {
        return std::make_unique<BondedModel<Dim>>(std::move(particles), HarmonicSpring{}, box);
    };
    for (const auto* build : {&solid, &springs})
        for (const int steps : {0, 50}) BOOST_TEST_CONTEXT(Dim << "D, " << steps << " steps")
    BOOST_TEST(against_symmetric_whole<Dim>(*build, steps) < 1e-12);
}

// Mirrors are planes of symmetry for them.
BOOST_AUTO_TEST_CASE(solids_with_neighbours_for_good_are_half_of_a_symmetric_whole) {
    bodies_with_neighbours_for_good<1>();
    bodies_with_neighbours_for_good<2>();
    bodies_with_neighbours_for_good<3>();
    const Build<2> yields = [](Particles<2> particles, const Box<2>& box) {
        return std::make_unique<TotalLagrangianModel<2>>(
            std::move(particles), SmoothHenckySolid<PlaneStrainVonMises>({0.7, 0.4}, {0.05, 0.1}),
            TotalLagrangianScheme{.density = 1.0, .range = 2.6}, box);
    };
    BOOST_TEST(against_symmetric_whole<2>(yields) < 1e-12);
}

// One that flies to a mirror is turned back at it, and the mirror's impulse and the body's energy are accounted for.
BOOST_AUTO_TEST_CASE(a_solid_flies_to_a_mirror) {
    Points<2> x = square_lattice<2>({4, 4});
    x.colwise() -= x.rowwise().minCoeff().eval();
    x.array() += 0.6;
    Box<2> box;
    box.set_wall(0, false, {WallKind::mirror, -4.0});
    TotalLagrangianModel<2> model(make_particles<2>(x, 1.0), StVenantKirchhoff{0.7, 0.4},
                                  {.density = 1.0, .range = 2.6}, box);
    std::vector<double> y(model.layout().size(), 0.0);
    const State<2> state(model.layout(), y);
    state.position() = x;
    state.velocity().row(0).setConstant(-0.5);
    Motion<2> motion(model, y, {.method = "rk4", .dt = 0.01});
    const auto before = measure_invariants<2>(model, motion.y());
    motion.advance_to(25.0);
    const auto after = measure_invariants<2>(model, motion.y());
    const auto v = ConstState<2>(model.layout(), motion.y()).velocity();
    BOOST_TEST(v.row(0).mean() > 0.15);  // the rest is in its vibrations
    BOOST_TEST(model.reflections() >= 4U);
    BOOST_TEST(std::abs(after.energy - before.energy) < 1e-6 * before.energy);
    BOOST_TEST((after.momentum_balance() - before.momentum_balance()).norm() < 1e-10);
}

// A square and a cube of gas: the energy by itself, the momentum with what the mirrors gave.
BOOST_AUTO_TEST_CASE(gas_between_mirrors_keeps_its_energy) {
    const auto coarse = run<2>(gas, mirrors<2>(cells), 0.04, 12.0);
    const auto fine = run<2>(gas, mirrors<2>(cells), 0.02, 12.0);
    BOOST_TEST(coarse.reflections > 20U);
    BOOST_TEST((coarse.inside && fine.inside));
    BOOST_TEST(coarse.energy < 1e-5);
    BOOST_TEST(fine.energy < coarse.energy / 8.0);
    BOOST_TEST(fine.momentum < 1e-10);
    const auto space = run<3>(gas, mirrors<3>(cells), 0.04, 4.0);
    BOOST_TEST(space.reflections > 20U);
    BOOST_TEST(space.energy < 1e-5);
    BOOST_TEST(run<3>(gas, mirrors<3>(cells), 0.02, 4.0).energy < space.energy / 8.0);
    BOOST_TEST(space.momentum < 1e-10);
    const auto adaptive = run<2>(gas, mirrors<2>(cells), {}, 12.0, "arkode:DORMAND_PRINCE_7_4_5");
    BOOST_TEST(adaptive.energy < 1e-7);
    BOOST_TEST(adaptive.reflections > 20U);
}

// Walls that rub, move and heat: friction and heat that pass them are in the account.
BOOST_AUTO_TEST_CASE(accounts_of_walls_close) {
    Box<2> box = mirrors<2>(cells, WallKind::no_slip);
    box.set_wall(1, false, {WallKind::no_slip, 0.0, {0.0, 0.0}, 1.5});
    box.set_wall(1, true, {WallKind::no_slip, double(cells), {0.3, 0.0}, 0.5});
    const auto coarse = run<2>(water, box, 0.04, 6.0), fine = run<2>(water, box, 0.02, 6.0);
    BOOST_TEST(coarse.energy < 1e-5);
    BOOST_TEST(fine.energy < coarse.energy / 8.0);
    BOOST_TEST(fine.momentum < 1e-10);
    BOOST_TEST(fine.inside);
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    const auto walled = [](auto change) {
        return refusal([&] {
            Box<2> box = mirrors<2>(cells);
            change(box);
        });
    };
    BOOST_TEST(says(walled([](auto& b) {
                        b.set_wall(0, true, {WallKind::mirror, -1.0});
                    }),
                    "the lower one across direction x at 0 must lie below the upper one at -1"));
    BOOST_TEST(says(walled([](auto& b) {
                        b.set_wall(1, true, {WallKind::no_slip, 6.0, {0.0, 0.0}, -0.5});
                    }),
                    "temperature -0.5 across direction y must be above 0"));
    BOOST_TEST(says(walled([](auto& b) {
                        b.set_wall(0, true, {WallKind::mirror, 6.0, {0, 1}});
                    }),
                    "only no-slip walls can move"));
    BOOST_TEST(says(walled([](auto& b) {
                        b.set_wall(0, true, {WallKind::no_slip, 6.0, {1, 0}});
                    }),
                    "only no-slip walls can move"));
    BOOST_TEST(says(walled([](auto&) {
                        Box<2>({4.0, 0.0}).set_wall(0, true, {});
                    }),
                    "is periodic"));
    const auto refused = [](auto make) { return refusal(make); };
    const auto particles = jittered<2>(cells, 1);
    const Scheme far{.density = Density::continuity, .range = 6.5};
    BOOST_TEST(says(refused([&] { FluidModel<2>(particles, gas, far, mirrors<2>(cells)); }),
                    "images of images would have no end"));
    Box<2> narrow;
    narrow.set_wall(1, true, {WallKind::mirror, 3.0});
    BOOST_TEST(says(refused([&] { FluidModel<2>(particles, gas, {.range = 2.5}, narrow); }),
                    "is beyond the mirror wall at 3; move the body or the wall"));
    Scheme balanced{.angular_momentum = AngularMomentum::torque_pair, .range = 2.5};
    BOOST_TEST(says(
        refused([&] {
            SmoothParticleModel<2>(particles, ElasticSolid{0.7, 0.4}, balanced, mirrors<2>(cells));
        }),
        "walls give angular momentum"));
    Scheme near{.closest_approach = 0.4, .range = 2.5};
    BOOST_TEST(
        says(refused([&] {
                 SmoothParticleModel<2>(particles, ElasticSolid{0.7, 0.4}, near, mirrors<2>(cells));
             }),
             "closest approach"));
    BOOST_TEST(says(refused([&] {
                        PairPotentialModel<2>(particles, 2.5, mirrors<2>(cells, WallKind::no_slip));
                    }),
                    "neither the velocity nor the temperature of a wall"));
    BOOST_TEST(says(refused([&] {
                        BondedModel<2>(particles, HarmonicSpring{},
                                       mirrors<2>(cells, WallKind::no_slip));
                    }),
                    "use a mirror"));
    auto at_the_wall = particles;
    at_the_wall.reference_position(0, 3) = 0.0;
    BOOST_TEST(
        says(refused([&] { BondedModel<2>(at_the_wall, HarmonicSpring{}, mirrors<2>(cells)); }),
             "is where particle"));
    BOOST_TEST(says(refused([&] {
                        Box<2> warm = mirrors<2>(cells);
                        warm.set_wall(1, true, {WallKind::mirror, double(cells), {0, 0}, 1.5});
                        FluidModel<2>(particles, gas, {.range = 2.5}, warm);
                    }),
                    "top: nothing here conducts heat"));
}
