// SPDX-License-Identifier: GPL-3.0-or-later
// The pipeline against loops over all pairs written straight from the papers.
#include "support/effort.hpp"
#include "support/oracle_model.hpp"
#include "support/random_state.hpp"
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

const ElasticSolid solid{0.7, 0.4};

template <int Dim>
void compare(int cells, Kernel kernel = Kernel::lucy) {
    for (const Scheme& scheme : all_schemes<Dim>(kernel)) {
        BOOST_TEST_CONTEXT(scheme.describe()) {
            SmoothParticleModel<Dim> model(jittered_particles<Dim>(cells, 11), solid, scheme);
            const auto oracle = oracle_model<Dim>(model.particles(), solid, scheme);
            const auto wrong =
                oracle_model<Dim>(model.particles(), solid, scheme, Mutation::printed_gradient);
            const auto y = random_state(model, 12);
            const auto rates = rates_of(model, y);
            BOOST_TEST(relative_difference(rates, rates_of(*oracle, y)) < 1e-12);
            BOOST_TEST(relative_difference(rates, rates_of(*wrong, y)) > 1e-3);
            if (kernel == Kernel::lucy || kernel == Kernel::w3) continue;
            const auto other =
                oracle_model<Dim>(model.particles(), solid, scheme, Mutation::lucys_weight);
            BOOST_TEST(relative_difference(rates, rates_of(*other, y)) > 1e-2);
        }
    }
}

/// How far rates are from those of a law that is wrong on purpose.
double distance_from(Mutation mutation, const Scheme& scheme) {
    SmoothParticleModel<2> model(jittered_particles<2>(8, 11), solid, scheme);
    const auto wrong = oracle_model<2>(model.particles(), solid, scheme, mutation);
    auto y = random_state(model, 12);
    // Turning, so that there is an angular momentum to keep.
    const State<2> state(model.layout(), y);
    for (Eigen::Index i = 0; i < state.position().cols(); ++i)
        state.velocity().col(i) += Point<2>(-state.position()(1, i), state.position()(0, i));
    return relative_difference(rates_of(model, y), rates_of(*wrong, y));
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_comparison_sees_what_the_schemes_differ_in) {
    const Scheme viscous{.viscosity = 0.3, .range = 2.6};
    BOOST_TEST(distance_from(Mutation::none, viscous) < 1e-12);
    BOOST_TEST(distance_from(Mutation::viscous_recession, viscous) > 1e-3);
    const Scheme gauss{.angular_momentum = AngularMomentum::gauss, .range = 2.6};
    BOOST_TEST(distance_from(Mutation::none, gauss) < 1e-12);
    BOOST_TEST(distance_from(Mutation::printed_multipliers, gauss) > 1e-3);
}

BOOST_AUTO_TEST_CASE(one_dimension) { compare<1>(25); }
BOOST_AUTO_TEST_CASE(two_dimensions) { compare<2>(8); }
BOOST_AUTO_TEST_CASE(three_dimensions) { compare<3>(4); }

BOOST_AUTO_TEST_CASE(other_weight_functions) {
    // One way for all of them: under sanitizers one will do.
    for (const Kernel kernel :
         effort(std::vector{Kernel::monaghan, Kernel::w2, Kernel::w3, Kernel::w5},
                std::vector{Kernel::w3})) {
        compare<1>(25, kernel);
        compare<2>(6, kernel);
        compare<3>(4, kernel);
    }
}

BOOST_AUTO_TEST_CASE(summed_density_of_the_lattice) {
    // sum_R w(|R|) over the sites of the triangular lattice, Lucy, h = 3: 1.1550863, itself included.
    Scheme scheme{.density = Density::summed, .range = 3.0};
    SmoothParticleModel<2> model(make_particles<2>(triangular_hexagon(8), 1.0), solid, scheme);
    std::vector<double> y(model.layout().size(), 0.0);
    State<2>(model.layout(), y).position() = model.particles().reference_position;
    Eigen::Index centre = 0;
    model.particles().reference_position.colwise().norm().minCoeff(&centre);
    BOOST_TEST(model.density(y)[static_cast<std::size_t>(centre)] == 1.155086,
               boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(periodic_lattice_equals_the_inside_of_a_large_one) {
    // Rates of a periodic lattice with a plane wave equal those deep inside a larger free one.
    const int n = 12;
    const double height = n * std::sqrt(0.75);
    Scheme scheme{.transport = Transport::monaghan, .range = 3.0};
    const auto wave = [&](SmoothParticleModel<2>& model) {
        auto y = std::vector<double>(model.layout().size(), 0.0);
        const State<2> s(model.layout(), y);
        s.position() = model.particles().reference_position;
        for (Eigen::Index i = 0; i < s.position().cols(); ++i) {
            const double phase = 2.0 * std::numbers::pi * s.position()(1, i) / height;
            s.velocity()(0, i) = 0.1 * std::sin(phase);
            s.stress()(2, i) = 0.05 * std::cos(phase);
            s.density()(0, i) = std::sqrt(4.0 / 3.0);
        }
        return y;
    };
    const Box<2> box({double(n), height});
    SmoothParticleModel<2> periodic(make_particles<2>(triangular_block(n, n), 1.0, 1.0, box), solid,
                                    scheme, box);
    Points<2> large = triangular_block(3 * n, 3 * n);
    large.colwise() -= Eigen::Vector2d(n, height);
    SmoothParticleModel<2> free(make_particles<2>(large, 1.0), solid, scheme);
    const auto yp = wave(periodic), yf = wave(free);
    const auto rp = rates_of(periodic, yp), rf = rates_of(free, yf);
    const ConstState<2> p(periodic.layout(), rp), f(free.layout(), rf);
    int compared = 0;
    for (Eigen::Index i = 0; i < p.position().cols(); ++i)
        for (Eigen::Index k = 0; k < f.position().cols(); ++k) {
            const auto& a = periodic.particles().reference_position;
            if ((a.col(i) - free.particles().reference_position.col(k)).norm() > 1e-9) continue;
            BOOST_TEST((p.velocity().col(i) - f.velocity().col(k)).norm() < 1e-13);
            BOOST_TEST((p.stress().col(i) - f.stress().col(k)).norm() < 1e-13);
            BOOST_TEST((p.position().col(i) - f.position().col(k)).norm() < 1e-13);
            ++compared;
        }
    BOOST_TEST(compared == n * n);
}
