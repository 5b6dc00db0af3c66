// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a square drop becomes round with surface tension and stays square without, [HH07] 7 and 8; 5 s
//
// Surface tension from density gradients, [HH07] 7 and 8.
//
//     o o o o o            o o o          A square of an embedded-atom fluid in open space, of density
//     o o o o o    ->    o o o o o        rho0 at its particles, relaxes under friction:
//     o o o o o    ->    o o o o o
//     o o o o o            o o o          Phi = sum_i m e(rho_i) + s_g sum_i |grad rho_i|^2
//
//     e = (B0/(2 rho0)) (rho/rho0 - 1)^2,    m v_dot_i = -d Phi/d r_i - m gamma v_i
//
// Inside the gradients cancel; at the edge they do not, and cost the more the longer the edge is. With
// s_g = 0 the corners have no reason to go. m4 = |<r^4 cos 4 theta>|/<r^4> about the centre of mass is
// 3/7 for the square and zero for a disk (drop/roundness.hpp).
//
// rho0 is what the weight function sums to at a site of the square lattice, not mass per volume. The
// density alone lets particles gather at few places (string_phase.cpp), which no more than blurs the
// drop's outline; --core keeps them apart. --disorder starts from a square that is not perfect: the drop
// then takes longer to be round.
//
// Without --surface-tension both are run, s_g = 0 and 0.1; names in result.json without a prefix then
// belong to s_g = 0, names with tension_ to the other. With --surface-tension S a single case is, whose
// names have no prefix.
#include "drop/roundness.hpp"
#include "kernels/lattices.hpp"
#include "reduced_units.hpp"
#include "stiffness.hpp"
#include <spam/external/friction.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/picture/draw.hpp>
#include <spam/rhs/density_potentials.hpp>
#include <spam/setup/drawn.hpp>
#include <spam/spam.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace spam;

constexpr double longest_range = 1000.0;   // rho0 is a sum over its square sites
constexpr double tension_of_figure = 0.1;  // where both are run
constexpr double usual_core = 1.0;         // which the usual step resolves

struct Parameters {
    int cells = 20;
    std::optional<double> surface_tension;
    double core = 0.0;
    double core_range = 0.7;
    double disorder = 0.0;
    int seed = 1;
    double damping = 0.1;
    Kernel kernel = Kernel::lucy;
    double range = 3.0;
};

struct Drop {
    std::string label, prefix, title;
    double tension;
    std::shared_ptr<ParticleModel<2>> model;
};

/// The same displacements on every computer: the standard fixes the generator's numbers.
Points<2> places(const Parameters& p) {
    std::mt19937_64 random(static_cast<std::uint64_t>(p.seed));
    Points<2> x = square_lattice<2>({p.cells, p.cells});
    for (double& coordinate : x.reshaped()) coordinate += p.disorder * (2.0 * drawn(random) - 1.0);
    return x;
}

Drop make_drop(const Parameters& p, double tension) {
    const auto weight = weight_function<2>(to_string(p.kernel), p.range);
    DensityPotentials potentials;
    potentials.state = EmbeddedAtom{
        1.0, kernels::relative_density<2>(kernels::square(), weight, Point<2>::Zero())};
    potentials.surface_tension = tension;
    if (p.core > 0.0) potentials.core = {p.core, p.core_range};
    potentials.kernel = p.kernel;
    potentials.range = p.range;
    auto particles = make_particles<2>(places(p), 1.0);
    particles.body.assign(particles.size(), 0);  // one drop, also where places are disordered
    auto model = std::make_unique<DensityPotentialModel<2>>(std::move(particles), potentials);
    if (p.damping > 0.0)
        model->add(std::make_unique<Friction<2>>(p.damping, FrictionOf::all_motion));
    return {"", "",
            tension > 0.0 ? fmt::format("surface tension {:g}", tension) : "no surface tension",
            tension, std::move(model)};
}

std::vector<Drop> drops_of(const Parameters& p) {
    std::vector<Drop> all;
    if (p.surface_tension) {
        all.push_back(make_drop(p, *p.surface_tension));
        return all;
    }
    all.push_back(make_drop(p, 0.0));
    all.push_back(make_drop(p, tension_of_figure));
    all[0].label = "no_tension";
    all[1].label = "tension";
    all[1].prefix = "tension_";
    return all;
}

Column<2> m4_column() {
    return {"m4", [](const Model<2>& model, std::span<const double> y) {
                return fourfold_moment(ConstState<2>(model.layout(), y).position(),
                                       model.particles().mass);
            }};
}

// ---- what was found ----

/// The case of the lecture, or one of its two drops.
bool is_known(const Session& session, const Parameters& p, const RunRecord& run) {
    return session.when_default({"cells", "core", "disorder", "damping", "kernel", "range"}) &&
           (!p.surface_tension || *p.surface_tension == 0.0 ||
            *p.surface_tension == tension_of_figure) &&
           run.complete && run.statistics.t_end >= 400.0;
}

/// rms, at any time: what round-off of momenta is relative to where particles are faster than sound, 1.
double largest_speed(const History& h) {
    return std::sqrt(2.0 * h.largest("kinetic") / h.first("mass"));
}

/// Friction takes energy: the largest rise from one row to the next, of the largest energy in all. Where
/// it takes less than a millionth from row to row in the mean, in a short run or at a rate next to none,
/// rises are errors of the steps, and nothing is claimed of them.
void claim_energy_rise(Session& session, const Drop& drop, const History& h) {
    const auto energy = h.column("energy");
    double rise = 0.0, largest = std::abs(energy.front());
    for (std::size_t k = 1; k < energy.size(); ++k) {
        rise = std::max(rise, energy[k] - energy[k - 1]);
        largest = std::max(largest, std::abs(energy[k]));
    }
    const double change = h.largest("energy") - h.smallest("energy");
    session.claim({drop.prefix + "energy_rise", largest > 0.0 ? rise / largest : 0.0, 0.0, 1e-9,
                   "friction can only take energy away"},
                  !(change < 1e-6 * largest * static_cast<double>(energy.size())));
}

