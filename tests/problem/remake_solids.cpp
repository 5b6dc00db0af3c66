// SPDX-License-Identifier: GPL-3.0-or-later
// Particles of solids that remember the material, split, merged and removed in mid-run: a body strained and turned by
// any angle stores the same energy after a split, what has flowed or broken stays so, and what changes is in the
// accounts. The old ways, one offset for place and reference and a memory left behind, fail each of them.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include "support/turned_body.hpp"
#include <spam/core/memory.hpp>
#include <spam/material/flowing_solid.hpp>
#include <spam/material/hencky_solid.hpp>
#include <spam/material/yielding_solid.hpp>
#include <spam/problem/motion.hpp>
#include <spam/problem/remake.hpp>
#include <spam/problem/repopulation.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/rhs/total_lagrangian.hpp>

#include <boost/test/unit_test.hpp>
#include <fmt/format.h>

#include <functional>
#include <memory>

using namespace spam;
using namespace spam::test;

namespace {

constexpr PolynomialSolid polynomial{0.43, 0.43};
const HenckySolid<PlaneStrainVonMises> logarithmic({0.43, 0.43}, LinearHardening{0.05, 0.02});
const YieldingSolid<PlaneVonMises> updated({0.43, 0.43}, LinearHardening{0.02, 0.05});

using Made = std::unique_ptr<ParticleModel<2>>;
struct Solid {
    const char* name;
    std::function<Made(Particles<2>)> make;
    bool by_reference;  ///< remembers places in the material
    bool heat = true;   ///< takes up what it loses
};

Made lagrangian(Particles<2> particles, const HyperelasticMaterial<2>& law) {
    return std::make_unique<TotalLagrangianModel<2>>(std::move(particles), law,
                                                     TotalLagrangianScheme{1.2, 2.6, 0.1});
}
Made with_vectors(Particles<2> particles, const HyperelasticMaterial<2>& law,
                  double stretch_limit = HUGE_VAL) {
    MaterialVectorScheme scheme{1.2, 2.6, 1.0};
    scheme.stretch_limit = stretch_limit;
    return std::make_unique<MaterialVectorModel<2>>(std::move(particles), law, scheme);
}

const std::vector<Solid> solids{
    {"total Lagrangian", [](auto p) { return lagrangian(std::move(p), polynomial); }, true, false},
    {"total Lagrangian that yields", [](auto p) { return lagrangian(std::move(p), logarithmic); },
     true, false},
    {"material vectors", [](auto p) { return with_vectors(std::move(p), polynomial); }, true},
    {"material vectors that flow",
     [](auto p) {
         return with_vectors(std::move(p), FlowingSolid{polynomial, 0.05});
     },
     true},
    {"updated, yielding",
     [](auto p) -> Made {
         return std::make_unique<SmoothParticleModel<2>>(std::move(p), Material<2>(updated),
                                                         Scheme{.range = 2.6});
     },
     false}};

const MaterialVectors<2>& vectors_of(const Model<2>& model) {
    return *dynamic_cast<const ParticleModel<2>&>(model).term<MaterialVectors<2>>();
}

/// Stretched and sheared as a whole, then turned; velocities at random. Of a law that yields, settled.
std::vector<double> strained(Model<2>& model, double angle, double by = 0.1) {
    auto y = random_state<2>(model, 11);
    const State<2> state(model.layout(), y);
    Matrix<2> U;
    U << 1.0 + by, 0.4 * by, 0.4 * by, 1.0 - 0.6 * by;
    state.position() = (rotation<2>(angle) * U * model.particles().reference_position).eval();
    for (const auto& block : model.layout().blocks())
        if (block.field.role() == Role::history) state.field(block.field).setZero();
    if (state.has(Field::stress)) state.stress() *= 0.1;
    model.settle(0.0, y);
    return y;
}

Population<2> split(const Particles<2>& particles, std::vector<Mat<2>> F) {
    Repopulation<2> change(particles, std::move(F));
    Points<2> two(2, 2), three(2, 3);
    two << 0.2, -0.2, 0.1, -0.1;
    three << 0.25, -0.05, -0.2, 0.0, 0.2, -0.2;
    change.split(3, two);
    change.split(27, three);
    change.split(28, two);
    return change.finish();
}

enum class Kind { split, merge, all };
Population<2> changed(const Model<2>& model, std::span<const double> y, Kind kind) {
    if (kind == Kind::split) return split(model.particles(), model.deformation_gradients(y));
    Repopulation<2> change(model, y);
    change.merge({30, 31});
    change.merge({40, 48, 49});
    if (kind == Kind::merge) return change.finish();
    Points<2> two(2, 2);
    two << 0.2, -0.2, 0.1, -0.1;
    change.split(20, two);
    change.split(39, two);  // beside one that is merged
    change.remove(5);
    return change.finish();
}

/// Changes of m, p, L and E, and of the balances, which hold what is booked.
struct Closure {
    double mass, momentum, angular_momentum, internal, energy, balance;
    Closure(const Remade<2>& r, const Model<2>& next) {
        const Invariants<2>&a = r.before, b = measure_invariants<2>(next, r.y);
        const auto change = [](const auto& x, const auto& y) { return (x - y).norm(); };
        const double p = std::sqrt(2.0 * a.mass * a.kinetic), L = 5.0 * p;
        const double E = a.kinetic + std::abs(a.internal);
        mass = std::abs(b.mass / a.mass - 1.0);
        momentum = change(b.momentum, a.momentum) / p;
        angular_momentum = change(b.angular_momentum, a.angular_momentum) / L;
        internal = std::abs(b.internal / a.internal - 1.0);
        energy = std::abs(b.energy - a.energy) / E;
        balance = std::max({change(b.momentum_balance(), a.momentum_balance()) / p,
                            change(b.angular_momentum_balance(), a.angular_momentum_balance()) / L,
                            std::abs(b.energy_balance() - a.energy_balance()) / E});
    }
    std::string words() const {
        return fmt::format("m {:.1e}, p {:.1e}, L {:.1e}, U {:.1e}, E {:.1e}, balances {:.1e}",
                           mass, momentum, angular_momentum, internal, energy, balance);
    }
};

const std::vector<double> angles{0.0, 0.3, 1.0, 2.0, -2.9};
Particles<2> some_particles() { return jittered_particles<2>(9, 3, 0.1); }

double largest_difference(const Mat<2>& a, const Mat<2>& b) {
    double worst = 0.0;
    for (std::size_t c = 0; c < 4; ++c) worst = std::max(worst, std::abs(a.c[c] - b.c[c]));
    return worst;
}

}  // namespace

