// SPDX-License-Identifier: GPL-3.0-or-later
// Particles split and merged on the way of a run: what criteria do, and what is refused.
#include "problem/rezoned_gas.hpp"
#include "support/refusal.hpp"
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/material/harmonic_spring.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/problem/remake.hpp>
#include <spam/problem/repopulation.hpp>
#include <spam/problem/run_in_memory.hpp>
#include <spam/rhs/density_potentials.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace spam;
using spam::test::gas_of;
using spam::test::refusal;
using spam::test::summed;

namespace {

/// A square of gas in motion, with a Rezoning.
template <int Dim>
Case<Dim> expanding(double rate, const Rezoning<Dim>& how) {
    std::array<int, Dim> cells;
    cells.fill(Dim == 3 ? 6 : 12);
    auto particles = make_particles<Dim>(centred<Dim>(square_lattice<Dim>(cells)), 1.0);
    const Points<Dim> x = particles.reference_position;
    auto model =
        std::make_shared<FluidModel<Dim>>(std::move(particles), Fluid{GammaGas{2.0}}, summed);
    Case<Dim> one{model, model->state(x, rate * x, 0.05), {}};
    one.plan.t_end = 2.0;
    one.plan.output_every = one.plan.snapshot_every = 0.25;
    one.plan.rezone(how);
    one.plan.rezoning->every = 0.5;
    one.plan.rezoning->make = gas_of<Dim>;
    return one;
}

template <int Dim>
RunRecord ran(double rate, const Rezoning<Dim>& how, const char* method = "rk4") {
    auto record = run_in_memory(expanding<Dim>(rate, how), {.method = method, .dt = 0.05});
    BOOST_TEST(record.complete, record.statistics.stopped);
    for (const Drift& drift : record.drifts)
        BOOST_TEST(drift.change < (drift.name == "energy" ? 1e-6 : 1e-12), drift.name);
    return record;
}

}  // namespace

/// Each criterion alone, splits in two and in 2^Dim, and nothing twice: what was split is not merged at once.
BOOST_AUTO_TEST_CASE(criteria_split_and_merge) {
    const double inf = std::numeric_limits<double>::infinity();
    const auto last = [](const RunRecord& record, const char* name) {
        return record.history.last(name);
    };
    const auto four = ran<2>(0.4, {.volume = RezoningLimits{1.5, 0.3}});
    BOOST_TEST(last(four, "splits") >= 100.0);
    BOOST_TEST(last(four, "merges") == 0.0);
    BOOST_TEST(last(four, "particles") == 144.0 + 3.0 * last(four, "splits"));
    const auto two = ran<2>(0.4, {.volume = RezoningLimits{1.5, 0.3}, .in_two = true});
    BOOST_TEST(last(two, "particles") == 144.0 + last(two, "splits"));
    const auto few = ran<2>(0.4, {.neighbours = RezoningLimits{16.0, 70.0}});
    BOOST_TEST(last(few, "splits") > 20.0);
    // Merged particles are no mirror images of each other: RK4 keeps their angular momentum by its order alone.
    const auto many =
        ran<2>(-0.3, {.neighbours = RezoningLimits{0.0, 36.0}}, "arkode:FEHLBERG_13_7_8");
    BOOST_TEST(last(many, "merges") > 10.0);
    BOOST_TEST(last(many, "particles") < 120.0);
    BOOST_TEST(last(many, "rezoning_heat") > 0.0);
    const auto steep = ran<2>(0.1, {.gradient = RezoningLimits{0.6, 0.01}});
    BOOST_TEST(last(steep, "splits") > 10.0);
    BOOST_TEST(last(ran<2>(0.1, {.gradient = RezoningLimits{inf, 0.01}}), "splits") == 0.0);
    BOOST_TEST(last(ran<3>(0.3, {.volume = RezoningLimits{1.5, 0.1}}), "splits") > 50.0);
}

/// Densities and ranges that belong to each other, of children too.
BOOST_AUTO_TEST_CASE(ranges_by_density_are_found_anew) {
    const auto make = [](Particles<2> particles) {
        return std::make_shared<VariableRangeModel<2>>(std::move(particles), Fluid{GammaGas{2.0}},
                                                       VariableRangeScheme{3.0, Kernel::w4});
    };
    const auto first =
        make(make_particles<2>(centred<2>(square_lattice<2>(std::array{10, 10})), 1.0));
    const Points<2> x = first->particles().reference_position;
    const auto y = first->state(x, 0.1 * x, 0.5);
    Repopulation<2> change(first->particles());
    Points<2> corners(2, 2);
    corners << 0.25, -0.25, 0.25, -0.25;
    for (const std::size_t i : {44u, 45u, 54u}) change.split(i, corners);
    const auto population = change.finish();
    const auto next = make(population.particles);
    const auto remade = remake<2>(*first, y, population, *next);
    const ConstState<2> to(next->layout(), remade.y);
    const auto rho = next->solve_densities(to.position());
    double worst = 0.0, jump = 0.0;
    for (std::size_t k = 0; k < rho.size(); ++k) {
        const auto c = static_cast<Eigen::Index>(k);
        worst = std::max(worst, std::abs(to.density()(0, c) / rho[k] - 1.0));
        const auto old = static_cast<Eigen::Index>(population.parts[k].front().particle);
        jump = std::max(jump,
                        std::abs(ConstState<2>(first->layout(), y).density()(0, old) / rho[k] - 1));
    }
    BOOST_TEST(worst == 0.0);
    BOOST_TEST(jump > 0.01);  // what children would have of their parents is none of theirs
    BOOST_TEST(std::abs(remade.after.energy / remade.before.energy - 1.0) < 1e-14);
}

