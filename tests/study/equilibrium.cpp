// SPDX-License-Identifier: GPL-3.0-or-later
// States in which no particle feels a force: springs of known stiffness, and what has none.
#include <spam/core/error.hpp>
#include <spam/external/friction.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/flowing_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>
#include <spam/study/equilibrium.hpp>
#include <spam/study/lowest_modes.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <numbers>

using namespace spam;

namespace {

/// A force along x on the last particle, which may also depend on velocity or turn with the place.
class Pull final : public External<2> {
  public:
    Pull(std::size_t last, double force, double swirl)
        : last_(last),
          force_(force),
          swirl_(swirl) {}
    void add(const Now& now, Eigen::Index first, Eigen::Index last) const override {
        auto v_dot = now.rate.velocity();
        const auto x = now.state.position();
        for (Eigen::Index i = first; i < last; ++i) {
            if (i == static_cast<Eigen::Index>(last_))
                v_dot(0, i) += force_ / now.particles.mass[last_];
            v_dot.col(i) += swirl_ * Point<2>(-x(1, i), x(0, i));
        }
    }
    std::string describe() const override { return "pull"; }

  private:
    std::size_t last_;
    double force_, swirl_;
};

/// A row of springs along x.
struct Chain {
    explicit Chain(int links, double force, double swirl = 0.0, double mass = 1.0)
        : model(make_particles<2>(square_lattice<2>({links + 1, 1}), mass)) {
        model.add_term<Springs<2>>(HarmonicSpring{0.7, 1.0});
        Eigen::Index last = 0;
        model.particles().reference_position.row(0).maxCoeff(&last);
        model.add(std::make_unique<Pull>(static_cast<std::size_t>(last), force, swirl));
        y = initial_state<2>(model, 1.0, 1.0, at_rest<2>());
        const auto x = model.particles().reference_position;
        for (Eigen::Index i = 0; i < x.cols(); ++i) held.push_back(x(0, i) < 0.5);
    }
    ParticleModel<2> model;
    std::vector<double> y;
    std::vector<bool> held;
};

}  // namespace

// Every spring is drawn out by F/kappa, and tension keeps the row straight.
BOOST_AUTO_TEST_CASE(a_chain_of_springs) {
    Chain chain(8, 0.05);
    for (const double t : {0.0, 3.0}) {
        const Equilibrium rest = equilibrium<2>(chain.model, chain.y, chain.held, 1e-12, t);
        BOOST_TEST(rest.largest_force < 1e-12);
        const auto x = ConstState<2>(chain.model.layout(), rest.y).position();
        BOOST_TEST(x.row(0).maxCoeff() == 8.0 * (1.0 + 0.05 / 0.7),
                   boost::test_tools::tolerance(1e-10));
        BOOST_TEST(x.row(1).cwiseAbs().maxCoeff() < 1e-9);
        BOOST_TEST(ConstState<2>(chain.model.layout(), rest.y).velocity().norm() == 0.0);
        BOOST_TEST(rest.rhs_evaluations < 200U);
    }
}

// No length or force has a unit of its own.
BOOST_AUTO_TEST_CASE(a_chain_of_springs_in_other_units) {
    for (const double L : {1e-9, 1e6})
        for (const double f : {1e-12, 1e9}) {  // of forces
            const double kappa = 0.7 * f / L;
            ParticleModel<2> model(make_particles<2>(square_lattice<2>({9, 1}, L), 1.0, L));
            model.add_term<Springs<2>>(HarmonicSpring{kappa, L});
            const auto x = model.particles().reference_position.row(0);
            Eigen::Index last = 0;
            x.maxCoeff(&last);
            model.add(std::make_unique<Pull>(static_cast<std::size_t>(last), 0.05 * f, 0.0));
            const auto y = initial_state<2>(model, 1.0, 1.0, at_rest<2>());
            std::vector<bool> held;
            for (const double at : x) held.push_back(at < x.minCoeff() + 0.5 * L);
            const Equilibrium rest = equilibrium<2>(model, y, held, 1e-11 * f);
            BOOST_TEST(rest.largest_force < 1e-11 * f);
            const auto at = ConstState<2>(model.layout(), rest.y).position();
            BOOST_TEST(
                (at.row(0).maxCoeff() - at.row(0).minCoeff()) / L == 8.0 * (1.0 + 0.05 / 0.7),
                boost::test_tools::tolerance(1e-9));
        }
}

