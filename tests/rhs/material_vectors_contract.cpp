// SPDX-License-Identifier: GPL-3.0-or-later
// What a solid with material vectors owes the house: no thread count in its bits, restarts that go on with the
// same bits while neighbours change, states without meaning named, bodies that do not see each other, bad
// input refused in a line.
#include "support/refusal.hpp"
#include "support/turned_body.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/diagnostics/total_energy.hpp>
#include <spam/material/flowing_solid.hpp>
#include <spam/material/hencky_solid.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/setup/initial_state.hpp>

#include <boost/test/unit_test.hpp>

#include <limits>

using namespace spam;
using namespace spam::test;

namespace {

constexpr PolynomialSolid solid{0.43, 0.43};
const MaterialVectorScheme usual{1.2, 2.6, 1.0};

/// A block that is sheared until all have other neighbours.
struct Sheared {
    explicit Sheared(const HyperelasticMaterial<2>& law = solid)
        : model(make_particles<2>(triangular_block(12, 12), 1.0), law, usual) {}
    MaterialVectorModel<2> model;
    std::vector<double> y0 = initial_state<2>(
        model, 1.2, 0.43, [](const Point<2>& x) { return Point<2>(0.25 * x.y(), 0.0); });
};

using Bits = std::vector<double>;
Bits bits(std::span<const double> y) { return {y.begin(), y.end()}; }

std::string refused(const MaterialVectorScheme& scheme, const HyperelasticMaterial<2>& law = solid,
                    const Box<2>& box = {}) {
    return refusal([&] {
        MaterialVectorModel<2>(jittered_particles<2>(8, 101, 0.15, box), law, scheme, box);
    });
}

}  // namespace

namespace {
void check_threads(const HyperelasticMaterial<2>& law) {
    const auto particles = jittered_particles<2>(40, 102);
    BOOST_TEST(particles.size() > parallel_threshold);
    std::vector<Bits> outcomes;
    for (const int threads : {1, 2, 3}) {
        set_threads(threads);
        MaterialVectorModel<2> model(particles, law, usual);
        auto y = moved(model, 0.2, 103), other = moved(model, 0.6, 104);
        Bits all = rates_of(model, y);
        model.settle(0.0, other);
        for (const double x : rates_of(model, y)) all.push_back(x);
        all.push_back(model.internal_energy(y));
        all.push_back(model.law.heat());
        outcomes.push_back(std::move(all));
    }
    set_threads(1);
    BOOST_TEST((outcomes[0] == outcomes[1]));
    BOOST_TEST((outcomes[0] == outcomes[2]));
}
}  // namespace

BOOST_AUTO_TEST_CASE(threads_leave_no_trace) {
    check_threads(solid);
    check_threads(FlowingSolid{solid, 0.05, 0.03});
}

BOOST_AUTO_TEST_CASE(states_that_are_not_accepted_leave_no_trace) {
    MaterialVectorModel<2> model(jittered_particles<2>(9, 105), solid, usual);
    const auto y = moved(model, 0.2, 106), other = moved(model, 3.0, 107);
    const auto one = rates_of(model, y);
    rates_of(model, other);
    model.internal_energy(other);
    model.density(other);
    BOOST_TEST((rates_of(model, y) == one));
}

/// Once, in a run that goes on from a checkpoint as well; 0.313 = 0.43 * 1.6/2.2 (safe_tension).
BOOST_AUTO_TEST_CASE(tension_above_what_the_penalty_keeps_stable) {
    const auto stretched = [](MaterialVectorModel<2>& model, double by) {
        std::vector<double> y = initial_state<2>(model, 1.2, 0.43, at_rest<2>());
        State<2>(model.layout(), y).position() *= by;
        return y;
    };
    const auto make = [](double penalty) {
        return std::make_unique<MaterialVectorModel<2>>(
            make_particles<2>(triangular_block(12, 12), 1.0), solid,
            MaterialVectorScheme{1.2, 2.6, penalty});
    };
    const auto model = make(1.0);
    const auto gently = stretched(*model, 1.15), strongly = stretched(*model, 1.18),
               compressed = stretched(*model, 0.9);
    // hydrostatic: (lambda + eta) (f^2 - 1)
    BOOST_TEST(std::abs(model->law.largest_tension(gently) - 0.86 * (1.15 * 1.15 - 1.0)) < 1e-12);
    BOOST_TEST(std::abs(model->law.largest_tension(compressed) - 0.86 * (0.81 - 1.0)) < 1e-12);
    for (int step = 0; step < 100; ++step) {
        BOOST_TEST(model->watch(0.1 * step, gently).empty());
        BOOST_TEST(model->watch(0.1 * step, compressed).empty());
    }
    const auto before = rates_of(*model, strongly);
    std::vector<Remark> all;
    for (int step = 0; step < 100; ++step)
        for (const Remark& remark : model->watch(0.1 * step, strongly)) all.push_back(remark);
    BOOST_REQUIRE(all.size() == 1);
    BOOST_TEST(all[0].what == "tension above the 0.313 that penalty kappa = 1 keeps stable");
    BOOST_TEST(std::abs(all[0].value - 0.86 * (1.18 * 1.18 - 1.0)) < 1e-12);
    BOOST_TEST(!all[0].stop);
    BOOST_TEST((rates_of(*model, strongly) == before));
    BOOST_TEST(model->describe().find("stable up to a tension of 0.313") != std::string::npos);

    Archive written;
    model->remember(written);
    const auto again = make(1.0);
    Archive back(written.bytes());
    again->remember(back);
    for (int step = 0; step < 100; ++step) BOOST_TEST(again->watch(0.0, strongly).empty());
    // a larger penalty bears it
    for (int step = 0; step < 100; ++step) BOOST_TEST(make(2.0)->watch(0.0, strongly).empty());
}

