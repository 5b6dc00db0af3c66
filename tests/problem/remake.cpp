// SPDX-License-Identifier: GPL-3.0-or-later
// Particles split, merged and removed in mid-run: mass, momentum and energy are kept across the change (the
// angular momentum too, with what merged ones had about their centre in the accounts), balances go on without a
// jump, and motion goes on from an archive bit for bit, with every kind of integrator.
#include "support/element_mesh.hpp"
#include "support/refusal.hpp"
#include "support/turned_body.hpp"
#include <spam/core/archive.hpp>
#include <spam/core/error.hpp>
#include <spam/external/friction.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/problem/motion.hpp>
#include <spam/problem/remake.hpp>
#include <spam/problem/repopulation.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;

namespace {

std::unique_ptr<ParticleModel<2>> model_of(Particles<2> particles, bool friction) {
    auto model = std::make_unique<SmoothParticleModel<2>>(
        std::move(particles), ElasticSolid::triangular_lattice(), Scheme{});
    if (friction) model->add(std::make_unique<Friction<2>>(0.05));
    return model;
}

IntegratorOptions options_of(const std::string& method) {
    IntegratorOptions options;
    options.method = method;
    if (method == "rk4") options.dt = 0.1;
    return options;
}

/// Some split in two or four, some merged.
Population<2> changed(const Particles<2>& particles, bool merging) {
    Repopulation<2> change(particles);
    Points<2> two(2, 2), four(2, 4);
    two << 0.2, -0.2, 0.1, -0.1;
    four << 0.2, -0.2, 0.0, 0.0, 0.0, 0.0, 0.2, -0.2;
    change.split(3, two);
    change.split(11, four);
    change.split(20, two);
    if (merging) {
        change.merge({30, 31});
        change.merge({40, 41, 42});
    }
    return change.finish();
}

struct Account {
    double mass, momentum, angular_momentum, energy;
};
Account change_of(const Invariants<2>& a, const Invariants<2>& b) {
    return {std::abs(b.mass - a.mass), (b.momentum_balance() - a.momentum_balance()).norm(),
            (b.angular_momentum_balance() - a.angular_momentum_balance()).norm(),
            std::abs(b.energy_balance() - a.energy_balance())};
}

}  // namespace

BOOST_AUTO_TEST_CASE(invariants_are_kept_across_a_change_of_particles) {
    for (const char* method : {"rk4", "arkode:DORMAND_PRINCE_7_4_5", "cvode:adams"})
        for (const bool merging : {false, true})
            for (const bool friction : {false, true})
                BOOST_TEST_CONTEXT(method << merging << friction) {
                    const auto first =
                        model_of(make_particles<2>(triangular_hexagon(4), 1.3), friction);
                    const auto y0 = initial_state<2>(*first, 1.5, 0.43, rigid_rotation(0.05));
                    Motion<2> motion(*first, y0, options_of(method));
                    motion.advance_to(4.0);
                    const auto population = changed(first->particles(), merging);
                    const auto second = model_of(population.particles, friction);
                    const auto remade = remake<2>(*first, motion.y(), population, *second);
                    const auto a = measure_invariants<2>(*first, motion.y()),
                               b = measure_invariants<2>(*second, remade.y);
                    const Account change = change_of(a, b);
                    BOOST_TEST(change.mass < 1e-13 * a.mass);
                    BOOST_TEST(change.momentum < 1e-13);
                    BOOST_TEST(change.energy < 1e-13);
                    BOOST_TEST(change.angular_momentum < 1e-12);
                    // With what parts moved about their centre, which is booked.
                    const double lost = std::abs(
                        (remade.after.angular_momentum - remade.before.angular_momentum)[0]);
                    BOOST_TEST((merging ? lost > 1e-4 && lost < 0.2 : lost < 1e-12));
                    // On from there, and from an archive of the change: the same bytes.
                    Motion<2> next(*second, remade.y, options_of(method), motion.t());
                    const auto third = model_of(population.particles, friction);
                    for (const auto& block : second->layout().blocks())
                        third->layout().set_scale(block.field, block.scale);
                    Motion<2> twin(*third, remade.y, options_of(method), motion.t());
                    Archive saved;
                    next.remember(saved);
                    Archive reading(saved.bytes());
                    twin.remember(reading);
                    next.advance_to(6.0);
                    twin.advance_to(6.0);
                    BOOST_TEST(std::equal(next.y().begin(), next.y().end(), twin.y().begin()));
                    const Account later = change_of(b, measure_invariants<2>(*second, next.y()));
                    BOOST_TEST(later.momentum < 1e-12);
                    BOOST_TEST(later.energy < 1e-5);
                }
}

