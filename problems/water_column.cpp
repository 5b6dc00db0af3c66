// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a water column comes to rest, then collapses over a floor, [HH07] 11; 10 s
//
// A column of water collapses under gravity, [HH07] 11; a dam breaks.
//
//     |o o o o|               |                     W x 2.5 W particles of mass and spacing 1
//     |o o o o| relaxes under |                     between mirrors come to rest (friction gamma).
//     |o o o o| friction      |o o o                Then the wall on the right and the friction are
//     |o o o o|           ->  |o o o o o o o        taken away, and the column collapses over the
//     +-------+               +----------------     floor, which has no end.
//
//     m v_dot_i = -d Phi/d r_i - m g e_y [- m gamma v_i],   g (2.5 W) = 0.4
//     Phi = sum_i m e(rho_i) + s_g sum_i |grad rho_i|^2 + core;   rho_i = sum_j m w_ij
//     e = (rho - 1)^2/2,   P = rho^3 - rho^2: tension below the density 1
//
// At rest dP/dd = rho g at depth d below the surface, and so rho(d) = (2 + sqrt(1 + 6 g d))/3. It is the
// summed density that obeys it, the one that the pressure depends on: profile_error is the largest
// difference of its mean in horizontal slabs, less than the range below the surface left out. Where the
// surface is follows from the mass, which the floor carries: P(rho_floor) = g 2.5 W. mass_error is that
// of the number of particles in place of their summed density.
//
// The front is the particle farthest to the right (leading_percent: where the 1 % ahead of the others
// begin). Motion is chaotic: in 25 runs that relax for 176 to 224 (--samples 25) it is at 33.3 +- 0.2 for
// t = 40 and at 57.9 +- 0.7 for t = 80.
//
//     --compare       W, 2 W and 4 W: 640, 2,560 and 10,240 particles. With g and gamma halved and times
//                     doubled each time the flow is the same at t/W (g 2.5 W and the speed of sound are),
//                     but for the thin front, which gets farther. Means of 25 columns of 640 and of
//                     five of 2,560 are compared; 17 min. --t-end then ends all of them.
//     --aspect 2      the dam of Martin and Moyce 1952, whose fronts of water are then in the picture. At the
//                     end they are alike; before, this fluid is up to 17 % ahead: it is pushed together
//                     by its weight, and springs apart. --gravity 0.1 makes it stiffer: 7 %, 10 s
//     --model elements --mesh 80x64
//                     the column as plane finite elements that hold the fluid (rhs/elements.hpp): the density is the
//                     mass by the area of the corners, the stress -P 1. Floor and walls hold the nodes across
//                     them; along them they slide. At rest row k from the top has the pressure g dy (k - 1/2),
//                     dy the mass of a row by the width. What resists the hourglass takes hourglass_work from
//                     the motion, which counts as energy. The run ends at t = 2.5 W. With the width and the mesh
//                     below 1 min, pressures at rest to 4e-8
//     --model both    the two beside each other, as on the slide: with --width 40 --aspect 1.6 --cavitation 0.02
//                     80 x 64 elements that are twice as high as wide, and 2,560 particles. That the particles of the
//                     slide fill 40 x 64 as well is inferred from its mesh, dy = 2 dx = 1. --samples: means of
//                     several columns of particles; 3 min each
//     --left, --right, --bottom
//                     walls: mirrors, or rigid ones. The one on the right is taken away.
//     --cavitation P  the tension is P at most (text: "P > Pc -> P = Pc", where pressure is meant to be
//                     tension); the energy of the limited law is used, so that energy is still kept
#include "water_column/column.hpp"
#include <spam/problem/remake.hpp>

