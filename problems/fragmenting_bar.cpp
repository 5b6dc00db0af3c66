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
#include "breaking/pieces.hpp"
#include "fragmenting_bar/body_ledger.hpp"
#include <spam/io/csv.hpp>
#include <spam/problem/nearest_state.hpp>
#include <spam/spam.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace spam;

struct Parameters {
    int columns = 8, rows = 60;
    int projectile = 5;
    double speed = 1.0, offset = 8.0;
};

/// The bar centred on the origin, the projectile left of it, out of reach; how many are the bar's.
Points<2> bar_and_projectile(const Parameters& p, double range) {
    Points<2> bar = triangular_block(p.columns, p.rows);
    bar.colwise() -= bar.rowwise().mean().eval();
    Points<2> ball = triangular_hexagon(p.projectile);
    ball.row(0).array() += bar.row(0).minCoeff() - p.projectile - 3.0 * range;
    ball.row(1).array() += p.offset;
    Points<2> all(2, bar.cols() + ball.cols());
    all << bar, ball;
    return all;
}

void write_ledger(const RunFolder& folder, const BodyLedger& ledger) {
    CsvWriter csv(folder / "bodies.csv",
                  {"change", "t", "body", "parents", "particles", "mass", "momentum_x",
                   "momentum_y", "angular_momentum", "energy"});
    std::size_t change = 0;
    for (const auto& entry : ledger.entries()) {
        for (std::size_t b = 0; b < entry.bodies.size(); ++b) {
            const BodyTotals& body = entry.bodies[b];
            csv.add(std::vector<double>{
                static_cast<double>(change), entry.t, static_cast<double>(b + 1),
                static_cast<double>(entry.parents[b].size()), static_cast<double>(body.particles),
                body.mass, body.momentum.x(), body.momentum.y(), body.angular_momentum,
                body.energy});
        }
        ++change;
    }
}

/// Relative to the angular momentum and the momentum that came with the projectile.
void check_account(Session& session, const BodyLedger& ledger, const Scheme& scheme,
                   const RunRecord& run) {
    const BodyTotals& projectile = *std::max_element(
        ledger.entries().front().bodies.begin(), ledger.entries().front().bodies.end(),
        [](const auto& a, const auto& b) { return a.momentum.norm() < b.momentum.norm(); });
    const double L = std::max(std::abs(projectile.angular_momentum), projectile.momentum.norm());
    double L_change = 0.0, p_change = 0.0, left_out = 0.0;
    for (const auto& entry : ledger.entries()) {
        const BodyTotals& sum = entry.sum_change;
        L_change = std::max(L_change, entry.largest_L_change / L);
        p_change = std::max(p_change, entry.largest_momentum_change / projectile.momentum.norm());
        left_out = std::max({left_out, std::abs(sum.mass) / projectile.mass,
                             sum.momentum.norm() / projectile.momentum.norm(),
                             std::abs(sum.angular_momentum) / L,
                             std::abs(sum.energy) / run.history.first("energy")});
    }
    const bool pair = scheme.angular_momentum == AngularMomentum::torque_pair;
    const bool kept = pair || scheme.angular_momentum == AngularMomentum::torque_particle;
    session.measure("changes_of_bodies", static_cast<double>(ledger.entries().size() - 2),
                    "joined or parted");
    session.check({"left_out_at_changes", left_out, 0.0, 1e-12,
                   "mass, momentum, angular momentum and energy of all bodies, after and before"});
    session.check({"momentum_change_of_bodies", p_change, 0.0, 1e-12, "while they were bodies"});
    session.claim({"angular_momentum_change_of_bodies", L_change, 0.0, pair ? 1e-9 : 1e-5,
                   "[HHM04] IX: each body's own balance"},
                  kept);
}