BOOST_AUTO_TEST_CASE(what_is_removed_is_booked) {
    const auto first = model_of(make_particles<2>(triangular_hexagon(3), 1.0), true);
    auto y = initial_state<2>(*first, 1.1547, 0.43, rigid_rotation(0.05));
    Repopulation<2> change(first->particles());
    for (const std::size_t i : {0u, 5u, 17u}) change.remove(i);
    const auto population = change.finish();
    BOOST_TEST(population.removed.size() == 3u);
    const auto second = model_of(population.particles, true);
    const auto remade = remake<2>(*first, y, population, *second);
    BOOST_TEST(remade.before.mass - remade.after.mass == 3.0);
    const Account balance =
        change_of(measure_invariants<2>(*first, y), measure_invariants<2>(*second, remade.y));
    BOOST_TEST(balance.momentum < 1e-14);
    BOOST_TEST(balance.angular_momentum < 1e-13);
    BOOST_TEST(balance.energy < 1e-14);
    BOOST_TEST((remade.after.momentum - remade.before.momentum).norm() > 1e-3);
}

BOOST_AUTO_TEST_CASE(changes_without_meaning_are_refused) {
    auto particles = make_particles<2>(triangular_hexagon(2), 1.0);
    Points<2> crooked(2, 2);
    crooked << 0.2, -0.1, 0.0, 0.0;
    Repopulation<2> change(particles);
    BOOST_CHECK_THROW(change.split(1, crooked), InputError);
    BOOST_CHECK_THROW(change.split(1, Points<2>::Zero(2, 1)), InputError);
    BOOST_CHECK_THROW(change.merge({4}), InputError);
    BOOST_CHECK_THROW(change.remove(1000), InputError);
    change.remove(7);
    BOOST_CHECK_THROW(change.merge({6, 7}), InputError);
    particles.material.assign(particles.size(), 0);
    particles.material[9] = 1;
    Repopulation<2> mixed(particles);
    BOOST_CHECK_THROW(mixed.merge({8, 9}), InputError);
    BOOST_CHECK_THROW(mixed.merge({3, 4, 3}), InputError);
    BOOST_TEST(mixed.finish().particles.size() == particles.size());  // nothing of it is done
}

/// Elements go on with all they hold where no corner has changed.
BOOST_AUTO_TEST_CASE(corners_of_elements_stay) {
    using namespace spam::test;
    const auto make = [] {
        return test::model_of({distorted_mesh(3, 3)}, spam::Material<2>(yielding(0.02)));
    };
    const auto mesh = make(), again = make();
    const auto held = random_elements(*mesh, 0.02);
    const auto unchanged = Repopulation<2>(mesh->particles()).finish();
    BOOST_TEST((remake<2>(*mesh, held, unchanged, *again).y == held));
    Repopulation<2> cut(mesh->particles());
    cut.remove(4);
    const auto without = cut.finish();
    ParticleModel<2> torn(without.particles);
    BOOST_CHECK_THROW(remake<2>(*mesh, held, without, torn), InputError);
}

/// What moves at random in a box and in space: material vectors take up all that a change takes from the motion.
template <int Dim>
void check_vectors(const Box<Dim>& box) {
    const auto make = [&](Particles<Dim> particles) {
        return MaterialVectorModel<Dim>(std::move(particles), PolynomialSolid{0.43, 0.43},
                                        {1.2, 2.4, 1.0}, box);
    };
    auto first = make(test::jittered_particles<Dim>(Dim == 2 ? 8 : 6, 3, 0.05, box));
    const auto y = test::moved<Dim>(first, 0.1, 5);
    Repopulation<Dim> change(first, y);
    Points<Dim> two = Points<Dim>::Zero(Dim, 2);
    two.col(0) << 0.1, Point<Dim - 1>::Constant(0.15);
    two.col(1) = -two.col(0);
    for (const std::size_t i : {0u, 20u, 21u}) change.split(i, two);
    change.merge({30, 31});
    const auto population = change.finish();
    auto second = make(population.particles);
    const auto remade = remake<Dim>(first, y, population, second);
    const auto &a = remade.before, &b = remade.after;
    BOOST_TEST((b.momentum - a.momentum).norm() < 1e-13 * a.mass);
    BOOST_TEST(std::abs(b.energy / a.energy - 1.0) < 1e-13);
    BOOST_TEST(second.law.heat() > 1e-6 * a.energy);
    BOOST_TEST(b.energy == measure_invariants<Dim>(second, remade.y).energy);
}