/// Nothing is left to the accounts, and children have the F of their parent.
BOOST_AUTO_TEST_CASE(a_split_keeps_all_of_a_body_strained_and_turned) {
    for (const Solid& solid : solids)
        for (const double angle : angles) BOOST_TEST_CONTEXT(solid.name << " by " << angle) {
                const auto first = solid.make(some_particles());
                const auto y = strained(*first, angle);
                const auto F = first->deformation_gradients(y);
                BOOST_TEST(F.empty() != solid.by_reference);
                const auto population = split(first->particles(), F);
                const auto second = solid.make(population.particles);
                const auto remade = remake<2>(*first, y, population, *second);
                const Closure closure(remade, *second);
                BOOST_TEST_MESSAGE(solid.name << " by " << angle << ": " << closure.words());
                BOOST_TEST(closure.mass < 1e-14);
                BOOST_TEST(closure.momentum < 1e-13);
                BOOST_TEST(closure.angular_momentum < 1e-13);
                BOOST_TEST(closure.internal < 1e-13);
                BOOST_TEST(closure.energy < 1e-13);
                if (!solid.by_reference) continue;
                const auto now = second->deformation_gradients(remade.y);
                for (std::size_t k = 0; k < now.size(); ++k)
                    BOOST_TEST(largest_difference(now[k], F[population.parts[k].front().particle]) <
                               1e-12);
                // The mutated law, one offset for both: refused, and it would store another energy.
                const auto one_offset = split(first->particles(), {});
                const auto wrong = solid.make(one_offset.particles);
                BOOST_TEST(refusal([&] {
                               remake<2>(*first, y, one_offset, *wrong);
                           }).find("is split by offsets that do not turn and stretch with it") !=
                           std::string::npos);
                if (&solid != solids.data()) continue;
                const double ratio =
                    wrong->internal_energy(remade.y) / first->internal_energy(y) - 1.0;
                BOOST_TEST_MESSAGE("with one offset U changes by " << ratio);
                BOOST_TEST(std::abs(ratio) > 1e-5);
            }
}

