// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked of every law of pairs of one's own.
#pragma once

#include <spam/core/error.hpp>
#include <spam/rhs/pair_term.hpp>
#include <spam/rhs/particle_model.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

namespace spam::test {

inline std::vector<double> alternating(std::size_t n) {
    std::vector<double> numbers(n);
    for (std::size_t i = 0; i < n; ++i) numbers[i] = i % 2 == 0 ? 0.3 : -0.2;
    return numbers;
}

/// Its force is minus the gradient of its energy, of other masses than 1 too; pairs beyond its range do not
/// act; momentum is kept to the last digits.
inline void check_own_law(const std::string& name, std::vector<std::vector<double>> columns) {
    auto particles = make_particles<2>(triangular_block(7, 5), 1.0);
    for (std::size_t i = 0; i < particles.size(); ++i)
        particles.mass[i] = 1.0 + 0.1 * double(i % 3);
    ParticleModel<2> model(particles);
    PairLaw<2> law{registered_sweeps<2>(name), 1.6, name + ", a law of one's own"};
    law.constants.own = {0.05, 1.6};
    law.columns = std::move(columns);
    model.add_term<PairTerm<2>>(law);
    std::vector<double> y(model.layout().size()), y_dot(y.size());
    const State<2> state(model.layout(), y);
    state.position() = particles.reference_position;
    for (Eigen::Index k = 0; k < state.position().size(); ++k)
        state.position().data()[k] += 0.1 * std::sin(1.7 * static_cast<double>(k));
    model.rates(0.0, y, y_dot);
    const State<2> rate(model.layout(), y_dot);
    Point<2> sum = Point<2>::Zero();
    double strongest = 0.0;
    for (Eigen::Index i = 0; i < rate.velocity().cols(); ++i) {
        const double m = particles.mass[static_cast<std::size_t>(i)];
        sum += m * rate.velocity().col(i);
        for (int a = 0; a < 2; ++a) {
            double& x = state.position()(a, i);
            const double here = x, h = 1e-5;
            x = here + h;
            const double more = model.internal_energy(y);
            x = here - h;
            const double less = model.internal_energy(y);
            x = here;
            BOOST_TEST(std::abs(m * rate.velocity()(a, i) + (more - less) / (2.0 * h)) < 1e-9);
            strongest = std::max(strongest, std::abs(m * rate.velocity()(a, i)));
        }
    }
    BOOST_TEST(sum.norm() < 1e-15);
    BOOST_TEST(strongest > 1e-3);
    BOOST_CHECK_THROW(registered_sweeps<2>(name + " of somebody else"), InputError);
}

}  // namespace spam::test

#define OWN_LAW(name, ...)                                    \
    BOOST_AUTO_TEST_CASE(forces_are_those_of_the_potential) { \
        spam::test::check_own_law(name, __VA_ARGS__);         \
    }
