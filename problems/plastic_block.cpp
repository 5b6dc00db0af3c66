// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a free block that bends, yields and keeps its energy; orders of three ways to yield; 2 s
//
// An elastic-plastic block of smooth particles, free in space, that bends and turns.
//
//     o o o o o o o o o o     Triangular lattice, 20 x 11, spacing 1. It starts without stress with a velocity
//      o o o o o o o o o o    that bends it beyond its yield stress Y (von Mises, two dimensions):
//     o o o o o o o o o o         v = (A sin(pi x/20) - w y, .7 A sin(pi x/20) sin(pi x/10) y/5 + w x)
//
// The stress must not leave the yield surface, and there are three ways to keep it there:
//
//     --yield return   every right-hand side returns the stress to the surface, and after each step that
//                      becomes the stress. The rates do not change there: energy, momentum (and in the
//                      total-Lagrangian form angular momentum) are kept as in an elastic run. Of first order
//                      in dt, with a small factor; an adaptive step does not see that error.
//     --yield after    elastic right-hand sides, and a return after each step: what is often done. Ten times
//                      the error, and the plastic work is taken at stresses that are too high.
//     --yield smooth   a rate that keeps the stress within: of the order of the method, adaptive steps
//                      control it, at the price of shorter ones.
//
// --compare runs all of them with steps and tolerances of their own: comparison.csv, and error against work
// in one picture. It reports what the tolerance of adaptive steps does not control. 15 s
#include "plastic_block/block.hpp"

#include <thread>

namespace {

using namespace plastic_block;

Column<2> plastic_strain_column() {
    return {"largest_plastic_strain", [](const Model<2>& model, std::span<const double> y) {
                const auto strain = plastic_strains(model, y);
                return *std::max_element(strain.begin(), strain.end());
            }};
}

void report(Session& session, const Parameters& p, const RunRecord& run) {
    const double energy = std::abs(run.history.last("energy") / run.history.first("energy") - 1.0);
    const bool known = run.complete && p.yielding != Yielding::after_steps &&
                       session.integrator().method == "rk4" &&
                       session.integrator().dt.value_or(1.0) <= 0.25 &&
                       run.history.first("energy") > 0.0 && p.range >= 2.0;
    const Findings findings(session);
    findings.claim("energy_change", energy, 0.0, 2e-6, "no plastic work is added to e", known);
    findings.measure_last(run.history, {"plastic_work", "largest_plastic_strain"});
    findings.check_promises(run);
}

/// As many as a run of its own length has.
struct Snapshot {
    double t;
    Points<2> position;
    std::vector<double> strain;
    void remember(Archive& archive) { archive(t, position, strain); }
};

void draw(Session& session, const std::vector<Snapshot>& snapshots, const RunRecord& run) {
    std::vector<ConfigurationPanel> panels;
    for (const Snapshot& one : snapshots)
        panels.push_back({fmt::format("t = {:.3g}", one.t), one.position, one.strain, {}});
    draw_configurations(session, "plastic_strain", "Yielding block: plastic strain", panels,
                        panels.size(), "plastic strain");
    draw_curves(session, "energies", "Yielding block",
                {over_time("", run.history, "energy",
                           {{"kinetic", "kinetic"},
                            {"internal", "internal"},
                            {"plastic work", "plastic_work"},
                            {"total", "energy"}})});
}

void run_one(Session& session, const Parameters& p) {
    // Smooth flow is stiff, the more the narrower it sets in.
    if (p.yielding == Yielding::smooth)
        session.prefer_step(0.0625 * std::min(1.0, p.width / Parameters{}.width));
    const Block block = make_block(p);
    Plan<2> plan;
    plan.t_end = session.common().smoke ? 5.0 : 20.0;
    plan.snapshot_every = 0.25 * session.common().t_end.value_or(plan.t_end);
    plan.record({{"plastic_work", plastic_work}, plastic_strain_column()});
    std::vector<Snapshot> snapshots;
    plan.observe({.on_snapshot =
                      [&](double t, const Model<2>& model, std::span<const double> y) {
                          if (snapshots.size() < 5)
                              snapshots.push_back({t, ConstState<2>(model.layout(), y).position(),
                                                   plastic_strains(model, y)});
                      },
                  .memory = [&](Archive& archive) { archive(snapshots); }});
    const RunRecord run = session.run(*block.model, block.y0, std::move(plan));
    report(session, p, run);
    if (session.plots()) draw(session, snapshots, run);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("plastic_block", "a free block that bends, yields and keeps its energy", 0.25,
                    "0.25, less with --yield smooth");
    problem.units(lattice_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("columns", p.columns, "particles along the block", between(4, 1000));
    options.integer("rows", p.rows, "rows of particles", between(3, 1000));
    options.number("amplitude", p.amplitude, "speed A of the bending at the start",
                   between(0.0, 0.5));
    options.number("spin", p.spin, "angular velocity w at the start", between(-0.2, 0.2));
    options.number("yield-stress", p.yield_stress,
                   "stress difference at which the solid yields; its moduli are 0.433",
                   between(1e-6, 1e6));
    options.number("hardening", p.hardening, "growth of the yield stress with plastic strain",
                   between(0.0, 1e3));
    options.choice<Formulation>("formulation", p.formulation,
                                {Formulation::updated, Formulation::total_lagrangian},
                                "sums over present neighbours, or over those of the start");
    options.choice<Yielding>("yield", p.yielding,
                             {Yielding::in_stages, Yielding::after_steps, Yielding::smooth},
                             "return in every right-hand side, after each step, or smooth rates");
    options
        .number("yield-width", p.width, "part of the yield stress over which smooth flow sets in",
                between(1e-3, 1.0))
        .only_when(
            {"yield", "compare"}, [&p] { return p.compare || p.yielding == Yielding::smooth; },
            "has a meaning for --yield smooth alone");
    options
        .choice<Transport>("transport", p.transport,
                           {Transport::plain, Transport::average, Transport::monaghan},
                           "velocity with which particles of the updated form move")
        .only_when(
            {"formulation", "compare"},
            [&p] { return p.compare || p.formulation == Formulation::updated; },
            "has no meaning for {by}, whose particles move with their velocity");
    options.number("range", p.range, "range h of Lucy's weight function", between(1.2, 6.0));
    options
        .number("penalty", p.penalty,
                "penalty against zero-energy modes of the total-Lagrangian form",
                between(0.0, 100.0))
        .only_when(
            {"formulation", "compare"},
            [&p] { return p.compare || p.formulation == Formulation::total_lagrangian; },
            "has a meaning for --formulation total_lagrangian alone");
    options.flag("compare", p.compare, "errors, orders and work of all forms");
    add_jobs_option(options, p.jobs, "runs of --compare computed at the same time")
        .needs("compare");
    options.exclude("compare", {"formulation", "yield"},
                    "has no effect with {by}, which runs all of them; leave one out");
    return problem.main(argc, argv, [&](Session& session) {
        if (p.compare)
            compare(session, p);
        else
            run_one(session, p);
    });
}
