// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: Sod's shock tube, and Toro's five, against the exact solution, three resolutions; 10 s
//
// Sod's shock tube: a gas at rest, rho = 1, P = 1 on the left of a diaphragm, rho = 0.125, P = 0.1 on its right.
// --toro 1 to 5: the five pairs of gases of E. F. Toro's book (Riemann Solvers and Numerical Methods for Fluid
// Dynamics, table 4.1), of which the third and the fourth have pressures 100,000 and 10,000 to 1 and the second
// nearly a vacuum.
//
//     |ooooooooooooooooo|. . . . . . . . .|     At t = 0 the diaphragm is gone. A fan runs to the left, a
//       rho = 1, P = 1     0.125, 0.1           contact and a shock to the right; until they meet the ends
//    -1/2               0                1/2    the solution depends on x/t alone and is known.
//
// All particles have the same distance at the start, those on the right an eighth of the mass. Von Neumann's
// artificial viscosity turns the energy that a shock takes into heat. The ends are mirrors (--left, --right); what
// they give is the pressure of the gas before them, as long as nothing has arrived. Where gases stream there are
// further particles beyond both ends, so many that what the ends do to them does not come back.
//
// Beside a hot gas a cold one does work by the mean of both pressures (--work mean, the form of all texts), which
// soon is more than it has: where pressures differ much runs end there. By their own pressures (--work own,
// the default with --toro) particles stay on their adiabats but for what the viscosity heats. --compare
// computes all five by both forms with 400 to 3,200 particles: comparison.csv, errors and their orders; 2 min.
#include "shock_tube/comparison.hpp"

namespace {

using namespace shock_tube;

constexpr double known_until =
    0.25;  // the fan meets the left end at 0.42, the shock the right one at 0.28

/// Mean pressure on a wall at an end: its impulse by the time.
void report_ends(Session& session, const Parameters& p, const Tube& tube, const RunRecord& run) {
    const Findings findings(session, tube.prefix);
    const double t = run.statistics.t_end;
    if (!run.complete || !(t > 0.0)) return;
    for (const bool upper : {false, true}) {
        const Wall<1>& wall = tube.model->box().wall(0, upper);
        const GasState& gas = upper ? p.setting.right : p.setting.left;
        if (wall.open() || gas.u != 0.0) continue;
        const std::string side = Sides::name(0, upper);
        findings.claim(
            "pressure_on_" + side, std::abs(run.history.last("impulse_" + side + "_x")) / t, gas.P,
            0.02 * gas.P, "of the gas at rest before that end",
            wall.kind == WallKind::mirror && session.when_default({"toro"}) && t <= known_until &&
                p.standard(session) && p.gamma <= 1.4 && tube.cells >= 800);
    }
}

void report(Session& session, const Parameters& p, const Tube& tube, const RunRecord& run) {
    const Findings findings(session, tube.prefix);
    const double t = run.statistics.t_end;
    const bool known = session.when_default({"gamma"}) && p.standard(session) && run.complete &&
                       t > 0.75 * p.setting.t_end &&
                       t <= (session.when_default({"toro"}) ? known_until : p.setting.t_end) &&
                       tube.cells >= 800;
    findings.measure("density_error", density_error(tube, run.y, t), "mean |rho - exact|");
    for (const Plateau& one : plateaus(tube, p.gamma, run.y, t))
        if (std::isfinite(one.found))  // not so early that no particle is on it
            findings.claim(one.name, one.found, one.exact, p.tolerance() * one.scale,
                           "the exact solution of Riemann's problem", known && p.setting.resolved);
    report_ends(session, p, tube, run);
    findings.check_promises(run);
}

/// How the error falls with the number of particles.
void compare_sizes(Session& session, const Parameters& p, const std::vector<Tube>& tubes,
                   const std::vector<RunRecord>& runs) {
    const Findings findings(session);
    LogLogCurve curve{.x = {}, .y = {}};
    for (std::size_t k = 0; k < runs.size(); ++k)
        add_point(curve, tubes[k].cells,
                  density_error(tubes[k], runs[k].y, runs[k].statistics.t_end));
    findings.measure_orders(labels_of(tubes), curve.y, "of the density's error");
    const double order = std::log2(curve.y.front() / curve.y.back()) / 2.0;
    findings.claim("order", order, 1.0, 0.2, "shocks and contacts are a few particles wide",
                   session.when_default({"toro", "cells", "gamma"}) && p.standard(session) &&
                       tubes.front().model->box().wall(0, false).kind == WallKind::mirror &&
                       tubes.front().model->box().wall(0, true).kind == WallKind::mirror &&
                       runs.back().statistics.t_end > 0.15 &&
                       runs.back().statistics.t_end <= known_until);
    if (!session.plots()) return;
    const LogLogPanel panel{.title = "",
                            .x_label = "particles",
                            .y_label = "mean |ρ - exact|",
                            .curves = {curve},
                            .words = fmt::format("order {:.2f}", order)};
    draw_log_log(
        session, "error",
        {p.setting.title + ": mean error of the density", {panel}, 1, {"smooth particles"}, ""});
}

CurvePanel panel_of(const Parameters& p, const std::vector<Tube>& tubes,
                    const std::vector<RunRecord>& runs, std::size_t which, double t) {
    CurvePanel panel = frame("", "x", quantities[which]);
    Curve exact{"exact", {}, {}, Mark::line, 1};
    for (int k = -500; k <= 500; ++k)
        add_point(exact, 0.001 * k, exact_value(tubes.front(), p.gamma, which, 0.001 * k, t));
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const ConstState<1> state(tubes[r].model->layout(), runs[r].y);
        const auto values = found(tubes[r], runs[r].y, which);
        Curve points{fmt::format("{} particles", tubes[r].cells),
                     {},
                     {},
                     Mark::points,
                     static_cast<int>(r) + 2};
        for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
            if (std::abs(state.position()(0, i)) > 0.5) continue;
            add_point(points, state.position()(0, i), values[static_cast<std::size_t>(i)]);
        }
        panel.curves.push_back(points);
    }
    panel.curves.push_back(exact);  // above them
    return panel;
}

