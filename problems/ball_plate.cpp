// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a ball hits a plate and goes through it, sticks, or both break into many pieces, [HH07] 13; 10 s
//
// Ball and plate, [HH07] 13: a ball of radius R hits a plate, both of the same triangular lattice.
//
//             o o o
//            o o o o      ball: 241 particles, R = 8, at `speed`
//             o o o  |
//                    v    gap
//     o o o o o o o o o o o o o o      plate: `columns` x `rows` = 80 x 8 particles, at rest
//      o o o o o o o o o o o o o o
//
//     --model pair_md        molecules. Sound is faster (12) than the fastest ball, 8; they stick together,
//                            or break into tens and hundreds of pieces
//     --model embedded_atom  potentials of the density, a core, and a strength by the curvature
//     --model spam           smooth particles of an elastic, perfectly plastic solid, and a core
//
// ball_speed is that of the ball's centre of mass, along the way it came. Pieces are linked by pairs nearer than
// 1.5 spacings. A run lasts until the ball would have gone `travel`, at the speed that it had.
//
//     --model elements       finite elements of the same solid, which are removed at a plastic strain of 1
//                            (--failure-strain), and a contact between their nodes
//
//     --compare       the speeds of the lecture, one after the other
//     --ends held     the outermost particles of the plate are held, so that it bends and is torn
#include "ball_plate/impact.hpp"
#include "reduced_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ball_plate {
namespace {

Plan<2> plan_of(const Session& session, const Parameters& p, Impact& impact) {
    Plan<2> plan;
    plan.t_end = (session.common().smoke ? 0.25 : 1.0) * p.travelled() / impact.speed;
    plan.output_every = plan.t_end / 200.0;
    plan.snapshot_every = plan.t_end / 10.0;
    plan.record(columns_of(p));
    const bool elements = p.matter.kind == MatterKind::elements;
    for (const double part : {0.0, elements ? 0.1 : 0.2, elements ? 0.3 : 0.6, 1.0})
        if (elements)
            impact.frames.push_back({part * plan.t_end});
        else
            impact.drawn.push_back({part * plan.t_end});
    if (elements)
        plan.observe(keep_frames(impact.frames));
    else
        plan.observe(keep_nearest<2>(impact.drawn));
    return plan;
}

void compute(Session& session, const Parameters& p) {
    std::vector<Impact> impacts;
    for (const double speed : p.compare ? speeds_of(p.matter.kind) : std::vector{p.speed}) {
        impacts.push_back(make_impact(session, p, speed));
        if (p.compare) impacts.back().prefix = fmt::format("v_{:g}_", speed);
    }
    std::vector<Case<2>> cases;
    for (Impact& impact : impacts) {
        std::string label = impact.prefix.substr(0, impact.prefix.rfind('_'));
        cases.push_back({impact.model, impact.y0, plan_of(session, p, impact), std::move(label)});
    }
    const auto runs = session.run_all(std::move(cases));
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, impacts[k], runs[k]);
    if (session.plots()) draw(session, p, impacts, runs);
}

void add_options(Problem& problem, Parameters& p) {
    Options& options = problem.options();
    options.number("speed", p.speed, "speed of the ball (that of sound is 1.06, of molecules 12)",
                   between(1e-3, 20.0));
    options.flag("compare", p.compare, "compute the four speeds of the lecture");
    options.exclude("compare", {"speed"},
                    "has no effect with {by}, which has the speeds of the lecture; leave one out");
    options.number("radius", p.radius, "radius of the ball", between(1.0, 200.0));
    options.integer("columns", p.columns, "particles along the plate", between(4, 5000));
    options.integer("rows", p.rows, "particles across the plate", between(1, 500));
    options.number("gap", p.gap, "distance of ball and plate at the start", between(0.5, 100.0));
    options.number(
        "travel", p.travel,
        "how far the ball would have gone at the end, had it not met the plate (default: 75 with "
        "--model pair_md, 125 of elements, else 20)",
        between(1.0, 1e4));
    options.choice<Ends>("ends", p.ends, {Ends::free, Ends::held},
                         "the outermost particles of the plate move freely, or are held");
    options
        .choice<ContactKind>(
            "contact", p.contact_kind, {ContactKind::none, ContactKind::repulsive},
            "with none, particles of ball and plate are neighbours like any others, and stick "
            "together; with repulsive they only push each other away, as elements always do")
        .only_when(
            {"model"}, [&p] { return p.matter.kind != MatterKind::elements; },
            "has no meaning with {by}, whose ball and plate always repel each other; leave it "
            "out");
    const auto repel = [&p] { return p.repulsion().has_value(); };
    const std::string why = "has no meaning without a contact; give --contact repulsive";
    options
        .number("contact-energy", p.contact.energy, "energy e_c of the contact", between(1e-3, 1e3))
        .only_when({"contact", "model"}, repel, why);
    options
        .number("contact-range", p.contact.range,
                "distance at which particles of ball and plate touch, at most a spacing",
                positive())
        .only_when({"contact", "model"}, repel, why);
    breaking::add_matter_options(
        problem, p.matter,
        {MatterKind::pair_md, MatterKind::embedded_atom, MatterKind::spam, MatterKind::elements});
}

}  // namespace
}  // namespace ball_plate

int main(int argc, char** argv) {
    spam::Problem problem("ball_plate", "a ball that hits a plate, [HH07] 13", 0.1,
                          "0.05, of molecules 0.0025, of embedded atoms 0.0125; shorter where "
                          "cores, contact or speed need it");
    problem.units(spam::lattice_units());
    ball_plate::Parameters p;
    ball_plate::add_options(problem, p);
    return problem.main(argc, argv, [&](spam::Session& session) {
        if (session.common().smoke) {
            if (!session.given("radius")) p.radius = 3.0;
            if (!session.given("columns")) p.columns = 20;
            if (!session.given("rows")) p.rows = 4;
        }
        session.prefer_step(ball_plate::step_of(p));
        ball_plate::compute(session, p);
    });
}