/// Potentials: paid where particles have an energy, else refused; cold laws have nothing to pay with.
BOOST_AUTO_TEST_CASE(what_nothing_can_pay_for_is_refused) {
    const DensityPotentials surface{.surface_tension = 0.2, .range = 3.0};
    const auto lattice = make_particles<2>(centred<2>(square_lattice<2>(std::array{8, 8})), 1.0);
    Points<2> corners(2, 2);
    corners << 0.25, -0.25, 0.25, -0.25;
    Repopulation<2> change(lattice);
    change.split(27, corners);
    const auto population = change.finish();
    const auto alone = [&](Particles<2> p) {
        auto model = std::make_shared<ParticleModel<2>>(std::move(p));
        model->add_term<DensityPotentialTerm<2>>(surface);
        return model;
    };
    const auto with_gas = [&](Particles<2> p) {
        auto model = std::make_shared<ParticleModel<2>>(std::move(p));
        model->add_term<SmoothParticles<2>>(Fluid{GammaGas{2.0}}, summed);
        model->add_term<DensityPotentialTerm<2>>(surface);
        return model;
    };
    const auto cold = [&](Particles<2> p) {
        return std::make_shared<FluidModel<2>>(std::move(p), Fluid{EmbeddedAtom{}}, summed);
    };
    const auto remade = [&](const auto& make, double e) {
        const auto first = make(lattice), second = make(population.particles);
        std::vector<double> y(first->layout().size(), 0.0);
        const State<2> state(first->layout(), y);
        state.position() = lattice.reference_position;
        if (state.has(Field::energy)) state.energy().setConstant(e);
        return remake<2>(*first, y, population, *second);
    };
    BOOST_TEST(refusal([&] { remade(alone, 0.0); }).find("no energy of their own to pay for it") !=
               std::string::npos);
    const auto paid = remade(with_gas, 5.0);
    BOOST_TEST(std::abs(paid.after.energy / paid.before.energy - 1.0) < 1e-14);
    const auto cold_with_ranges = [&](Particles<2> p) {
        return std::make_shared<VariableRangeModel<2>>(std::move(p), Fluid{EmbeddedAtom{}},
                                                       VariableRangeScheme{3.0, Kernel::w4});
    };
    BOOST_TEST(refusal([&] { remade(cold, 0.0); }).find("and nothing can pay") !=
               std::string::npos);
    BOOST_TEST(refusal([&] { remade(cold_with_ranges, 0.0); }).find("and nothing can pay") !=
               std::string::npos);
    BOOST_TEST(!cold_with_ranges(lattice)->law.nature().no_rezoning.empty());
}

/// Neither children nor twins, through many generations.
BOOST_AUTO_TEST_CASE(nothing_is_made_behind_a_wall) {
    Box<2> box;
    box.set_wall(0, false, {WallKind::mirror, 0.0});
    const auto make = [&](Particles<2> particles) {
        return std::make_shared<FluidModel<2>>(std::move(particles), Fluid{GammaGas{2.0}}, summed,
                                               box);
    };
    for (const bool expands : {true, false}) {
        const auto model = make(make_particles<2>(cell_centres<2>({8, 8}), 1.0));
        const Points<2> x = model->particles().reference_position;
        Case<2> one{model, model->state(x, (expands ? 0.5 : -0.3) * x, 0.05), {}};
        one.plan.t_end = expands ? 6.0 : 2.0;
        one.plan.output_every = one.plan.snapshot_every = 0.5;
        one.plan.rezone({.volume = expands ? RezoningLimits{1.2, 0.2} : RezoningLimits{9.0, 1.2}});
        one.plan.rezoning->every = 0.5;
        one.plan.rezoning->make = make;
        const auto record = run_in_memory(one, {.method = "rk4", .dt = 0.05});
        BOOST_TEST(record.complete, record.statistics.stopped);
        BOOST_TEST(record.history.last(expands ? "splits" : "merges") > 3.0);
        const auto n = static_cast<Eigen::Index>(record.statistics.particles);
        BOOST_TEST(Eigen::Map<const Points<2>>(record.y.data(), 2, n).row(0).minCoeff() > 0.0);
    }
}

BOOST_AUTO_TEST_CASE(models_that_cannot_be_rezoned_say_so) {
    const auto lattice = make_particles<2>(triangular_hexagon(4), 1.0);
    const auto why = [&](const auto& model,
                         Rezoning<2> how = {.volume = RezoningLimits{2.0, 0.5}}) {
        how.every = 1.0;
        how.make = gas_of<2>;
        return refusal([&] { how.check(model); });
    };
    const auto gas = gas_of<2>(lattice);
    BOOST_TEST(why(*gas) == "accepted");
    BOOST_TEST(why(SmoothParticleModel<2>(lattice, ElasticSolid::triangular_lattice(), Scheme{})) ==
               "accepted");
    const auto says = [](const std::string& line, const char* words) {
        BOOST_TEST(line.starts_with("rezoning: "), line);
        BOOST_TEST(line.find(words) != std::string::npos, line);
    };
    says(why(BondedModel<2>(lattice, HarmonicSpring{})), "use smooth particles");
    says(why(MaterialVectorModel<2>(lattice, PolynomialSolid{0.43, 0.43}, {1.2, 2.4, 1.0})),
         "use an updated solid");
    says(why(FluidModel<2>(lattice, Fluid{EmbeddedAtom{}}, summed)), "use a law with an energy");
    says(why(*gas, {.volume = RezoningLimits{2.0, 0.6}}), "merged again");
    says(why(*gas, {.neighbours = RezoningLimits{12.0, 30.0}}), "merged again");
    says(why(*gas, {.volume = RezoningLimits{-1.0, -1.0}}), "give limits");
    says(why(*gas, {}), "give a criterion");
}
