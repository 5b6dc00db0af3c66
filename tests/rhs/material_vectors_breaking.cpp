// SPDX-License-Identifier: GPL-3.0-or-later
// A solid with material vectors whose bonds yield or break: what that takes off the energy is heat, to rounding; p,
// L and energy with heat are kept while pieces fly apart; a broken pair stays so until it has been apart.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include "support/turned_body.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/total_energy.hpp>
#include <spam/material/flowing_solid.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/setup/initial_state.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;
using namespace spam::test;

namespace {

constexpr PolynomialSolid elastic{0.43, 0.43};
constexpr double Y = 0.02, c = 3.0;

MaterialVectorScheme usual() { return {1.2, 2.6, 1.0}; }
MaterialVectorScheme with_bond_yield() {
    auto scheme = usual();
    scheme.bond_yield = c;
    return scheme;
}
MaterialVectorScheme brittle(double stretch, double stress = HUGE_VAL) {
    auto scheme = usual();
    scheme.stretch_limit = stretch;
    scheme.stress_limit = stress;
    return scheme;
}

/// Largest |e|/|F X| of bonds that weigh something.
template <int Dim>
double largest_misfit(const MaterialVectorModel<Dim>& model, std::span<const double> y) {
    const auto F = model.law.deformation_gradients(y);
    const auto x = ConstState<Dim>(model.layout(), y).position();
    double worst = 0.0;
    for (std::size_t k = 0; k < F.size(); ++k)
        for (const auto& bond : model.law.bonds(y, k)) {
            if (!(bond.weight > 0.0)) continue;
            const Vec<Dim> FX = F[k] * bond.X;
            double e2 = 0.0;
            for (int a = 0; a < Dim; ++a)
                e2 += std::pow(x(a, bond.partner) - x(a, static_cast<Eigen::Index>(k)) - FX[a], 2);
            worst = std::max(worst, std::sqrt(e2 / dot(FX, FX)));
        }
    return worst;
}

template <int Dim>
void check_bond_yield() {
    const double limit = c * Y / (2.0 * elastic.eta);
    MaterialVectorModel<Dim> model(jittered_particles<Dim>(Dim == 2 ? 9 : 5, 3),
                                   FlowingSolid{elastic, Y}, with_bond_yield());
    auto y = moved(model, 0.06, 4);  // too little for other neighbours
    BOOST_TEST(largest_misfit<Dim>(model, y) > 1.2 * limit);
    const double energy = model.internal_energy(y);
    BOOST_TEST(model.settle(0.0, y));
    BOOST_TEST(model.law.heat() > 0.05 * energy);
    BOOST_TEST(std::abs(model.internal_energy(y) / energy - 1.0) < 1e-13);
    for (int k = 0; k < 40; ++k) model.settle(0.0, y);  // F is another one each time
    BOOST_TEST(largest_misfit<Dim>(model, y) < 1.001 * limit);
    BOOST_TEST(std::abs(model.internal_energy(y) / energy - 1.0) < 1e-13);

    // A law that never yields has bonds that never do.
    auto rigid = usual();
    rigid.bond_yield = 4.0;
    MaterialVectorModel<Dim> strong(model.particles(), elastic, rigid),
        plain(model.particles(), elastic, usual());
    BOOST_TEST(!strong.settle(0.0, y));
    BOOST_TEST((rates_of(strong, y) == rates_of(plain, y)));
}

/// Relative changes of p (by mass), L and energy with heat until t = 30.
struct Kept {
    double p, L, energy, heat;
    BondBreaks breaks;
};
Kept motion_of(const HyperelasticMaterial<2>& law, const MaterialVectorScheme& scheme, double dt,
               double pull) {
    MaterialVectorModel<2> model(make_particles<2>(triangular_block(16, 8), 1.0), law, scheme);
    const auto y0 = initial_state<2>(model, 1.2, 0.43, [&](const Point<2>& x) {
        return Point<2>(pull * x.x() + 0.02 * x.y(), 0.05 * x.x());
    });
    Motion<2> motion(model, y0, {.method = "rk4", .dt = dt});
    const auto start = measure_invariants(model, motion.y());
    motion.advance_to(30.0);
    const auto end = measure_invariants(model, motion.y());
    return {(end.momentum - start.momentum).norm() / start.mass,
            std::abs(end.angular_momentum[0] / start.angular_momentum[0] - 1.0),
            std::abs(end.energy / start.energy - 1.0), model.law.heat() / start.energy,
            model.law.breaks()};
}

/// Two particles deep in a block are pulled apart and pushed back.
struct Pulled {
    explicit Pulled(const MaterialVectorScheme& scheme)
        : model(make_particles<2>(triangular_block(9, 9), 1.0), elastic, scheme),
          y(initial_state<2>(model, 1.2, 0.43, [](const Point<2>&) { return Point<2>(0, 0); })) {}
    /// All on the right move by this much; then the model settles.
    bool pull(double by) {
        auto x = State<2>(model.layout(), y).position();
        x = model.particles().reference_position;
        for (Eigen::Index k = 0; k < x.cols(); ++k)
            if (x(0, k) > 0.0) x(0, k) += by;
        return model.settle(0.0, y);
    }
    /// Bonds with weight between left and right, both directions counted.
    std::size_t across() const {
        std::size_t count = 0;
        const auto& X = model.particles().reference_position;
        for (std::size_t k = 0; k < model.particles().size(); ++k)
            for (const auto& bond : model.law.bonds(y, k))
                count += bond.weight > 0.0 &&
                         (X(0, static_cast<Eigen::Index>(k)) > 0.0) != (X(0, bond.partner) > 0.0);
        return count;
    }
    MaterialVectorModel<2> model;
    std::vector<double> y;
};

}  // namespace