/// Bodies meet when one comes within the other's range: it must not step, or be searched for, beyond.
void refuse_tunnelling(const Session& session, const Parameters& p, double row_interval) {
    const auto refuse = [&](const char* name, double interval, const char* what) {
        const double range = session.scheme().range;
        if (p.speed * interval <= range) return;
        throw InputError(fmt::format(
            "speed: at {:g} the projectile moves {:.3g} in {} {} = {:g}, more than the range {:g}, "
            "and would pass through the bar; lower it, or choose --{} below {:.2g}",
            p.speed, p.speed * interval, what, name, interval, range, name, range / p.speed));
    };
    if (session.integrator().dt) refuse("dt", *session.integrator().dt, "a step");
    refuse("output-every", row_interval, "the time between two searches for bodies,");
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("fragmenting_bar", "a bar broken by a projectile, [HHM04] IX", 0.05);
    Parameters p;
    auto& options = problem.options();
    options.integer("columns", p.columns, "particles across the bar", between(2, 200));
    options.integer("rows", p.rows, "particles along the bar", between(4, 2000));
    options.integer("projectile", p.projectile, "size n of the hexagonal projectile",
                    between(1, 100));
    options.number("speed", p.speed, "speed of the projectile (the speed of sound is 1.06)",
                   positive());
    options.number("offset", p.offset, "height of the impact above the middle of the bar",
                   between(-1e6, 1e6));
    problem.use_scheme({.transport = Transport::monaghan,
                        .angular_momentum = AngularMomentum::torque_pair,
                        .viscosity = 1.0});

    return problem.main(argc, argv, [&](Session& session) {
        if (session.common().smoke) {
            if (!session.given("columns")) p.columns = 4;
            if (!session.given("rows")) p.rows = 16;
            if (!session.given("projectile")) p.projectile = 2;
            if (!session.given("offset")) p.offset = 2.0;
        }
        const double row_interval = session.common().output_every.value_or(0.5);
        refuse_tunnelling(session, p, row_interval);
        SmoothParticleModel<2> model(
            make_particles<2>(bar_and_projectile(p, session.scheme().range), 1.0),
            ElasticSolid::triangular_lattice(), session.scheme());
        const auto moving = static_cast<std::int64_t>(p.columns) * p.rows;
        auto y0 = initial_state<2>(model, std::sqrt(4.0 / 3.0), std::sqrt(3.0 / 16.0),
                                   [](const Point<2>&) { return Point<2>(0.0, 0.0); });
        const State<2> start(model.layout(), y0);
        for (std::size_t i = 0; i < model.particles().size(); ++i)
            if (model.particles().id[i] >= moving)
                start.velocity()(0, static_cast<Eigen::Index>(i)) = p.speed;

        BodyLedger ledger;
        ledger.find_bodies(0.0, model, y0, row_interval);
        Plan<2> plan;
        plan.t_end = session.common().t_end.value_or(session.common().smoke ? 20.0 : 200.0);
        plan.output_every = row_interval;
        plan.record({closest_pair_column<2>(),
                     {"bodies",
                      [](const Model<2>& m, std::span<const double>) {
                          return static_cast<double>(m.particles().bodies());
                      }},
                     {"pieces", [](const Model<2>& m, std::span<const double> y) {
                          return static_cast<double>(breaking::piece_sizes(m, y, 5).size());
                      }}});
        plan.observe({.revise =
                          [&ledger, row_interval](double t, Model<2>& m, std::span<double> y) {
                              return ledger.find_bodies(t, m, y, row_interval);
                          },
                      .memory = [&ledger](Archive& archive) { archive(ledger); }});
        std::vector<NearestState<2>> drawn;
        for (const double part : {0.0, 0.15, 0.5, 1.0}) drawn.push_back({part * plan.t_end});
        plan.observe(keep_nearest<2>(drawn));
        const auto run = session.run(model, std::move(y0), std::move(plan));

        ledger.close(run.statistics.t_end, model, run.y);
        write_ledger(session.folder(), ledger);
        check_account(session, ledger, model.scheme(), run);
        session.check_promises(run);
        session.measure("bodies", static_cast<double>(model.particles().bodies()),
                        "do not act on each other");
        auto known = Problem::scheme_option_names();
        known.insert(known.end(), {"columns", "rows", "projectile", "speed", "offset", "kernel",
                                   "range", "t-end"});
        session.claim({"pieces", run.history.last("pieces"), 5.0, 2.0,
                       "connected within 1.5 spacings, five particles or more"},
                      run.complete && session.when_default(known));
        if (session.plots()) {
            std::vector<ConfigurationPanel> panels;
            for (const NearestState<2>& state : drawn) {
                panels.push_back(speed_panel(fmt::format("t = {:.3g}", state.t), model, state));
                panels.back().outlines.clear();
            }
            session.note_drawn(draw_configurations(session.plots_folder(), "configurations",
                                                   "A bar hit by a projectile", panels,
                                                   panels.size(), "speed"));
        }
    });
}