void report(Session& session, const Parameters& p, const Drop& drop, const RunRecord& run) {
    const History& h = run.history;
    const bool round = drop.tension > 0.0;
    session.claim({drop.prefix + "m4", h.last("m4"), round ? 0.0 : 0.35, round ? 0.06 : 0.15,
                   round ? "[HH07] 7: gradients make drops round"
                         : "[HH07] 7: without them the drop does not become round"},
                  is_known(session, p, run));
    const auto n = static_cast<double>(run.statistics.particles);
    session.check({drop.prefix + "momentum_per_particle",
                   std::hypot(h.largest_change("momentum_x"), h.largest_change("momentum_y")) / n,
                   0.0, 1e-12 * std::max(1.0, largest_speed(h)),
                   "pairwise forces; friction leaves a momentum of zero at zero"});
    claim_energy_rise(session, drop, h);
    session.measure(drop.prefix + "energy_per_particle", h.last("energy") / n);
    session.measure(drop.prefix + "closest_pair", h.last("closest_pair"));
    session.check_promises(run, drop.prefix);
}

ConfigurationPanel panel_of(const Drop& drop, const std::string& title, std::span<const double> y) {
    const auto& model = *drop.model;
    Points<2> x = ConstState<2>(model.layout(), y).position();
    x.colwise() -= Point<2>(x.rowwise().mean());
    return {title, x, model.density(y), {}};
}

void draw(Session& session, const std::vector<Drop>& drops, const std::vector<double>& start,
          const std::vector<RunRecord>& runs) {
    std::vector<ConfigurationPanel> panels{panel_of(drops.front(), "start", start)};
    CurvePanel curves{"", "t", "m₄ (square 3/7, disk 0)", false, {}};
    for (std::size_t k = 0; k < runs.size(); ++k) {
        panels.push_back(panel_of(
            drops[k], fmt::format("{}, t = {:g}", drops[k].title, runs[k].statistics.t_end),
            runs[k].y));
        curves.curves.push_back(
            {drops[k].title, runs[k].history.column("t"), runs[k].history.column("m4")});
    }
    const auto title =
        fmt::format("A square drop of {} particles", runs.front().statistics.particles);
    session.note_drawn(draw_configurations(session.plots_folder(), "configurations", title, panels,
                                           panels.size(), "density"));
    session.note_drawn(draw_curves(session.plots_folder(), "m4", title, {curves}));
}

void refuse_impossible(const Parameters& p) {
    if (!(p.range > 1.0) || !(p.range <= longest_range))
        throw InputError(
            fmt::format("range: {:g} must lie above the particle spacing 1 (else no particle has a "
                        "neighbour) and not above {:g}; 2 to 4 spacings are usual",
                        p.range, longest_range));
    if (p.core > 0.0 && p.core_range < 0.01)
        throw InputError(fmt::format(
            "core-range: {:g} is below a hundredth of the spacing, 1: no step resolves such "
            "a core; give 0.01 or more, or leave out --core",
            p.core_range));
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("drop", "a square drop of an embedded-atom fluid, [HH07] 7 and 8", 0.1,
                    "0.1, shorter with stiffer cores");
    problem.units(fluid_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("cells", p.cells, "the drop is cells x cells particles", between(2, 1000));
    options.number("surface-tension", p.surface_tension,
                   "strength s_g of the surface tension; 0 for none (default: both 0 and 0.1)",
                   between(0.0, 100.0));
    options.number("core", p.core, "energy of the core that keeps two particles apart; 0 for none",
                   between(0.0, 1e3));
    options.number("core-range", p.core_range, "distance at which cores touch", positive())
        .only_when(
            {"core"}, [&p] { return p.core > 0.0; },
            "has no meaning without a core; give --core 0.1, or leave it out");
    options.number("disorder", p.disorder, "largest random displacement from the square lattice",
                   between(0.0, 0.5));
    options.integer("seed", p.seed, "seed of the random displacements", between(0, 1000000000))
        .only_when(
            {"disorder"}, [&p] { return p.disorder > 0.0; },
            "has no meaning without disorder; give --disorder 0.1, or leave it out");
    options.number("damping", p.damping, "rate of the friction, gamma", between(1e-6, 100.0));
    options.choice<Kernel>("kernel", p.kernel, all_kernels(), "weight function");
    options.number("range", p.range, "distance at which the weight function vanishes", positive());

    return problem.main(argc, argv, [&](Session& session) {
        refuse_impossible(p);
        if (session.common().smoke && !session.given("cells")) p.cells = 10;
        session.prefer_step(
            0.1 * relative_step({p.core, p.core_range}, {usual_core, Parameters{}.core_range}));
        auto drops = drops_of(p);
        std::vector<Case<2>> cases;
        std::vector<double> start;
        for (auto& drop : drops) {
            start = initial_state<2>(*drop.model, 1.0, 1.0, at_rest<2>());
            drop.model->layout().set_scale(Field::velocity, 0.1);
            Plan<2> plan;
            plan.t_end = session.common().smoke ? 20.0 : 400.0;
            plan.record({m4_column(), closest_pair_column<2>()});
            cases.push_back({drop.model, start, std::move(plan), drop.label});
        }
        const auto runs = session.run_all(std::move(cases));
        for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, drops[k], runs[k]);
        if (session.plots()) draw(session, drops, start, runs);
    });
}
