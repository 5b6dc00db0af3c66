// SPDX-License-Identifier: GPL-3.0-or-later
// States in which no particle feels a force: springs of known stiffness, and what has none.
#include <spam/core/error.hpp>
#include <spam/external/external.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>
#include <spam/study/equilibrium.hpp>

#include <boost/test/unit_test.hpp>

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
            if (i == static_cast<Eigen::Index>(last_)) v_dot(0, i) += force_;
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
    explicit Chain(int links, double force, double swirl = 0.0)
        : model(make_particles<2>(square_lattice<2>({links + 1, 1}), 1.0)) {
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

BOOST_AUTO_TEST_CASE(what_has_no_equilibrium) {
    Chain swirl(8, 0.05, 0.01), all(8, 0.05);
    BOOST_CHECK_THROW(equilibrium<2>(swirl.model, swirl.y, swirl.held, 1e-9), InputError);
    BOOST_CHECK_THROW(equilibrium<2>(all.model, all.y, std::vector<bool>(9, true), 1e-9),
                      InputError);
    SmoothParticleModel<2> updated(make_particles<2>(triangular_block(6, 6), 1.0),
                                   ElasticSolid{0.4, 0.4}, Scheme{});
    const auto y = lattice_state(updated, at_rest<2>());
    BOOST_CHECK_THROW(equilibrium<2>(updated, y, std::vector<bool>(36, false), 1e-9), InputError);
}