/// What a body in motion gains or loses with its particles is booked; it goes on from an archive bit for bit.
BOOST_AUTO_TEST_CASE(bodies_in_motion_go_on) {
    for (const Solid& solid : solids)
        for (const double angle : {0.0, 1.0})
            for (const Kind kind : {Kind::split, Kind::merge, Kind::all})
                BOOST_TEST_CONTEXT(solid.name << " by " << angle << ", "
                                              << static_cast<int>(kind)) {
                    const auto first = solid.make(some_particles());
                    auto y0 = strained(*first, angle, 0.05);
                    State<2>(first->layout(), y0).velocity() *= 0.02;
                    const IntegratorOptions options{.method = "rk4", .dt = 0.05};
                    Motion<2> motion(*first, y0, options);
                    motion.advance_to(3.0);
                    const auto population = changed(*first, motion.y(), kind);
                    const auto second = solid.make(population.particles),
                               third = solid.make(population.particles);
                    const auto remade = remake<2>(*first, motion.y(), population, *second);
                    const Closure closure(remade, *second);
                    BOOST_TEST_MESSAGE(solid.name << " by " << angle << ", in motion, "
                                                  << static_cast<int>(kind) << ": "
                                                  << closure.words());
                    BOOST_TEST(closure.balance < 1e-13);
                    if (kind != Kind::all) {
                        BOOST_TEST(closure.mass < 1e-14);
                        BOOST_TEST(closure.momentum < 1e-13);
                        BOOST_TEST(closure.energy < (solid.heat ? 1e-13 : 0.02));
                    }
                    if (kind == Kind::split) BOOST_TEST(closure.angular_momentum < 1e-13);
                    Motion<2> next(*second, remade.y, options, motion.t());
                    Archive saved;
                    next.remember(saved);
                    Archive back(saved.bytes());
                    next.remember(back);
                    Motion<2> twin(*third, remade.y, options, motion.t());
                    Archive reading(saved.bytes());
                    twin.remember(reading);
                    reading.expect_end();
                    next.advance_to(5.0);
                    twin.advance_to(5.0);
                    BOOST_TEST(std::ranges::equal(next.y(), twin.y()));
                    const auto b = measure_invariants<2>(*second, next.y()),
                               c = measure_invariants<2>(*third, twin.y());
                    BOOST_TEST(b.energy_balance() == c.energy_balance());
                    BOOST_TEST(std::abs(b.energy_balance() / remade.before.energy - 1.0) < 1e-4);
                    BOOST_TEST((b.momentum_balance() - remade.before.momentum).norm() < 1e-12);
                }
}

/// A body that has flowed: F, heat and energy are those of before. A model made of the same particles that is given y
/// alone, as remake() once did, knows nothing of that.
BOOST_AUTO_TEST_CASE(what_has_flowed_stays_so) {
    const auto make = solids[3].make;
    for (const double angle : angles) {
        const auto first = make(some_particles());
        const auto y = strained(*first, angle, 0.3);
        const auto& law = vectors_of(*first);
        BOOST_TEST(law.heat() > 0.01 * law.energy(y));
        const Population<2> same = Repopulation<2>(first->particles()).finish();
        const auto second = make(same.particles), forgetful = make(same.particles);
        const auto remade = remake<2>(*first, y, same, *second);
        BOOST_TEST((remade.y == y));
        BOOST_TEST(vectors_of(*second).heat() == law.heat());
        BOOST_TEST(second->internal_energy(y) == first->internal_energy(y));
        BOOST_TEST((rates_of<2>(*second, y) == rates_of<2>(*first, y)));
        double forgotten = 0.0;
        for (std::size_t k = 0; k < y.size() / 4; ++k)
            forgotten =
                std::max(forgotten, largest_difference(forgetful->deformation_gradients(y)[k],
                                                       first->deformation_gradients(y)[k]));
        BOOST_TEST(forgotten > 0.05);
        const auto population = changed(*first, y, Kind::all);
        const auto third = make(population.particles);
        const auto other = remake<2>(*first, y, population, *third);
        const auto F = first->deformation_gradients(y), now = third->deformation_gradients(other.y);
        const auto& heat = vectors_of(*third).heat_of_particles();
        for (std::size_t k = 0; k < now.size(); ++k) {
            double carried = 0.0;
            for (const auto& part : population.parts[k])
                carried += part.of * law.heat_of_particles()[part.particle];
            BOOST_TEST(heat[k] >= carried - 1e-12);
            if (population.parts[k].size() == 1)
                BOOST_TEST(largest_difference(now[k], F[population.parts[k][0].particle]) < 0.1);
        }
    }
}

