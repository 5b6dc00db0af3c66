// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: Taylor's bar: a copper cylinder against a rigid wall, beside converged elements; 1 min on 2 cores
//
// Taylor's test: a cylinder of copper flies against a rigid wall without friction and keeps a foot.
//
//      ____                 Length 32.4 mm, radius 3.2 mm, 227 m/s; E = 117 GPa, nu = .35, 8930 kg/m^3, yield
//     |    | |              stress 0.4 GPa, hardening 0.1 GPa. After 80 us the bar is at rest. Converged finite
//     |    | v 227 m/s      elements: length 21.43 mm, radius of the foot 7.226 mm (Foulk and others 2021).
//     |____|
//    /////////              Smooth particles on a cubic lattice, sums over the neighbours of the start, and
//                           von Mises' surface in space at any deformation (logarithmic strain).
//
// The foot's edge converges slowly: the particles at the rim have neighbours on one side alone.
//
//     --compare    five, six and eight particles a radius, and the order at which the errors fall. 20 min
#include "common.hpp"
#include "taylor_bar/bar.hpp"

namespace taylor_bar {
namespace {

constexpr double known_length = 21.43, known_foot = 7.226;
const char* const elements = "converged finite elements (Foulk and others 2021)";

/// One measurement serves all columns of a row.
std::vector<Column<3>> columns_of(const std::shared_ptr<BarShape>& now) {
    const auto column = [&](const char* name, double BarShape::*of) {
        return Column<3>{
            name, [now, of](const Model<3>&, std::span<const double>) { return (*now).*of; }};
    };
    return {column("length", &BarShape::length), column("foot", &BarShape::foot),
            column("largest_plastic_strain", &BarShape::strain)};
}

struct Drawn {
    double t;
    Section section;
    void remember(Archive& archive) { archive(t, section.position, section.strain); }
};

Plan<3> plan_of(const Session& session, const Parameters& p, const Bar& bar,
                std::vector<Drawn>& drawn) {
    Plan<3> plan;
    const double slower = p.time() / Parameters{}.time();
    plan.t_end = session.end(80.0 * slower, 4.0 * slower);
    plan.output_every = plan.t_end / 80.0;
    plan.snapshot_every = plan.t_end / 4.0;
    const auto now = std::make_shared<BarShape>();
    plan.observe({.columns = columns_of(now),
                  .on_row = [now, &bar](double, const Model<3>&, std::span<const double> y) {
                      *now = shape_of(bar, y);
                  }});
    plan.observe({.on_snapshot =
                      [&bar, &drawn](double t, const Model<3>&, std::span<const double> y) {
                          drawn.push_back({t, section_of(bar, y)});
                      },
                  .memory = [&drawn](Archive& archive) { archive(drawn); }});
    return plan;
}

/// Whether it is the bar of the elements.
bool is_known(const Session& session, const RunRecord& run) {
    return session.when_default({"aspect", "radius", "speed", "young", "yield-stress", "hardening",
                                 "poisson", "density", "range", "penalty"}) &&
           run.complete && run.statistics.t_end >= 79.0;
}

void report(Session& session, const Bar& bar, const RunRecord& run) {
    const Findings findings(session, bar.prefix);
    const bool known = is_known(session, run) && bar.spacing <= 0.65;
    findings.claim("length", run.history.last("length"), known_length, 0.02 * known_length,
                   elements, known);
    findings.claim("foot", run.history.last("foot"), known_foot, 0.06 * known_foot, elements,
                   known);
    findings.measure("largest_plastic_strain", run.history.last("largest_plastic_strain"));
    findings.check("energy_change",
                   run.history.largest_change("energy") / run.history.first("energy"), 0.0, 1e-3,
                   "kinetic, elastic, the wall's and what flow takes");
    findings.check_promises(run);
}

void draw(Session& session, const std::vector<Drawn>& drawn, const RunRecord& run) {
    std::vector<ConfigurationPanel> panels;
    for (const Drawn& one : drawn)
        panels.push_back(
            {fmt::format("t = {:.3g} µs", one.t), one.section.position, one.section.strain, {}});
    draw_configurations(
        session, "plastic_strain",
        is_known(session, run)
            ? fmt::format(
                  "Taylor's bar, a section: length {:.2f} mm (elements {:.2f}), foot {:.2f} mm "
                  "(elements {:.2f})",
                  run.history.last("length"), known_length, run.history.last("foot"), known_foot)
            : fmt::format("Taylor's bar, a section: length {:.2f} mm, foot {:.2f} mm",
                          run.history.last("length"), run.history.last("foot")),
        panels, panels.size(), "plastic strain");
}

/// Errors of three sizes, and the order at which they fall.
void compare(Session& session, const std::vector<Bar>& bars, const std::vector<RunRecord>& runs) {
    for (const char* name : {"length", "foot"}) {
        const double known = std::string(name) == "length" ? known_length : known_foot;
        const auto error = [&](std::size_t k) {
            return std::abs(runs[k].history.last(name) - known) / known;
        };
        for (std::size_t k = 0; k < bars.size(); ++k)
            session.measure(fmt::format("{}_{}_error", bars[k].label, name), error(k), elements);
        const std::size_t last = bars.size() - 1;
        session.measure(
            fmt::format("{}_order", name),
            std::log(error(0) / error(last)) / std::log(bars[0].spacing / bars[last].spacing),
            "against particles a radius");
    }
}

void compute(Session& session, const Parameters& p) {
    std::vector<Bar> bars;
    if (p.compare)
        for (const int n : {5, 6, 8}) bars.push_back(make_bar(p, n));
    else
        bars.push_back(make_bar(p, p.particles_per_radius));
    session.prefer_step(bars.back().step());
    std::vector<std::vector<Drawn>> drawn(bars.size());
    const auto runs = run_all(session, bars, [&](const Bar& bar) {
        return plan_of(session, p, bar, drawn[static_cast<std::size_t>(&bar - bars.data())]);
    });
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, bars[k], runs[k]);
    if (runs.size() == bars.size() && p.compare && is_known(session, runs.back()))
        compare(session, bars, runs);
    if (session.plots() && runs.size() == bars.size()) draw(session, drawn.back(), runs.back());
}

}  // namespace
}  // namespace taylor_bar

