// SPDX-License-Identifier: GPL-3.0-or-later
#include "vortices.hpp"

namespace taylor_green {

Point<2> ExactFlow::velocity(const Point<2>& x, double t) const {
    const double k = wave(), now = U * left(t);
    const double a = k * x[0] - quarter[0], b = k * x[1] - quarter[1];
    return {-now * std::cos(a) * std::sin(b), now * std::sin(a) * std::cos(b)};
}

double ExactFlow::pressure(const Point<2>& x, double t) const {
    const double k = wave(), now = U * left(t);
    const double a = k * x[0] - quarter[0], b = k * x[1] - quarter[1];
    return -0.25 * now * now * (std::cos(2.0 * a) + std::cos(2.0 * b));
}

Flow make_flow(const Parameters& p, int cells) {
    const double L = cells;
    const auto box = p.sides->box<2>(Point<2>::Zero(), Point<2>(L, L));
    auto model = stirred::make_model(p, cells, box, p.disorder, p.seed);
    Flow flow;
    flow.exact = {L, p.viscosity(cells), p.speed};
    for (const int a : {0, 1}) {
        if (box.periodic(a)) continue;
        flow.exact.quarter[a] = 0.5 * std::numbers::pi;
        for (const bool upper : {false, true})
            flow.known = flow.known && box.wall(a, upper).kind == WallKind::mirror;
    }
    flow.transport = to_string(p.scheme.transport);
    flow.title = p.compare ? fmt::format("{0} x {0}", cells) : flow.transport;
    const Points<2>& x = model->particles().reference_position;
    Points<2> v(2, x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i) v.col(i) = flow.exact.velocity(x.col(i), 0.0);
    // Moved particles carry the mean momentum of where they happen to be: they start without. Walls take it.
    for (const int a : {0, 1})
        if (box.periodic(a)) v.row(a).array() -= v.row(a).mean();
    flow.y0 = model->state(x, v);
    stirred::set_pressure(*model, flow.y0,
                          [&](const Point<2>& at) { return flow.exact.pressure(at, 0.0); });
    model->layout().set_scale(Field::velocity, p.speed);
    flow.model = std::move(model);
    return flow;
}

Observer<2> compare_with_exact(const ExactFlow& exact) {
    const auto now = std::make_shared<double>(0.0);
    const auto error = [exact, now](const Model<2>& model, std::span<const double> y) {
        const ConstState<2> state(model.layout(), y);
        double off = 0.0, size = 0.0;
        for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
            const Point<2> v = exact.velocity(state.position().col(i), *now);
            off += (state.velocity().col(i) - v).norm();
            size += v.norm();
        }
        return off / size;
    };
    // sum v^2 of the exact flow over its square, at mass one.
    const double start = exact.U * exact.L / std::numbers::sqrt2;
    const auto decay = [start](const Model<2>& model, std::span<const double> y) {
        return ConstState<2>(model.layout(), y).velocity().norm() / start;
    };
    return {.columns = {{"velocity_error", error}, {"decay", decay}},
            .on_row = [now](double t, const auto&, auto) { *now = t; }};
}

namespace {

/// Points: exact. Lines: each flow.
void draw_curves_of(Session& session, const Parameters& p, const std::vector<Flow>& flows,
                    const std::vector<RunRecord>& runs) {
    const ExactFlow& exact = flows.front().exact;
    CurvePanel energy = frame("", "t U/L", "kinetic energy by that at the start", true),
               error = frame("", "t U/L", "velocity error");
    Curve right{"exact", {}, {}, Mark::points, 1};
    for (int k = 0; k <= 20; ++k) {
        const double t = 0.05 * k * runs.front().statistics.t_end;
        add_point(right, t / exact.turn(), exact.left(t) * exact.left(t));
    }
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const auto t = divided(runs[k].history.column("t"), flows[k].exact.turn());
        auto decay = runs[k].history.column("decay");
        for (double& root : decay) root *= root;
        const int style = static_cast<int>(k) + 2;
        energy.curves.push_back({flows[k].title, t, decay, Mark::line, style});
        error.curves.push_back(
            {flows[k].title, t, runs[k].history.column("velocity_error"), Mark::line, style});
    }
    energy.curves.push_back(right);  // on top
    draw_curves(session, "decay", fmt::format("Taylor-Green vortices, Re = {:g}", p.reynolds),
                {energy, error});
}

}  // namespace

void draw(Session& session, const Parameters& p, const std::vector<Flow>& flows,
          const std::vector<RunRecord>& runs) {
    if (flows.front().known) draw_curves_of(session, p, flows, runs);
    if (p.compare) return;
    std::vector<ConfigurationPanel> panels;
    for (const Flow& flow : flows)
        for (NearestState<2> state : flow.drawn) {
            if (!state.there()) continue;
            state.position = flow.model->box().wrapped(state.position);
            panels.push_back(speed_panel(
                fmt::format("{}, t = {:.2f} L/U", flow.transport, state.t / flow.exact.turn()),
                *flow.model, state));
            panels.back().outlines.clear();
        }
    if (panels.empty()) return;
    draw_configurations(session, "configurations",
                        fmt::format("Taylor-Green vortices, {} particles, Re = {:g}",
                                    flows.front().model->particles().size(), p.reynolds),
                        panels, flows.front().drawn.size(), "speed");
}

}  // namespace taylor_green