// A chain held at one end: omega^2 = 4 K sin^2((2j - 1) pi/(4 n + 2)), K = kappa along it and F by the length of a
// drawn link across it, which the tension alone keeps straight.
BOOST_AUTO_TEST_CASE(modes_of_a_chain_under_tension) {
    constexpr int links = 12;
    constexpr double F = 0.05, kappa = 0.7;
    for (const double mass : {1.0, 2.5}) {
        Chain chain(links, F, 0.0, mass);
        const auto rest = equilibrium<2>(chain.model, chain.y, chain.held, 1e-12);
        std::vector<double> exact;
        for (const double K : {kappa, F / (1.0 + F / kappa)})
            for (int j = 1; j <= links; ++j)
                exact.push_back(
                    4.0 * K / mass *
                    std::pow(std::sin((2 * j - 1) * std::numbers::pi / (4 * links + 2)), 2));
        std::sort(exact.begin(), exact.end());
        for (const std::size_t count : {std::size_t{1}, std::size_t{3}, std::size_t{2 * links}}) {
            const auto modes = lowest_modes<2>(chain.model, rest.y, chain.held, count);
            for (std::size_t k = 0; k < count; ++k)
                BOOST_TEST(std::abs(modes.omega_squared[k] - exact[k]) < 1e-8);
            BOOST_TEST(modes.largest_residual < 1e-7);
            const Eigen::MatrixXd products = mass * modes.shapes.transpose() * modes.shapes;
            BOOST_TEST((products - Eigen::MatrixXd::Identity(products.rows(), products.cols()))
                           .cwiseAbs()
                           .maxCoeff() < 1e-10);
            const auto first = std::find(chain.held.begin(), chain.held.end(), true);
            const Eigen::Index held = 2 * (first - chain.held.begin());
            BOOST_TEST(modes.shapes.middleRows(held, 2).norm() == 0.0);
        }
    }
    // Pushed instead, it buckles.
    Chain pushed(links, -F);
    auto y = pushed.y;
    auto x = State<2>(pushed.model.layout(), y).position();
    x.row(0) *= 1.0 - F / kappa;
    BOOST_TEST(lowest_modes<2>(pushed.model, y, pushed.held, 1).omega_squared.front() < -1e-3);
}

// At rest a free body has three motions without force; the next is a bend, twice.
BOOST_AUTO_TEST_CASE(modes_of_a_free_hexagon) {
    TotalLagrangianModel<2> model(make_particles<2>(triangular_hexagon(3), 1.0),
                                  StVenantKirchhoff::like(ElasticSolid::triangular_lattice()),
                                  TotalLagrangianScheme{triangular_density, 3.0, 0.1});
    const auto y = lattice_state(model, at_rest<2>());
    const auto modes = lowest_modes<2>(model, y, std::vector<bool>(37, false), 6);
    for (std::size_t k = 0; k < 3; ++k) BOOST_TEST(std::abs(modes.omega_squared[k]) < 1e-9);
    for (std::size_t k = 3; k < 5; ++k)
        BOOST_TEST(std::abs(modes.omega_squared[k] - 0.0328464) < 1e-6);
    BOOST_TEST(modes.omega_squared[5] > 0.034);
}

BOOST_AUTO_TEST_CASE(what_has_no_equilibrium) {
    Chain swirl(8, 0.05, 0.01), all(8, 0.05);
    BOOST_CHECK_THROW(equilibrium<2>(swirl.model, swirl.y, swirl.held, 1e-9), InputError);
    BOOST_CHECK_THROW(equilibrium<2>(all.model, all.y, std::vector<bool>(9, true), 1e-9),
                      InputError);
    BOOST_CHECK_THROW(equilibrium<2>(swirl.model, swirl.y, std::vector<bool>(3, false), 1e-9),
                      InputError);
    BOOST_CHECK_THROW(lowest_modes<2>(swirl.model, swirl.y, swirl.held, 1), InputError);
    Chain fine(8, 0.05);
    for (const std::size_t count : {std::size_t{0}, std::size_t{17}})
        BOOST_CHECK_THROW(lowest_modes<2>(fine.model, fine.y, fine.held, count), InputError);
    fine.model.add(std::make_unique<Friction<2>>(0.1));
    const auto y_damped = lattice_state(fine.model, at_rest<2>());
    BOOST_CHECK_THROW(equilibrium<2>(fine.model, y_damped, fine.held, 1e-9), InputError);
    SmoothParticleModel<2> updated(make_particles<2>(triangular_block(6, 6), 1.0),
                                   ElasticSolid{0.4, 0.4}, Scheme{});
    const auto y = lattice_state(updated, at_rest<2>());
    BOOST_CHECK_THROW(equilibrium<2>(updated, y, std::vector<bool>(36, false), 1e-9), InputError);
}

// Friction between particles, and particles that yield.
BOOST_AUTO_TEST_CASE(rest_that_is_not_unique) {
    const auto particles = make_particles<2>(triangular_block(6, 4), 1.0);
    const auto x = particles.reference_position.row(0);
    std::vector<bool> held;
    for (const double at : x) held.push_back(at < x.minCoeff() + 0.9);  // two layers
    const auto refused = [&](auto& model) {
        const auto y = lattice_state(model, at_rest<2>());
        BOOST_CHECK_EXCEPTION(
            equilibrium<2>(model, y, held, 1e-9), InputError,
            [](const InputError& e) { return std::string(e.what()).starts_with("equilibrium: "); });
    };
    for (const double eta : {0.1, 1e-6}) {
        FluidModel<2> fluid(particles, Fluid{EmbeddedAtom{}, NewtonViscosity{eta, 0.0}},
                            {.density = Density::summed, .range = 3.0});
        refused(fluid);
    }
    ParticleModel<2> flows(particles), elastic(particles);
    const PolynomialSolid law{0.4, 0.4};
    const MaterialVectorScheme scheme{triangular_density, 3.0};
    flows.add_term<MaterialVectors<2>>(FlowingSolid{law, 0.01}, scheme);
    refused(flows);
    // Those that do not flow have a potential: a block that is drawn comes to rest.
    elastic.add_term<MaterialVectors<2>>(law, scheme);
    elastic.add(std::make_unique<Pull>(particles.size() - 1, 0.001, 0.0));
    const auto y = initial_state<2>(elastic, triangular_density, 1.0, at_rest<2>());
    const auto rest = equilibrium<2>(elastic, y, held, 1e-9);
    BOOST_TEST(rest.largest_force < 1e-9);
}
