// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a plane blast in a cold gas against Sedov's exact solution, two resolutions; 2 min
//
// A strong explosion in the plane: energy 1 in a disc of hot particles in a cold gas at rest, of density 1.
//
//     +---------------+     A quarter of the plane; mirrors at its left and its lower edge are the planes of
//     | . . . . . . . |     symmetry. All particles have the same mass; the pressure of the hot ones is
//     | . . . . . . . |     --ratio times that of the others. The disc sweeps up the gas around it. Once that is
//     |: . . . . . . .|     much more than its own, radius, density, velocity and pressure are known (L. I. Sedov;
//     |: : . . . . . .|     Landau and Lifshitz, Fluid Mechanics, par. 106): R = xi_0 (E t^2/rho)^(1/4)
//     +---------------+     (blast/sedov.hpp).
//
// What was hot fills most of the blast in the end, as thin as a thirtieth of the gas around. So that its particles,
// whose range is fixed, still have neighbours there, they are lighter: --finer times as many in each direction.
// By the mean pressure of pairs (--work mean, the
// form of all texts) cold particles would do work that they have no heat for, and the run stops at once; by
// their own (the default) the energy is kept as exactly, and none becomes colder but by expanding.
#include "blast/gas.hpp"

namespace {

using namespace blast;

constexpr double last_radius = 0.8;  // the edges are at 1

std::vector<Column<2>> columns_of(const Gas& gas) {
    const auto& model = gas.model;
    const double cold = ConstState<2>(model->layout(), gas.y0).energy().minCoeff();
    return {{"front",
             [model](const Model<2>&, std::span<const double> y) {
                 const double r = front(*model, y);
                 return std::isfinite(r) ? r : 0.0;
             }},
            {"least_energy_ratio", [model, cold](const Model<2>&, std::span<const double> y) {
                 return ConstState<2>(model->layout(), y).energy().minCoeff() / cold;
             }}};
}

void report(Session& session, const Parameters& p, const Gas& gas, const RunRecord& run) {
    const Findings findings(session, gas.prefix);
    const double t = run.statistics.t_end, R = gas.radius(t);
    const bool known = session.when_default({"gamma", "radius", "finer", "viscosity", "density",
                                             "kernel", "range"}) &&
                       session.when_default(p.sides->names()) && p.scheme.work == Work::own &&
                       p.ratio >= 1e4 && run.complete && R > 0.6 && R < 0.9;
    // A weight that is steep at its edge may leave no peak to follow: no failure where nothing is claimed.
    const bool claimed = known && gas.cells >= 48;
    if (const double found = front(*gas.model, run.y); claimed || std::isfinite(found))
        findings.claim("front", found, R, 0.03 * R, "Sedov's exact solution", claimed);
    const Rings rings = rings_of(*gas.model, run.y);
    findings.measure("peak_density", *std::max_element(rings.density.begin(), rings.density.end()),
                     fmt::format("exact: {:.4g}", (p.gamma + 1.0) / (p.gamma - 1.0)));
    findings.measure("least_energy_ratio", run.history.smallest("least_energy_ratio"),
                     "of the coldest particle at any time, by that at the start");
    const auto& energy = *std::find_if(run.drifts.begin(), run.drifts.end(),
                                       [](const Drift& d) { return d.name == "energy"; });
    findings.claim("energy_change", energy.change, 0.0, 1e-9,
                   "both forms of the work keep it, the integrator to its accuracy",
                   known && !session.given("dt") && !session.given("integrator"));
    findings.check_promises(run);
}

/// Radii in all runs over time, and profiles at the end.
void draw(Session& session, const Parameters& p, const std::vector<Gas>& gases,
          const std::vector<RunRecord>& runs) {
    const double t = runs.back().statistics.t_end;
    const Gas& last = gases[runs.size() - 1];
    const double R = last.radius(t), D = 0.5 * R / t, g = p.gamma;
    std::vector<CurvePanel> panels{frame("", "t", "radius of the front"), frame("", "r", "density"),
                                   frame("", "r", "velocity"), frame("", "r", "pressure")};
    for (auto& panel : panels) panel.curves.push_back({"exact", {}, {}});
    for (int k = 0; k <= 400; ++k) {
        add_point(panels[0].curves[0], t * k / 400.0, last.radius(t * k / 400.0));
        const auto s = last.exact.at(k / 400.0);
        const double scale[] = {(g + 1.0) / (g - 1.0) * s.density, 2.0 / (g + 1.0) * D * s.velocity,
                                2.0 / (g + 1.0) * D * D * s.pressure};
        for (std::size_t q = 0; q < 3; ++q)
            add_point(panels[q + 1].curves[0], R * k / 400.0, scale[q]);
    }
    for (std::size_t q = 0; q < 3; ++q)  // the shock, and the gas before it
        for (const double r : {R, 1.0}) add_point(panels[q + 1].curves[0], r, q == 0 ? 1.0 : 0.0);
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const Rings rings = rings_of(*gases[k].model, runs[k].y);
        const std::vector<double>* const found[] = {&rings.density, &rings.velocity,
                                                    &rings.pressure};
        const auto name = fmt::format("{0} x {0} particles", gases[k].cells);
        const int style = static_cast<int>(k) + 2;
        auto front = runs[k].history.column("front");
        for (double& r : front)
            if (r == 0.0) r = std::nan("");
        panels[0].curves.push_back({name, runs[k].history.column("t"), front, Mark::points, style});
        for (std::size_t q = 0; q < 3; ++q)
            panels[q + 1].curves.push_back({name, rings.r, *found[q], Mark::points, style});
    }
    const auto title =
        fmt::format("A plane blast, γ = {:g}, pressures {:g} : 1, at t = {:.3g}", g, p.ratio, t);
    draw_curves(session, "profiles", title, panels);
    const ConstState<2> state(last.model->layout(), runs.back().y);
    draw_configurations(session, "density", title,
                        {{fmt::format("{0} x {0} particles", last.cells),
                          state.position(),
                          last.model->density(runs.back().y),
                          {}}},
                        1, "density");
}

