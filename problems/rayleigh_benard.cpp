// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: convection rolls between a hot and a cold plate, beside finite differences, [HH07] 12; 10 s
//
// Rayleigh-Benard convection, [HH07] 12: a gas between two plates, hot below and cold above.
//
//     ===================  T = 0.5     Ideal gas of two dimensions, P = rho T, e = T; viscosity eta = kappa,
//      o  o  o  o  o  o  o             the conductivity, without bulk. Gravity g = 1/L makes the density of the
//      o  o  o  o  o  o  o  | g        conducting layer the same everywhere: 1. Above a critical Rayleigh
//      o  o  o  o  o  o  o  v          number
//     ===================  T = 1.5         Ra = g L^4 (dlnT/dy)/(nu D_T) = L^2/(eta kappa)
//          2 L, periodic               the layer at rest is not stable: two rolls turn against each other and
//                                      carry more heat than conduction, by the Nusselt number.
//
// Plates are no-slip walls of given temperature: images of the particles behind them. They may be mirrors, at
// which the gas slips, and the sides may be walls too. Heat through each of
// them is integrated with y (heat_bottom, heat_top in invariants.csv): its mean over the second half of the
// run, which takes 80 L (less where the lower plate is hotter, and sound quicker), is what result.json
// tells. Beside the particles the same equations with the same coefficients are
// solved by finite differences on a fixed grid of L cells from plate to plate (rayleigh_benard/grid.hpp).
//
//     --height 50        5,000 particles, as in the lecture
//     --bottom mirror@1.5 --top mirror@0.5
//                        plates without friction
//     --left mirror --right mirror
//                        a box with insulated sides instead of a layer without end
//     --scan             from Ra = 1500 to 4000: which rolls stay, and the Ra of the onset. Linear theory says
//                        1707.76, of a layer whose temperature and density vary little; here they vary by a
//                        factor of three. The particles' onset is later: at rest they are in order, and resist
//                        weak rolls as a solid does. 2 min
#include "rayleigh_benard/convection.hpp"
#include "wall_step.hpp"

