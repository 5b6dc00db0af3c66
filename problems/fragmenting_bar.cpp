// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a bar hit by a projectile breaks into pieces, each conserving its angular momentum; 20 s
//
// A bar is hit by a projectile, [HHM04] IX: the case that "local conservation of angular momentum is
// necessary" for.
//
//          | o o |
//          | o o |
//    ooo   | o o |         bar: columns x rows of triangular lattice, at rest
//   ooooo ->| o o |         projectile: a hexagon, at `speed`, `offset` above the middle
//    ooo   | o o |
//          | o o |         both elastic, the same material
//
// Bodies are connected parts within the range of the weight function: they do not act on each other.
// They are found anew at every row of invariants.csv; projectile and bar become one when they meet,
// and pieces that part have their own torque balance from then on. bodies.csv accounts for mass,
// momentum, energy and every body's angular momentum through every change.
//
//     --formulation material_vectors   a solid that yields and tears (problem pierced_bar), in which there is
//                                      nothing to balance; --stretch-limit and --stress-limit break its bonds
//     --compare                        that beside plain velocities, ⟨v⟩_Monaghan, and balanced torques
#include "breaking/pieces.hpp"
#include "fragmenting_bar/account.hpp"

namespace fragmenting_bar {
namespace {

void add_options(Problem& problem, Parameters& p) {
    Options& options = problem.options();
    add_target_options(options, p.target);
    problem.use_scheme({.transport = Transport::monaghan,
                        .angular_momentum = AngularMomentum::torque_pair,
                        .viscosity = 1.0});
    options.choice<Formulation>(
        "formulation", p.formulation, {Formulation::updated, Formulation::material_vectors},
        "an elastic solid that sums over the present neighbours, or one that flows and remembers a "
        "vector for each of them");
    options.flag("compare", p.compare, "compute four schemes, one after the other");
    breaking::add_flowing_options(options, p.flowing);

    auto of_scheme = Problem::scheme_option_names();
    of_scheme.emplace_back("formulation");
    auto excluded = of_scheme;
    std::erase(excluded, "viscosity");
    options.exclude("compare", excluded,
                    "has no effect with {by}, which has four schemes; leave one out");
    std::erase(of_scheme, "formulation");
    of_scheme.emplace_back("kernel");
    options.only_when(
        of_scheme, {"formulation"}, [&p] { return !p.vectors(); },
        "has no meaning with {by}, which has a weight of its own and nothing to "
        "choose; leave it out");
    options.only_when(
        breaking::flowing_option_names(), {"formulation", "compare"},
        [&p] { return p.vectors() || p.compare; },
        "has no meaning for an elastic solid; give --formulation material_vectors");
}

Plan<2> plan_of(const Session& session, const Parameters& p, Bar& bar, double row_interval) {
    Plan<2> plan;
    plan.t_end = session.end(p.target.time(200.0), p.target.time(20.0));
    plan.output_every = row_interval;
    if (p.compare) plan.step = bar.label == "material_vectors" ? step_of_vectors : step;
    plan.record({closest_pair_column<2>(),
                 {"bodies",
                  [](const Model<2>& m, std::span<const double>) {
                      return static_cast<double>(m.particles().bodies());
                  }},
                 {"pieces", [](const Model<2>& m, std::span<const double> y) {
                      return static_cast<double>(
                          breaking::piece_sizes(m, y, least_particles).size());
                  }}});
    BodyLedger& ledger = *bar.ledger;
    plan.observe(
        {.revise = [&ledger, row_interval](
                       double t, Model<2>& m,
                       std::span<double> y) { return ledger.find_bodies(t, m, y, row_interval); },
         .memory =
             [&ledger, row_interval](Archive& archive) {
                 double interval = row_interval;
                 archive(interval, ledger);
                 if (interval < row_interval)  // until then others may have come too near
                     throw InputError(fmt::format(
                         "output-every: {:g}, but bodies have been looked for every {:g} so far, far "
                         "enough ahead for that; give no more",
                         row_interval, interval));
             }});
    bar.drawn = p.compare ? states_at<2>({0.2, 0.5}, plan.t_end)
                          : states_at<2>({0.0, 0.15, 0.5, 1.0}, plan.t_end);
    plan.observe(keep_nearest<2>(bar.drawn));
    return plan;
}

void report(Session& session, const Parameters& p, const Bar& bar, const RunRecord& run) {
    const Findings findings(session, bar.prefix);
    check_account(session, bar, run);
    findings.check_promises(run);
    const History& h = run.history;
    findings.measure("bodies", static_cast<double>(bar.model->particles().bodies()),
                     "do not act on each other");
    auto options = Problem::scheme_option_names();
    options.insert(options.end(), {"columns", "rows", "projectile", "speed", "offset", "kernel",
                                   "range", "t-end", "formulation", "compare"});
    findings.claim("pieces", h.last("pieces"), 5.0, 2.0,
                   "connected within 1.5 spacings, five particles or more",
                   run.complete && session.when_default(options));
    if (!p.compare) return;
    findings.measure("angular_momentum_ratio",
                     h.last("angular_momentum") / h.first("angular_momentum"));
    findings.measure("closest_pair", h.smallest("closest_pair"));
}

void compute(Session& session, const Parameters& p) {
    const double row_interval = session.common().output_every.value_or(0.5);
    if (p.vectors()) session.prefer_step(step_of_vectors);
    refuse_tunnelling(session, p.target, session.scheme().range, row_interval);
    std::vector<Bar> bars;
    if (p.compare)
        bars = compared(p, session.scheme());
    else
        bars.push_back(make_bar(p, session.scheme(), p.vectors()));
    for (Bar& bar : bars) bar.ledger->find_bodies(0.0, *bar.model, bar.y0, 0.0);
    const auto runs =
        run_all(session, bars, [&](Bar& bar) { return plan_of(session, p, bar, row_interval); });
    for (std::size_t k = 0; k < runs.size(); ++k) {
        bars[k].ledger->close(runs[k].statistics.t_end, *bars[k].model, runs[k].y);
        const RunFolder folder =
            p.compare ? session.folder().inside(bars[k].label) : session.folder();
        write_ledger(folder, *bars[k].ledger);
        report(session, p, bars[k], runs[k]);
    }
    if (session.plots() && !runs.empty()) draw(session, bars, runs);
}

}  // namespace
}  // namespace fragmenting_bar

int main(int argc, char** argv) {
    using namespace fragmenting_bar;
    Problem problem("fragmenting_bar", "a bar broken by a projectile, [HHM04] IX", step);
    problem.units(lattice_units());
    Parameters p;
    add_options(problem, p);
    return problem.main(argc, argv, [&](Session& session) {
        make_small(session, p.target);
        compute(session, p);
    });
}
