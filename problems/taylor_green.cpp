// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: four vortices that decay in a periodic square: particles that keep their order; 20 s
//
// Taylor and Green's vortices (1937), exact at all times for a fluid that is not compressed.
//
//     +-----------------+      u = -U e^(-8 pi^2 nu t/L^2) cos(2 pi x/L) sin(2 pi y/L)
//     |  ->  ->  <-  <- |      v =  U e^(-8 pi^2 nu t/L^2) sin(2 pi x/L) cos(2 pi y/L)
//     |   o   o   o   o |
//     |  <-  <-  ->  -> |      Particles that move with v are drawn out into strings where the flow parts,
//     |   o   o   o   o |      and lose their order, their forces the meaning. Shifting (physics/
//     |  ->  ->  <-  <- |      shifting.hpp) lets them find places between each other.
//     +-----------------+
//
//     --left mirror --right mirror --bottom mirror --top mirror
//                        a quarter of a wave further the sides are planes of symmetry, and mirrors change
//                        nothing
#include "taylor_green/vortices.hpp"

using namespace spam;
using namespace taylor_green;

namespace {

Plan<2> plan_of(const Session& session, Flow& flow) {
    Plan<2> plan;
    plan.t_end = session.end(flow.exact.turn(), 0.02 * flow.exact.turn());
    plan.snapshot_every = plan.t_end / 20.0;
    if (flow.known) plan.observe(compare_with_exact(flow.exact));
    flow.drawn = states_at<2>({0.0, 0.2, 1.0}, plan.t_end);
    plan.observe(keep_nearest(flow.drawn));
    return plan;
}

/// Of e^(-rate t U/L), from the root of the kinetic energy at the end.
double decay_rate(const Flow& flow, const RunRecord& run) {
    const double t = run.history.last("t") / flow.exact.turn();
    return t > 0.0 ? -std::log(run.history.last("decay") / run.history.first("decay")) / t : 0.0;
}

void report(Session& session, const Parameters& p, const Flow& flow, const RunRecord& run) {
    const Findings findings(session, flow.prefix);
    findings.check_promises(run);
    if (!flow.known) return;
    const double exact = 8.0 * std::numbers::pi * std::numbers::pi / p.reynolds;
    const bool known = session.when_default(stirred::decisive_options()) && run.complete &&
                       session.when_default({"disorder"}) && flow.label != "plain" &&
                       flow.exact.L >= 50.0 && run.statistics.t_end >= 0.99 * flow.exact.turn();
    const std::string source = "Taylor and Green 1937";
    findings.claim("decay_rate", decay_rate(flow, run), exact, 0.03 * exact, source, known);
    findings.claim("velocity_error_half", run.history.at(0.5 * flow.exact.turn(), "velocity_error"),
                   0.0, 0.05, source, known);
    findings.claim("velocity_error", run.history.last("velocity_error"), 0.0, 0.05, source, known);
    findings.measure("largest_velocity_error", run.history.largest("velocity_error"));
}

/// One or three sizes; the one without shifting beside it.
std::vector<Flow> flows_of(const Parameters& p) {
    auto flows = by_size(p.cells, p.compare, [&](int cells) { return make_flow(p, cells); });
    if (p.compare || !p.shifted()) return flows;
    Parameters plain = p;
    plain.scheme.transport = Transport::plain;
    flows.push_back(make_flow(plain, p.cells));
    flows[0].call("shifting");
    flows[1].call("plain");
    return flows;
}

void run(Session& session, const Parameters& p) {
    std::vector<Flow> flows = flows_of(p);
    // Disorder goes away fast at first.
    session.prefer_step((p.disorder > 0.0 ? 0.25 : 1.0) *
                        stirred::step_of(p, flows.back().exact.nu, flows.back().model->box()));
    const auto runs = run_all(session, flows, [&](Flow& flow) { return plan_of(session, flow); });
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, flows[k], runs[k]);
    if (p.compare && flows.front().known)
        Findings(session).measure_orders(labels_of(flows), last_of(runs, "velocity_error"),
                                         "of the velocity error at the end");
    if (session.plots() && !runs.empty()) draw(session, p, flows, runs);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("taylor_green",
                    "four vortices decay in a periodic square, against the exact solution", 0.4,
                    stirred::step_words);
    problem.units(fluid_units());
    Parameters p;
    auto& options = problem.options();
    stirred::add_options(options, p, "largest speed at the start");
    const Sides sides(options, {"periodic", "periodic", "periodic", "periodic"},
                      {.temperatures = false, .remark = stirred::sides_remark});
    p.sides = &sides;
    options.number(
        "disorder", p.disorder,
        "largest random displacement of the particles from the square lattice, in spacings",
        between(0.0, 0.4));
    options.integer("seed", p.seed, "seed of the random displacements", between(0, 1000000000));
    options.only_when(
        {"seed"}, {"disorder"}, [&p] { return p.disorder > 0.0; },
        "has no meaning with {by}; it needs a disorder above 0");
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("cells", p.cells, 16);
        run(session, p);
    });
}
