// SPDX-License-Identifier: GPL-3.0-or-later
// The total-Lagrangian solid against loops over all pairs (support/lagrangian_oracle.hpp), and
// what it keeps: its forces are the slope of an energy that knows neither origin nor axes. Each
// property with a law that fails.
#include "support/lagrangian_oracle.hpp"
#include "support/turned_body.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;
using Mutation = LagrangianMutation;

namespace {

const StVenantKirchhoff solid{0.7, 0.4};

TotalLagrangianScheme scheme(double penalty) { return {1.2, 2.6, penalty}; }

template <int Dim>
int cells() {
    return Dim == 1 ? 20 : Dim == 2 ? 7 : 4;
}

template <int Dim>
TotalLagrangianModel<Dim> model_of(double penalty) {
    return {jittered_particles<Dim>(cells<Dim>(), 91), solid, scheme(penalty)};
}
template <int Dim>
LagrangianOracle<Dim> wrong(Mutation mutation) {
    return {jittered_particles<Dim>(cells<Dim>(), 91), solid, scheme(0.3), {}, mutation};
}

/// Far from the reference: turned, moved and every particle displaced by up to 0.2.
template <int Dim>
std::vector<double> deformed_state(const Model<Dim>& model, unsigned seed) {
    auto y = random_state(model, seed);
    std::mt19937_64 random(seed + 1);
    std::uniform_real_distribution<double> u(-0.2, 0.2);
    auto x = State<Dim>(model.layout(), y).position();
    for (auto& c : x.reshaped()) c += u(random);
    x = (rotation<Dim>(2.1) * x).eval();
    x.array() += 5.3;
    return y;
}

// ---- against the oracle ----

template <int Dim>
void check_against_oracle(const Particles<Dim>& particles, double penalty, const Box<Dim>& box = {},
                          Kernel kernel = Kernel::lucy) {
    BOOST_TEST_CONTEXT(Dim << " dimensions, penalty " << penalty << ", " << to_string(kernel)) {
        TotalLagrangianScheme used = scheme(penalty);
        used.kernel = kernel;
        TotalLagrangianModel<Dim> model(particles, solid, used, box);
        LagrangianOracle<Dim> oracle(particles, solid, used, box);
        const auto y = deformed_state(model, 92);
        BOOST_TEST(relative_difference(rates_of(model, y), rates_of(oracle, y)) < 1e-12);
        const double energy = oracle.internal_energy(y);
        BOOST_TEST(std::abs(model.internal_energy(y) - energy) < 1e-12 * energy);
        const auto F = oracle.gradients(y);
        const auto rho = model.density(y);
        double worst = 0.0;
        for (std::size_t i = 0; i < F.size(); ++i)
            worst = std::max(worst, std::abs(rho[i] * F[i].determinant() / 1.2 - 1.0));
        BOOST_TEST(worst < 1e-11);
    }
}

template <int Dim>
void check_all_against_oracle() {
    for (const double penalty : {0.0, 0.1, 10.0}) {
        check_against_oracle<Dim>(jittered_particles<Dim>(cells<Dim>(), 91), penalty);
        std::array<double, Dim> lengths;
        lengths.fill(Dim == 2 ? 8.0 * std::sqrt(0.75) : 6.0);
        lengths[0] = Dim == 2 ? 8.0 : 6.0;
        const Box<Dim> box(lengths);
        auto particles = jittered_particles<Dim>(Dim == 2 ? 8 : 6, 93, 0.15, box);
        particles.reference_position.array() += 3.1;  // some lie outside the box
        check_against_oracle<Dim>(particles, penalty, box);
        for (const Kernel kernel : {Kernel::monaghan, Kernel::w4})
            check_against_oracle<Dim>(particles, penalty, box, kernel);
    }
}

// ---- properties ----

template <int Dim>
double slope_error(Model<Dim>& model) {
    const std::size_t stride = 1 + model.particles().size() / 9;
    return test::slope_error<Dim>(model, deformed_state(model, 94), 5e-4, stride);
}

/// |dp/dt| and |dL/dt|, all components, relative to the sums of their terms.
template <int Dim>
std::array<double, 2> residuals(Model<Dim>& model, unsigned seed) {
    const auto y = deformed_state(model, seed);
    return test::residuals<Dim>(y, forces_of(model, y));
}

/// F where x = G X + c, against G.
template <int Dim, class Gradients>
double linear_field_error(const Model<Dim>& model, const Gradients& gradients) {
    Matrix<Dim> G = 1.3 * rotation<Dim>(0.4);
    G(0, Dim - 1) += 0.2;
    std::vector<double> y(model.layout().size(), 0.0);
    State<Dim>(model.layout(), y).position() =
        (G * model.particles().reference_position).array() + 2.0;
    double worst = 0.0;
    for (const auto& F : gradients(y))
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b) worst = std::max(worst, std::abs(F(a, b) - G(a, b)));
    return worst;
}

