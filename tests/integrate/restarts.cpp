// SPDX-License-Identifier: GPL-3.0-or-later
// A run that writes a checkpoint and goes on, and one that begins at that checkpoint with everything made
// anew, have the same bits: every method, fixed and adaptive.
#include "support/refusal.hpp"
#include "support/small_hexagons.hpp"
#include <spam/core/error.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

struct Outcome {
    std::vector<double> y;
    Integrator::Statistics statistics;
};

std::vector<double> copy(const Vector& y) { return {y.span().begin(), y.span().end()}; }

void go_on(Integrator& integrator, double t_end) {
    while (integrator.t() < t_end) integrator.step(t_end);
}

constexpr double half = 2.05, whole = 4.0;  // the first not on the grid of fixed steps

/// Goes half the way and writes what must be remembered.
std::pair<Archive, std::vector<double>> first_half(const IntegratorOptions& options,
                                                   const System& system) {
    const SundialsContext context;
    Vector y = start_of(system, context);
    const auto integrator = make_integrator(options, system.ode, y, 0.0, context);
    go_on(*integrator, half);
    Archive archive;
    integrator->remember(archive);
    return {archive, copy(y)};
}

/// To the end in one go, with a checkpoint on the way.
Outcome uninterrupted(const IntegratorOptions& options, const System& system) {
    const SundialsContext context;
    Vector y = start_of(system, context);
    const auto integrator = make_integrator(options, system.ode, y, 0.0, context);
    go_on(*integrator, half);
    Archive written;
    integrator->remember(written);
    Archive reading(written.bytes());
    integrator->remember(reading);
    reading.expect_end();
    go_on(*integrator, whole);
    return {copy(y), integrator->statistics()};
}

/// From the checkpoint on, all else made anew; `remembers` or not.
Outcome restarted(const IntegratorOptions& options, const IntegrationMethod& method,
                  bool remembers) {
    const auto before = hexagon_for(method, 2, 0.03);
    const auto [archive, y_half] = first_half(options, *before);
    const auto system = hexagon_for(method, 2, 0.03);
    const SundialsContext context;
    Vector y = start_of(*system, context);
    std::copy(y_half.begin(), y_half.end(), y.span().begin());
    const auto integrator =
        make_integrator(options, system->ode, y, remembers ? 0.0 : half, context);
    if (remembers) {
        Archive reading(archive.bytes());
        integrator->remember(reading);
        BOOST_TEST(integrator->t() == half);
    }
    go_on(*integrator, whole);
    return {copy(y), integrator->statistics()};
}

std::vector<IntegratorOptions> ways_of(const IntegrationMethod& method) {
    std::vector<IntegratorOptions> ways;
    IntegratorOptions options;
    options.method = method.name;
    options.rtol = 1e-7;
    if (method.adaptive) ways.push_back(options);
    options.relaxation = true;
    if (refusal([&] { options.validate(); }) == "accepted") ways.push_back(options);
    options.relaxation = false;
    options.dt = 0.1;
    if (method.fixed) ways.push_back(options);
    return ways;
}

bool same_counts(const Integrator::Statistics& a, const Integrator::Statistics& b) {
    return a.steps == b.steps && a.rejected_steps == b.rejected_steps &&
           a.rhs_evaluations == b.rhs_evaluations && a.limited_by == b.limited_by &&
           a.error_share == b.error_share && a.last_step == b.last_step;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_method_goes_on_bit_for_bit) {
    std::size_t without_memory = 0;
    for (const IntegrationMethod& method : integration_methods()) {
        for (const IntegratorOptions& options : ways_of(method)) {
            BOOST_TEST_CONTEXT(options.describe()) {
                const Outcome one = uninterrupted(options, *hexagon_for(method, 2, 0.03));
                const Outcome other = restarted(options, method, true);
                BOOST_TEST((one.y == other.y));
                BOOST_TEST(same_counts(one.statistics, other.statistics));
                // A fixed step has little to remember, a multistep method begins anew anyway.
                if (restarted(options, method, false).y != one.y) ++without_memory;
            }
        }
    }
    BOOST_TEST(without_memory > 10U);  // the comparison can fail
}

BOOST_AUTO_TEST_CASE(what_ends_early_is_refused) {
    const IntegrationMethod& method = integration_method("gsl:rk8pd");
    const auto system = hexagon_for(method, 1, 0.03);
    const auto options = ways_of(method).front();
    const auto [archive, y_half] = first_half(options, *system);
    const SundialsContext context;
    Vector y = start_of(*system, context);
    const auto integrator = make_integrator(options, system->ode, y, 0.0, context);
    Archive cut(std::span(archive.bytes()).first(archive.bytes().size() / 2));
    BOOST_CHECK_THROW(integrator->remember(cut), InputError);
}
