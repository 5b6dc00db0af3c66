// SPDX-License-Identifier: GPL-3.0-or-later
// Choices of scheme, and what becomes of any combination of laws (combined_laws.hpp).
#pragma once

#include "rhs/combined_laws.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/problem/motion.hpp>

#include <boost/test/unit_test.hpp>

#include <regex>

namespace spam::test {

/// What a combination came to.
struct Row {
    std::string refused{};
    double momentum = 0.0, angular_momentum = 0.0, energy = 0.0;  ///< how fast what is kept changes
    bool turns = false;  ///< the angular momentum is promised
};

/// The derivatives of p - impulse, L - angular impulse and E - work - heat along the rates, as in
/// accounts.cpp, at a state on the way.
inline Row run(Sample& sample) {
    Row row;
    IntegratorOptions rk4;
    rk4.dt = 0.1;
    Motion<2> motion(sample.model, sample.start(), rk4);
    motion.advance_to(0.2);
    std::vector<double> y(motion.y().begin(), motion.y().end());
    std::vector<double> y_dot(y.size());
    sample.model.rates(0.2, y, y_dot);
    BOOST_TEST_REQUIRE(sample.model.failure().empty(), sample.model.failure());
    // A little on: what has just been settled is at the kink between loading and unloading.
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += 0.02 * y_dot[k];
    sample.model.rates(0.2, y, y_dot);
    constexpr double h = 1e-3;
    std::vector<Invariants<2>> at;
    for (const double step : {h, -h, 2.0 * h, -2.0 * h}) {
        std::vector<double> z = y;
        for (std::size_t k = 0; k < z.size(); ++k) z[k] += step * y_dot[k];
        at.push_back(measure_invariants<2>(sample.model, z));
    }
    const auto slope = [&](const auto& f) {
        return std::abs((8.0 * (f(at[0]) - f(at[1])) - (f(at[2]) - f(at[3]))) / (12.0 * h));
    };
    row.momentum = std::max(slope([](const auto& i) { return i.momentum_balance()[0]; }),
                            slope([](const auto& i) { return i.momentum_balance()[1]; }));
    row.angular_momentum = slope([](const auto& i) { return i.angular_momentum_balance()[0]; });
    row.energy = slope([](const auto& i) { return i.energy_balance(); });
    row.turns = sample.model.promises().angular_momentum != Promise::not_kept;
    return row;
}

inline Row combine(const Build& law, const std::function<void(Sample&)>& more, const Scheme& scheme,
                   const std::function<void(Sample&)>& external, const Box<2>& box = {}) {
    Sample sample(box);
    try {
        law(sample, scheme);
        more(sample);
        external(sample);
        sample.model.events();
    } catch (const InputError& e) {
        return {.refused = e.what()};
    }
    return run(sample);
}

/// A reason is one line that names the option, says what is wrong and what to do.
inline void judge(const Row& row) {
    if (!row.refused.empty()) {
        BOOST_TEST(row.refused.find('\n') == std::string::npos);
        BOOST_TEST(std::regex_search(row.refused, std::regex("^[a-z-]+: .{30,}[;,] ")),
                   row.refused);
        return;
    }
    BOOST_TEST(row.momentum < 1e-10);
    BOOST_TEST(row.energy < 1e-8);
    if (row.turns) BOOST_TEST(row.angular_momentum < 1e-9);
}

template <class F>
void for_each_scheme(const F& f) {
    for (const auto density : {Density::continuity, Density::summed, Density::chain_rule})
        for (const auto transport :
             {Transport::plain, Transport::average, Transport::monaghan, Transport::shifting})
            for (const auto angular_momentum :
                 {AngularMomentum::free, AngularMomentum::gauss, AngularMomentum::torque_particle,
                  AngularMomentum::torque_pair})
                for (const double viscosity : {0.0, 1.0})
                    for (const double closest : {0.0, 0.5})
                        f(Scheme{.density = density,
                                 .transport = transport,
                                 .angular_momentum = angular_momentum,
                                 .viscosity = viscosity,
                                 .closest_approach = closest});
}

}  // namespace spam::test
