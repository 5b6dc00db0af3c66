// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements.hpp"

#include "../breaking/element_frames.hpp"
#include <spam/external/clamp.hpp>
#include <spam/material/yielding_solid.hpp>
#include <spam/setup/meshes.hpp>

namespace tension_elements {
namespace {

void drive_end(ParticleModel<2>& model, double side, double speed) {
    auto end = select<2>(model.particles(), [&](const Point<2>& x) {
        return side * x.x() > model.particles().reference_position.row(0).maxCoeff() - 1e-9;
    });
    const Point<2> velocity(side * speed, 0.0);
    auto clamp = std::make_unique<Clamp<2>>(
        std::move(end), [velocity](double) { return velocity; },
        [](double) { return Point<2>(0.0, 0.0); });
    clamp->only_along(0);
    model.add(std::move(clamp));
}

/// Heights of the columns of nodes, from left to right.
Eigen::ArrayXd heights(const Parameters& p, const Model<2>& model, std::span<const double> y) {
    const auto x = ConstState<2>(model.layout(), y).position();
    Eigen::ArrayXd top(p.columns + 1), bottom(p.columns + 1);
    for (std::size_t k = 0; k < model.particles().size(); ++k) {
        const auto id = static_cast<int>(model.particles().id[k]);
        const int column = id % (p.columns + 1), row = id / (p.columns + 1);
        if (row == 0) bottom[column] = x(1, static_cast<Eigen::Index>(k));
        if (row == p.rows) top[column] = x(1, static_cast<Eigen::Index>(k));
    }
    return top - bottom;
}

}  // namespace

Bar make_bar(const Parameters& p) {
    const auto elastic = ElasticSolid::triangular_lattice();
    const double density = triangular_density, half = 0.5 * p.columns;
    Mesh mesh = rectangle_mesh(p.columns, p.rows);
    for (auto x : mesh.node.colwise()) x.y() *= 1.0 - p.taper * (1.0 - std::abs(x.x()) / half);
    MeshedBodies bodies = make_nodes({mesh}, density);
    Bar bar;
    bar.model = std::make_shared<ParticleModel<2>>(std::move(bodies.nodes));
    const YieldingSolid law(PlaneVonMises{elastic.lambda, elastic.eta},
                            LinearHardening{p.yield_stress, p.hardening},
                            Failure{.plastic_strain = p.failure_strain});
    bar.model->add_term<Elements>(std::move(bodies.element),
                                  std::vector<Elements::Material>{{law, density, p.hourglass}});
    for (const double side : {-1.0, 1.0}) drive_end(*bar.model, side, p.end_speed);
    bar.strain_rate = p.end_speed / half;
    bar.y0 = initial_state<2>(*bar.model, density, p.yield_stress, [&](const Point<2>& x) {
        return Point<2>(bar.strain_rate * x.x(), 0.0);
    });
    return bar;
}

Eigen::RowVectorXd plastic_strains(const Model<2>& model, std::span<const double> y) {
    return ConstState<2>(model.layout(), y).elements().field(field_kind::plastic_strain);
}

double neck(const Parameters& p, const Model<2>& model, std::span<const double> y) {
    Eigen::Index column = 0;
    heights(p, model, y).minCoeff(&column);
    return std::abs(static_cast<double>(column) - 0.5 * p.columns);
}

std::vector<Column<2>> columns_of(const Parameters& p) {
    using Y = std::span<const double>;
    return {{"largest_plastic_strain",
             [](const Model<2>& m, Y y) { return plastic_strains(m, y).maxCoeff(); }},
            {"mean_plastic_strain",
             [](const Model<2>& m, Y y) { return plastic_strains(m, y).mean(); }},
            {"neck", [p](const Model<2>& m, Y y) { return neck(p, m, y); }},
            {"neck_height", [p](const Model<2>& m, Y y) { return heights(p, m, y).minCoeff(); }},
            {"length",
             [](const Model<2>& m, Y y) {
                 const auto x = ConstState<2>(m.layout(), y).position().row(0);
                 return x.maxCoeff() - x.minCoeff();
             }},
            {"elements_broken",
             [](const Model<2>& m, Y y) { return static_cast<double>(elements_broken(m, y)); }}};
}

namespace {

/// The three states of the lecture's slide, whose nominal strains are .050, .075 and .100.
struct Known {
    double t, nominal, largest;
};
constexpr Known slide[] = {{32.0, 0.050, 0.048}, {48.0, 0.075, 0.081}, {64.0, 0.100, 0.113}};

/// At the row of that time; nothing where there is none.
std::optional<double> at(const History& h, const char* name, double t) {
    const auto times = h.column("t"), values = h.column(name);
    for (std::size_t k = 0; k < times.size(); ++k)
        if (std::abs(times[k] - t) < 1e-9) return values[k];
    return {};
}

void report(Session& session, const Parameters& p, const RunRecord& run, bool known) {
    const Findings findings(session);
    const History& h = run.history;
    for (const Known& one : slide) {
        const auto length = at(h, "length", one.t), strain = at(h, "largest_plastic_strain", one.t),
                   neck = at(h, "neck", one.t);
        if (!strain) continue;
        const auto name = [&](const char* what) { return fmt::format("{}_at_{:g}", what, one.t); };
        findings.claim(name("nominal_strain"), *length / p.columns - 1.0, one.nominal, 1e-3,
                       "[HH07] 13, slide", known);
        findings.claim(name("largest_plastic_strain"), *strain, one.largest, 0.006,
                       "another program with the same elements", known);
        findings.claim(name("neck"), *neck, 0.0, 3.0, "[HH07] 13: the neck is at the middle",
                       known);
    }
    findings.measure_last(h,
                          {"largest_plastic_strain", "mean_plastic_strain", "neck", "neck_height",
                           "length", "elements_broken"},
                          "at the end");
    findings.check_promises(run);
}

}  // namespace

void compute(Session& session, const Parameters& p, double t_end, bool known) {
    Bar bar = make_bar(p);
    Plan<2> plan;
    plan.t_end = t_end;
    plan.output_every = t_end / 128.0;
    plan.snapshot_every = t_end / 16.0;
    plan.record(columns_of(p));
    std::vector<NearestState<2>> drawn;
    for (const Known& one : slide) drawn.push_back({one.t / 64.0 * t_end});
    plan.observe(keep_nearest<2>(drawn, breaking::strains_of_elements));
    const auto run = session.run(*bar.model, bar.y0, std::move(plan));
    report(session, p, run, known);
    if (!session.plots()) return;
    std::vector<ConfigurationPanel> panels;
    for (const auto& state : drawn)
        if (state.there())
            panels.push_back(
                breaking::strain_panel(fmt::format("t = {:.4g}, drawn out by {:.3g} %", state.t,
                                                   100.0 * bar.strain_rate * state.t),
                                       *bar.model, state.position, state.values));
    draw_configurations(session, "configurations", "A bar of finite elements under tension", panels,
                        1, "plastic strain");
}

}  // namespace tension_elements
