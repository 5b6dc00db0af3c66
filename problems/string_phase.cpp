// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a relaxing embedded-atom fluid forms strings unless particles have cores, [HH07] 8; 5 s
//
// The string phase and its cure, [HH07] 8.
//
//      . : .   .'       .  .  .  .       Particles at random places of a periodic box move down the
//     :     ':'           .  .  .  .     slope of an energy of the density alone,
//      ':. .'  '.  or   .  .  .  .
//         '     :'        .  .  .  .         Phi = sum_i m e(rho_i),  e = (rho/rho0 - 1)^2/(2 rho0)
//
//     m v_dot_i = -d Phi/d r_i - m gamma v_i
//
// until friction has brought them to rest. Nothing in Phi tells two particles at one place from two that
// lie apart as long as the density at the particles is rho0: they gather in strings and clumps. A core,
//
//     Phi += sum_pairs e_c (1 - r^2/s^2)^4,   r < s,
//
// keeps them apart. clumped_fraction: the part of the particles with another one nearer than 0.4.
//
// With the s = 0.7 of the standard case no particle is clumped, but particles still line up in chains around
// holes: all along them the density is rho0, and cores shorter than the spacing have nothing against it.
// Wider ones, --core 0.1 --core-range 1.2, leave an even fluid with one hole (320 particles of density 1
// do not fill the box).
//
// Without --core both are run; names in result.json without a prefix then belong to the one without a
// core, names with core_ to the other. With --core E a single case is, whose names have no prefix.
#include "relaxing_atoms.hpp"
#include <spam/kernel/lucy.hpp>
#include <spam/kernel/weight_integrals.hpp>
#include <spam/neighbors/pair_list.hpp>

namespace {

using namespace spam;

constexpr double near = 0.4;         // clumped: another particle nearer than this
constexpr double core_energy = 0.1;  // where both are run
constexpr double most_pairs = 2e9;   // what a sum over pairs can take
constexpr double widest = 1000.0;    // side of the box, in ranges

struct Parameters : RelaxingAtoms {
    Parameters() { range = 3.5; }

    int particles = 320;
    double side = 20.0;
    std::optional<double> core;
    double rho0 = 1.0;
    int seed = 1;
};

/// The same places for every computer: the standard fixes the generator's numbers.
Points<2> random_places(const Parameters& p) {
    std::mt19937_64 random(static_cast<std::uint64_t>(p.seed));
    Points<2> x(2, p.particles);
    for (double& coordinate : x.reshaped()) coordinate = p.side * drawn(random);
    return x;
}

Variant<2> make_sample(const Parameters& p, double e_c) {
    return p.at_rest_at(
        random_places(p), p.potentials(p.rho0, e_c),
        e_c > 0.0 ? fmt::format("core {:g} of range {:g}", e_c, p.core_range) : "no core",
        Box<2>({p.side, p.side}));
}

Column<2> clumped_fraction_column() {
    return {"clumped_fraction", [](const Model<2>& model, std::span<const double> y) {
                return clumped_fraction<2>(ConstState<2>(model.layout(), y).position(), near,
                                           model.box());
            }};
}

// ---- what was found ----

/// The case of the lecture, from any random start.
bool is_known(const Session& session, const Parameters& p, const RunRecord& run) {
    return session.when_default(
               {"particles", "side", "core-range", "damping", "rho0", "kernel", "range"}) &&
           (!p.core || *p.core == 0.0 || *p.core == core_energy) && run.complete &&
           run.statistics.t_end >= 500.0;
}

/// Friction takes energy, all that there is: by how much a row lies above the one before, at most. Where
/// it takes less than a millionth of the motion's from row to row in the mean, in a short run or at a
/// rate next to none, rises are errors of the steps, and nothing is claimed of them.
void claim_energy_rise(const Findings& findings, const History& h, double n) {
    const auto energy = h.column("energy");
    const double change = h.largest("energy") - h.smallest("energy");
    findings.claim("energy_rise_per_particle", largest_rise(energy) / n, 0.0, 1e-9,
                   "friction takes energy and never gives it back",
                   !(change < 1e-6 * h.largest("kinetic") * static_cast<double>(energy.size())));
}

void report(Session& session, const Parameters& p, const Variant<2>& sample, bool core,
            const RunRecord& run) {
    const Findings findings(session, sample.prefix);
    const History& h = run.history;
    findings.claim("clumped_fraction", h.last("clumped_fraction"), core ? 0.0 : 0.775,
                   core ? 0.0 : 0.225,
                   core ? "[HH07] 8: a core cures the strings"
                        : "[HH07] 8: a string phase, more than 55 % are in it",
                   is_known(session, p, run));
    check_momentum(findings, run, "pairwise forces, and a friction that stops what does not move");
    const auto n = static_cast<double>(run.statistics.particles);
    claim_energy_rise(findings, h, n);
    findings.measure("energy_per_particle", h.last("energy") / n);
    // Of a few particles in a wide box, none is nearer than half of it.
    if (std::isfinite(h.last("closest_pair"))) findings.measure_last(h, {"closest_pair"});
    findings.check_promises(run);
}

/// Of every particle, to the nearest other one; the range where there is none.
std::vector<double> nearest_distances(const Points<2>& x, double range, const Box<2>& box) {
    const PairList<2> list(x, range, box);
    std::vector<double> nearest(list.size(), range);
    for (std::size_t i = 0; i < nearest.size(); ++i)
        for (const std::uint32_t j : list.neighbours(i)) {
            if (j == i) continue;
            Point<2> r = x.col(static_cast<Eigen::Index>(i)) - x.col(j);
            for (int a = 0; a < 2; ++a) r[a] -= box.length(a) * std::round(r[a] / box.length(a));
            nearest[i] = std::min(nearest[i], r.norm());
        }
    return nearest;
}

void draw(Session& session, const Parameters& p, const std::vector<Variant<2>>& samples,
          const std::vector<RunRecord>& runs) {
    const Points<2> border = rectangle({0.0, 0.0}, {p.side, p.side});
    std::vector<ConfigurationPanel> panels;
    CurvePanel curves = frame("", "t", fmt::format("part of the particles nearer than {:g}", near));
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const auto& box = samples[k].model->box();
        const Points<2> x = ConstState<2>(samples[k].model->layout(), runs[k].y).position();
        panels.push_back(
            {samples[k].title, box.wrapped(x), nearest_distances(x, p.range, box), {border}});
        curves.curves.push_back(over_time(samples[k].title, runs[k].history, "clumped_fraction"));
    }
    const auto title =
        fmt::format("Embedded-atom fluid at t = {:g}", runs.front().statistics.t_end);
    draw_configurations(session, "configurations", title, panels, panels.size(),
                        "nearest neighbour");
    draw_curves(session, "clumped_fraction", title, {curves});
}

