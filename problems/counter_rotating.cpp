// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: two counter-rotating hexagons: what conserves the angular momentum of each; 5 s
//
// Two counter-rotating hexagons, [HHM04] VII and IX.
//
//        . o o o .        . o o o .
//       o o o o o o      o o o o o o        the right one is the mirror image of the left one
//      o o o o o o o    o o o o o o o
//       o o o o o o      o o o o o o        gap > 2 h: they never meet
//        ' o o o '        ' o o o '
//         -> omega        <- omega
//
// No matter how badly each keeps its angular momentum, their sum vanishes: a constraint on the sum has
// nothing to do. Only a constraint for each body,
//     P_b/R_b - M_b R_b + X_b = 0     for b = 1, 2
// keeps both. Run twice: torques balanced for each body, and for all together.
#include "common.hpp"

namespace {

using namespace spam;
using std::numbers::pi;

using Hexagons = Variant<2, SmoothParticleModel<2>>;

/// The second hexagon is the mirror image of the first in the y axis.
Points<2> two_hexagons(int size, double gap) {
    const Points<2> one = triangular_hexagon(size);
    Points<2> both(2, 2 * one.cols());
    both << one, one;
    const double shift = size + 0.5 * gap;
    both.row(0).head(one.cols()).array() -= shift;
    both.row(0).tail(one.cols()) = -both.row(0).head(one.cols());
    return both;
}

/// omega about the centre of the left one, -omega about that of the right one.
VelocityField<2> against_each_other(double omega, double shift) {
    return [=](const Point<2>& x) {
        const double side = x.x() < 0.0 ? -1.0 : 1.0, w = -side * omega;
        return Point<2>(-w * x.y(), w * (x.x() - side * shift));
    };
}

double drift(const History& h, const std::string& column) {
    return h.largest_change(column) / std::abs(h.first(column));
}

void draw(Session& session, const std::vector<Hexagons>& pairs, const std::vector<RunRecord>& runs,
          double turn) {
    std::vector<ConfigurationPanel> panels;
    std::vector<CurvePanel> curves;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        panels.push_back(speed_panel(pairs[k].title, *pairs[k].model, pairs[k].drawn.front()));
        panels.back().outlines.clear();  // of two bodies there is no single one
        const History& h = runs[k].history;
        const auto t = divided(h.column("t"), turn);
        CurvePanel panel = frame(pairs[k].title, "turns", "L(t) / |L(0)| of each body");
        for (const char* side : {"left", "right"}) {
            const auto L = h.column(side == std::string("left") ? "angular_momentum_body_1"
                                                                : "angular_momentum_body_2");
            panel.curves.push_back({side, t, divided(L, std::abs(L.front()))});
        }
        curves.push_back(panel);
    }
    draw_configurations(
        session, "configurations",
        fmt::format("Counter-rotating hexagons at t = {:.4g}", runs.front().statistics.t_end),
        panels, panels.size(), "speed");
    draw_curves(session, "curves", "Counter-rotating hexagons", curves);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("counter_rotating",
                    "two hexagons that rotate against each other, [HHM04] VII, IX");
    problem.units(lattice_units());
    int size = 8;
    double speed = 0.1, turns = 1.0;
    problem.options().integer("size", size,
                              "n: the corners are n spacings from the centre of each hexagon",
                              between(1, 1000));
    problem.options().number("speed", speed, "speed of the corners", between(1e-6, 1e3));
    problem.options().number("turns", turns, "number of nominal turns", positive());
    problem.options().one_of({"turns", "t-end"}, "the end of the run");
    problem.use_scheme(
        {.transport = Transport::monaghan, .angular_momentum = AngularMomentum::torque_pair});
    problem.options().only_when({"balance"}, {}, [&] { return problem.options().given("balance"); },
                                {});

    return problem.main(argc, argv, [&](Session& session) {
        if (session.scheme().angular_momentum == AngularMomentum::free)
            throw InputError(
                "angular-momentum: free balances nothing, for one body or for all; use gauss, "
                "torque_particle or torque_pair");
        session.smoke_default("size", size, 3);
        session.smoke_default("turns", turns, 0.1);
        const double omega = speed / size, turn = 2.0 * pi / omega;
        const double gap = 2.0 * session.scheme().range + 2.0;

        // With --balance one case, else both.
        std::vector<Balance> balances{Balance::body, Balance::global};
        if (session.given("balance")) balances = {session.scheme().balance};

        std::vector<Hexagons> pairs;
        const double t_end = session.common().t_end.value_or(turns * turn);
        for (const Balance balance : balances) {
            Scheme scheme = session.scheme();
            scheme.balance = balance;
            Hexagons pair{.title = balance == Balance::body ? "balance of each body"
                                                            : "balance of all together"};
            if (balances.size() > 1) pair.label = to_string(balance);
            if (!pairs.empty()) pair.prefix = "global_";
            pair.model = std::make_shared<SmoothParticleModel<2>>(
                make_particles<2>(two_hexagons(size, gap), 1.0), ElasticSolid::triangular_lattice(),
                scheme);
            pair.y0 = lattice_state(*pair.model, against_each_other(omega, size + 0.5 * gap));
            pair.drawn = {{t_end}};
            pairs.push_back(std::move(pair));
        }
        const auto runs = run_all(session, pairs, [&](Hexagons& pair) {
            Plan<2> plan{.t_end = t_end};
            plan.record({closest_pair_column<2>()});
            plan.observe(keep_nearest<2>(pair.drawn));
            return plan;
        });
        // what was found
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const History& h = runs[k].history;
            const Scheme& scheme = pairs[k].model->scheme();
            const auto& steps = session.integrator();
            const bool kept = steps.method == "rk4" && steps.dt.value_or(HUGE_VAL) <= 0.25 &&
                              scheme.balance == Balance::body &&
                              scheme.angular_momentum != AngularMomentum::gauss;
            const double tolerance = scheme.angular_momentum == AngularMomentum::torque_pair &&
                                             scheme.transport != Transport::plain
                                         ? 1e-10
                                         : 1e-8;
            const Findings findings(session, pairs[k].prefix);
            for (const int body : {1, 2})
                findings.claim(fmt::format("angular_momentum_drift_body_{}", body),
                               drift(h, fmt::format("angular_momentum_body_{}", body)), 0.0,
                               tolerance, "[HHM04] IX: a balance for each body", kept);
            findings.check(
                "angular_momentum_sum",
                h.largest_change("angular_momentum") / std::abs(h.first("angular_momentum_body_1")),
                0.0, 1e-10, "mirror images: the sum vanishes whatever each of them loses");
            findings.check_promises(runs[k]);
        }
        if (runs.size() == 2) {
            auto names = Problem::scheme_option_names();
            names.insert(names.end(),
                         {"kernel", "range", "size", "speed", "turns", "t-end", "integrator"});
            Findings(session).claim("global_balance_loses",
                                    drift(runs[1].history, "angular_momentum_body_1"), 0.39, 0.04,
                                    "[HHM04] IX: the global sum constrains nothing",
                                    runs[1].complete && session.when_default(names));
        }
        if (session.plots()) draw(session, pairs, runs, turn);
    });
}
