// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of several materials whose particles remember: each particle has the law of its own number.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/diagnostics/invariants.hpp>
#include <spam/material/flowing_solid.hpp>
#include <spam/material/hencky_solid.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;
using namespace spam::test;

namespace {

using Laws = std::vector<HyperelasticMaterial<2>>;
constexpr double density = 1.1547005383792515;  // of the triangular lattice

/// A block, the right two thirds of number 1.
Particles<2> two_parts(int columns = 12) {
    auto particles = make_particles<2>(triangular_block(columns, 10), 1.0);
    const double border = particles.reference_position.row(0).mean() - 2.0;
    for (std::size_t i = 0; i < particles.size(); ++i)
        particles.material.push_back(
            particles.reference_position(0, static_cast<Eigen::Index>(i)) < border ? 0 : 1);
    return particles;
}

std::unique_ptr<ParticleModel<2>> total_lagrangian(const HyperelasticMaterial<2>& law,
                                                   const Particles<2>& particles = two_parts()) {
    return std::make_unique<TotalLagrangianModel<2>>(particles, law,
                                                     TotalLagrangianScheme{density, 3.0});
}
std::unique_ptr<ParticleModel<2>> material_vectors(const HyperelasticMaterial<2>& law,
                                                   const Particles<2>& particles = two_parts()) {
    return std::make_unique<MaterialVectorModel<2>>(particles, law, MaterialVectorScheme{density});
}
using Make = std::unique_ptr<ParticleModel<2>> (*)(const HyperelasticMaterial<2>&,
                                                   const Particles<2>&);
constexpr Make both[] = {total_lagrangian, material_vectors};

/// At X -> F X, not uniform in velocity.
std::vector<double> strained(ParticleModel<2>& model, const Eigen::Matrix2d& F) {
    auto y = initial_state<2>(model, density, 0.43, [](const Point<2>& x) {
        return Point<2>(0.05 * std::sin(x.y()), 0.05 * std::cos(x.x()));
    });
    const State<2> state(model.layout(), y);
    state.position() = (F * model.particles().reference_position).eval();
    return y;
}

const PolynomialSolid soft{0.43, 0.43}, stiff{2.0, 1.5};
const Eigen::Matrix2d stretch = (Eigen::Matrix2d() << 1.06, 0.03, -0.02, 0.97).finished();

}  // namespace

BOOST_AUTO_TEST_CASE(several_of_one_kind_are_one) {
    for (const Make make : both) {
        auto one_material = two_parts();
        one_material.material.clear();
        const auto one = make(soft, one_material), two = make(Laws{soft, soft}, two_parts());
        const auto y = strained(*one, stretch);
        BOOST_TEST((rates_of(*one, y) == rates_of(*two, y)));
        BOOST_TEST(one->internal_energy(y) == two->internal_energy(y));
    }
}

// Particles see a uniform strain exactly: the energy is that of the materials, volume by volume.
BOOST_AUTO_TEST_CASE(each_particle_has_the_energy_of_its_law) {
    Mat<2> F;
    for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) F(a, b) = stretch(a, b);
    for (const Make make : both) {
        const auto model = make(Laws{soft, stiff}, two_parts());
        const auto& p = model->particles();
        double expected = 0.0;
        for (std::size_t i = 0; i < p.size(); ++i)
            expected +=
                p.mass[i] / density * (p.material[i] == 0 ? soft.energy(F) : stiff.energy(F));
        const auto y = strained(*model, stretch);
        BOOST_TEST(std::abs(model->internal_energy(y) / expected - 1.0) < 1e-11);
        const auto other = make(Laws{stiff, soft}, two_parts());
        BOOST_TEST(std::abs(other->internal_energy(y) / expected - 1.0) > 1e-2);
    }
}