void run(Session& session, const Parameters& p) {
    std::vector<Gas> gases;
    for (const int cells : {p.cells, 2 * p.cells}) {
        gases.push_back(make_gas(p, cells, session.common().dry_run));
        if (p.single) break;
        gases.back().call(fmt::format("{}", cells));
    }
    session.prefer_step(p.step(gases.back().cells));
    const auto runs = run_all(session, gases, [&](const Gas& gas) {
        Plan<2> plan;
        plan.t_end = session.end(gas.time(last_radius), gas.time(2.0 * p.radius));
        if (!gas.y0.empty()) plan.record(columns_of(gas));
        return plan;
    });
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, gases[k], runs[k]);
    if (session.plots() && !runs.empty()) draw(session, p, gases, runs);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("blast", "a plane blast against Sedov's exact solution", 0.001,
                    "0.05 spacings by the speed of sound in the hot gas");
    problem.units(reduced_units("the edge of the quarter, the density of the gas and the energy"));
    Parameters p;
    auto& options = problem.options();
    options.integer("cells", p.cells, "particles along an edge of the quarter that is computed",
                    between(16, 4000));
    options.number("ratio", p.ratio, "pressure of the hot disc by that of the cold gas",
                   between(1.0, 1e12));
    options.integer("finer", p.finer,
                    "hot particles in place of one, in each direction: so much lighter are they",
                    between(1, 8));
    options.number("radius", p.radius, "radius of the hot disc; the edge is 1", between(0.02, 0.4));
    options.number("gamma", p.gamma, "ratio of the heat capacities", between(1.05, 5.0));
    options.number("viscosity", p.scheme.viscosity, "coefficient alpha of the artificial viscosity",
                   non_negative());
    add_density_option(options, p.scheme.density);
    options.choice<Work>(
        "work", p.scheme.work, {Work::mean, Work::own},
        "what changes a particle's energy: work by the mean pressure of each pair, or by "
        "its own");
    const SideOption side("mirror",
                          {{SideKind::periodic, "would bring the blast back from the other side"}});
    const Sides sides(options, {side, side, side, side}, {.temperatures = false});
    p.sides = &sides;
    options.choice<Kernel>("kernel", p.scheme.kernel, all_kernels(), "weight function");
    options.number("range", p.scheme.range, "range h of the weight function, in spacings",
                   between(1.2, 12.0));
    options.flag("single", p.single,
                 "compute this number of particles only, not four times as many");
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("cells", p.cells, 16);
        run(session, p);
    });
}
