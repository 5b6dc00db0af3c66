// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a plastic sheet is crushed between two walls, folds upon itself and is let go; 15 s
//
// A thin sheet of plastic metal between two rigid walls without friction.
//
//      | ooooooooooooooooooooooooo |          |    /\  /\    |      Total-Lagrangian smooth particles of a
//   -> | ooooooooooooooooooooooooo | <-   ->  |   /  \/  \   | <-   material that yields at any strain
//      | ooooooooooooooooooooooooo |          |  /        \  |      (material/hencky_solid.hpp). The walls
//                                                                   come in, turn back at --width, and go
// out again. The sheet buckles and folds, and what is folded touches: particles of the sheet that are
// farther apart than 2.5 spacings in the reference configuration repel each other by
//
//     phi = e_c (1 - r^2/s^2)^4,   r < s <= 1   (rhs/contact.hpp).
//
// The walls are external (external/rigid_wall.hpp): what they give is in the accounts, and p - impulse,
// L - angular impulse and E - work are kept through plastic flow and contact. E contains what has been spent
// on plastic flow. When the walls are gone no particles touch each other: folds that were pressed together do
// not stick.
#include "common.hpp"
#include <spam/external/rigid_wall.hpp>
#include <spam/material/hencky_solid.hpp>
#include <spam/rhs/total_lagrangian.hpp>

namespace {

using namespace spam;

const double rho = triangular_density, modulus = triangular_modulus;
constexpr double wall_energy = 0.2, wall_range = 0.7;

struct Parameters {
    int columns = 60, rows = 3;
    double speed = 0.04;  // of each wall
    double width = 10.0;
    double yield_stress = 0.02, hardening = 0.0;
    double amplitude = 0.001;
    double range = 3.0, penalty = 1.0;  // 0.1 lets neighbours meet in sharp folds
    ContactScheme contact{.energy = 0.3, .range = 1.0, .folds_beyond = 2.5};

