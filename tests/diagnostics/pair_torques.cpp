// SPDX-License-Identifier: GPL-3.0-or-later
// Torques of pairs and particles against loops over all pairs, and what they must sum to.
#include "plane_wave/block_rotation.hpp"
#include "support/random_state.hpp"
#include <spam/analysis/plane_wave.hpp>
#include <spam/diagnostics/fits.hpp>
#include <spam/diagnostics/pair_torques.hpp>
#include <spam/problem/plan.hpp>

#include <boost/test/unit_test.hpp>

#include <numeric>

using namespace spam;
using namespace spam::test;

namespace {

const ElasticSolid solid{0.7, 0.4};

/// T_ij as printed, [HHM04] III A, with P = -sigma; 0 beyond the range.
double printed_torque(const SmoothParticleModel<2>& model, const std::vector<double>& y,
                      Eigen::Index i, Eigen::Index j) {
    const ConstState<2> s(model.layout(), y);
    const auto rho = model.density(y);
    const double h = model.scheme().range;
    const auto& m = model.particles().mass;
    const Point<2> r = s.position().col(i) - s.position().col(j);
    const double d = r.norm();
    if (d >= h) return 0.0;
    // w'/r of Lucy, from w' = -60 r (1 - r/h)^2 / (pi h^4)
    const double slope = -60.0 / (std::numbers::pi * std::pow(h, 4)) * std::pow(1.0 - d / h, 2);
    const auto P = [&](int c) {
        return -s.stress()(c, i) / std::pow(rho[static_cast<std::size_t>(i)], 2) -
               s.stress()(c, j) / std::pow(rho[static_cast<std::size_t>(j)], 2);
    };
    return m[static_cast<std::size_t>(i)] * m[static_cast<std::size_t>(j)] * slope *
           (r.x() * r.y() * (P(0) - P(1)) - (r.x() * r.x() - r.y() * r.y()) * P(2));
}

}  // namespace

BOOST_AUTO_TEST_CASE(torques_as_printed) {
    for (const auto density : {Density::continuity, Density::summed}) {
        SmoothParticleModel<2> model(jittered_particles<2>(8, 21), solid,
                                     {.density = density, .range = 2.6});
        const auto y = random_state(model, 22);
        const auto torques = pair_torques(model, y);
        std::vector<double> pairs, particles(model.particles().size()), doubled = particles;
        for (std::size_t i = 0; i < particles.size(); ++i)
            for (std::size_t j = i + 1; j < particles.size(); ++j) {
                const double T = printed_torque(model, y, static_cast<Eigen::Index>(i),
                                                static_cast<Eigen::Index>(j));
                if (T == 0.0) continue;
                pairs.push_back(T);
                for (const std::size_t k : {i, j}) {
                    particles[k] += 0.5 * T;
                    doubled[k] += T;
                }
            }
        BOOST_TEST_REQUIRE(torques.pair.size() == pairs.size());
        BOOST_TEST(relative_difference(torques.pair, pairs) < 1e-12);
        BOOST_TEST(relative_difference(torques.particle, particles) < 1e-12);
        BOOST_TEST(relative_difference(torques.particle, doubled) > 0.1);
    }
}

BOOST_AUTO_TEST_CASE(their_sum_is_the_rate_of_the_angular_momentum) {
    SmoothParticleModel<2> model(jittered_particles<2>(8, 23), solid, {.range = 2.6});
    const auto y = random_state(model, 24), rates = rates_of(model, y);
    const ConstState<2> state(model.layout(), y), rate(model.layout(), rates);
    double L_dot = 0.0;
    for (Eigen::Index i = 0; i < state.position().cols(); ++i)
        L_dot += model.particles().mass[static_cast<std::size_t>(i)] *
                 (state.position()(0, i) * rate.velocity()(1, i) -
                  state.position()(1, i) * rate.velocity()(0, i));
    const auto torques = pair_torques(model, y);
    for (const auto& all : {torques.pair, torques.particle}) {
        const auto d = distribution(all);
        BOOST_TEST(d.positive_sum + d.negative_sum == L_dot, boost::test_tools::tolerance(1e-11));
        const double R = d.balance_factor();
        BOOST_TEST(std::abs(d.positive_sum / R + d.negative_sum * R) < 1e-13 * d.positive_sum);
        BOOST_TEST(std::abs(d.positive_sum + d.negative_sum) > 1e-6 * d.positive_sum);
    }
}