namespace {

using namespace rayleigh_benard;

constexpr double weak_roll = 1e-3;

/// Sound goes as the root of the temperature: steps and runs of a hotter layer are shorter by so much.
double quicker(const Layer& layer) { return std::min(1.0, std::sqrt(Layer{}.hot / layer.hot)); }

Plan<2> plan_of(const Session& session, const Convection& gas) {
    Plan<2> plan;
    plan.t_end = session.end(80.0 * gas.layer.L * quicker(gas.layer), 6.0 * quicker(gas.layer));
    plan.output_every = plan.t_end / 160.0;
    plan.record({roll_amplitude_column(gas.layer)});
    return plan;
}

void report(Session& session, const Parameters& p, const Convection& gas, const RunRecord& run,
            const GridRun& twin) {
    const Findings findings(session);
    const auto t = run.history.column("t");
    const std::size_t from = middle(t), to = t.size() - 1;
    const double bottom = nusselt(gas.layer, t, run.history.column("heat_bottom"), from, to, false);
    const double top = nusselt(gas.layer, t, run.history.column("heat_top"), from, to, true);
    const double grid_bottom = nusselt(gas.layer, twin.t, twin.heat_bottom, from, to, false);
    const double grid_top = nusselt(gas.layer, twin.t, twin.heat_top, from, to, true);
    const double mean = 0.5 * (bottom + top), of_grid = 0.5 * (grid_bottom + grid_top);
    const bool long_enough =
        run.complete && run.statistics.t_end >= 79.0 * gas.layer.L * quicker(gas.layer);
    const bool known = session.when_default({"height", "rayleigh", "roll", "friction", "density",
                                             "work", "kernel", "range"}) &&
                       session.when_default(p.sides->names()) && long_enough;
    const bool still = gas.layer.rayleigh <= 1000.0;
    findings.claim("nusselt_bottom", bottom, 1.8, 0.15, "an independent computation", known);
    findings.claim("nusselt_top", top, 1.8, 0.15, "an independent computation", known);
    findings.claim("nusselt_difference", top - bottom, 0.0, 0.1, "in the steady state", known);
    findings.measure("nusselt_of_grid", of_grid, "finite differences, both plates");
    findings.claim("nusselt_by_grid", mean / of_grid, 1.0, 0.1, "finite differences", known);
    findings.measure("roll_amplitude", run.history.last("roll_amplitude"));
    findings.measure("roll_amplitude_of_grid", twin.roll.back(), "finite differences");
    if (still && p.roll > 0.0)
        findings.claim("roll_left",
                       run.history.last("roll_amplitude") / run.history.first("roll_amplitude"),
                       0.0, 0.1, "below the onset rolls die out", long_enough);
    findings.measure("reflections", static_cast<double>(gas.model->reflections()),
                     "particles that crossed a plate");
    findings.check_promises(run);
}

/// Slow convection means quick diffusion; beside a fast wall particles change places quickly.
double step_of(const Convection& gas) {
    return std::min({0.2 * quicker(gas.layer), 1.5 / gas.model->fastest_damping(gas.y0),
                     step_beside_walls(gas.model->box())});
}

void run_one(Session& session, const Parameters& p) {
    std::vector<Convection> gases{make_convection(p, p.rayleigh, session.common().dry_run)};
    const Convection& gas = gases.front();
    session.prefer_step(step_of(gas));
    const auto runs =
        run_all(session, gases, [&](const Convection& one) { return plan_of(session, one); });
    if (!runs.front().complete) return;
    Grid grid(gas.layer, gas.model->box(), p.height);
    GridRun twin;
    session.evaluate([&] { twin = run_grid(grid, runs.front().history.column("t")); });
    report(session, p, gas, runs.front(), twin);
    if (session.plots()) draw(session, gas, runs.front(), grid, twin);
}

constexpr double rigid_onset = 1707.76,
                 slip_onset =
                     779.27;  // 8 pi^4: rolls as wide as they are high; wider ones from 657.51 on

/// Between two plates at which the gas sticks or slips, and periodic along them, so that the rolls that grow
/// first fit in very nearly.
std::optional<double> linear_onset(const Box<2>& box) {
    const WallKind lower = box.wall(1, false).kind, upper = box.wall(1, true).kind;
    if (lower != upper || !box.periodic(0) || box.fastest_wall() > 0.0) return {};
    return lower == WallKind::mirror ? slip_onset : rigid_onset;
}

/// Where the values change from below `limit` to above it, linear between; nothing where they do not.
std::optional<double> crossing(const std::vector<double>& at, const std::vector<double>& value,
                               double limit) {
    for (std::size_t k = 1; k < value.size(); ++k)
        if (value[k - 1] < limit && value[k] >= limit)
            return at[k - 1] +
                   (at[k] - at[k - 1]) * (limit - value[k - 1]) / (value[k] - value[k - 1]);
    return {};
}

/// Strong rolls either die or stay; on the grid the growth of weak ones is found as well.
void run_scan(Session& session, const Parameters& p) {
    Scan scan;
    scan.linear_onset = linear_onset(make_convection(p, 1e4, true).model->box());
    for (const double part : {0.9, 1.2, 1.35, 1.5, 1.65, 1.8, 2.4})
        scan.rayleigh.push_back(std::round(part * scan.linear_onset.value_or(rigid_onset)));
    std::vector<Convection> gases;
    double step = HUGE_VAL;
    for (const double Ra : scan.rayleigh) {
        gases.push_back(make_convection(p, Ra, session.common().dry_run));
        gases.back().call(fmt::format("ra{:g}", Ra));
        step = std::min(step, step_of(gases.back()));
    }
    session.prefer_step(step);
    const auto runs =
        run_all(session, gases, [&](const Convection& one) { return plan_of(session, one); });
    if (runs.size() < gases.size() ||
        !std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run.complete; }))
        return;
    session.evaluate([&] {
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const auto t = runs[k].history.column("t");
            Grid strong(gases[k].layer, gases[k].model->box(), p.height);
            Layer weak_layer = gases[k].layer;
            weak_layer.roll = weak_roll;
            Grid weak(weak_layer, gases[k].model->box(), p.height);
            scan.of_particles.push_back(runs[k].history.last("roll_amplitude"));
            scan.of_grid.push_back(run_grid(strong, t).roll.back());
            const GridRun growing = run_grid(weak, t);
            scan.growth.push_back(growth_rate(growing.t, growing.roll));
        }
    });
    for (std::size_t k = 0; k < runs.size(); ++k) {
        session.measure("roll_" + gases[k].label, scan.of_particles[k],
                        "smooth particles, at the end");
        session.measure("roll_of_grid_" + gases[k].label, scan.of_grid[k],
                        "finite differences, at the end");
        session.measure("growth_of_grid_" + gases[k].label, scan.growth[k],
                        "finite differences, weak rolls");
        session.check_promises(runs[k], gases[k].label + "_");
    }
    const auto report_onset = [&](const std::string& name, std::optional<double> Ra,
                                  const std::string& source) {
        if (!Ra) return;
        session.measure(name, *Ra, source);
        if (scan.linear_onset)
            session.measure(name + "_by_linear_theory", *Ra / *scan.linear_onset,
                            fmt::format("by {:g}", *scan.linear_onset));
    };
    report_onset("onset", crossing(scan.rayleigh, scan.of_particles, 0.25 * scan.of_grid.back()),
                 "smooth particles: strong rolls stay");
    report_onset("onset_of_grid", crossing(scan.rayleigh, scan.growth, 0.0),
                 "finite differences: weak rolls grow");
    if (session.plots()) draw_scan(session, scan);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem(
        "rayleigh_benard", "convection between a hot and a cold plate, [HH07] 12", 0.2,
        "0.2, or shorter where heat diffuses fast, the lower plate is hotter or a side moves fast");
    problem.units(gas_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("height", p.height,
                    "particles from plate to plate, twice as many along them, at spacing 1",
                    between(8, 200));
    const SideOption::Excluded no_end{{SideKind::open, "would let the gas out"}};
    SideOption::Excluded no_plate;
    for (const auto kind : {SideKind::open, SideKind::periodic, SideKind::rigid})
        no_plate.emplace(kind, "has no temperature, and heat must come from below and leave above");
    const Sides sides(options, {{"periodic", no_end},
                                {"periodic", no_end},
                                {"no-slip@1.5", no_plate},
                                {"no-slip@0.5", no_plate}});
    p.sides = &sides;
    options.number("rayleigh", p.rayleigh, "Rayleigh number", between(1.0, 1e6));
    options.number("roll", p.roll, "speed of the rolls at the start; that of sound is 1.4",
                   between(0.0, 0.3));
    add_friction_option(options, p.friction);
    add_density_option(options, p.density);
    options.choice<Work>(
        "work", p.work, {Work::mean, Work::own},
        "what changes a particle's energy: work by the mean stress of each pair, or by its "
        "own");
    options.choice<Kernel>("kernel", p.kernel, all_kernels(), "weight function");
    options.number("range", p.range, "range h of the weight function", between(1.2, 6.0));
    options.flag("scan", p.scan, "find the Rayleigh number at which small rolls begin to grow");
    options.exclude("scan", {"rayleigh"},
                    "has no effect with {by} (seven Rayleigh numbers); leave one out");
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("height", p.height, 10);
        if (p.scan && !session.given("roll")) p.roll = 0.2;
        if (p.scan && p.roll == 0.0)
            throw InputError("roll: 0 leaves nothing that could stay with --scan; give 0.2");
        p.scan ? run_scan(session, p) : run_one(session, p);
    });
}
