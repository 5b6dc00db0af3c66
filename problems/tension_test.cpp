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
//     --dimension 3          a bar of square section in space: 30 layers of 8 x 8 rows (`columns`, `rows`) of a
//                            face-centred cubic lattice, along the edge of its cells, with every second place
//                            taken, so that neighbours are 1 and layers sqrt(1/2) apart: 960 particles. All models
//                            but elements; pictures show the layer of sites that is next to the middle
//
// A bar of molecules that is loaded slowly parts where its rows are torn: bonds bear 5.30, a load f pulls with
// 15 f on each row of the middle, f = 0.353. It takes a while to move apart: at 0.364 with load-rate 1/1500 (the
// bar of the lecture parts at t = 620), at 0.41 with 1/200, which is the default. The others flow, and part at
// lower loads when these grow more slowly; motion is chaotic, and --seed changes loads by a tenth. Without
// a core smooth particles clump before they part.
//
// In space 2 rows (rows - 1) bonds join two layers, at 45 degrees to the bar. While layers are drawn apart as they are
// each bears up to 4.06 along it, the largest F(r) x/r with r^2 = x^2 + 1/2, at x = 0.846. A load f pulls with
// columns rows^2 f/8 on the middle: f = 65 (1 - 1/rows)/columns = 1.894. Molecules part at 1.93 with load-rate 0.005,
// at 1.99 with 0.025, which is the default. Embedded atoms lose their lattice and flow; smooth particles part between
// layers, which come together in pairs under tension; material vectors neck and part in two.
#include "tension_test/bar.hpp"

namespace {

using namespace tension_test;

template <int Dim>
Plan<Dim> plan_of(const Session& session, PulledBar<Dim>& bar, bool several) {
    Plan<Dim> plan;
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
        bar.drawn = states_at<Dim>({0.6}, plan.t_end);
    else if (bar.load_rate > 0.0)
        bar.drawn = states_at<Dim>({0.0, 0.4, 0.6}, plan.t_end);
    else
        bar.drawn = states_at<Dim>({0.0, 0.2, 0.4}, plan.t_end);
    plan.observe(keep_nearest<Dim>(bar.drawn));
    return plan;
}

template <int Dim>
void compute(Session& session, const Parameters& p) {
    std::vector<PulledBar<Dim>> bars;
    const auto kinds = kinds_of(p.matter.kind);
    const bool several = kinds.size() > 1;
    for (const MatterKind kind : kinds) {
        Matter matter = p.matter;
        matter.kind = kind;
        bars.push_back(make_bar<Dim>(session, p, matter));
        if (several) bars.back().call(std::string(to_string(kind)));
    }
    if (!several) session.prefer_step(bars.front().step);
    const auto runs =
        run_all(session, bars, [&](PulledBar<Dim>& bar) { return plan_of(session, bar, several); });
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, bars[k], runs[k]);
    if (session.plots()) draw(session, p, bars, runs);
}

void add_options(Problem& problem, Parameters& p) {
    Options& options = problem.options();
    options.integer("dimension", p.dimension,
                    "2: a bar in the plane; 3: of square section, in space", between(2, 3));
    options.only_when(
        {"dimension"}, {"model"},
        [&p] { return p.dimension == 2 || p.matter.kind != MatterKind::elements; },
        "has no meaning with {by}, which are of the plane; leave one out");
    options.integer("columns", p.columns,
                    "particles along the bar; in space layers, sqrt(1/2) apart (default there: 30)",
                    between(8, 2000));
    options.integer("rows", p.rows,
                    "particles across the bar (default: 14, or 12 elements; in space 8)",
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
        if (p.dimension == 3 && !session.given("columns")) p.columns = 30;
        session.smoke_default("columns", p.columns, 16);
        session.smoke_default("rows", p.rows, 6);
        if (p.matter.kind == breaking::MatterKind::elements)
            compute_elements(session, p);
        else
            p.dimension == 2 ? compute<2>(session, p) : compute<3>(session, p);
    });
}
