// SPDX-License-Identifier: GPL-3.0-or-later
#include "column.hpp"

namespace water_column {

bool reached(const RunRecord& run, double t) { return run.statistics.t_end >= t * (1.0 - 1e-9); }

Sampled sampled(std::span<const Computed> samples, double t, const char* name) {
    Sampled all;
    double squares = 0.0;  // of differences from the mean: Welford's recurrence
    for (const Computed& one : samples) {
        if (!one.collapse || !reached(*one.collapse, t)) continue;
        const double value = one.collapse->history.at(t, name), before = value - all.mean;
        all.mean += before / ++all.number;
        squares += before * (value - all.mean);
    }
    if (all.number > 1) all.deviation = std::sqrt(squares / (all.number - 1));
    return all;
}

namespace {

/// Options that say of what the fluid is and how it came to rest, whatever the size of the column.
bool is_standard(const Session& session, const Parameters& p) {
    return session.when_default({"gravity", "surface-tension", "core", "core-range", "damping",
                                 "relaxation-time", "kernel", "range"}) &&
           session.when_default(p.sides->names()) && !p.cavitation &&
           p.aspect <= 2.5;  // higher ones come to rest more slowly
}

/// Mean force of the floor over the last tenth of the run, by the weight.
double floor_force(const FluidColumn& column, const History& h) {
    return h.mean_rate("impulse_bottom_y", 0.9) / (column.g * column.particles());
}

void report_rest(Session& session, const FluidColumn& column, double range, bool known,
                 const RunRecord& run) {
    const Findings findings(session, column.prefix);
    const History& h = run.history;
    findings.claim("profile_error", profile_error(column, run.y, range), 0.0, 0.01,
                   "rho(d) = (2 + sqrt(1 + 6 g d))/3",
                   known && run.complete && column.width >= figure_width);
    findings.measure("mass_error", mass_error(column, run.y, range),
                     "particles below the surface, against the same formula");
    findings.claim("floor_force", floor_force(column, h), 1.0, 0.01, "by the weight",
                   known && run.complete && column.width >= figure_width);
    findings.measure("kinetic_energy_at_rest", h.last("kinetic") / column.particles(),
                     "a particle's");
    session.check_promises(run, column.prefix + "relaxation_");
}

struct Known {
    double time, front;  // by the unit of time, by the width
};

/// Of 640 particles, from another program.
constexpr Known known_fronts[] = {{2.5, 33.6 / figure_width}, {5.0, 57.2 / figure_width}};

void report_collapse(Session& session, const FluidColumn& column, bool known,
                     const RunRecord& run) {
    const Findings findings(session, column.prefix);
    const History& h = run.history;
    for (const Known& one : known_fronts) {
        const double t = one.time * column.unit;
        if (!reached(run, t)) continue;
        const double front = one.front * column.width;
        session.claim({fmt::format("{}front_at_{:g}", column.prefix, t), h.at(t, "front"), front,
                       0.05 * front, "[HH07] 11; recorded value"},
                      known && column.width == figure_width && column.rows == 40);
        for (const char* name : {"leading_percent", "height"})
            session.measure(fmt::format("{}{}_at_{:g}", column.prefix, name, t), h.at(t, name));
    }
    findings.measure("closest_pair", h.smallest("closest_pair"), "smallest of the collapse");
    session.check_promises(run, column.prefix + "collapse_");
}

/// Against water, where the run has come so far. A fluid in which sound is not much faster than the flow
/// starts earlier: pushed together at rest, it springs apart when it is let go (less so with --gravity 0.1).
void report_water(Session& session, const FluidColumn& column, bool known, const RunRecord& run) {
    const Findings findings(session, column.prefix);
    double largest = 0.0, latest = 0.0;
    for (const Measured& water : martin_and_moyce()) {
        const double t = scaled_time(column, water.T) * column.width;
        if (!reached(run, t)) return;
        const double front = run.history.at(t, "front") / column.width;
        session.measure(fmt::format("{}front_by_width_at_T_{:g}", column.prefix, water.T), front,
                        fmt::format("Martin and Moyce 1952: {:g}", water.Z));
        latest = front / water.Z - 1.0;
        largest = std::max(largest, std::abs(latest));
    }
    findings.measure("largest_difference_from_water", largest,
                     "Martin and Moyce 1952; the first fronts");
    findings.claim("difference_from_water", latest, 0.0, 0.1,
                   "Martin and Moyce 1952, the last front", known && column.width >= figure_width);
}

void report_samples(Session& session, std::span<const Computed> samples) {
    const FluidColumn& column = *samples[0].column;
    for (const Known& one : known_fronts) {
        const double t = one.time * column.unit;
        const Sampled front = sampled(samples, t, "front");
        if (front.number < 2) continue;
        session.measure(fmt::format("{}mean_front_at_{:g}", column.prefix, t), front.mean,
                        fmt::format("of {} samples", front.number));
        session.measure(fmt::format("{}deviation_of_front_at_{:g}", column.prefix, t),
                        front.deviation, "standard deviation of one sample");
    }
}

/// Fronts at the same scaled times, of each column by those of the one half as wide. Motion is chaotic: at t = 5 W
/// the front of one column of 640 particles scatters by 1 %, and another compiler or processor draws other samples
/// of it. So means of samples are compared, and of fewer than three nothing is claimed.
void compare(Session& session, std::span<const Computed> narrow, std::span<const Computed> wide,
             bool known) {
    const FluidColumn &small = *narrow[0].column, &large = *wide[0].column;
    for (const Known& one : known_fronts)
        for (const char* name : {"front", "leading_percent"}) {
            const double t = one.time * small.unit;
            const Sampled before = sampled(narrow, t, name), after = sampled(wide, 2.0 * t, name);
            if (before.number == 0 || after.number == 0) continue;
            session.claim(
                {fmt::format("{}_of_{}_by_{}_at_{:g}", name, large.width, small.width, one.time),
                 after.mean / before.mean / 2.0, 1.0, 0.08,
                 fmt::format("[HH07] 11: the same flow at twice the time; means of {} "
                             "and {}",
                             after.number, before.number)},
                known && small.width >= figure_width && before.number >= 3);
        }
}

}  // namespace

void report(Session& session, const Parameters& p, const std::vector<Computed>& columns) {
    const bool known = is_standard(session, p);
    const Computed& last = columns.back();
    if (last.column->of_elements()) {
        report_elements(session, p, last);
        if (columns.size() > 1)
            report_both(session, p, std::span(columns).first(columns.size() - 1), last);
    }
    for (const auto& [column, rest, collapse] : columns) {
        if (column->of_elements()) continue;
        if (column->sample > 0) continue;  // the session looks after what they promise
        report_rest(session, *column, p.range, known, *rest);
        if (!collapse) continue;
        report_collapse(session, *column, known, *collapse);
        if (is_martin_and_moyce(*column)) report_water(session, *column, known, *collapse);
    }
    std::span<const Computed> left = columns, before;
    while (!left.empty()) {
        const auto next = std::find_if(left.begin() + 1, left.end(),
                                       [](const Computed& one) { return one.column->sample == 0; });
        const auto samples = left.first(static_cast<std::size_t>(next - left.begin()));
        report_samples(session, samples);
        if (p.compare && !before.empty()) compare(session, before, samples, known);
        before = samples;
        left = left.subspan(samples.size());
    }
}

}  // namespace water_column