BOOST_AUTO_TEST_CASE(vectors_in_boxes_and_in_space) {
    check_vectors<2>({});
    check_vectors<2>(Box<2>({8.0, 8.0 * std::sqrt(0.75)}));
    check_vectors<3>({});
}

/// A crystal at rest stores nothing, wherever two of its particles become one: places in the material are averaged by
/// nearest images, as those in space are.
template <int Dim>
void check_merged_across_a_border(const Box<Dim>& box, int cells) {
    const auto make = [&](Particles<Dim> particles) {
        return TotalLagrangianModel<Dim>(std::move(particles), PolynomialSolid{0.43, 0.43},
                                         {1.2, 2.4, 0.1}, box);
    };
    auto first = make(test::jittered_particles<Dim>(cells, 3, 0.05, box));
    const auto& X = first.particles().reference_position;
    std::vector<double> y(first.layout().size(), 0.0);
    State<Dim>(first.layout(), y).position() = X;
    std::vector<std::size_t> pair{0, 0};  // the nearest of all across a border
    double nearest = 1.5;
    for (Eigen::Index i = 0; i < X.cols(); ++i)
        for (Eigen::Index j = i + 1; j < X.cols(); ++j) {
            const Point<Dim> r = X.col(j) - X.col(i), image = box.nearest(r);
            if ((image - r).norm() < 1.0 || image.norm() >= nearest) continue;
            nearest = image.norm();
            pair = {static_cast<std::size_t>(i), static_cast<std::size_t>(j)};
        }
    BOOST_REQUIRE(nearest < 1.5);
    Repopulation<Dim> change(first, y);
    change.merge(pair);
    const auto population = change.finish();
    auto second = make(population.particles);
    const auto remade = remake<Dim>(first, y, population, second);
    BOOST_TEST(remade.before.energy < 1e-13);
    BOOST_TEST(remade.after.energy < 1e-13);
    Repopulation<Dim> without_box(first.particles(), first.deformation_gradients(y));
    without_box.merge(pair);
    const auto averaged = without_box.finish();
    auto third = make(averaged.particles);
    const std::string said = test::refusal([&] { remake<Dim>(first, y, averaged, third); });
    BOOST_TEST(said.find("merged with others in another box") != std::string::npos, said);
    std::vector<double> there(third.layout().size(), 0.0);
    std::ranges::copy(remade.y, there.begin());
    BOOST_TEST(third.internal_energy(there) > 1e-3);  // what the refusal saves from
}

BOOST_AUTO_TEST_CASE(merged_across_a_border) {
    check_merged_across_a_border<2>(Box<2>({8.0, 8.0 * std::sqrt(0.75)}), 8);
    check_merged_across_a_border<3>(Box<3>({6.0, 6.0, 6.0}), 6);
}

/// Another box, another external: what moves is the same, and accounts begin anew.
BOOST_AUTO_TEST_CASE(a_run_starts_where_another_model_ended) {
    const auto particles = make_particles<2>(triangular_hexagon(3), 1.0);
    const auto first = model_of(particles, true), second = model_of(particles, false);
    second->add(std::make_unique<Friction<2>>(0.2, FrictionOf::all_motion));
    auto y0 = initial_state<2>(*first, 1.1547, 0.43, rigid_rotation(0.05));
    State<2>(first->layout(), y0).velocity()(0, 3) += 0.1;
    Motion<2> motion(*first, y0, options_of("rk4"));
    motion.advance_to(4.0);
    const auto y = restated<2>(*first, motion.y(), *second);
    BOOST_TEST(y.size() == second->layout().size());
    const ConstState<2> from(first->layout(), motion.y()), to(second->layout(), y);
    for (const Field field : {Field::position, Field::velocity, Field::density, Field::stress})
        BOOST_TEST((from.field(field) == to.field(field)));
    BOOST_TEST(from.field(Field::work)(0, 0) != 0.0);
    BOOST_TEST(to.field(Field::work)(0, 0) == 0.0);
    const auto other = model_of(make_particles<2>(triangular_hexagon(2), 1.0), true);
    BOOST_CHECK_THROW(restated<2>(*first, motion.y(), *other), InputError);
}