template <int Dim>
void check_properties() {
    for (const double penalty : {0.0, 0.1, 10.0}) {
        BOOST_TEST_CONTEXT(Dim << " dimensions, penalty " << penalty) {
            auto model = model_of<Dim>(penalty);
            BOOST_TEST(slope_error<Dim>(model) < 1e-9);
            BOOST_TEST(invariance_error<Dim>(model, deformed_state<Dim>(model, 95)) < 1e-12);
            BOOST_TEST(residuals<Dim>(model, 96)[0] < 1e-13);
            if (Dim > 1) BOOST_TEST(residuals<Dim>(model, 97)[1] < 1e-13);
            BOOST_TEST(linear_field_error<Dim>(model, [&](const auto& y) {
                           return model.deformation_gradients(y);
                       }) < 1e-13);
        }
    }
    // and each can fail
    auto right = wrong<Dim>(Mutation::none);
    BOOST_TEST(slope_error<Dim>(right) < 1e-9);
    auto no_reaction = wrong<Dim>(Mutation::no_reaction);
    BOOST_TEST(slope_error<Dim>(no_reaction) > 1e-3);
    auto uncorrected = wrong<Dim>(Mutation::uncorrected);
    BOOST_TEST(slope_error<Dim>(uncorrected) < 1e-9);  // a worse gradient, but one energy
    BOOST_TEST(linear_field_error<Dim>(
                   uncorrected, [&](const auto& y) { return uncorrected.gradients(y); }) > 1e-2);
    auto own_stress = wrong<Dim>(Mutation::own_stress_only);
    BOOST_TEST(residuals<Dim>(own_stress, 96)[0] > 1e-3);
    if constexpr (Dim > 1) {
        BOOST_TEST(residuals<Dim>(no_reaction, 97)[1] > 1e-5);
        for (const auto mutation : {Mutation::fixed_axes, Mutation::small_strain}) {
            auto anisotropic = wrong<Dim>(mutation);
            BOOST_TEST(invariance_error<Dim>(anisotropic, deformed_state<Dim>(anisotropic, 95)) >
                       1e-3);
            BOOST_TEST(residuals<Dim>(anisotropic, 97)[1] > 1e-5);
        }
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(against_the_oracle_1d) { check_all_against_oracle<1>(); }
BOOST_AUTO_TEST_CASE(against_the_oracle_2d) { check_all_against_oracle<2>(); }
BOOST_AUTO_TEST_CASE(against_the_oracle_3d) { check_all_against_oracle<3>(); }
BOOST_AUTO_TEST_CASE(properties_1d) { check_properties<1>(); }
BOOST_AUTO_TEST_CASE(properties_2d) { check_properties<2>(); }
BOOST_AUTO_TEST_CASE(properties_3d) { check_properties<3>(); }

BOOST_AUTO_TEST_CASE(a_mutated_law_differs_from_the_model) {
    auto model = model_of<2>(0.3);
    const auto y = deformed_state(model, 92);
    for (const auto mutation : {Mutation::no_reaction, Mutation::fixed_axes, Mutation::uncorrected,
                                Mutation::own_stress_only, Mutation::small_strain}) {
        auto other = wrong<2>(mutation);
        BOOST_TEST(relative_difference(rates_of<2>(other, y), rates_of<2>(model, y)) > 1e-3);
    }
}