BOOST_AUTO_TEST_CASE(how_torques_are_counted) {
    const std::vector<double> torques{-1.0, 0.0, 2.0, 2.0, -0.5, 0.0};
    const auto d = distribution(torques);
    BOOST_TEST(d.negative == 2U);
    BOOST_TEST(d.positive == 2U);
    BOOST_TEST(d.negative_sum == -1.5);
    BOOST_TEST(d.positive_sum == 4.0);
    BOOST_TEST(distribution(std::vector<double>{1.0}).balance_factor() == 1.0);
    const auto bars = histogram(torques, 4);
    BOOST_TEST(bars.bin_width == 1.0);
    BOOST_TEST((bars.count == std::vector<double>{0, 2, 2, 2}));
    BOOST_TEST((bars.centre == std::vector<double>{-1.5, -0.5, 0.5, 1.5}));
}

BOOST_AUTO_TEST_CASE(columns_follow_the_state) {
    SmoothParticleModel<2> model(jittered_particles<2>(6, 25), solid, {.range = 2.6});
    const auto columns = pair_torque_columns();
    BOOST_TEST(columns.size() == 10U);
    for (const unsigned seed : {26U, 27U}) {
        const auto y = random_state(model, seed);
        const auto torques = pair_torques(model, y);
        for (const auto& column : columns) {
            const bool pairs = column.name.starts_with("pair_");
            const auto d = distribution(pairs ? torques.pair : torques.particle);
            if (column.name.ends_with("_torques_negative"))
                BOOST_TEST(column.measure(model, y) == static_cast<double>(d.negative));
            if (column.name.ends_with("_positive_sum"))
                BOOST_TEST(column.measure(model, y) == d.positive_sum);
            if (column.name.ends_with("_factor"))
                BOOST_TEST(column.measure(model, y) == d.balance_factor());
        }
    }
}

BOOST_AUTO_TEST_CASE(torques_of_a_long_wave_are_minus_the_rate_of_blocks) {
    // T_i = -(m/rho) (<r^2>/4) curl div sigma, <r^2> = 5 h^2/28; and twice the error at half the
    // wavelength would not pass.
    const auto standing = standing_wave(Polarization::transverse, 60, 1e-4, {.range = 4.0});
    const auto& model = *standing.solid.model;
    const auto torques = pair_torques(model, standing.solid.y0);
    const auto& reference = model.particles().reference_position;
    std::vector<double> predicted;
    const double r2 = 5.0 * 16.0 / 28.0, d = 4.0;
    for (const double y : reference.row(1))  // (d^4/12) curl div sigma: d^4/12 belongs to the block
        predicted.push_back(-r2 / 4.0 / standing.wave.density * standing.wave.block_torque(d, y) *
                            12.0 / std::pow(d, 4));
    BOOST_TEST(best_factor(torques.particle, predicted) == 1.0, boost::test_tools::tolerance(0.02));
}

BOOST_AUTO_TEST_CASE(blocks_turn_with_a_rigid_rotation) {
    const auto lattice = triangular_solid(12, 12, solid, {}, 1.1547, 0.0);
    const Points<2>& x = lattice.model->particles().reference_position;
    const Point<2> centre(5.0, 5.0);
    Points<2> v(2, x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        v.col(i) = 0.3 * Point<2>(-(x(1, i) - centre.y()), x(0, i) - centre.x());
    const auto block = block_rotation(*lattice.model, x, v, centre, 4.0, 12);
    // Ixx = Iyy over all places of the block
    BOOST_TEST(block.angular_momentum == 0.3 * 2.0 * block.second_moment,
               boost::test_tools::tolerance(0.05));
    // sum m dy^2 about the centre of mass comes near rho side^4/12 from below
    const double continuum = std::sqrt(4.0 / 3.0) * std::pow(4.0, 4) / 12.0;
    BOOST_TEST(block.second_moment < continuum);
    BOOST_TEST(block.second_moment > 0.85 * continuum);
}

BOOST_AUTO_TEST_CASE(periods_from_zeros) {
    std::vector<double> t, value;
    for (int n = 0; n < 300; ++n) {
        t.push_back(0.1 * n);
        value.push_back(-3.0 * std::sin(2.0 * std::numbers::pi * t.back() / 7.3));
    }
    BOOST_TEST(period_of_zeros(t, value) == 7.3, boost::test_tools::tolerance(1e-4));
    BOOST_TEST(period_of_zeros(std::span(t).first(60), std::span(value).first(60)) == 0.0);
    // Zeros that are rows.
    std::vector<double> rows, square;
    for (int n = 0; n < 17; ++n) {
        rows.push_back(n);
        square.push_back(n % 2 == 1 ? 0.0 : n % 4 == 0 ? 1.0 : -1.0);
    }
    BOOST_TEST(period_of_zeros(rows, square) == 4.0, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(best_factor(std::vector<double>{2, 4}, std::vector<double>{1, 2}) == 2.0);
}