BOOST_AUTO_TEST_CASE(bonds_yield_in_the_plane) { check_bond_yield<2>(); }
BOOST_AUTO_TEST_CASE(bonds_yield_in_space) { check_bond_yield<3>(); }

BOOST_AUTO_TEST_CASE(a_block_whose_bonds_yield) {
    auto scheme = usual();
    scheme.bond_yield = 2.0;
    for (const double dt : {0.1, 0.05}) {
        const Kept kept = motion_of(FlowingSolid{elastic, Y}, scheme, dt, 0.0),
                   without = motion_of(FlowingSolid{elastic, Y}, usual(), dt, 0.0);
        BOOST_TEST_MESSAGE("dt " << dt << ": heat " << kept.heat << ", dE/E " << kept.energy
                                 << ", dL/L " << kept.L << "; without bond yield: heat "
                                 << without.heat << ", dE/E " << without.energy);
        BOOST_TEST(kept.p < 1e-14);
        BOOST_TEST(kept.L < 1e-8);
        BOOST_TEST(kept.energy < 1e-4);
        BOOST_TEST(kept.heat != without.heat);
    }
}

BOOST_AUTO_TEST_CASE(a_pair_breaks_for_good_until_it_has_been_apart) {
    Pulled pulled(brittle(1.3));
    const std::size_t whole = pulled.across();
    BOOST_TEST(!pulled.pull(0.1));
    BOOST_TEST(pulled.across() == whole);
    const auto energy_at = [&](double by) {
        Pulled other(usual());
        other.pull(0.0);
        auto x = State<2>(other.model.layout(), other.y).position();
        for (Eigen::Index k = 0; k < x.cols(); ++k)
            if (x(0, k) > 0.0) x(0, k) += by;
        return other.model.internal_energy(other.y);
    };
    const double before = energy_at(0.6);
    BOOST_TEST(pulled.pull(0.6));
    const BondBreaks breaks = pulled.model.law.breaks();
    BOOST_TEST(breaks.pairs > 10U);
    BOOST_TEST(std::abs(pulled.model.internal_energy(pulled.y) / before - 1.0) < 1e-13);
    BOOST_TEST(pulled.model.law.heat() > 0.1 * before);
    const std::size_t left = pulled.across();
    BOOST_TEST(left < whole - breaks.pairs);  // both directions
    // Back again: new rows, no new bonds.
    pulled.pull(0.0);
    const std::size_t mended = pulled.across();
    BOOST_TEST(mended <= left);
    pulled.pull(0.2);
    pulled.pull(0.0);
    BOOST_TEST(pulled.across() <= mended);
    // Apart, and back: particles that meet are bound.
    pulled.pull(6.0);
    BOOST_TEST(pulled.across() == 0U);
    pulled.pull(0.0);
    BOOST_TEST(pulled.across() == whole);
}

BOOST_AUTO_TEST_CASE(by_stress) {
    Pulled pulled(brittle(HUGE_VAL, 0.05));
    BOOST_TEST(!pulled.pull(0.02));
    BOOST_TEST(pulled.pull(0.4));
    BOOST_TEST(pulled.model.law.breaks().pairs > 10U);
    Pulled pressed(brittle(HUGE_VAL, 0.05));
    BOOST_TEST(!pressed.pull(-0.1));
}

BOOST_AUTO_TEST_CASE(a_bar_that_breaks_keeps_p_L_and_energy) {
    for (const auto& scheme : {brittle(1.1), brittle(HUGE_VAL, 0.04)})
        for (const double dt : {0.05, 0.025}) {
            const Kept kept = motion_of(elastic, scheme, dt, 0.02);
            BOOST_TEST_MESSAGE("dt " << dt << ": " << kept.breaks.pairs << " pairs, heat "
                                     << kept.heat << ", " << kept.breaks.gains
                                     << " gains of in sum " << kept.breaks.gained << ", dp "
                                     << kept.p << ", dL/L " << kept.L << ", dE/E " << kept.energy);
            BOOST_TEST(kept.breaks.pairs > 20U);
            // Particles that are hardly whole may gain: less than a thousandth.
            BOOST_TEST(kept.breaks.gains < 5U);
            BOOST_TEST(kept.breaks.gained < 1e-3 * kept.heat);
            BOOST_TEST(kept.heat > 0.01);
            BOOST_TEST(kept.p < 1e-14);
            BOOST_TEST(kept.L < 1e-9);
            BOOST_TEST(kept.energy < 1e-5);
        }
}

