// SPDX-License-Identifier: GPL-3.0-or-later
#include "gas.hpp"
#include <spam/io/csv.hpp>
#include <spam/io/gnuplot.hpp>

#include <fmt/format.h>

#include <cmath>

namespace free_expansion {
namespace {

/// So long: while the gas is dense. It is where it is cheapest to measure, and dearest to compute.
constexpr double length = 8.0;

std::vector<Gas<2>> gases_of(const Parameters& p, bool smoke) {
    const std::vector<int> sizes = smoke ? std::vector{10, 16} : std::vector{10, 32, 64, 128, 256};
    std::vector<Gas<2>> gases;
    for (const int n : sizes) {
        gases.push_back(make_gas<2>(n, p));
        gases.back().label = fmt::format("n{}", n);
        gases.back().prefix = gases.back().label + "_";
    }
    return gases;
}

void draw_cost(Session& session, const LogLogCurve& seconds) {
    LogLogCurve linear{1, true, seconds.x, {}};
    for (const double n : seconds.x) linear.y.push_back(seconds.y.back() * n / seconds.x.back());
    session.note_drawn(draw_log_log(session.plots_folder(), "cost",
                                    {"What a unit of time costs",
                                     {{"", "particles", "seconds", {seconds, linear}}},
                                     1,
                                     {"measured", "proportional to N"},
                                     "RK4, dt = 0.25: 16 right-hand sides; Lucy's weight, h = 6"}));
}

}  // namespace

void measure_cost(Session& session, const Parameters& p) {
    auto gases = gases_of(p, session.common().smoke);
    const double t_end = session.common().t_end.value_or(session.common().smoke ? 2.0 : length);
    std::vector<Case<2>> cases;
    for (auto& gas : gases) {
        Plan<2> plan;
        plan.t_end = plan.output_every = plan.snapshot_every = t_end;
        cases.push_back({*gas.model, gas.y0, std::move(plan), gas.label});
    }
    const auto runs = session.run_all(std::move(cases));
    CsvWriter csv(session.folder() / "cost.csv",
                  {"particles", "right_hand_sides", "pairs", "seconds_per_unit_time"});
    LogLogCurve curve{0, false, {}, {}};
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const RunStatistics& s = runs[k].statistics;
        const auto n = static_cast<double>(s.particles);
        const double seconds = s.wall_seconds / s.t_end;
        const double evaluations = static_cast<double>(s.rhs_evaluations);
        const double pairs = static_cast<double>(s.pair_interactions);
        csv.add(std::vector<double>{n, evaluations, pairs, seconds});
        session.check_promises(runs[k], gases[k].prefix);
        session.check({gases[k].prefix + "seconds_per_unit_time", seconds, {}, 0.0, "measured"});
        session.check(
            {gases[k].prefix + "pairs_per_particle", pairs / evaluations / n, {}, 0.0, "measured"});
        session.check({gases[k].prefix + "nanoseconds_per_pair",
                       1e9 * s.wall_seconds / pairs,
                       {},
                       0.0,
                       "measured"});
        curve.x.push_back(n);
        curve.y.push_back(seconds);
    }
    if (session.plots()) draw_cost(session, curve);
}

}  // namespace free_expansion