    /// Half of the distance of the walls at the start: they touch no particle.
    double start() const { return 0.5 * columns + 0.5; }
    double turning_time() const { return (start() - 0.5 * width) / speed; }
    double half_width(double t) const { return 0.5 * width + speed * std::abs(turning_time() - t); }
    /// The walls have gone back by a third of their way.
    double t_end() const { return turning_time() + start() / 3.0 / speed; }
};

std::unique_ptr<ParticleModel<2>> make_model(const Parameters& p) {
    Points<2> x = triangular_block(p.columns, p.rows);
    x.colwise() -= 0.5 * (x.rowwise().minCoeff() + x.rowwise().maxCoeff()).eval();
    auto model = std::make_unique<ParticleModel<2>>(make_particles<2>(x, 1.0));
    model->add_term<TotalLagrangian<2>>(
        HenckySolid<PlaneVonMises>({modulus, modulus}, {p.yield_stress, p.hardening}),
        TotalLagrangianScheme{rho, p.range, p.penalty});
    model->add_term<Contact<2>>(p.contact);
    for (const double side : {1.0, -1.0})
        model->add(std::make_unique<RigidWall<2>>(
            Point<2>(side, 0.0), [p](double t) { return -p.half_width(t); }, wall_energy,
            wall_range));
    return model;
}

/// What decides to which side the sheet buckles, and that its halves are not alike.
VelocityField<2> slight_bend(const Parameters& p) {
    return [p](const Point<2>& x) {
        const double k = 2.0 * std::numbers::pi / p.columns;
        return Point<2>(0.0, p.amplitude * (std::cos(k * x.x()) + 0.5 * std::sin(2.0 * k * x.x())));
    };
}

double plastic_work(const Model<2>& model, std::span<const double> y) {
    return ConstState<2>(model.layout(), y).field(field_kind::plastic_work).sum() / rho;
}

std::vector<Column<2>> columns(const Contact<2>& contact) {
    using State = std::span<const double>;
    const auto extent = [](const Model<2>& m, State y, int axis) {
        const auto x = ConstState<2>(m.layout(), y).position().row(axis);
        return x.maxCoeff() - x.minCoeff();
    };
    return {
        {"length", [extent](const Model<2>& m, State y) { return extent(m, y, 0); }},
        {"height", [extent](const Model<2>& m, State y) { return extent(m, y, 1); }},
        {"plastic_work", plastic_work},
        {"contact_energy", [&contact](const Model<2>&, State y) { return contact.energy(y); }},
        {"closest_contact", [&contact](const Model<2>&, State y) { return contact.closest(y); }},
        closest_pair_column<2>()};
}

void report(Session& session, const Parameters& p, const RunRecord& run) {
    const Findings findings(session);
    const History& h = run.history;
    const bool crushed = run.complete && run.statistics.t_end >= p.turning_time();
    const bool released = run.complete && run.statistics.t_end >= 0.99 * p.t_end();
    const bool known =
        session.when_default({"columns", "rows", "speed", "width", "yield-stress", "hardening",
                              "amplitude", "range", "penalty", "contact-energy", "contact-range"});
    findings.claim("closest_contact", h.smallest("closest_contact"), 0.75, 0.25,
                   "no two particles that touch are nearer than half a spacing",
                   session.at_default({"contact-energy", "contact-range"}) && p.speed <= 0.08);
    if (crushed)
        findings.claim("touched", h.largest("contact_energy") > 0.0 ? 1.0 : 0.0, 1.0, 0.0,
                       "the sheet has folded upon itself", known);
    if (released)
        findings.claim("contact_energy_at_end", h.last("contact_energy"), 0.0, 0.0,
                       "contact does not hold on to anything", known);
    findings.check("energy_less_wall_work",
                   std::abs((h.last("energy") - h.last("work")) - h.first("energy")) /
                       std::max(h.largest("energy"), 1e-300),
                   0.0, 1e-3, "by the largest energy");
    findings.measure("largest_contact_energy", h.largest("contact_energy"));
    findings.measure("wall_work", h.last("work"));
    findings.measure("plastic_work", h.last("plastic_work"));
    findings.measure("shortest_length", h.smallest("length"));
    findings.measure("length", h.last("length"));
    findings.measure("height", h.last("height"));
    findings.measure("closest_pair", h.smallest("closest_pair"));
    findings.check_promises(run);
}

std::vector<double> plastic_strains(const Model<2>& model, std::span<const double> y) {
    const auto strain = ConstState<2>(model.layout(), y).field(field_kind::plastic_strain);
    return {strain.data(), strain.data() + strain.size()};
}

void draw(Session& session, const Parameters& p, const std::vector<NearestState<2>>& drawn,
          const RunRecord& run) {
    std::vector<ConfigurationPanel> panels;
    double last = -1.0;
    for (const auto& shape : drawn) {
        if (!(shape.t > last)) continue;  // a run that ended before its time
        last = shape.t;
        panels.push_back({fmt::format("t = {:.3g}", shape.t), shape.position, shape.values, {}});
        const double high = shape.position.row(1).maxCoeff() + 2.0,
                     low = shape.position.row(1).minCoeff() - 2.0, half = p.half_width(shape.t);
        for (const double side : {-1.0, 1.0})
            panels.back().outlines.push_back(
                rectangle({side * half, low}, {side * (half + 0.6), high}));
    }
    draw_configurations(session, "configurations", "A plastic sheet between two walls", panels, 3,
                        "plastic strain");
    draw_curves(session, "curves", "A plastic sheet between walls",
                {over_time("", run.history, "energy",
                           {{"work of the walls", "work"},
                            {"plastic work", "plastic_work"},
                            {"kinetic", "kinetic"},
                            {"contact", "contact_energy"}})});
}

void add_options(Options& options, Parameters& p) {
    options.integer("columns", p.columns, "particles along the sheet", between(10, 1000));
    options.integer("rows", p.rows, "layers of particles", between(2, 100));
    options.number("speed", p.speed, "speed of each wall", between(1e-4, 1.0));
    options.number("width", p.width, "distance of the walls where they turn back",
                   between(1.0, 1e4));
    options.number("yield-stress", p.yield_stress,
                   "stress difference at which the sheet yields; its moduli are 0.433",
                   between(1e-3, 1e6));
    options.number("hardening", p.hardening, "growth of the yield stress with plastic strain",
                   between(0.0, 1e3));
    options.number("amplitude", p.amplitude, "speed across the sheet at the start",
                   between(0.0, 1.0));
    options.number("range", p.range, "distance at which Lucy's weight function vanishes",
                   between(1.2, 6.0));
    options.number("penalty", p.penalty, "penalty kappa against zero-energy modes",
                   between(0.0, 100.0));
    add_contact_options(options, p.contact, "folds of the sheet");
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("crushed_sheet", "a plastic sheet crushed between two walls", 0.1,
                    "0.1, shorter with a stiffer contact");
    problem.units(lattice_units());
    Parameters p;
    add_options(problem.options(), p);
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("columns", p.columns, 24);
        session.smoke_default("rows", p.rows, 2);
        session.smoke_default("width", p.width, 5.0);
        session.smoke_default("speed", p.speed, 0.08);
        if (!(p.width < 2.0 * p.start()))
            refuse(
                "width: the walls begin {:g} apart and cannot come in to {:g}; give a smaller --width",
                2.0 * p.start(), p.width);
        session.prefer_step(0.1 * relative_step(p.contact, Parameters{}.contact));
        const auto model = make_model(p);
        auto y0 = initial_state<2>(*model, rho, p.yield_stress, slight_bend(p));
        model->layout().set_scale(Field::velocity, p.speed);
        Plan<2> plan;
        plan.t_end = session.common().t_end.value_or(p.t_end());
        plan.snapshot_every = plan.t_end / 40.0;
        plan.record(columns(*model->term<Contact<2>>()));
        auto drawn = states_at<2>({0.0, 0.4, 0.7, 0.9, 1.0}, p.turning_time());
        drawn.push_back({p.t_end()});
        plan.observe(keep_nearest<2>(drawn, plastic_strains));
        const auto run = session.run<2>(*model, std::move(y0), std::move(plan));
        report(session, p, run);
        if (session.plots()) draw(session, p, drawn, run);
    });
}