/// Pairs that have broken are broken between children too, and no new bond comes between them.
BOOST_AUTO_TEST_CASE(what_has_broken_stays_so) {
    const auto make = [](Particles<2> p) { return with_vectors(std::move(p), polynomial, 1.05); };
    const auto first = make(some_particles());
    const auto y = strained(*first, 0.7, 0.055);
    const auto broken = vectors_of(*first).breaks().pairs;
    BOOST_TEST(broken > 10U);
    const auto population = split(first->particles(), first->deformation_gradients(y));
    const auto second = make(population.particles);
    auto remade = remake<2>(*first, y, population, *second);
    BOOST_TEST(vectors_of(*second).breaks().pairs == broken);
    std::size_t without_weight = 0;
    for (std::size_t k = 0; k < population.parts.size(); ++k)
        for (const auto& bond : vectors_of(*second).bonds(remade.y, k)) {
            const auto a = population.parts[k].front().particle,
                       b = population.parts[bond.partner].front().particle;
            if (a == b) continue;  // siblings
            for (const auto& before : vectors_of(*first).bonds(y, a))
                if (before.partner == b && before.weight == 0.0 &&
                    dot(before.X, before.X) < 2.4 * 2.4) {
                    BOOST_TEST(bond.weight == 0.0);
                    ++without_weight;
                }
        }
    BOOST_TEST(without_weight > 2 * broken);
}

BOOST_AUTO_TEST_CASE(what_physics_forbids_is_refused) {
    const auto particles = some_particles();
    const auto springs = [](const Particles<2>& p) {
        return std::make_unique<BondedModel<2>>(p, HarmonicSpring{});
    };
    const auto bonded = springs(particles);
    const auto y = random_state<2>(*bonded, 1);
    Repopulation<2> removing(particles);
    removing.remove(7);
    const auto fewer = removing.finish();
    const auto left = springs(fewer.particles);
    remake<2>(*bonded, y, fewer, *left);
    const auto more = split(particles, {});
    const auto other = springs(more.particles);
    BOOST_TEST(refusal([&] {
                   remake<2>(*bonded, y, more, *other);
               }).starts_with("population: all springs have one length"));

    const auto solid = solids[2].make(particles);
    const auto state = strained(*solid, 0.2);
    const auto same = Repopulation<2>(particles).finish();
    const auto lagrangian_one = solids[0].make(particles);
    BOOST_TEST(refusal([&] { remake<2>(*solid, state, same, *lagrangian_one); }) ==
               "population: the next model must be made of the same laws in the same order");
    auto two_bodies = particles;
    two_bodies.body[31] = 1;
    const auto apart = solids[2].make(two_bodies);
    Repopulation<2> joining(two_bodies, apart->deformation_gradients(state));
    BOOST_TEST(refusal([&] {
                   joining.merge({30, 31});
                   joining.finish();
               }) == "population: particles 40 and 39 are of different bodies and cannot be one");
}

/// Every law names what it keeps, once.
BOOST_AUTO_TEST_CASE(the_table_of_what_is_remembered) {
    const auto solid = solids[3].make(some_particles());
    Archive archive;
    Memory<2> memory(archive);
    dynamic_cast<Model<2>&>(*solid).remember(memory);
    std::vector<std::string> names;
    for (const auto& [field, holder] : memory.fields())
        if (field.role() == Role::memory && holder != Holder::run) names.emplace_back(field.name());
    BOOST_TEST(
        (names == std::vector<std::string>{"heat_of_vectors", "body_of_vectors", "material_vector",
                                           "weight_of_vector", "broken"}));
}
