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
#include "relaxing_atoms.hpp"

namespace {

using namespace spam;

constexpr double longest_range = 1000.0;   // rho0 is a sum over its square sites
constexpr double tension_of_figure = 0.1;  // where both are run
constexpr double usual_core = 1.0;         // which the usual step resolves

struct Parameters : RelaxingAtoms {
    int cells = 20;
    std::optional<double> surface_tension;
    double core = 0.0;
    double disorder = 0.0;
    int seed = 1;
};

Variant<2> make_drop(const Parameters& p, double tension) {
    const auto weight = weight_function<2>(to_string(p.kernel), p.range);
    auto potentials = p.potentials(
        kernels::relative_density<2>(kernels::square(), weight, Point<2>::Zero()), p.core);
    potentials.surface_tension = tension;
    Points<2> x = square_lattice<2>({p.cells, p.cells});
    displace(x, p.disorder, p.seed);
    return p.at_rest_at(
        x, potentials,
        tension > 0.0 ? fmt::format("surface tension {:g}", tension) : "no surface tension");
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

/// Friction takes energy: the largest rise from one row to the next, of the largest energy in all. Where
/// it takes less than a millionth from row to row in the mean, in a short run or at a rate next to none,
/// rises are errors of the steps, and nothing is claimed of them.
void claim_energy_rise(const Findings& findings, const History& h) {
    const auto energy = h.column("energy");
    const double largest = std::max(std::abs(h.largest("energy")), std::abs(h.smallest("energy")));
    const double change = h.largest("energy") - h.smallest("energy");
    findings.claim("energy_rise", largest > 0.0 ? largest_rise(energy) / largest : 0.0, 0.0, 1e-9,
                   "friction can only take energy away",
                   !(change < 1e-6 * largest * static_cast<double>(energy.size())));
}

void report(Session& session, const Parameters& p, const Variant<2>& drop, bool round,
            const RunRecord& run) {
    const Findings findings(session, drop.prefix);
    const History& h = run.history;
    findings.claim("m4", h.last("m4"), round ? 0.0 : 0.35, round ? 0.06 : 0.15,
                   round ? "[HH07] 7: gradients make drops round"
                         : "[HH07] 7: without them the drop does not become round",
                   is_known(session, p, run));
    check_momentum(findings, run, "pairwise forces; friction leaves a momentum of zero at zero");
    claim_energy_rise(findings, h);
    findings.measure("energy_per_particle",
                     h.last("energy") / static_cast<double>(run.statistics.particles));
    findings.measure_last(h, {"closest_pair"});
    findings.check_promises(run);
}

ConfigurationPanel panel_of(const Variant<2>& drop, const std::string& title,
                            std::span<const double> y) {
    return {title,
            centred<2>(ConstState<2>(drop.model->layout(), y).position()),
            drop.model->density(y),
            {}};
}

void draw(Session& session, const std::vector<Variant<2>>& drops,
          const std::vector<RunRecord>& runs) {
    std::vector<ConfigurationPanel> panels{panel_of(drops.front(), "start", drops.back().y0)};
    CurvePanel curves = frame("", "t", "m₄ (square 3/7, disk 0)");
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const std::string& title = drops[k].title;
        panels.push_back(panel_of(
            drops[k], fmt::format("{}, t = {:g}", title, runs[k].statistics.t_end), runs[k].y));
        curves.curves.push_back(over_time(title, runs[k].history, "m4"));
    }
    const auto title =
        fmt::format("A square drop of {} particles", runs.front().statistics.particles);
    draw_configurations(session, "configurations", title, panels, panels.size(), "density");
    draw_curves(session, "m4", title, {curves});
}

void refuse_impossible(const Parameters& p) {
    if (!(p.range > 1.0) || !(p.range <= longest_range))
        refuse(
            "range: {:g} must lie above the particle spacing 1 (else no particle has a "
            "neighbour) and not above {:g}; 2 to 4 spacings are usual",
            p.range, longest_range);
    refuse_short_core(p.core, p.core_range, "leave out --core");
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
    add_core_options(options, p.core, p.core_range, positive(), "0.1");
    add_disorder_options(options, p.disorder, p.seed,
                         "largest random displacement from the square lattice", 0.5, "0.1");
    p.add_options(options);

    return problem.main(argc, argv, [&](Session& session) {
        refuse_impossible(p);
        session.smoke_default("cells", p.cells, 10);
        // Waves of the surface are faster with the root of its tension; up to 1 the usual step serves.
        session.prefer_step(
            0.1 * std::min(1.0, std::sqrt(1.0 / p.surface_tension.value_or(1.0))) *
            step_of_short_range(p.range, Parameters{}.range) *
            relative_step({p.core, p.core_range}, {usual_core, Parameters{}.core_range}));
        auto drops = one_or_both(p.surface_tension, tension_of_figure, "tension",
                                 [&](double tension) { return make_drop(p, tension); });
        const auto runs = relax(session, drops, 400.0, m4_column());
        for (std::size_t k = 0; k < runs.size(); ++k)
            report(session, p, drops[k], p.surface_tension.value_or(double(k)) > 0.0, runs[k]);
        if (session.plots()) draw(session, drops, runs);
    });
}