BOOST_AUTO_TEST_CASE(forces_are_those_of_the_energy) {
    for (const Make make : both) {
        const auto model = make(Laws{soft, stiff}, two_parts());
        const auto y = strained(*model, stretch);
        Motion<2> motion(*model, y, {.method = "rk4", .dt = 0.0125});
        motion.advance_to(10.0);
        const auto before = measure_invariants<2>(*model, y),
                   after = measure_invariants<2>(*model, motion.y());
        BOOST_TEST(after.kinetic > 1.2 * before.kinetic);
        // Neighbours that material vectors meet and lose on the way change it a little.
        BOOST_TEST(std::abs(after.energy / before.energy - 1.0) <
                   (make == total_lagrangian ? 1e-8 : 1e-5));
        BOOST_TEST((after.momentum - before.momentum).norm() < 1e-12);
        BOOST_TEST((after.angular_momentum - before.angular_momentum).norm() < 1e-7);
    }
}

/// The soft part flows, and the other does not; a memory that one of them has is in y.
BOOST_AUTO_TEST_CASE(one_flows_beside_one_that_does_not) {
    const auto model = material_vectors(Laws{FlowingSolid{soft, 0.005}, stiff});
    Motion<2> motion(*model, strained(*model, stretch), {.method = "rk4", .dt = 0.05});
    motion.advance_to(2.0);
    const auto& law = *model->term<MaterialVectors<2>>();
    BOOST_TEST(law.heat() > 0.0);
    const double beyond = model->particles().reference_position.row(0).mean() + 3.5;
    for (std::size_t i = 0; i < model->particles().size(); ++i)
        if (model->particles().reference_position(0, static_cast<Eigen::Index>(i)) > beyond)
            BOOST_TEST(law.heat_of_particles()[i] == 0.0);
    BOOST_TEST(model->particles().reference_position.row(0).maxCoeff() > beyond);

    const HenckySolid<RadialVonMises<2>> yields{{0.5, 0.4}, LinearHardening{0.02, 0.01}};
    const auto remembers = total_lagrangian(Laws{StVenantKirchhoff{0.43, 0.43}, yields});
    BOOST_TEST(remembers->layout().has(yields.history().front()));
    Motion<2> bends(*remembers, strained(*remembers, stretch), {.method = "rk4", .dt = 0.05});
    bends.advance_to(2.0);
    const auto strain = bends.state().field(field_kind::plastic_strain);
    double most[2] = {0.0, 0.0};
    for (std::size_t i = 0; i < remembers->particles().size(); ++i) {
        double& of = most[remembers->particles().material[i]];
        of = std::max(of, strain(0, static_cast<Eigen::Index>(i)));
    }
    BOOST_TEST(most[0] == 0.0);
    BOOST_TEST(most[1] > 1e-3);
}

