// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: two elastic rings collide, deform and part: contact without adhesion; 10 s
//
// Two elastic rings of triangular lattice fly against each other.
//
//      . o o .    . o o .       Each ring is a body of its own: its particles sum over each other alone,
//    o o     o o o     o o      in the reference configuration (--formulation total_lagrangian) or as
//    o o  -> o o o <-  o o      they lie now (updated: continuity density, pair torques balanced,
//      ' o o '    ' o o '       artificial viscosity). Particles of different rings repel each other,
//
//         phi = e_c (1 - r^2/s^2)^4,   r < s <= 1   (rhs/contact.hpp)
//
// and feel nothing of each other once they are farther apart than s: rings that meet part again. Sums over
// both bodies alike would glue them together, because a stress between them can be a tension.
//
// Where the rings have parted, part of their kinetic energy is in vibrations: restitution is the speed at
// which the centres part by the one at which they met.
#include "breaking/pieces.hpp"
#include "solid_choice.hpp"

namespace {

using namespace spam;

struct Parameters : SolidChoice {
    Parameters() { usual_viscosity = 1.0; }

    double radius = 16.0, inner_radius = 12.0;
    double speed = 0.05;  // of each ring
    double offset = 0.0;
    double range = 3.0;
    ContactScheme contact{};

    /// How long they take, up to a factor: a ring bends in a time that grows like radius^2 by thickness, and
    /// goes its own radius.
    double time() const {
        return radius * radius / (radius - inner_radius) / 64.0 + radius / speed / 320.0;
    }
};

Points<2> ring(const Parameters& p) {
    const Points<2> disk = triangular_disk(p.radius);
    std::vector<Eigen::Index> kept;
    for (Eigen::Index k = 0; k < disk.cols(); ++k)
        if (disk.col(k).norm() >= p.inner_radius * (1.0 - 1e-12)) kept.push_back(k);
    return disk(Eigen::all, kept);
}

[[noreturn]] void refuse_no_ring(const Parameters& p) {
    refuse(
        "inner-radius: what is left of a disk of radius {:g} beyond {:g} is no ring; "
        "leave two spacings or more between the two",
        p.radius, p.inner_radius);
}

/// The left ring, and its mirror image: what the one loses on its way the other loses as well.
Particles<2> two_rings(const Parameters& p) {
    Points<2> left = ring(p);
    if (left.cols() == 0) refuse_no_ring(p);
    left.row(0).array() -= p.radius + 1.0;
    left.row(1).array() -= 0.5 * p.offset;
    const auto one = make_particles<2>(left, 1.0);
    auto other = one;
    other.reference_position = -one.reference_position;
    return joined<2>({one, other});
}

std::unique_ptr<ParticleModel<2>> make_model(const Parameters& p) {
    auto model = std::make_unique<ParticleModel<2>>(two_rings(p));
    if (model->particles().bodies() != 2) refuse_no_ring(p);
    const std::size_t n = model->particles().size() / 2;
    for (const std::size_t first : {std::size_t{0}, n})
        p.add_term(*model, first, n, ElasticSolid::triangular_lattice(), triangular_density,
                   p.range, {.angular_momentum = AngularMomentum::torque_pair});
    model->add_term<Contact<2>>(p.contact);
    return model;
}

/// From the centre of mass of the first ring to that of the second, and how fast it changes.
struct Centres {
    Point<2> r, v;
    Centres(const Model<2>& model, std::span<const double> y) {
        const ConstState<2> state(model.layout(), y);
        const Eigen::Index n = state.position().cols() / 2;
        const auto mean = [n](const auto& x) {
            return Point<2>(x.rightCols(n).rowwise().mean() - x.leftCols(n).rowwise().mean());
        };
        r = mean(state.position());
        v = mean(state.velocity());
    }
};

std::vector<Column<2>> columns(const Contact<2>& contact) {
    using State = std::span<const double>;
    return {
        {"separation", [](const Model<2>& m, State y) { return Centres(m, y).r.norm(); }},
        {"parting_speed",
         [](const Model<2>& m, State y) {
             const Centres centres(m, y);
             return 0.5 * centres.v.dot(centres.r.normalized());
         }},
        {"contact_energy", [&contact](const Model<2>&, State y) { return contact.energy(y); }},
        {"closest_contact", [&contact](const Model<2>&, State y) { return contact.closest(y); }},
        {"pieces", [](const Model<2>& m,
                      State y) { return static_cast<double>(breaking::piece_sizes(m, y).size()); }},
        closest_pair_column<2>()};
}

/// Time of the first row from which on no bodies touch; negative while they do.
double parted_at(const History& h) {
    const auto t = h.column("t"), energy = h.column("contact_energy");
    std::size_t k = energy.size();
    while (k > 0 && energy[k - 1] == 0.0) --k;
    return k == 0 || k == energy.size() ? -1.0 : t[k];
}

void report(Session& session, const RunRecord& run) {
    const Findings findings(session);
    const History& h = run.history;
    findings.claim("closest_contact", h.smallest("closest_contact"), 0.75, 0.25,
                   "no two particles of different rings nearer than half a spacing",
                   session.at_default({"contact-energy", "contact-range", "speed"}));
    const double parted = parted_at(h);
    const bool known =
        run.complete && run.statistics.t_end >= 600.0 &&
        session.when_default({"radius", "inner-radius", "speed", "offset", "formulation", "range",
                              "penalty", "viscosity", "contact-energy", "contact-range"});
    findings.claim("contact_energy_at_end", h.last("contact_energy"), 0.0, 0.0,
                   "contact does not hold on to anything", known);
    findings.claim("parting_speed", h.last("parting_speed"), 0.0394, 0.003,
                   "an independent program of the same equations", known);
    if (parted >= 0.0) {
        findings.measure("parted_at", parted);
        findings.measure("restitution", -h.last("parting_speed") / h.first("parting_speed"));
    }
    findings.measure("largest_contact_energy",
                     h.largest("contact_energy") / (h.first("kinetic") + h.first("internal")),
                     "by the energy at the start");
    findings.measure("smallest_separation", h.smallest("separation"));
    findings.measure("closest_pair", h.smallest("closest_pair"));
    findings.measure("pieces", h.last("pieces"),
                     "linked by pairs nearer than 1.5 spacings, at the end");
    findings.check_promises(run);
}

void draw(Session& session, const ParticleModel<2>& model,
          const std::vector<NearestState<2>>& drawn, const RunRecord& run) {
    std::vector<ConfigurationPanel> panels;
    for (const auto& state : drawn) {
        panels.push_back(speed_panel(fmt::format("t = {:.3g}", state.t), model, state));
        panels.back().outlines.clear();
    }
    const History& h = run.history;
    draw_configurations(session, "configurations", "Two elastic rings collide", panels, 2, "speed");
    draw_curves(session, "curves", "Two elastic rings collide",
                {over_time("", h, "distance of the centres", {{"", "separation"}}),
                 over_time("", h, "energy",
                           {{"kinetic", "kinetic"},
                            {"elastic and contact", "internal"},
                            {"contact", "contact_energy"}})});
}

void add_options(Options& options, Parameters& p) {
    options.number("radius", p.radius, "distance of the outermost particles from a ring's centre",
                   between(3.0, 1000.0));
    options.number("inner-radius", p.inner_radius, "distance of the innermost ones",
                   between(0.0, 1000.0));
    options.number("speed", p.speed, "speed of each ring at the start", between(1e-4, 2.0));
    options.number("offset", p.offset, "height of one centre above the other",
                   between(-2000.0, 2000.0));
    p.add_formulation_option(options);
    options.number("range", p.range, "distance at which the weight function vanishes",
                   between(1.1, 20.0));
    p.add_constants(options);
    add_contact_options(options, p.contact, "particles of different rings");
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("colliding_rings", "two elastic rings collide and part", 0.1,
                    "0.1, shorter where contact or speed need it");
    problem.units(lattice_units());
    Parameters p;
    add_options(problem.options(), p);
    return problem.main(argc, argv, [&](Session& session) {
        const bool smoke = session.common().smoke;
        Parameters usual;
        if (smoke) usual.radius = 6.0, usual.inner_radius = 3.5;
        if (!session.given("radius")) p.radius = usual.radius;
        if (!session.given("inner-radius")) p.inner_radius = usual.inner_radius;
        session.prefer_step(0.1 * relative_step(p.contact, {.energy = 0.3}) *
                            relative_step(p.speed, 0.25));
        const auto model = make_model(p);
        auto y0 = lattice_state(*model, [&](const Point<2>& x) {
            return Point<2>(x.x() < 0.0 ? p.speed : -p.speed, 0.0);
        });
        Plan<2> plan;
        plan.t_end =
            session.common().t_end.value_or((smoke ? 40.0 : 640.0) * (p.time() / usual.time()));
        plan.snapshot_every = plan.t_end / 20.0;
        plan.record(columns(*model->term<Contact<2>>()));
        auto drawn = states_at<2>({0.0, 0.2, 0.5, 1.0}, plan.t_end);
        plan.observe(keep_nearest<2>(drawn));
        const auto run = session.run<2>(*model, std::move(y0), std::move(plan));
        report(session, run);
        if (session.plots()) draw(session, *model, drawn, run);
    });
}
