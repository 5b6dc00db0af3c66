// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a projectile goes through a bar that flows and breaks; p, L and E are kept, pieces turn on; 10 s
//
// The projectile and the bar of [HHM04] IX (problem fragmenting_bar), of a solid that yields and tears, with
// material vectors (rhs/material_vectors.hpp).
//
//          | o o |
//          | o o |
//    ooo   | o o |         bar: columns x rows of triangular lattice, at rest
//   ooooo ->| o o |         projectile: a hexagon, at `speed`, `offset` above the middle
//    ooo   | o o |         von Mises' yield stress Y, mean tension at most p_c
//          | o o |
//
// Between the changes of its table of neighbours the motion derives from one energy that rotations leave
// unchanged, and what flow takes off that energy is booked as heat. So nothing has to be balanced: p, L and
// E + heat are kept, and so is the spin of every piece from when it has parted on. A piece is what is connected
// within the range, so that pieces do not act on each other.
//
//     --contact repulsive   the projectile is a body of its own: particles of the two repel each other inside one
//                           spacing, without adhesion (rhs/contact.hpp)
//     --contact none        both are of one body: they meet as neighbours do, and what yields may stick
#include "pierced_bar/shot.hpp"
#include "reduced_units.hpp"
#include "stiffness.hpp"

#include <fmt/format.h>

namespace pierced_bar {
namespace {

void add_options(Options& options, Parameters& p) {
    add_target_options(options, p.target);
    breaking::add_flowing_options(options, p.matter);
    options.number("range", p.matter.range, "distance beyond which bonds weigh nothing",
                   between(1.1, 20.0));
    options.number("core", p.matter.core,
                   "energy of the core that keeps two particles apart; 0 for none",
                   between(0.0, 1e3));
    options
        .number("core-range", p.matter.core_range, "distance at which cores touch",
                between(0.01, 1.0))
        .only_when(
            {"core"}, [&p] { return p.matter.core > 0.0; },
            "has no meaning without a core; give --core 1, or leave it out");
    options.choice<ContactKind>(
        "contact", p.contact_kind, {ContactKind::repulsive, ContactKind::none},
        "with repulsive, particles of projectile and bar only push each other away; with none they "
        "become neighbours like any others, and may stick");
    options
        .number("contact-energy", p.contact.energy, "energy e_c of the contact", between(1e-3, 1e3))
        .only_when(
            {"contact"}, [&p] { return p.repulsion().has_value(); },
            "has no meaning without a contact; give --contact repulsive");
    options
        .number("contact-range", p.contact.range,
                "distance at which particles of projectile and bar touch, at most a spacing",
                positive())
        .only_when(
            {"contact"}, [&p] { return p.repulsion().has_value(); },
            "has no meaning without a contact; give --contact repulsive");
}

}  // namespace
}  // namespace pierced_bar

int main(int argc, char** argv) {
    using namespace spam;
    Problem problem("pierced_bar", "a projectile goes through a bar that flows and breaks", 0.025,
                    "0.025, shorter with stiffer cores or contacts");
    problem.units(lattice_units());
    pierced_bar::Parameters p;
    pierced_bar::add_options(problem.options(), p);
    return problem.main(argc, argv, [&](Session& session) {
        make_small(session, p.target);
        const pierced_bar::Parameters usual;
        const double contact = p.repulsion() ? relative_step(*p.repulsion(), usual.contact) : 1.0;
        session.prefer_step(0.025 * contact *
                            relative_step({p.matter.core, p.matter.core_range},
                                          {usual.matter.core, usual.matter.core_range}));
        const double row_interval = session.common().output_every.value_or(0.5);
        refuse_tunnelling(session, p.target, p.matter.range, row_interval);
        pierced_bar::Shot shot = pierced_bar::make_shot(p);
        Plan<2> plan;
        plan.t_end =
            session.common().t_end.value_or(p.target.time(session.common().smoke ? 20.0 : 200.0));
        plan.output_every = row_interval;
        plan.snapshot_every = plan.t_end / 40.0;
        plan.record(pierced_bar::columns_of(shot));
        PiecesInMotion pieces(pierced_bar::least_particles);
        plan.observe(pieces.observer());
        std::vector<breaking::HeatFrame> frames;
        for (const double part : {0.0, 0.075, 0.15, 0.35}) frames.push_back({part * plan.t_end});
        plan.observe(keep_frames(frames, *shot.law));
        const auto run = session.run<2>(*shot.model, shot.y0, std::move(plan));
        pierced_bar::write_pieces(session.folder(), pieces);
        pierced_bar::report(session, run, pieces);
        if (session.plots()) pierced_bar::draw(session, frames, run, pieces);
    });
}
