// SPDX-License-Identifier: GPL-3.0-or-later
// When a drift counts as beyond its limit, and how often that is said.
#include <spam/problem/drift_guard.hpp>

#include <boost/test/unit_test.hpp>

#include <limits>

using namespace spam;

namespace {

Drift energy(double change) { return {"energy", Promise::integrator_error, change, 1e-6}; }

std::size_t beyond(const DriftLimits& limits, const Drift& drift) {
    return DriftGuard(limits).newly_exceeded({drift}).size();
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_limit_itself_is_within) {
    const DriftLimits promised{.action = DriftAction::warn};
    BOOST_TEST(beyond(promised, energy(1e-6)) == 0u);
    BOOST_TEST(beyond(promised, energy(1.001e-6)) == 1u);
    BOOST_TEST(beyond(promised, energy(std::numeric_limits<double>::quiet_NaN())) == 1u);
    BOOST_TEST(beyond(promised, energy(std::numeric_limits<double>::infinity())) == 1u);
}

BOOST_AUTO_TEST_CASE(a_limit_given_comes_before_the_promise) {
    const DriftLimits loose{.action = DriftAction::warn, .energy = 1e-3};
    BOOST_TEST(beyond(loose, energy(0.999e-3)) == 0u);
    BOOST_TEST(beyond(loose, energy(1.001e-3)) == 1u);
    const DriftLimits of_another{.action = DriftAction::warn, .momentum = 1.0};
    BOOST_TEST(beyond(of_another, energy(1.001e-6)) == 1u);
}

BOOST_AUTO_TEST_CASE(what_is_not_promised_has_no_limit_of_its_own) {
    Drift drift{"angular momentum", Promise::not_kept, 0.5, 1e-6};
    BOOST_TEST(beyond({.action = DriftAction::stop}, drift) == 0u);
    BOOST_TEST(beyond({.action = DriftAction::stop, .angular_momentum = 0.4}, drift) == 1u);
    BOOST_TEST(beyond({.action = DriftAction::stop, .angular_momentum = 0.6}, drift) == 0u);
}

BOOST_AUTO_TEST_CASE(a_warning_comes_once_and_a_stop_again_after_a_restart) {
    DriftGuard warns({.action = DriftAction::warn}), stops({.action = DriftAction::stop});
    BOOST_TEST(warns.newly_exceeded({energy(2e-6)}).size() == 1u);
    BOOST_TEST(warns.newly_exceeded({energy(3e-6)}).size() == 0u);
    BOOST_TEST(warns.newly_exceeded({{"mass", Promise::exact, 1e-11, 1e-12}}).size() == 1u);
    BOOST_TEST(stops.newly_exceeded({energy(2e-6)}).size() == 1u);
    BOOST_TEST(stops.newly_exceeded({energy(3e-6)}).size() == 1u);
}