BOOST_AUTO_TEST_CASE(restarts_while_neighbours_change) {
    for (const auto& options :
         {IntegratorOptions{.method = "leapfrog", .dt = 0.2},
          IntegratorOptions{.method = "rk4", .dt = 0.2},
          IntegratorOptions{.method = "arkode:DORMAND_PRINCE_7_4_5", .dt = {}}}) {
        for (const HyperelasticMaterial<2>& law :
             {HyperelasticMaterial<2>(solid), HyperelasticMaterial<2>(FlowingSolid{solid, 0.05})})
            BOOST_TEST_CONTEXT(options.method << ", " << law.describe()) {
                Sheared first(law);
                Motion<2> motion(first.model, first.y0, options);
                motion.advance_to(4.0);
                Archive written;
                motion.remember(written);
                Archive back(written.bytes());
                motion.remember(back);
                const Bits half = bits(motion.y());
                const std::size_t pairs = first.model.pairs(), builds = first.model.list_builds();
                motion.advance_to(8.0);
                BOOST_TEST(builds > 2U);
                BOOST_TEST(first.model.list_builds() > builds);

                for (const bool remembers : {true, false}) {
                    Sheared second(law);
                    BOOST_TEST(second.model.pairs() != pairs);
                    Motion<2> again(second.model, half, options, remembers ? 0.0 : 4.0);
                    if (remembers) {
                        Archive reading(written.bytes());
                        again.remember(reading);
                        reading.expect_end();
                        BOOST_TEST(second.model.pairs() == pairs);
                    }
                    again.advance_to(8.0);
                    BOOST_TEST((bits(again.y()) == bits(motion.y())) == remembers);
                }
            }
    }
}

/// Methods that go on from earlier steps serve where neighbours only come and go without weight; what flows or
/// breaks is refused in a line.
BOOST_AUTO_TEST_CASE(multistep_methods_where_nothing_flows) {
    for (const char* method : {"cvode:adams", "gsl:msadams"}) {
        const IntegratorOptions options{.method = method, .dt = {}, .rtol = 1e-9};
        Sheared sheared;
        BOOST_TEST(sheared.model.settles_seldom());
        Motion<2> motion(sheared.model, sheared.y0, options);
        const double energy = total_energy(sheared.model, motion.y());
        const std::size_t builds = sheared.model.list_builds();
        motion.advance_to(8.0);
        BOOST_TEST(sheared.model.list_builds() > builds + 4);
        BOOST_TEST(std::abs(total_energy(sheared.model, motion.y()) / energy - 1.0) < 1e-6);
        // When particles enter depends on the steps: no two methods agree better than their tables do.
        const auto by_rk4 = [](double dt) {
            Sheared twin;
            Motion<2> fine(twin.model, twin.y0, {.method = "rk4", .dt = dt});
            fine.advance_to(8.0);
            return Points<2>(fine.state().position());
        };
        const Points<2> fine = by_rk4(0.0125);
        const double tables = (by_rk4(0.025) - fine).cwiseAbs().maxCoeff();
        BOOST_TEST((motion.state().position() - fine).cwiseAbs().maxCoeff() < 3.0 * tables);
        BOOST_TEST(tables < 0.02);

        auto brittle = usual;
        brittle.stretch_limit = 1.5;
        MaterialVectorModel<2> breaks(sheared.model.particles(), solid, brittle),
            yields(sheared.model.particles(), FlowingSolid{solid, 0.05}, usual);
        for (MaterialVectorModel<2>* model : {&breaks, &yields}) {
            BOOST_TEST(!model->settles_seldom());
            BOOST_TEST(refusal([&] {
                           Motion<2>(*model, sheared.y0, options);
                       }).starts_with("integrator: "));
        }
    }
}

BOOST_AUTO_TEST_CASE(energy_is_kept_while_neighbours_change) {
    std::vector<double> error;
    for (const double dt : {0.1, 0.05, 0.025}) {
        Sheared sheared;
        Motion<2> motion(sheared.model, sheared.y0, {.method = "rk4", .dt = dt});
        const double energy = total_energy(sheared.model, motion.y());
        const std::size_t builds = sheared.model.list_builds();
        motion.advance_to(10.0);
        BOOST_TEST(sheared.model.list_builds() > builds + 4);
        error.push_back(std::abs(total_energy(sheared.model, motion.y()) / energy - 1.0));
        BOOST_TEST_MESSAGE("dt " << dt << ": dE/E " << error.back() << ", heat "
                                 << sheared.model.law.heat() << ", lists "
                                 << sheared.model.list_builds());
    }
    BOOST_TEST(error[2] < 1e-5);
    BOOST_TEST(error[2] < 0.2 * 0.2 * error[0]);
}

