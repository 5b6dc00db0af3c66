// SPDX-License-Identifier: GPL-3.0-or-later
// Choices of scheme, and what becomes of any combination of laws (combined_laws.hpp).
#pragma once

#include "rhs/combined_laws.hpp"
#include "support/plane_and_space.hpp"
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
template <int Dim>
Row run(Sample<Dim>& sample) {
    Row row;
    IntegratorOptions rk4;
    rk4.dt = 0.1;
    Motion<Dim> motion(sample.model, sample.start(), rk4);
    motion.advance_to(0.2);
    std::vector<double> y(motion.y().begin(), motion.y().end());
    std::vector<double> y_dot(y.size());
    sample.model.rates(0.2, y, y_dot);
    BOOST_TEST_REQUIRE(sample.model.failure().empty(), sample.model.failure());
    // A little on: what has just been settled is at the kink between loading and unloading.
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += 0.02 * y_dot[k];
    sample.model.rates(0.22, y, y_dot);
    constexpr double h = 1e-3;
    std::vector<Invariants<Dim>> at;
    for (const double step : {h, -h, 2.0 * h, -2.0 * h}) {
        std::vector<double> z = y;
        for (std::size_t k = 0; k < z.size(); ++k) z[k] += step * y_dot[k];
        at.push_back(measure_invariants<Dim>(sample.model, z));
    }
    const auto slope = [&](const auto& f) -> decltype(f(at[0])) {
        return (8.0 * (f(at[0]) - f(at[1])) - (f(at[2]) - f(at[3]))) / (12.0 * h);
    };
    row.momentum = slope([](const auto& i) { return i.momentum_balance(); }).cwiseAbs().maxCoeff();
    row.angular_momentum =
        slope([](const auto& i) { return i.angular_momentum_balance(); }).cwiseAbs().maxCoeff();
    row.energy = std::abs(slope([](const auto& i) { return i.energy_balance(); }));
    row.turns = sample.model.promises().angular_momentum != Promise::not_kept;
    return row;
}

template <int Dim>
Row combine(const Build<Dim>& law, const Add<Dim>& more, const Scheme& scheme,
            const Add<Dim>& external, const Box<Dim>& box = {}) {
    Sample<Dim> sample(box);
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

/// What became of combinations, by name: the option that refuses it, or whether it keeps L.
struct Tally {
    std::size_t ran = 0, losing = 0;  ///< losing: without a promise for L, and it changes
    std::map<std::string, std::string> fate{};

    void count(const std::string& name, const Row& row) {
        BOOST_TEST_CONTEXT(name) judge(row);
        fate[name] = row.refused.substr(0, row.refused.find(':'));
        if (!row.refused.empty()) return;
        ++ran;
        if (row.turns) fate[name] = "keeps L";
        losing += !row.turns && row.angular_momentum > 1e-9;
    }
    std::size_t refused() const { return fate.size() - ran; }
};

/// In space the same is refused and kept as in the plane, which alone has elements.
inline void compare(const Tally& plane, const Tally& space) {
    for (const Tally* all : {&plane, &space}) {
        BOOST_TEST_MESSAGE(all->ran << " combinations run, " << all->losing << " lose L, "
                                    << all->refused() << " are refused");
        BOOST_TEST(10 * all->losing > all->ran);  // they can
    }
    std::size_t of_elements = 0;
    for (const auto& [name, fate] : plane.fate)
        if (name.find("Elements") != std::string::npos)
            ++of_elements;
        else
            BOOST_TEST((space.fate.contains(name) && space.fate.at(name) == fate), name);
    BOOST_TEST(space.fate.size() + of_elements == plane.fate.size());
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