namespace {

using namespace water_column;

Plan<2> plan_of_rest(const Parameters& p, const FluidColumn& column) {
    Plan<2> plan;
    plan.t_end = column.relaxation_time;
    plan.output_every = plan.t_end / 250.0;
    plan.own_end = true;
    if (column.of_elements()) {
        plan.record(mesh_columns(p));
        return plan;
    }
    plan.record({{"centre_height",
                  [](const Model<2>& model, std::span<const double> y) {
                      return ConstState<2>(model.layout(), y).position().row(1).mean();
                  }},
                 closest_pair_column<2>()});
    return plan;
}

/// Elements are drawn out, and end where they would soon be turned inside out. Beside them particles as well.
Plan<2> plan_of_collapse(const Session& session, const Parameters& p, FluidColumn& column) {
    Plan<2> plan;
    const bool particles_alone = p.model == ColumnOf::particles;
    const double whole = particles_alone ? 6.25 : 2.5;
    plan.t_end = (session.common().smoke ? 1.0 : whole) * column.unit;
    plan.output_every = column.unit / 40.0;
    plan.snapshot_every = column.unit / 4.0;
    plan.record(column.of_elements() ? mesh_columns(p) : motion_columns(p.range));
    if (!column.of_elements() && !particles_alone) plan.record(compared_columns(p));
    column.drawn = particles_alone ? states_at<2>({0.0, 1.25, 2.5, 5.0}, column.unit)
                                   : states_at<2>({0.0, compared_times[0], compared_times[1], 2.5},
                                                  column.unit);
    plan.observe(keep_nearest(column.drawn));
    return plan;
}

/// The front of one column of 640 particles scatters by 1 %, and that of more particles by less, at eight times
/// the cost for each doubling of the width.
int samples_of(const Parameters& p, int refinement) {
    if (refinement == 4) return 1;
    return p.samples.value_or(!p.compare ? 1 : refinement == 1 ? 25 : 5);
}

std::vector<FluidColumn> make_columns(const Session& session, Parameters& p) {
    std::vector<FluidColumn> columns;
    for (const int refinement : {1, 2, 4}) {
        if (p.model == ColumnOf::elements || (refinement > 1 && !p.compare)) break;
        const int samples = samples_of(p, refinement);
        for (int sample = 0; sample < samples; ++sample) {
            columns.push_back(make_column(p, refinement, sample, session.common().dry_run));
            auto& column = columns.back();
            if (p.compare) column.prefix = fmt::format("{}_", column.width);
            if (p.model == ColumnOf::both) column.prefix = "particles_";
            if (sample > 0) column.prefix += fmt::format("sample_{}_", sample);
        }
    }
    if (p.model == ColumnOf::particles) return columns;
    columns.push_back(make_mesh_column(p, session.common().dry_run));
    if (p.model == ColumnOf::both) columns.back().prefix = "elements_";
    return columns;
}

void compute(Session& session, Parameters& p) {
    std::vector<FluidColumn> columns = make_columns(session, p);
    if (p.model == ColumnOf::elements) session.prefer_step(step_of(columns.back()));
    std::vector<Case<2>> cases;
    for (auto& column : columns) {
        const auto rest = [&column](const RunRecord& before) {
            return restated<2>(*column.between_walls, before.y, *column.released);
        };
        cases.push_back({column.between_walls, column.y0, plan_of_rest(p, column),
                         column.prefix + "relaxation"});
        cases.push_back({column.released,
                         {},
                         plan_of_collapse(session, p, column),
                         column.prefix + "collapse",
                         rest});
        if (p.model == ColumnOf::both && column.of_elements())
            for (const int k : {1, 2}) (cases.end() - k)->plan.step = step_of(column);
    }
    const auto runs = session.run_all(std::move(cases));  // fewer where they were stopped
    std::vector<Computed> computed;
    for (std::size_t k = 0; k < runs.size(); k += 2)
        computed.push_back(
            {&columns[k / 2], &runs[k], k + 1 < runs.size() ? &runs[k + 1] : nullptr});
    report(session, p, computed);
    if (session.plots()) draw(session, p, computed);
}

void refuse_impossible(const Parameters& p) {
    if (p.model == ColumnOf::elements) return;
    if (!(p.range > 1.0))
        refuse(
            "range: {:g} must lie above the particle spacing 1 (else no "
            "particle has a neighbour); 2 to 4 spacings are usual",
            p.range);
    if (!(p.range < p.width))
        refuse(
            "width: {} spacings must be more than the range {:g} of the weight "
            "function (a particle acts on one wall at a time, not through both); give a "
            "larger --width or a shorter --range",
            p.width, p.range);
    if (!(p.range < p.aspect * p.width))
        refuse(
            "aspect: a column of height {:g} (aspect times width) must be higher than "
            "the range {:g}; give a larger --aspect or --width",
            p.aspect * p.width, p.range);
    refuse_short_core(p.core, p.core_range, "--core 0");
}

void add_model_options(Options& options, Parameters& p, const std::vector<std::string>& sides) {
    options.choice<ColumnOf>(
        "model", p.model, {ColumnOf::particles, ColumnOf::elements, ColumnOf::both},
        "the column is of particles, of finite elements, or of both beside each other");
    options.text(
        "mesh", p.mesh,
        "elements across and up, as in 80x64 (default: twice as many across as W and one for "
        "each row of particles: dy = 2 dx = 1)");
    options.number("hourglass-viscosity", p.hourglass.viscosity,
                   "of what resists the hourglass, in parts of rho sqrt(A) c/4",
                   between(0.0, 100.0));
    options.number("hourglass-stiffness", p.hourglass.stiffness,
                   "of what resists the hourglass, in parts of rho c^2/4", between(0.0, 100.0));
    options.only_when(
        {"mesh", "hourglass-viscosity", "hourglass-stiffness"}, {"model"},
        [&p] { return p.model != ColumnOf::particles; },
        "has no meaning with {by}; give --model elements or both");
    options.only_when(
        {"compare"}, {"model"}, [&p] { return p.model == ColumnOf::particles; },
        "has no meaning with {by}: one column of elements is computed; leave it out");
    const auto particles = [&p] { return p.model != ColumnOf::elements; };
    options.only_when(
        {"surface-tension", "core", "core-range", "kernel", "range"}, {"model"}, particles,
        "has no meaning with {by}, which have no weight function and no fields of particles; leave it "
        "out, or give --model both");
    options.only_when({"samples"}, {"model"}, particles,
                      "has no meaning with {by}: one column of elements is computed; leave it out");
    options.only_when(sides, {"model"}, particles,
                      "has no meaning with {by}, whose nodes are guided along floor and walls; "
                      "leave it out");
}

constexpr const char* no_friction =
    "rubs, and forces from a potential feel nothing of the velocity of a wall";

void add_options(Options& options, Parameters& p) {
    options.integer("width", p.width, "W, particles from wall to wall", between(4, 400));
    options.number("aspect", p.aspect, "height of the column by its width", between(0.1, 10.0));
    options.number("gravity", p.gravity,
                   "g times the height of the column, by the square of the speed of sound",
                   between(0.01, 2.0));
    options.flag("compare", p.compare, "compute columns twice and four times as wide as well");
    options.integer(
        "samples", p.samples,
        "number of columns of each size. Motion is chaotic: all but the first rest for 1 % to "
        "12 % less or more time, and the mean of their fronts is reported. --compare computes the "
        "widest column once (default: 1; with --compare 25 of the narrowest and 5 of the next)",
        between(1, 25));
    options.number(
        "cavitation", p.cavitation,
        "largest tension that the fluid bears (default: that of the embedded atom, 4/27)",
        between(0.0, 0.148));
    options.number("surface-tension", p.surface_tension,
                   "strength s_g of the surface tension; 0 for none", between(0.0, 100.0));
    add_core_options(options, p.core, p.core_range, positive(), "1");
    options.number("damping", p.damping,
                   "rate of the friction that brings the column to rest, gamma (default: 1.6/W); "
                   "with --compare of the first column",
                   between(1e-6, 100.0));
    options.number(
        "relaxation-time", p.relaxation_time,
        "time in which it comes to rest (default: 12.5 W, of elements 20 W); with --compare of the first "
        "column",
        between(1e-3, 1e9));
    options.choice<Kernel>("kernel", p.kernel, all_kernels(), "weight function");
    options.number("range", p.range, "distance at which the weight function vanishes", positive());
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("water_column", "a column of water comes to rest and collapses, [HH07] 11",
                    0.025, "0.025, shorter with stiffer cores");
    problem.units(fluid_units());
    Parameters p;
    add_options(problem.options(), p);
    const SideOption wall("mirror",
                          {{SideKind::open, "lets the fluid out before it has come to rest"},
                           {SideKind::periodic, "leaves nothing that could collapse"},
                           {SideKind::no_slip, no_friction},
                           {SideKind::moving, no_friction}});
    const Sides sides(problem.options(), {wall, wall, wall, ""}, {.temperatures = false});
    p.sides = &sides;
    add_model_options(problem.options(), p, sides.names());
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("width", p.width, 8);
        session.smoke_default("relaxation-time", p.relaxation_time, 8.0);
        refuse_impossible(p);
        const Parameters usual;
        session.prefer_step(
            0.025 * std::min(relative_step({p.core, p.core_range}, {usual.core, usual.core_range}),
                             relative_step_of_strength(1.0 + p.surface_tension,
                                                       1.0 + usual.surface_tension)));
        compute(session, p);
    });
}