BOOST_AUTO_TEST_CASE(bodies_do_not_see_each_other) {
    const auto one = jittered_particles<2>(6, 108);
    auto other = one;
    other.reference_position.row(0).array() += 6.5;  // nearer than the range
    auto both = joined<2>({one, other});
    for (std::size_t i = 0; i < both.size(); ++i) both.body[i] = i < one.size() ? 0 : 1;
    const auto particles = both;
    MaterialVectorModel<2> apart(particles, solid, usual), alone(one, solid, usual);
    both.body.assign(both.size(), 0);
    MaterialVectorModel<2> glued(both, solid, usual);
    BOOST_TEST(glued.pairs() > apart.pairs());
    auto y = moved(apart, 0.1, 110);
    const auto of_both = rates_of(apart, y);
    std::vector<double> z(alone.layout().size());
    const std::size_t n = one.size(), N = both.size();
    std::copy_n(y.begin(), 2 * n, z.begin());
    std::copy_n(y.begin() + static_cast<std::ptrdiff_t>(2 * N), 2 * n,
                z.begin() + static_cast<std::ptrdiff_t>(2 * n));
    const auto of_one = rates_of(alone, z);
    double worst = 0.0;
    for (std::size_t k = 0; k < 2 * n; ++k)
        worst = std::max(worst, std::abs(of_both[2 * N + k] - of_one[2 * n + k]));
    BOOST_TEST(worst < 1e-12);
}

BOOST_AUTO_TEST_CASE(across_a_border_as_inside) {
    const Box<2> box({8.0, 8.0 * std::sqrt(0.75)});
    auto particles = jittered_particles<2>(8, 111, 0.15, box);
    MaterialVectorModel<2> model(particles, solid, usual, box);
    particles.reference_position.array() += 3.1;
    MaterialVectorModel<2> shifted(particles, solid, usual, box);
    const auto y = moved(model, 0.1, 112);
    auto z = y;
    State<2>(model.layout(), z).position().array() += 3.1;
    BOOST_TEST(relative_difference(rates_of(shifted, z), rates_of(model, y)) < 1e-12);
    BOOST_TEST(std::abs(shifted.internal_energy(z) / model.internal_energy(y) - 1.0) < 1e-12);
    BOOST_TEST((model.promises().angular_momentum == Promise::not_kept));
}

BOOST_AUTO_TEST_CASE(states_without_meaning_are_named) {
    MaterialVectorModel<2> model(jittered_particles<2>(7, 108), solid, usual);
    const auto good = moved(model, 0.1, 109);
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        auto y = good;
        y[5] = bad;
        BOOST_TEST(std::isnan(rates_of(model, y)[0]));
        BOOST_TEST(model.failure().find("the deformation gradient of particle") == 0U,
                   model.failure());
    }
    rates_of(model, good);
    BOOST_TEST(model.failure().empty());
}

BOOST_AUTO_TEST_CASE(any_hyperelastic_law_without_a_memory) {
    BOOST_TEST(refused(usual, StVenantKirchhoff{0.7, 0.4}) == "accepted");
    BOOST_TEST(refused(usual, HenckySolid<PlaneVonMises>({0.43, 0.43}, LinearHardening{1e-3, 0.1}))
                   .starts_with("material: '"));
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    BOOST_TEST(refused(usual) == "accepted");
    BOOST_TEST(refused({0.0, 2.6, 1.0}).starts_with("density: 0"));
    BOOST_TEST(refused({1.2, 0.9, 1.0}).starts_with("range: 0.9"));
    BOOST_TEST(refused({1.2, 2.6, -1.0}).starts_with("penalty: -1"));
    BOOST_TEST(refused({1.2, 2.6, HUGE_VAL}).starts_with("penalty: inf"));
    BOOST_TEST(refused(usual, PolynomialSolid{0.4, 0.0}).starts_with("penalty: 1 is measured"));
    BOOST_TEST(refused(usual, solid, Box<2>({5.0, 0.0})).starts_with("box: periodic length 5"));
}

BOOST_AUTO_TEST_CASE(what_it_says_of_itself) {
    MaterialVectorModel<2> model(jittered_particles<2>(8, 101), solid, usual);
    BOOST_TEST((model.promises().momentum == Promise::exact));
    BOOST_TEST((model.promises().angular_momentum == Promise::integrator_error));
    BOOST_TEST(model.inseparable().empty());
    BOOST_TEST(model.settles());
    for (const char* words : {"material vectors", "range 2.6", "kappa = 1", "density 1.2"})
        BOOST_TEST((model.describe().find(words) != std::string::npos), words);
}