/// The penalty is in units of a particle's own stiffness: particles that see their own kind alone move as in a body of
/// one material, however stiff others are.
BOOST_AUTO_TEST_CASE(the_penalty_is_that_of_a_particles_own_law) {
    const PolynomialSolid steel{43.0, 43.0};
    auto one_material = two_parts(24);
    one_material.material.clear();
    const auto alone = material_vectors(soft, one_material),
               beside = material_vectors(Laws{soft, steel}, two_parts(24));
    // Soft particles are stretched, the others compressed.
    auto y = strained(*alone, Eigen::Matrix2d::Identity());
    const Points<2>& X = alone->particles().reference_position;
    const double border = X.row(0).mean() - 2.0;
    for (Eigen::Index i = 0; i < X.cols(); ++i)
        State<2>(alone->layout(), y).position()(0, i) += -0.06 * std::abs(X(0, i) - border);
    Eigen::Map<Eigen::ArrayXd> all(y.data(), static_cast<Eigen::Index>(y.size()));
    all += 0.02 * (37.0 * Eigen::ArrayXd::LinSpaced(all.size(), 0.0, 1.0)).sin();  // misfits
    const auto of_alone = rates_of(*alone, y), of_both = rates_of(*beside, y);
    const auto a = ConstState<2>(alone->layout(), of_alone).velocity(),
               b = ConstState<2>(beside->layout(), of_both).velocity();
    std::size_t inside = 0;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        if (X(0, i) > border - 7.5) continue;  // two ranges, and a little
        ++inside;
        BOOST_TEST((a.col(i) - b.col(i)).norm() < 1e-12 * a.norm());
    }
    BOOST_TEST(inside > 10U);
    BOOST_TEST((a - b).norm() > 1e-3 * a.norm());
    // A soft particle bears as little tension beside steel as it does alone, whose tension is another matter.
    const auto& with_steel = *beside->term<MaterialVectors<2>>();
    BOOST_TEST(with_steel.safe_tension() == alone->term<MaterialVectors<2>>()->safe_tension());
    const auto said = [&](double of_soft, double of_steel) {
        auto drawn = strained(*beside, Eigen::Matrix2d::Identity());
        for (Eigen::Index i = 0; i < X.cols(); ++i) {
            const double beyond = X(0, i) - border;
            State<2>(beside->layout(), drawn).position()(0, i) +=
                (beyond < 0.0 ? of_soft : of_steel) * beyond;
        }
        return material_vectors(Laws{soft, steel}, two_parts(24))->watch(0.0, drawn);
    };
    const auto of_soft = said(0.5, 0.0);
    BOOST_REQUIRE(of_soft.size() == 1U);
    BOOST_TEST(of_soft.front().value > with_steel.safe_tension());
    BOOST_TEST(of_soft.front().value < 10.0 * with_steel.safe_tension());
    BOOST_TEST(said(0.0, 0.05).empty());
}

/// Bonds of a law that does not flow keep their misfits, beside one whose bonds yield.
BOOST_AUTO_TEST_CASE(bonds_yield_by_the_law_of_their_particle) {
    const Laws laws{FlowingSolid{soft, 0.001}, stiff};
    const auto particles = two_parts(24);
    const auto model = std::make_unique<MaterialVectorModel<2>>(
        particles, laws, MaterialVectorScheme{.density = density, .bond_yield = 1.0});
    Motion<2> motion(*model, strained(*model, stretch), {.method = "rk4", .dt = 0.05});
    motion.advance_to(2.0);
    double heat[2] = {0.0, 0.0};
    for (std::size_t i = 0; i < particles.size(); ++i) {
        double& most = heat[particles.material[i]];
        // Particles that see none of the others: what enters at the border may be booked there.
        if (const double x = particles.reference_position(0, static_cast<Eigen::Index>(i)),
            border = particles.reference_position.row(0).mean() - 2.0;
            std::abs(x - border) > 3.5)
            most = std::max(most, std::abs(model->law.heat_of_particles()[i]));
    }
    BOOST_TEST(heat[0] > 0.0);
    BOOST_TEST(heat[1] == 0.0);
}

BOOST_AUTO_TEST_CASE(numbers_without_a_material_are_refused) {
    auto wrong = two_parts();
    wrong.material[7] = 2;
    for (const Make make : both) {
        const std::string said = refusal([&] { make(Laws{soft, stiff}, wrong); });
        BOOST_TEST(said.find("has number 2, and there are 2 materials") != std::string::npos, said);
        BOOST_TEST(refusal([&] { make(soft, two_parts()); }).find("there are 1") !=
                   std::string::npos);
    }
    // A law without stiffness would have no penalty.
    const PolynomialSolid fluid{1.0, 0.0};
    BOOST_TEST(fluid.stiffness() == 0.0);
    BOOST_TEST(refusal([&] {
                   material_vectors(Laws{fluid, stiff}, two_parts());
               }).starts_with("penalty: 2 is measured in the material's stiffness, which is 0"));
    BOOST_TEST(refusal([] { HyperelasticMaterial<2>(Laws{}); }).find("none is given") !=
               std::string::npos);
}