int main(int argc, char** argv) {
    using namespace taylor_bar;
    Problem problem("taylor_bar", "a copper cylinder against a rigid wall", 0.05,
                    "0.4 spacings of the flattened bar by the speed of waves");
    problem.units({.length = "mm", .mass = "g", .time = "µs", .stress = "TPa", .energy = "kJ"});
    Parameters p;
    auto& options = problem.options();
    options.integer("particles-per-radius", p.particles_per_radius,
                    "particles from the axis to the rim", between(2, 40));
    options.number("radius", p.radius, "of the bar", between(1e-12, 1e12)).unit("mm");
    options.number("aspect", p.aspect, "length of the bar by its radius", between(2.0, 100.0));
    options.number("speed", p.speed, "of the bar", between(1.0, 1000.0)).unit("m/s");
    options.number("young", p.young, "Young's modulus", between(1e-30, 1e30)).unit("GPa");
    options.number("poisson", p.poisson, "Poisson's ratio", between(-0.9, 0.49));
    options.number("density", p.density, "of the bar", between(1e-30, 1e30)).unit("kg/m^3");
    options.number("yield-stress", p.yield_stress, "yield stress", between(1e-30, 1e30))
        .unit("GPa");
    options
        .number("hardening", p.hardening, "growth of the yield stress with plastic strain",
                between(0.0, 1e30))
        .unit("GPa");
    options.number("range", p.range, "range h of Lucy's weight function, in spacings",
                   between(1.2, 4.0));
    options.number("penalty", p.penalty, "penalty against zero-energy modes", between(0.0, 10.0));
    options.flag("compare", p.compare, "five, six and eight particles a radius, and the order");
    options.exclude("compare", {"particles-per-radius"},
                    "has no effect with {by} (five, six and eight); leave one out");
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("particles-per-radius", p.particles_per_radius, 2);
        compute(session, p);
    });
}
