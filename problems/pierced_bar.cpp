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

namespace {

using namespace pierced_bar;
using namespace spam;

void add_options(Options& options, Parameters& p) {
    add_target_options(options, p.target);
    breaking::add_flowing_options(options, p.matter);
    options.number("range", p.matter.range, "distance beyond which bonds weigh nothing",
                   between(1.1, 20.0));
    add_core_options(options, p.matter.core, p.matter.core_range, between(0.01, 1.0), "1");
    options.choice<ContactKind>(
        "contact", p.contact_kind, {ContactKind::repulsive, ContactKind::none},
        "with repulsive, particles of projectile and bar only push each other away; with none they "
        "become neighbours like any others, and may stick");
    add_contact_options(options, p.contact, "particles of projectile and bar");
    options.only_when(
        {"contact-energy", "contact-range"}, {"contact"},
        [&p] { return p.repulsion().has_value(); },
        "has no meaning without a contact; give --contact repulsive");
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("pierced_bar", "a projectile goes through a bar that flows and breaks", 0.025,
                    "0.025, shorter with stiffer cores or contacts");
    problem.units(lattice_units());
    Parameters p;
    add_options(problem.options(), p);
    return problem.main(argc, argv, [&](Session& session) {
        make_small(session, p.target);
        const Parameters usual;
        const double contact = p.repulsion() ? relative_step(*p.repulsion(), usual.contact) : 1.0;
        session.prefer_step(0.025 * contact *
                            step_of_short_range(p.matter.range, usual.matter.range) *
                            relative_step({p.matter.core, p.matter.core_range},
                                          {usual.matter.core, usual.matter.core_range}));
        const double row_interval = session.common().output_every.value_or(0.5);
        refuse_tunnelling(session, p.target, p.matter.range, row_interval);
        Shot shot = make_shot(p);
        Plan<2> plan;
        plan.t_end = session.end(p.target.time(200.0), p.target.time(20.0));
        plan.output_every = row_interval;
        plan.snapshot_every = plan.t_end / 40.0;
        plan.record(columns_of(shot));
        PiecesInMotion pieces(least_particles);
        plan.observe(pieces.observer());
        auto drawn = states_at<2>({0.0, 0.075, 0.15, 0.35}, plan.t_end);
        plan.observe(keep_nearest<2>(drawn, [&](const Model<2>&, std::span<const double>) {
            return shot.law->heat_of_particles();
        }));
        const auto run = session.run<2>(*shot.model, shot.y0, std::move(plan));
        write_pieces(session.folder(), pieces);
        report(session, run, pieces);
        if (session.plots()) draw(session, drawn, run, pieces);
    });
}