void draw(Session& session, const Parameters& p, const std::vector<Tube>& tubes,
          const std::vector<RunRecord>& runs) {
    const double t = runs.back().statistics.t_end;
    std::vector<CurvePanel> panels;
    for (std::size_t which = 0; which < (p.toro ? quantities.size() : 3U); ++which)
        panels.push_back(panel_of(p, tubes, runs, which, t));
    draw_curves(session, "profiles",
                fmt::format("{} at t = {:g}, γ = {:g}", p.setting.title, t, p.gamma), panels);
}

void run_sizes(Session& session, const Parameters& p) {
    auto tubes = by_size(p.cells, !p.single,
                         [&](int cells) { return make_tube(p, cells, session.common().dry_run); });
    // Rigid sides turn particles back within a step, which costs the method its order.
    const auto is_rigid = [&](bool upper) {
        return tubes.back().model->box().wall(0, upper).kind == WallKind::rigid;
    };
    session.prefer_step(p.step(tubes.back().cells) *
                        (is_rigid(false) || is_rigid(true) ? 0.25 : 1.0));
    const auto runs = run_all(session, tubes, [&](const Tube&) {
        return Plan<1>{.t_end = session.end(p.setting.t_end, p.setting.t_end / 10.0)};
    });
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, tubes[k], runs[k]);
    if (runs.size() == 3) compare_sizes(session, p, tubes, runs);
    if (session.plots() && !runs.empty()) draw(session, p, tubes, runs);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem(
        "shock_tube", "Sod's shock tube against the exact solution, and Toro's five", 0.1,
        "0.1 by the number of particles of the largest size, with --toro shorter where the "
        "gas is faster");
    problem.units(reduced_units(
        "the length of the tube and, of Sod's, the density and pressure on its left"));
    Parameters p;
    auto& options = problem.options();
    options.integer(
        "toro", p.toro,
        "one of Toro's five pairs of gases: 1 Sod's, 2 two fans, 3 a blast to the right, 4 one "
        "to the left, 5 two shocks (default: Sod's to t = 0.2)",
        between(1, toro_tests));
    options.integer("cells", p.cells, "particles along the tube", between(20, 20000));
    options.number("gamma", p.gamma, "ratio of the heat capacities", between(1.05, 5.0));
    options.number("viscosity", p.scheme.viscosity, "coefficient alpha of the artificial viscosity",
                   between(0.0, 100.0));
    add_density_option(options, p.scheme.density);
    options.choice<Work>(
        "work", p.scheme.work, {Work::mean, Work::own},
        "what changes a particle's energy: work by the mean pressure of each pair, or by "
        "its own (with --toro and --compare: own)");
    const SideOption end(
        "mirror", {{SideKind::periodic,
                    "would let the two gases meet at the ends as well, without a diaphragm"}});
    const Sides sides(options, {end, end}, {.temperatures = false});
    p.sides = &sides;
    options.choice<Kernel>("kernel", p.scheme.kernel, all_kernels(), "weight function");
    options.number("range", p.scheme.range,
                   "range h of the weight function, in spacings (with --toro 3 to 5: 6)",
                   between(1.2, 20.0));
    options.flag(
        "single", p.single,
        "compute this number of particles only, not half as many and twice as many as well");
    options.flag(
        "compare", p.compare,
        "errors and orders of all five by both forms of the work, with 400 to 3,200 particles");
    add_jobs_option(options, p.jobs, "runs of --compare computed at the same time")
        .needs("compare");
    options.exclude("compare", {"toro", "cells", "single", "work", "left", "right"},
                    "has no meaning with {by}, which says it itself; leave one out");
    return problem.main(argc, argv, [&](Session& session) {
        if (p.compare) return compare(session, p);
        p.settle(session);
        session.smoke_default("cells", p.cells, 100);
        run_sizes(session, p);
    });
}