void refuse_impossible(const Parameters& p) {
    const double spacing =
        std::min(p.side / std::sqrt(static_cast<double>(p.particles)), 1.0 / std::sqrt(p.rho0));
    if (p.core != 0.0 && p.core_range < 0.01 * spacing)
        refuse(
            "core-range: {:g} is below a hundredth of the spacing {:.3g}: no step "
            "resolves such a core; give {:.3g} or more, or --core 0",
            p.core_range, spacing, std::ceil(10.0 * spacing) * 0.001);
    if (!(p.side > 2.0 * p.range))
        refuse(
            "side: {:g} is too short for --range {:g}: no pair may interact twice "
            "through the periodic border; give more than {:g}, or a shorter --range",
            p.side, p.range, 2.0 * p.range);
    const double neighbours = p.particles * std::numbers::pi * std::pow(p.range / p.side, 2.0);
    if (0.5 * p.particles * neighbours > most_pairs)
        refuse(
            "side: {} particles in a box of side {:g} have some {:.0e} neighbours "
            "each, too many to "
            "sum over; give a longer --side, fewer --particles or a shorter --range",
            p.particles, p.side, neighbours);
    if (!(p.side <= widest * p.range))
        refuse(
            "side: {:g} is so long that particles of range {:g} never meet; give {:g} or "
            "less, or a longer --range",
            p.side, p.range, widest * p.range);
}

/// 0.1 resolves the waves and cores of the standard case; steeper ones are faster.
double step_of(const Parameters& p) {
    const Parameters standard;
    const double waves =
        relative_step<2>(weight_function<2>(to_string(p.kernel), p.range), Lucy<2>(standard.range));
    const double core = p.core.value_or(core_energy);
    const double cores =
        core > 0.0 ? p.core_range / standard.core_range * std::sqrt(core_energy / core) : 1.0;
    // Sound at the density of the particles: c^2 = e''(rho) rho^2 = 1/rho0^3.
    return 0.1 * std::min({1.0, waves, cores, std::pow(p.rho0, 1.5)}) *
           step_of_short_range(p.range, standard.range);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("string_phase",
                    "strings of an embedded-atom fluid and their cure by cores, [HH07] 8", 0.1,
                    "0.1, shorter with steeper weights or cores");
    problem.units(fluid_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("particles", p.particles, "number of particles, at random places in the box",
                    between(2, 1000000));
    options.number("side", p.side, "side of the periodic box", between(1e-3, 1e9));
    options.integer("seed", p.seed, "seed of the random places", between(0, 1000000000));
    options.number("rho0", p.rho0, "density at which the fluid has no pressure", between(0.1, 1e3));
    options.number(
        "core", p.core,
        "energy of the core that keeps two particles apart; 0 for none (default: both 0 and 0.1)",
        between(0.0, 1e3));
    options.number("core-range", p.core_range, "distance at which cores touch", positive())
        .only_when(
            {"core"}, [&p] { return p.core != 0.0; }, "has no meaning for --core 0; leave it out");
    p.add_options(options);

    return problem.main(argc, argv, [&](Session& session) {
        refuse_impossible(p);
        session.prefer_step(step_of(p));
        auto samples = one_or_both(p.core, core_energy, "core",
                                   [&](double e_c) { return make_sample(p, e_c); });
        const auto runs = relax(session, samples, 500.0, clumped_fraction_column());
        for (std::size_t k = 0; k < runs.size(); ++k)
            report(session, p, samples[k], p.core.value_or(double(k)) > 0.0, runs[k]);
        if (session.plots()) draw(session, p, samples, runs);
    });
}
