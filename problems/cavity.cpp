// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a cavity whose lid moves, until the flow is steady: Ghia's profile; 20 s
//
// The flow in a square under a lid that moves, from rest until it is steady. It is not known in closed form;
// the usual reference is the multigrid computation of Ghia, Ghia and Shin (1982). Their table is up to 0.005 off
// what finer grids converge to (Marchi, Suero and Araki 2009), by which orders are measured.
//
//      ============= -> U       All four sides are no-slip walls: images of the particles behind them move with
//     |  ->  ->  ->  |          2 V - v. One vortex fills the square, its centre near the lid. Particles are
//     |  ^   o   |   |          stirred for ten turns and more; shifting (physics/shifting.hpp) keeps their
//     |  |       v   |          order. With v alone and the continuity equation the run does not survive.
//     |  <-  <-  <-  |
//      ==============           at rest
#include "cavity/centre_line.hpp"
#include "taylor_green/stirred_fluid.hpp"

using namespace spam;
using namespace cavity;
using stirred::Parameters;

namespace {

/// Until the end, L/U each: after ten the flow is steady but for some .004 of noise.
constexpr double turns = 12.0;

struct Flow : Variant<2> {
    double L = 0.0, speed = 0.0;
    bool ghias = false;  ///< it is the flow of Ghia, Ghia and Shin
    std::shared_ptr<CentreLine> line{};

    double turn() const { return L / speed; }
};

/// Whether the fluid sticks to all sides, of which the upper one alone moves.
bool under_a_lid(const Box<2>& box, double speed) {
    bool sticks = true;
    for (const int a : {0, 1})
        for (const bool upper : {false, true}) {
            const Wall<2>& wall = box.wall(a, upper);
            const Point<2> V(a == 1 && upper ? speed : 0.0, 0.0);
            sticks = sticks && wall.kind == WallKind::no_slip && wall.velocity == V;
        }
    return sticks;
}

Flow make_flow(const Parameters& p, int cells, bool only_described) {
    const double L = cells;
    const auto box = p.sides->box<2>(Point<2>::Zero(), Point<2>(L, L),
                                     {{"moving", fmt::format("moving:{}", p.speed)}});
    auto model = stirred::make_model(p, cells, box);
    Flow flow;
    flow.L = L;
    flow.speed = p.speed;
    flow.ghias = p.reynolds == 100.0 && under_a_lid(box, p.speed);
    if (!only_described) {
        const Points<2>& x = model->particles().reference_position;
        flow.y0 = model->state(x, Points<2>::Zero(2, x.cols()));
        stirred::set_pressure(*model, flow.y0, [](const Point<2>&) { return 0.0; });
    }
    model->layout().set_scale(Field::velocity, p.speed);
    flow.model = std::move(model);
    return flow;
}

/// Kinetic energy by that of all particles moving with the lid.
Column<2> stirred_column(double speed) {
    return {"stirred", [speed](const Model<2>& model, std::span<const double> y) {
                const auto v = ConstState<2>(model.layout(), y).velocity();
                return v.squaredNorm() / (speed * speed * static_cast<double>(v.cols()));
            }};
}

Plan<2> plan_of(const Session& session, const Parameters& p, Flow& flow) {
    Plan<2> plan;
    plan.t_end = session.end(turns * flow.turn(), 0.05 * flow.turn());
    plan.snapshot_every = plan.t_end / 10.0;
    plan.output_every = plan.t_end / 100.0;
    plan.record({stirred_column(p.speed)});
    // The mean over the last sixth: what is left of disorder comes and goes.
    flow.line =
        std::make_shared<CentreLine>(p.scheme, flow.L, p.speed, (5.0 / 6.0 - 1e-9) * plan.t_end);
    plan.observe(flow.line->observer(flow.ghias));
    flow.drawn = states_at<2>({0.1, 1.0}, plan.t_end);
    plan.observe(keep_nearest(flow.drawn));
    return plan;
}

/// Mean force of a wall over the last sixth of the run, by U^2 L.
double drag(const Flow& flow, const RunRecord& run, const std::string& impulse) {
    return run.history.mean_rate(impulse, 5.0 / 6.0) / (flow.speed * flow.speed * flow.L);
}

void report(Session& session, const Flow& flow, const RunRecord& run) {
    const Findings findings(session, flow.prefix);
    const bool known = session.when_default(stirred::decisive_options()) && flow.ghias &&
                       run.complete && flow.L >= 40.0 &&
                       run.statistics.t_end >= 0.99 * turns * flow.turn();
    if (flow.ghias) {
        const auto u = flow.line->mean();
        for (std::size_t k = 0; k < ghia().size(); ++k)
            findings.claim(fmt::format("u_at_{:.4f}", ghia()[k].y), u[k], ghia()[k].u, 0.03,
                           "Ghia, Ghia and Shin 1982", known);
        findings.measure("off_ghia", CentreLine::off_ghia(u), "the largest of these differences");
        findings.claim("off_converged", CentreLine::off_converged(u), 0.0, 0.015,
                       "largest difference, Marchi, Suero and Araki 2009", known);
    }
    findings.measure("stirred", run.history.last("stirred"), "v^2/U^2 in the mean");
    for (const bool upper : {false, true})
        if (const std::string side = Sides::name(1, upper);
            run.complete && !flow.model->box().wall(1, upper).open())
            findings.measure("drag_" + side, drag(flow, run, "impulse_" + side + "_x"),
                             "force along x by that wall, by U^2 L, over the last sixth");
    findings.measure("reflections", static_cast<double>(flow.model->reflections()),
                     "particles that crossed a wall");
    findings.check_promises(run);
}

void draw_profiles(Session& session, const Parameters& p, const std::vector<Flow>& flows,
                   const std::vector<RunRecord>& runs) {
    CurvePanel panel{"", "u/U at x = L/2", "y/L", false, {}};
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const auto [heights, u] = flows[k].line->profile();
        panel.curves.push_back({fmt::format("{0} x {0}", flows[k].L), u, heights, Mark::line,
                                static_cast<int>(k) + 2});
    }
    if (flows.front().ghias) {
        Curve points{"Ghia et al.", {}, {}, Mark::points, 1};
        for (const auto& [y, u] : ghia()) add_point(points, u, y);
        panel.curves.push_back(points);
    }
    draw_curves(session, "profile",
                fmt::format("Lid-driven cavity, Re = {:g}, t = {:.3g} L/U", p.reynolds,
                            runs.back().statistics.t_end / flows.back().turn()),
                {panel});
}

