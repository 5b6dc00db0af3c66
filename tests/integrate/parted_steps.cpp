// SPDX-License-Identifier: GPL-3.0-or-later
// Fixed steps in parts of a run (core/parts.hpp): how many exchanges a step takes, and that all parts hear of a stage
// without meaning, whichever it is, as the run in one part does.
#include "support/own_part.hpp"
#include "support/parts_in_threads.hpp"
#include "support/small_hexagons.hpp"
#include <spam/core/error.hpp>

#include <boost/test/unit_test.hpp>

#include <mutex>

using namespace spam;
using namespace spam::test;

namespace {

/// Of a hexagon of 37 particles, what is this part's: every third one, say.
std::unique_ptr<System> own_hexagon(bool separable) {
    Parts& parts = Parts::here();
    const auto all = make_particles<2>(triangular_hexagon(3), 1.0);
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < all.size(); ++i)
        if (i % parts.count() == parts.own()) numbers.push_back(i);
    if (!parts.alone()) parts.set_numbers(numbers);
    if (separable)
        return shaken(std::make_unique<BondedModel<2>>(own_part(all), HarmonicSpring{1.0, 1.0}),
                      0.01);
    Scheme scheme;
    scheme.range = 2.85;
    return shaken(
        std::make_unique<SmoothParticleModel<2>>(own_part(all), ElasticSolid{0.43, 0.43}, scheme),
        0.01);
}

struct End {
    std::string reason;
    std::size_t evaluations = 0;
    double t = 0.0;
    bool operator==(const End&) const = default;
};

/// Of all parts, where the rates that the last one finds have no meaning at evaluation number `bad`.
std::vector<End> ends(std::size_t count, const IntegrationMethod& method, std::size_t bad) {
    std::mutex one;
    std::vector<End> found;
    const auto work = [&] {
        const auto system = own_hexagon(method.separable);
        std::size_t evaluations = 0;
        const auto rates = system->ode.rates;
        system->ode.rates = [&](double t, std::span<const double> y, std::span<double> y_dot) {
            ++evaluations;
            rates(t, y, y_dot);
        };
        const auto failure = system->ode.failure;
        system->ode.failure = [&] {
            const bool last = Parts::here().own() + 1 == count;
            return last && evaluations == bad ? "no meaning" : failure();
        };
        const SundialsContext context;
        Vector y = start_of(*system, context);
        const auto integrator =
            make_integrator({.method = method.name, .dt = 0.05}, system->ode, y, 0.0, context);
        End end;
        try {
            for (int step = 0; step < 4; ++step) integrator->step(10.0);
        } catch (const GuardStop& stop) {
            end.reason = stop.what();
        }
        end.evaluations = integrator->statistics().rhs_evaluations;
        end.t = integrator->t();
        const std::lock_guard lock(one);
        found.push_back(end);
    };
    PartsInThreads::run(count, work);
    return found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(all_parts_end_at_the_same_stage_with_the_same_words) {
    int words = 0;
    for (const IntegrationMethod& method : integration_methods())
        for (std::size_t bad = 1; bad <= 9; ++bad) {
            // ARKODE agrees at every stage: its vectors exchange where nothing can be thrown.
            if (!method.fixed || method.name.starts_with("arkode:")) continue;
            const End whole = ends(1, method, bad).front();
            words += whole.reason.empty() ? 0 : 1;
            BOOST_TEST_CONTEXT(method.name << ", evaluation " << bad << ": " << whole.reason) {
                for (const std::size_t count : {2U, 3U})
                    for (const End& end : ends(count, method, bad)) {
                        BOOST_TEST(end.reason == whole.reason);
                        BOOST_TEST(end.evaluations == whole.evaluations);
                        BOOST_TEST(end.t == whole.t);
                    }
            }
        }
    BOOST_TEST(words > 50);
}

// One for the images of each stage and one for the guard; more where lists are made anew.
BOOST_AUTO_TEST_CASE(a_step_of_rk4_takes_five_exchanges) {
    std::mutex one;
    PartsInThreads::run(2, [&] {
        const auto system = own_hexagon(false);
        const SundialsContext context;
        Vector y = start_of(*system, context);
        const auto rk4 =
            make_integrator({.method = "rk4", .dt = 0.05}, system->ode, y, 0.0, context);
        std::size_t least = 1000;
        for (int step = 0; step < 10; ++step) {
            const std::size_t before = Parts::here().traffic().exchanges;
            rk4->step(10.0);
            least = std::min(least, Parts::here().traffic().exchanges - before);
        }
        const std::lock_guard lock(one);
        BOOST_TEST(least == 5U);
    });
}

// Without an exchange of its own; the largest, in all parts at the same call.
BOOST_AUTO_TEST_CASE(what_a_part_tells_goes_with_the_next_exchange) {
    std::mutex one;
    PartsInThreads::run(3, [&] {
        Parts& parts = Parts::here();
        const auto expect = [&](int told) {
            const std::lock_guard lock(one);
            BOOST_TEST(int{parts.told()} == told);
        };
        parts.agree();
        expect(0);
        if (parts.own() == 1) parts.tell(2);
        expect(0);
        parts.agree();
        expect(2);
        if (parts.own() == 2) parts.tell(15);
        parts.total(1);
        expect(15);
        std::string reason;
        if (parts.own() == 0) {
            parts.tell(31);
            parts.give_up("enough");
        } else {
            try {
                parts.agree();
            } catch (const PartGaveUp& other) {
                reason = other.what();
            }
        }
        expect(31);
        const std::lock_guard lock(one);
        BOOST_TEST(reason == (parts.own() == 0 ? "" : "enough"));
    });
}
