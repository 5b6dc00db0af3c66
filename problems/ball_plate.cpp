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
//     --dimension 3   a ball of 381 particles, R = 4, and a plate of six layers, 22 spacings wide, of the face-centred
//                     cubic lattice, of molecules or smooth particles; pictures show a cut through the middle.
//                     Another program's molecules make 1, 1, 7 and 150 to 165 pieces at v = 1, 2, 4, 8 when the ball
//                     would have gone 48, and ball_speed is 2.2 +- 0.1 at v = 8. Here 1, 1, 5.4 +- 1.5, 159.2 +- 1.9,
//                     2.127 +- 0.009: with --compare v = 4 and 8 are run with five seeds, which displace the particles
//                     of perfect crystals by 1e-10 (--disorder), so that they part in another way each time. What is
//                     less perfect parts less: with 0.01, as in the plane, into 2 to 4 and 135 to 151 pieces
//     --compare       the speeds of the lecture, one after the other
//     --ends held     the outermost particles of the plate are held, so that it bends and is torn
#include "ball_plate/impact.hpp"

namespace {

using namespace ball_plate;

template <int Dim>
Plan<Dim> plan_of(const Session& session, const Parameters& p, Impact<Dim>& impact) {
    Plan<Dim> plan;
    plan.t_end = (session.common().smoke ? 0.25 : 1.0) * p.travelled() / impact.speed;
    plan.output_every = plan.t_end / 200.0;
    plan.snapshot_every = plan.t_end / 10.0;
    plan.record(columns_of<Dim>(p));
    if constexpr (Dim == 3)
        plan.observe(
            {.on_row = [&impact](double, const Model<3>& model,
                                 std::span<const double> y) { impact.parted->look(model, y); },
             .memory = [&impact](Archive& archive) { archive(*impact.parted); }});
    if constexpr (Dim == 2)
        if (p.matter.kind == MatterKind::elements) {
            impact.drawn = states_at<2>({0.0, 0.1, 0.3, 1.0}, plan.t_end);
            plan.observe(keep_nearest<2>(impact.drawn, strains_of_elements));
            return plan;
        }
    impact.drawn = states_at<Dim>({0.0, 0.2, 0.6, 1.0}, plan.t_end);
    plan.observe(keep_nearest<Dim>(impact.drawn));
    return plan;
}

template <int Dim>
void compute(Session& session, const Parameters& p) {
    std::vector<Impact<Dim>> impacts;
    for (const double speed : p.compare ? speeds_of(p.matter.kind) : std::vector{p.speed}) {
        Parameters one = p;
        for (int k = 0; k < (p.compare ? seeds_of(p, speed) : 1); ++k, ++one.matter.seed) {
            impacts.push_back(make_impact<Dim>(session, one, speed));
            if (p.compare)
                impacts.back().call(k == 0 ? fmt::format("v_{:g}", speed)
                                           : fmt::format("v_{:g}_seed_{}", speed, one.matter.seed));
        }
    }
    const auto runs =
        run_all(session, impacts, [&](Impact<Dim>& impact) { return plan_of(session, p, impact); });
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, impacts[k], runs[k]);
    if constexpr (Dim == 3) report_seeds(session, p, impacts, runs);
    if (session.plots()) draw(session, p, impacts, runs);
}

void add_options(Problem& problem, Parameters& p) {
    Options& options = problem.options();
    options.number("speed", p.speed, "speed of the ball (that of sound is 1.06, of molecules 12)",
                   between(1e-3, 20.0));
    options.flag("compare", p.compare, "compute the four speeds of the lecture");
    options.exclude("compare", {"speed"},
                    "has no effect with {by}, which has the speeds of the lecture; leave one out");
    options.integer("dimension", p.dimension,
                    "2: the triangular lattice; 3: the face-centred cubic one, in space",
                    between(2, 3));
    options.only_when(
        {"dimension"}, {"model"},
        [&p] {
            return p.dimension == 2 || p.matter.kind == MatterKind::pair_md ||
                   p.matter.kind == MatterKind::spam;
        },
        "has no meaning with {by}: elements are of the plane, and a lattice of embedded atoms in "
        "space flies apart at rest; leave it out");
    options.number("radius", p.radius, "radius of the ball; in space 4 by default",
                   between(1.0, 200.0));
    options.integer("columns", p.columns,
                    "particles along the plate; in space spacings, of whole cells, along its edges "
                    "(22 by default)",
                    between(4, 5000));
    options.integer("rows", p.rows,
                    "particles across the plate; in space layers, sqrt(1/2) apart (6 by default)",
                    between(1, 500));
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
    add_contact_options(options, p.contact, "particles of ball and plate");
    options.only_when(
        {"contact-energy", "contact-range"}, {"contact", "model"},
        [&p] { return p.repulsion().has_value(); },
        "has no meaning without a contact; give --contact repulsive");
    breaking::add_matter_options(
        problem, p.matter,
        {MatterKind::pair_md, MatterKind::embedded_atom, MatterKind::spam, MatterKind::elements});
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("ball_plate", "a ball that hits a plate, [HH07] 13", 0.1,
                    "0.05, of molecules 0.0025, of embedded atoms 0.0125; shorter where "
                    "cores, contact or speed need it");
    problem.units(lattice_units());
    Parameters p;
    add_options(problem, p);
    return problem.main(argc, argv, [&](Session& session) {
        const auto in_space = [&](const char* option, auto& value, auto usual) {
            if (p.dimension == 3 && !session.given(option)) value = usual;
        };
        in_space("radius", p.radius, 4.0);
        in_space("columns", p.columns, 22);
        in_space("rows", p.rows, 6);
        in_space("disorder", p.matter.disorder, disorder_in_space);
        session.smoke_default("radius", p.radius, p.dimension == 3 ? 2.0 : 3.0);
        session.smoke_default("columns", p.columns, p.dimension == 3 ? 10 : 20);
        session.smoke_default("rows", p.rows, 4);
        session.prefer_step(step_of(p));
        p.dimension == 3 ? compute<3>(session, p) : compute<2>(session, p);
    });
}
