// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: fields of molecules: their momentum is balanced at every place, their temperature is too low; 15 s
//
// Molecules, phi = (2 - r^2)^8 - 2 (2 - r^2)^4, seen as a continuum with a weight function w of smooth particles
// (Hardy, J. Chem. Phys. 76, 622, 1982; diagnostics/molecular_fields.hpp):
//
//     rho = sum m w_i,   rho u = sum m v_i w_i,   P = sum m (v_i - u) (v_i - u) w_i + sum_{i<j} r_ij F_ij B_ij
//
// with the bond function B_ij, the mean of w along the line from i to j.
//
//       i ~~~~~ j      d(rho u)/dt + div(rho u u + P) = 0 at every place and time. Half of each bond at each of its
//          . r         molecules, which is right in the mean over space, misses by a tenth of d(rho u)/dt
//
// balance_error and halves_error are what is left at 100 random places: the largest, and the root of the mean square,
// both by the root of the mean square of d(rho u)/dt. That one is exact, by accelerations; the divergence is found by
// differences, extrapolated.
//
//     --system fluid   cells x cells molecules at density 1 in a periodic box, hot enough not to condense. Of few
//                      molecules the mean velocity u takes a part in their fluctuations: the temperature
//                      sum m (v_i - u)^2 w_i/(2 sum w_i) is too low by the part sum w^2/(sum w)^2 of the true one, by
//                      integrals 0.834/range^2 with Lucy's function: 0.0926, 0.0521 and 0.0232 at ranges 3, 4, 6.
//                      mean_temperature_3 and the like are means over time and, by density, over 256 places, by the
//                      true temperature. Long waves forget their velocities late: all are drawn anew 40 times, with
//                      the kinetic energy that there is, and errors are those of the mean of sixteen parts of the time
//     --system impact  two round crystals of `radius` meet at the relative speed `speed`, the middle of one `offset`
//                      beside that of the other. The speed of sound is 12
//
// Without --system both.
#include "md_fields/molecules.hpp"
#include <spam/rhs/pair_potentials.hpp>

namespace md_fields {
namespace {

Molecules make_fluid(const Parameters& p) {
    const auto side = static_cast<double>(p.cells);
    const Box<2> box({side, side});
    Molecules fluid{{}, System::fluid};
    fluid.model = std::make_shared<ParticleModel<2>>(
        one_body(make_particles<2>(square_lattice<2>({p.cells, p.cells}), 1.0, 1.0, box)), box);
    fluid.model->add_term<Cohesion<2>>();
    fluid.y0 = initial_state<2>(*fluid.model, 1.0, 1.0, at_rest<2>());
    Points<2> v = Points<2>::Zero(2, p.cells * p.cells);
    displace<2>(v, std::sqrt(3.0 * p.temperature), p.seed);
    const State<2> state(fluid.model->layout(), fluid.y0);
    state.velocity() = centred<2>(v);
    fluid.model->layout().set_scale(Field::velocity, 1.0);
    return fluid;
}

Molecules make_impact(const Parameters& p) {
    Molecules impact{{}, System::impact};
    const Points<2> disk = triangular_disk(p.radius);
    Points<2> left = disk, right = disk;
    const Point<2> apart(p.radius + 1.0, 0.5 * p.offset);
    left.colwise() -= apart;
    right.colwise() += apart;
    const auto particles = joined<2>(
        {one_body(make_particles<2>(left, 1.0)), one_body(make_particles<2>(right, 1.0))});
    impact.model = std::make_shared<ParticleModel<2>>(particles);
    impact.model->add_term<Cohesion<2>>();
    impact.y0 = initial_state<2>(*impact.model, triangular_density, 1.0, [&](const Point<2>& x) {
        return Point<2>(x.x() < 0.0 ? 0.5 * p.speed : -0.5 * p.speed, 0.0);
    });
    return impact;
}

/// Molecules, density, temperature and pressure, time by time.
void draw_fields(Session& session, const Molecules& one, const Parameters& p) {
    std::vector<ContourPanel> panels;
    const Point<2> corner(2.0 * p.radius + 4.0, p.radius + 0.5 * p.offset + 6.0);
    const auto grid = FieldGrid<2>::between(-corner, corner, 0.5);
    const Points<2> nodes = grid.points();
    std::vector<double> y(one.y0.size());
    for (const auto& seen : one.drawn) {
        if (!seen.there()) continue;
        const State<2> state(one.model->layout(), y);
        state.position() = seen.position;
        state.velocity() = seen.velocity;
        const auto values = MolecularFields<2>(p.weight(), *one.model, y).at(nodes);
        const auto add = [&](double low, double high, const char* label, const auto& value) {
            ContourPanel panel{
                .title = "", .grid = grid, .values = {}, .periodic = false, .particles = {}};
            panel.colours = ContourPanel::Colours{low, high, label};
            for (Eigen::Index k = 0; k < nodes.cols(); ++k)
                panel.values.push_back(values.density(k) > 0.3 ? value(k) : std::nan(""));
            panels.push_back(std::move(panel));
        };
        panels.push_back({.title = "",
                          .side = fmt::format("t = {:.3g}", seen.t),
                          .particles = seen.position,
                          .dot = 0.8});
        add(0.0, 1.4, "density", [&](auto k) { return values.density(k); });
        add(0.0, 3.0, "temperature", [&](auto k) { return values.temperature(k); });
        add(-10.0, 50.0, "pressure",
            [&](auto k) { return 0.5 * (values.pressure(0, k) + values.pressure(1, k)); });
    }
    if (!panels.empty())
        draw_contours(session, "fields",
                      fmt::format("Two crystals of {} molecules meet: fields of range {:g}",
                                  one.y0.size() / 8, p.range),
                      panels, 4, {-corner, corner});
}

void compute(Session& session, const Parameters& p) {
    std::vector<Molecules> all;
    const bool single = session.given("system");
    for (const System system : {System::fluid, System::impact}) {
        if (single && system != p.system) continue;
        all.push_back(system == System::fluid ? make_fluid(p) : make_impact(p));
        if (!single) all.back().call(std::string(to_string(system)));
    }
    const auto runs = run_all(session, all, [&](Molecules& one) {
        Plan<2> plan;
        if (one.system == System::fluid) {
            plan.t_end = session.end(72.0, 2.0);
            plan.output_every = plan.t_end / (session.common().smoke ? 20.0 : 480.0);
            plan.record(columns_of(one, p));
            plan.observe(draw_velocities(one, p.seed, plan.t_end / 40.0));
        } else {
            plan.t_end = session.end(6.0, 0.5);
            plan.snapshot_every = plan.t_end / 24.0;
            one.drawn = states_at<2>({0.125, 0.25, 0.5}, plan.t_end);
            plan.observe(keep_nearest<2>(one.drawn));
        }
        return plan;
    });
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const Findings findings(session, all[k].prefix);
        findings.check_promises(runs[k]);
        const bool fluid = all[k].system == System::fluid;
        const bool known = fluid && runs[k].complete &&
                           session.when_default({"cells", "temperature", "kernel", "t-end"});
        report_balance(findings, all[k], p, runs[k], known && p.range == 3.0);
        if (fluid) report_temperature(findings, runs[k], known);
        if (session.plots())
            fluid ? draw_balance(session, all[k], p, runs[k]) : draw_fields(session, all[k], p);
    }
}

}  // namespace
}  // namespace md_fields