void draw(Session& session, const Parameters& p, const std::vector<Flow>& flows,
          const std::vector<RunRecord>& runs) {
    draw_profiles(session, p, flows, runs);
    const Flow& flow = flows[runs.size() / 2];
    std::vector<ConfigurationPanel> panels;
    for (const auto& state : flow.drawn)
        if (state.there()) {
            panels.push_back(speed_panel(fmt::format("t = {:.3g} L/U", state.t / flow.turn()),
                                         *flow.model, state));
            panels.back().outlines = {rectangle({0.0, 0.0}, {flow.L, flow.L})};
        }
    if (!panels.empty())
        draw_configurations(session, "configurations",
                            fmt::format("Lid-driven cavity, {} particles, Re = {:g}",
                                        flow.model->particles().size(), p.reynolds),
                            panels, panels.size(), "speed");
}

void run(Session& session, const Parameters& p) {
    auto flows = by_size(p.cells, p.compare,
                         [&](int cells) { return make_flow(p, cells, session.common().dry_run); });
    const int most = static_cast<int>(flows.back().L);
    session.prefer_step(stirred::step_of(p, p.viscosity(most), flows.back().model->box()));
    const auto runs =
        run_all(session, flows, [&](Flow& flow) { return plan_of(session, p, flow); });
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, flows[k], runs[k]);
    if (flows.front().ghias)
        for (std::size_t k = 1; k < runs.size(); ++k) {
            const auto fine = flows[k].line->mean(), coarse = flows[k - 1].line->mean();
            const std::string both = fmt::format("{}_to_{}", flows[k - 1].label, flows[k].label);
            session.measure("order_" + both,
                            std::log2(CentreLine::off_ghia(coarse) / CentreLine::off_ghia(fine)),
                            "of the difference from Ghia's profile");
            session.measure(
                "order_of_converged_" + both,
                std::log2(CentreLine::off_converged(coarse) / CentreLine::off_converged(fine)),
                "of off_converged");
        }
    if (session.plots() && !runs.empty()) draw(session, p, flows, runs);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("cavity", "flow in a square under a moving lid, against Ghia, Ghia and Shin",
                    0.4, stirred::step_words);
    problem.units(fluid_units());
    Parameters p;
    p.cells = 40;
    // Images move with 2 V - v but stand where mirrors put them: by continuity densities drift there.
    p.scheme.density = Density::summed;
    stirred::add_options(problem.options(), p, "speed of the lid");
    const Sides sides(problem.options(), {"no-slip", "no-slip", "no-slip", "moving"},
                      {.temperatures = false,
                       .own = "moving",
                       .stands_for = "V is --speed",
                       .remark = stirred::sides_remark});
    p.sides = &sides;
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("cells", p.cells, 12);
        run(session, p);
    });
}
