// SPDX-License-Identifier: GPL-3.0-or-later
#include "gas.hpp"

#include <ctime>

namespace free_expansion {
namespace {

/// So long: while the gas is dense. It is where it is cheapest to measure, and dearest to compute.
constexpr double length = 8.0;

/// Processor time between the first reading and the last: others on the machine cost
/// seconds, but not these.
struct Clock {
    double from = -1.0, until = 0.0;
    std::clock_t start = 0, end = 0;

    void read(double t) {
        end = std::clock();
        until = t;
        if (from < 0.0) from = t, start = end;
    }
    double seconds_per_unit_time() const {
        const double span = until - from;
        return static_cast<double>(end - start) / CLOCKS_PER_SEC / std::max(span, 1e-300);
    }
};

template <int Dim>
std::vector<Gas<Dim>> gases_of(const Parameters& p, bool smoke) {
    const std::vector<int> sizes = smoke      ? std::vector{10, 16}
                                   : Dim == 3 ? std::vector{10, 12, 16, 24, 32}
                                              : std::vector{10, 32, 64, 128, 256};
    std::vector<Gas<Dim>> gases;
    for (const int n : sizes) {
        gases.push_back(make_gas<Dim>(n, p));
        gases.back().call(fmt::format("n{}", n));
    }
    return gases;
}

void draw_cost(Session& session, const Parameters& p, const LogLogCurve& seconds) {
    LogLogCurve linear{1, true, seconds.x, {}};
    for (const double n : seconds.x) linear.y.push_back(seconds.y.back() * n / seconds.x.back());
    draw_log_log(
        session, "cost",
        {"What a unit of time costs",
         {{"", "particles", "processor seconds", {seconds, linear}}},
         1,
         {"measured", "proportional to N"},
         fmt::format(
             "{}{}; weight {}, h = {:g}", session.integrator().method,
             session.integrator().dt ? fmt::format(", dt = {:g}", *session.integrator().dt) : "",
             spam::to_string(p.kernel), p.range)});
}

}  // namespace

template <int Dim>
void measure_cost(Session& session, const Parameters& p) {
    session.prefer_one_thread();  // whose processor time is what work costs
    auto gases = gases_of<Dim>(p, session.common().smoke);
    const double t_end = session.end(length, 2.0);
    std::vector<Case<Dim>> cases;
    std::vector<Clock> clocks(gases.size());
    for (auto& gas : gases) {
        Clock& clock = clocks[cases.size()];
        Plan<Dim> plan;
        plan.t_end = plan.output_every = plan.snapshot_every = t_end;
        plan.observe({.on_snapshot = [&clock](double t, const Model<Dim>&,
                                              std::span<const double>) { clock.read(t); }});
        cases.push_back({gas.model, gas.y0, std::move(plan), gas.label});
    }
    const auto runs = session.run_all(std::move(cases));
    CsvWriter csv(session.folder() / "cost.csv",
                  {"particles", "right_hand_sides", "pairs", "wall_seconds_per_unit_time",
                   "seconds_per_unit_time"});
    LogLogCurve curve{0, false, {}, {}};
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const RunStatistics& s = runs[k].statistics;
        const auto n = static_cast<double>(s.particles);
        const double seconds = clocks[k].seconds_per_unit_time();
        const double evaluations = static_cast<double>(s.rhs_evaluations);
        const double pairs = static_cast<double>(s.pair_interactions);
        csv.add(std::vector<double>{n, evaluations, pairs, s.wall_seconds / s.t_end, seconds});
        session.check_promises(runs[k], gases[k].prefix);
        session.measure(gases[k].prefix + "seconds_per_unit_time", seconds);
        session.measure(gases[k].prefix + "pairs_per_particle", pairs / evaluations / n);
        session.measure(gases[k].prefix + "nanoseconds_per_pair", 1e9 * seconds * s.t_end / pairs);
        add_point(curve, n, seconds);
    }
    if (session.plots()) draw_cost(session, p, curve);
}

template void measure_cost<2>(Session&, const Parameters&);
template void measure_cost<3>(Session&, const Parameters&);

}  // namespace free_expansion