int main(int argc, char** argv) {
    using namespace md_fields;
    Problem problem("md_fields", "fields of molecules by a weight function", 0.001);
    problem.units(spam::reduced_units(
        "the mass of a molecule, the distance of two at rest and the energy that parts them"));
    Parameters p;
    auto& options = problem.options();
    options.choice<System>(
        "system", p.system, {System::fluid, System::impact},
        "molecules in a periodic box, or two crystals that meet (default: both)");
    options.only_when({"system"}, {}, [&] { return options.given("system"); }, {});
    const auto is = [&](System system) {
        return [&options, &p, system] { return !options.given("system") || p.system == system; };
    };
    options.integer("cells", p.cells, "cells x cells molecules in the box", between(13, 500));
    options.number("temperature", p.temperature, "of the box at the start", between(1.0, 100.0));
    options.only_when({"cells", "temperature"}, {"system"}, is(System::fluid),
                      "has no meaning with {by}, which has no box; leave it out");
    options.number("radius", p.radius, "of the crystals", between(2.0, 200.0));
    options.number("speed", p.speed, "at which they meet", between(0.1, 40.0));
    options.number("offset", p.offset, "of their middles across the way, below twice the radius",
                   between(0.0, 400.0));
    options.only_when({"radius", "speed", "offset"}, {"system"}, is(System::impact),
                      "has no meaning with {by}, where no crystals meet; leave it out");
    options.choice<Kernel>("kernel", p.kernel, all_kernels(), "weight function of the fields");
    options.number("range", p.range,
                   "its range, of pictures and balances; that of temperatures is 3, 4 and 6",
                   between(1.0, 6.0));
    options.integer("seed", p.seed, "seed of the first velocities, and of random places",
                    between(0, 1000000000));
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("cells", p.cells, 14);
        session.smoke_default("radius", p.radius, 5.0);
        session.smoke_default("offset", p.offset, 4.0);
        if (p.offset >= 2.0 * p.radius && !(session.given("system") && p.system == System::fluid))
            refuse(
                "offset: {:g} is not below twice the radius {:g}, so that the crystals never meet",
                p.offset, p.radius);
        compute(session, p);
    });
}
