// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a tapered bar is pulled apart from within, by molecules and by smooth particles, [HH07] 13; 3 s
//
// Tension test, [HH07] 13: a bar of `columns` x `rows` particles of a triangular lattice, its heights 10 % less
// at the middle, with a load on every particle that grows with time, under friction.
//
//     <- <- < o o o o o o > -> ->
//     <- <- <  o o o o o  > -> ->       m v_dot_i = ... + m f(t) X_i/(L/2) e_x - m gamma v_i,   f = load-rate t
//     <- <- < o o o o o o > -> ->       X_i: place at the start, L = `columns`
//
// Forces at the ends alone would tear off the ends.
//
//     --model pair_md        molecules: breaks
//     --model embedded_atom  potentials of the density, a core, and a strength by the curvature: ductile
//     --model spam           smooth particles of an elastic, perfectly plastic solid, and a core: necks, then
//                            parts. Every particle begins with the density of the lattice at rest
//     --model material_vectors  the same with a vector for each neighbour (rhs/material_vectors.hpp); with
//                            --end-speed it has no load: it flies apart, necks where its ends are left
//                            behind, and parts into three. --stretch-limit and --stress-limit make it brittle
//     --model elements       finite elements of the same solid, drawn out at their ends: necks in the middle
//     --model all            the first three, each with a step of its own
//
// A bar of molecules that is loaded slowly parts where its rows are torn: bonds bear 5.30, a load f pulls with
// 15 f on each row of the middle, f = 0.353. It takes a while to move apart: at 0.364 with load-rate 1/1500 (the
// bar of the lecture parts at t = 620), at 0.41 with 1/200, which is the default. The others flow, and part at
// lower loads when these grow more slowly; motion is chaotic, and --seed changes loads by a tenth. Without
// a core smooth particles clump before they part.
#include "tension_test/bar.hpp"

namespace {

using namespace tension_test;

Plan<2> plan_of(const Session& session, PulledBar& bar, bool several) {
    Plan<2> plan;
    plan.t_end = bar.t_end;
    plan.output_every = plan.t_end / (session.common().smoke ? 200.0 : 1000.0);
    plan.snapshot_every = plan.t_end / 40.0;
    if (several) plan.step = bar.step;
    plan.record(columns_of(bar));
    if (bar.load_rate > 0.0)
        plan.observe({.enough = [](const History& h) {
            const auto t = parted_at(h);
            return t && h.last("t") >= 1.03 * *t;
        }});
    if (several)
        bar.drawn = states_at<2>({0.6}, plan.t_end);
    else if (bar.load_rate > 0.0)
        bar.drawn = states_at<2>({0.0, 0.4, 0.6}, plan.t_end);
    else
        bar.drawn = states_at<2>({0.0, 0.2, 0.4}, plan.t_end);
    plan.observe(keep_nearest<2>(bar.drawn));
    return plan;
}

void compute(Session& session, const Parameters& p) {
    std::vector<PulledBar> bars;
    const auto kinds = kinds_of(p.matter.kind);
    const bool several = kinds.size() > 1;
    for (const MatterKind kind : kinds) {
        Matter matter = p.matter;
        matter.kind = kind;
        bars.push_back(make_bar(session, p, matter));
        if (several) bars.back().call(std::string(to_string(kind)));
    }
    if (!several) session.prefer_step(bars.front().step);
    const auto runs =
        run_all(session, bars, [&](PulledBar& bar) { return plan_of(session, bar, several); });
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, bars[k], runs[k]);
    if (session.plots()) draw(session, bars, runs);
}

void add_options(Problem& problem, Parameters& p) {
    Options& options = problem.options();
    options.integer("columns", p.columns, "particles along the bar", between(8, 2000));
    options.integer("rows", p.rows, "particles across the bar (default: 14, or 12 elements)",
                    between(4, 200));
    options.number("taper", p.taper, "how much lower the bar is at its middle, by its height",
                   between(0.0, 0.5));
    options.number("load-rate", p.load_rate,
                   "growth of the load at the ends by time (default: that of the model)",
                   between(1e-9, 1e3));
    options.number("damping", p.damping, "rate of the friction, gamma (default: that of the model)",
                   between(0.0, 100.0));
    add_matter_options(problem, p.matter,
                       {MatterKind::pair_md, MatterKind::embedded_atom, MatterKind::spam,
                        MatterKind::material_vectors, MatterKind::elements, MatterKind::all});
    options.only_when(
        {"load-rate", "damping"}, {"model"}, [&p] { return p.matter.kind != MatterKind::elements; },
        "has no meaning with {by}, whose ends are drawn out; leave it out");
    options
        .number(
            "end-speed", p.end_speed,
            "speed at which the ends are drawn out: of elements (default 0.0469), and of material "
            "vectors in place of the load",
            between(1e-6, 10.0))
        .only_when(
            {"model"},
            [&p] {
                return p.matter.kind == MatterKind::elements ||
                       p.matter.kind == MatterKind::material_vectors;
            },
            "has no meaning with {by}, on which a load acts; leave it out")
        .excludes({"load-rate", "damping"});
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("tension_test", "a tapered bar under tension, [HH07] 13", 0.25);
    problem.units(lattice_units());
    Parameters p;
    add_options(problem, p);
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("columns", p.columns, 16);
        session.smoke_default("rows", p.rows, 6);
        if (p.matter.kind == breaking::MatterKind::elements)
            compute_elements(session, p);
        else
            compute(session, p);
    });
}
