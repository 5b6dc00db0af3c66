// SPDX-License-Identifier: GPL-3.0-or-later
// The second right-hand side allocates nothing. malloc is counted by a wrapper of our own, which
// sanitizers and other C libraries do not allow: there the test only runs the code.
#include "support/element_mesh.hpp"
#include "support/plane_and_space.hpp"
#include "support/random_state.hpp"
#include <spam/core/parallel.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/reaction.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/total_lagrangian.hpp>

#include <boost/test/unit_test.hpp>

#include <atomic>

#if defined(__GLIBC__) && !SPAM_SANITIZED && !defined(__clang__)
#define SPAM_COUNTS_ALLOCATIONS
#endif

namespace {
std::atomic<long> allocations{0};
}

#ifdef SPAM_COUNTS_ALLOCATIONS
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* malloc(std::size_t n) {
    ++allocations;
    return __libc_malloc(n);
}
void* calloc(std::size_t n, std::size_t size) {
    ++allocations;
    return __libc_calloc(n, size);
}
void* realloc(void* p, std::size_t n) {
    ++allocations;
    return __libc_realloc(p, n);
}
}
#endif

using namespace spam;
using namespace spam::test;

namespace {

template <int Dim>
long allocations_of_second_call(Model<Dim>& model, int threads) {
    set_threads(threads);
    const auto y = random_state(model, 62);
    std::vector<double> y_dot(y.size());
    model.rates(0.0, y, y_dot);
    const long before = allocations;
    model.rates(0.0, y, y_dot);
    const long count = allocations - before;
    set_threads(1);
    return count;
}

template <int Dim>
long allocations_of_second_call(int cells, const Scheme& scheme, int threads) {
    SmoothParticleModel<Dim> model(jittered_particles<Dim>(cells, 61), ElasticSolid{0.7, 0.4},
                                   scheme);
    return allocations_of_second_call(model, threads);
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(the_second_right_hand_side_allocates_nothing, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    for (const Scheme& scheme : all_schemes<Dim>()) {
        BOOST_TEST(allocations_of_second_call<Dim>(Dim == 2 ? 8 : 4, scheme, 1) == 0,
                   scheme.describe());
        BOOST_TEST(allocations_of_second_call<Dim>(Dim == 2 ? 40 : 12, scheme, 2) == 0,
                   scheme.describe());
    }
}

BOOST_AUTO_TEST_CASE(nor_do_those_of_long_range_forces_and_reactions) {
    ParticleModel<2> pulled(jittered_particles<2>(8, 61)), reacting(jittered_particles<2>(8, 61));
    pulled.add_term<LongRange<2>>(LongRangeScheme{});
    reacting.add_term<Reaction<2>>(ReactionScheme{});
    BOOST_TEST(allocations_of_second_call(pulled, 1) == 0);
    BOOST_TEST(allocations_of_second_call(reacting, 1) == 0);
}

BOOST_AUTO_TEST_CASE(nor_does_that_of_a_shifted_fluid) {
    for (const int threads : {1, 2}) {
        const Box<2> box({40.0, 40.0});
        FluidModel<2> model(make_particles<2>(square_lattice<2>({40, 40}), 1.0, 1.0, box),
                            Fluid{EmbeddedAtom{}, NewtonViscosity{0.1, 0.3}, {}, true},
                            {.transport = Transport::shifting}, box);
        BOOST_TEST(allocations_of_second_call(model, threads) == 0);
    }
}

BOOST_AUTO_TEST_CASE(nor_does_that_of_a_total_lagrangian_solid) {
    for (const double penalty : {0.0, 0.1}) {
        const TotalLagrangianScheme scheme{1.2, 3.0, penalty};
        TotalLagrangianModel<2> few(jittered_particles<2>(8, 61), StVenantKirchhoff{0.7, 0.4},
                                    scheme);
        BOOST_TEST(allocations_of_second_call(few, 1) == 0);
        TotalLagrangianModel<2> many(jittered_particles<2>(40, 61), StVenantKirchhoff{0.7, 0.4},
                                     scheme);
        BOOST_TEST(allocations_of_second_call(many, 2) == 0);
    }
}

BOOST_AUTO_TEST_CASE(nor_does_that_of_elements) {
    const auto few = model_of({distorted_mesh(5, 4)}, yielding(0.05), {0.1, 0.1});
    BOOST_TEST(allocations_of_second_call(*few, 1) == 0);
    const auto many = model_of({distorted_mesh(40, 30)}, yielding(0.05, 1.0), {0.1, 0.1});
    BOOST_TEST(allocations_of_second_call(*many, 2) == 0);
    MeshedBodies bodies = make_nodes({distorted_mesh(40, 30)}, lattice_density);
    ParticleModel<2> mixed(std::move(bodies.nodes));
    std::vector<std::int32_t> material(bodies.element.size());
    for (std::size_t k = 0; k < material.size(); ++k)
        material[k] = static_cast<std::int32_t>(k / 7 % 2);
    mixed.add_term<Elements>(
        std::move(bodies.element),
        std::vector<Elements::Material>{
            {elastic, lattice_density, {}},
            {Fluid{EmbeddedAtom{}, NewtonViscosity{0.1, 0.1}}, lattice_density, {0.1, 0.1}}},
        material);
    BOOST_TEST(allocations_of_second_call(mixed, 2) == 0);
}

BOOST_AUTO_TEST_CASE(nor_does_that_of_a_solid_with_material_vectors) {
    for (const int cells : {8, 40}) {
        MaterialVectorModel<2> model(jittered_particles<2>(cells, 61), PolynomialSolid{0.7, 0.4},
                                     {1.2, 3.0, 1.0});
        BOOST_TEST(allocations_of_second_call(model, cells == 8 ? 1 : 2) == 0);
    }
}

BOOST_AUTO_TEST_CASE(the_counter_counts) {
#ifdef SPAM_COUNTS_ALLOCATIONS
    const long before = allocations;
    const std::vector<double> block(1000);
    BOOST_TEST(block.size() == 1000U);
    BOOST_TEST(allocations > before);
#endif
}