BOOST_AUTO_TEST_CASE(it_says_how_many_have_broken) {
    Pulled pulled(brittle(1.3));
    BOOST_TEST(pulled.model.watch(0.0, pulled.y).empty());
    pulled.pull(0.6);
    const auto remarks = pulled.model.watch(1.0, pulled.y);
    BOOST_REQUIRE(!remarks.empty());
    BOOST_TEST(remarks[0].what == "pairs of particles whose bond has broken");
    BOOST_TEST(remarks[0].value == static_cast<double>(pulled.model.law.breaks().pairs));
    BOOST_TEST(!remarks[0].stop);
    BOOST_TEST((remarks.size() == 2) == (pulled.model.law.breaks().gains > 0));
    BOOST_TEST(pulled.model.watch(2.0, pulled.y).empty());
}

BOOST_AUTO_TEST_CASE(restarts_with_broken_pairs) {
    for (const auto& scheme : {brittle(1.1), with_bond_yield()}) {
        const HyperelasticMaterial<2> law = FlowingSolid{elastic, 0.05};
        const auto start = [&](MaterialVectorModel<2>& model) {
            return initial_state<2>(model, 1.2, 0.43, [&](const Point<2>& x) {
                return Point<2>(0.04 * x.x() + 0.02 * x.y(), 0.05 * x.x());
            });
        };
        const IntegratorOptions options{.method = "rk4", .dt = 0.1};
        const auto particles = make_particles<2>(triangular_block(16, 8), 1.0);
        MaterialVectorModel<2> first(particles, law, scheme), second(particles, law, scheme);
        Motion<2> motion(first, start(first), options);
        motion.advance_to(10.0);
        BOOST_TEST((first.law.breaks().pairs > 0U) == (scheme.stretch_limit < HUGE_VAL));
        Archive written;
        motion.remember(written);
        Archive back(written.bytes());
        motion.remember(back);
        const std::vector<double> half(motion.y().begin(), motion.y().end());
        motion.advance_to(20.0);
        Motion<2> again(second, half, options, 0.0);
        Archive reading(written.bytes());
        again.remember(reading);
        reading.expect_end();
        again.advance_to(20.0);
        BOOST_TEST((std::vector<double>(motion.y().begin(), motion.y().end()) ==
                    std::vector<double>(again.y().begin(), again.y().end())));
        BOOST_TEST(first.law.heat() == second.law.heat());
        BOOST_TEST(first.law.breaks().pairs == second.law.breaks().pairs);
    }
}

BOOST_AUTO_TEST_CASE(threads_break_the_same_bonds) {
    auto scheme = brittle(1.05);
    scheme.bond_yield = 1.0;
    const auto particles = jittered_particles<2>(40, 102);
    BOOST_TEST(particles.size() > parallel_threshold);
    std::vector<std::vector<double>> outcomes;
    for (const int threads : {1, 2, 3}) {
        set_threads(threads);
        MaterialVectorModel<2> model(particles, FlowingSolid{elastic, Y}, scheme);
        auto y = moved(model, 0.1, 103);
        model.settle(0.0, y);
        auto all = rates_of(model, y);
        all.push_back(model.internal_energy(y));
        all.push_back(model.law.heat());
        all.push_back(static_cast<double>(model.law.breaks().pairs));
        all.push_back(model.law.breaks().gained);
        outcomes.push_back(std::move(all));
    }
    set_threads(1);
    BOOST_TEST((outcomes[0] == outcomes[1]));
    BOOST_TEST((outcomes[0] == outcomes[2]));
}

BOOST_AUTO_TEST_CASE(limits_that_make_no_sense) {
    const auto refused = [](const MaterialVectorScheme& scheme) {
        return refusal(
            [&] { MaterialVectorModel<2>(jittered_particles<2>(8, 101), elastic, scheme); });
    };
    BOOST_TEST(refused(brittle(1.5, 0.1)) == "accepted");
    BOOST_TEST(refused(brittle(1.0)).starts_with("stretch_limit: 1 must be above 1"));
    BOOST_TEST(refused(brittle(1.5, 0.0)).starts_with("stress_limit: 0"));
    auto scheme = usual();
    scheme.bond_yield = -1.0;
    BOOST_TEST(refused(scheme).starts_with("bond_yield: -1"));
}
