// SPDX-License-Identifier: GPL-3.0-or-later
#include "bar.hpp"

#include "../breaking/pieces.hpp"
#include <spam/external/distributed_load.hpp>
#include <spam/external/friction.hpp>

namespace tension_test {
namespace {

/// What differs from model to model, and the load at which 840 particles part at that rate.
struct Known {
    double load_rate, damping, step, largest_load;
    double parts_at, tolerance;
};

Known known_of(MatterKind kind) {
    switch (kind) {
        case MatterKind::pair_md:
            return {5e-3, 0.1, 0.005, 0.6, 0.42, 0.03};
        case MatterKind::embedded_atom:
            return {2.5e-5, 0.1, 0.05, 0.025, 0.01725, 0.00225};
        case MatterKind::material_vectors:
            return {7e-6, 0.2, 0.125, 0.0135, 0.0116, 0.0012};
        case MatterKind::spam:
        case MatterKind::elements:
        case MatterKind::all:
            break;
    }
    return {7e-6, 0.2, 0.25, 0.01, 0.0073, 0.0012};
}

/// Of the bar at x, by that at its ends.
double height(const Parameters& p, double x) {
    const double half = 0.5 * (p.columns - 0.5);
    return 1.0 - p.taper * (1.0 - std::abs(x) / half);
}

Particles<2> tapered_block(const Parameters& p) {
    Points<2> x = centred<2>(triangular_block(p.columns, p.rows.value_or(14)));
    for (auto point : x.colwise()) point.y() *= height(p, point.x());
    return one_body(make_particles<2>(x, 1.0));
}

/// Everything but the seed.
bool is_known(const Session& session, const RunRecord& run) {
    auto options = Problem::scheme_option_names();
    options.insert(
        options.end(),
        {"columns",      "rows",          "taper",          "load-rate",  "damping",
         "yield-stress", "hardening",     "failure-strain", "strength",   "surface-tension",
         "core",         "core-range",    "disorder",       "kernel",     "range",
         "t-end",        "tension-limit", "penalty",        "bond-yield", "stretch-limit",
         "stress-limit"});
    return session.when_default(options) && run.complete;
}

/// Another program's bar of 50 x 14, with its penalty.
bool is_recorded_stretching(const Session& session, const Parameters& p, const RunRecord& run) {
    return run.complete && run.statistics.t_end >= 300.0 && p.end_speed == 0.4 && p.columns == 50 &&
           p.taper == 0.0 && p.matter.yield_stress == 0.03 && p.matter.tension_limit == 0.06 &&
           p.matter.disorder == 0.0 && p.matter.penalty == 1.0 &&
           session.when_default({"rows", "range", "core", "core-range", "bond-yield",
                                 "stretch-limit", "stress-limit"});
}

ConfigurationPanel panel_of(const PulledBar& bar, double t, const Points<2>& position,
                            const std::string& title) {
    const FirstNeighbours neighbours(bar.model->particles());
    return {bar.load_rate > 0.0
                ? fmt::format("{}t = {:.4g}, load {:.3g}", title, t, bar.load_rate * t)
                : fmt::format("{}t = {:.4g}", title, t),
            position,
            neighbours.lost(position),
            {}};
}

/// A load that grows with time and with the distance from the middle, under friction.
void add_load(ParticleModel<2>& model, const Parameters& p, double rate, double damping) {
    Points<2> pattern = model.particles().reference_position;
    pattern.row(0) /= 0.5 * p.columns;
    pattern.row(1).setZero();
    model.add(std::make_unique<DistributedLoad<2>>([rate](double t) { return rate * t; },
                                                   std::move(pattern)));
    if (damping > 0.0) model.add(std::make_unique<Friction<2>>(damping, FrictionOf::all_motion));
}

/// Free and without a load, with a velocity along it in proportion to the place.
PulledBar make_stretching_bar(const Session& session, const Parameters& p, const Matter& matter) {
    PulledBar bar{{}, matter.kind, 0.0, 0.05, 2.4 * p.columns / *p.end_speed};
    bar.model = make_model(session, matter, {tapered_block(p)});
    Points<2> x = bar.model->particles().reference_position;
    disturb(x, matter);
    bar.y0 = start(*bar.model, x, *p.end_speed);
    const State<2> state(bar.model->layout(), bar.y0);
    const auto& X = bar.model->particles().reference_position;
    state.velocity().row(0) = (*p.end_speed / X.row(0).maxCoeff()) * X.row(0);
    return bar;
}

}  // namespace

PulledBar make_bar(const Session& session, const Parameters& p, const Matter& matter) {
    if (p.end_speed) return make_stretching_bar(session, p, matter);
    const Known known = known_of(matter.kind);
    const double shorter = 60.0 / p.columns;  // the stress in the middle is as load times length
    const double rate = p.load_rate.value_or(shorter * known.load_rate);
    const Matter usual;
    const bool cores = matter.kind != MatterKind::pair_md && matter.kind != MatterKind::elements;
    const double step = known.step * (cores ? relative_step({matter.core, matter.core_range},
                                                            {usual.core, usual.core_range})
                                            : 1.0);
    PulledBar bar{{}, matter.kind, rate, step, shorter * known.largest_load / rate};
    bar.model = make_model(session, matter, {tapered_block(p)});
    add_load(*bar.model, p, rate, p.damping.value_or(known.damping));
    Points<2> x = bar.model->particles().reference_position;
    disturb(x, matter);
    bar.y0 = start(*bar.model, x, 0.1);
    return bar;
}

std::vector<Column<2>> columns_of(const PulledBar& bar) {
    const std::size_t least = bar.model->particles().size() / 20;
    // What is drawn out far is still one where nothing has come between.
    const double reach =
        bar.kind == MatterKind::material_vectors ? bar.model->reach() : piece_reach;
    const auto piece = [least, reach](std::size_t k) {
        return [least, reach, k](const Model<2>& model, std::span<const double> y) {
            const auto sizes = piece_sizes(model, y, least, reach);
            return k < sizes.size() ? static_cast<double>(sizes[k]) : 0.0;
        };
    };
    return {{"pieces",
             [least, reach](const Model<2>& model, std::span<const double> y) {
                 return static_cast<double>(piece_sizes(model, y, least, reach).size());
             }},
            {"largest_piece", piece(0)},
            {"second_piece", piece(1)},
            {"length",
             [](const Model<2>& model, std::span<const double> y) {
                 const auto x = ConstState<2>(model.layout(), y).position().row(0);
                 return x.maxCoeff() - x.minCoeff();
             }},
            closest_pair_column<2>()};
}

std::optional<double> parted_at(const History& h) {
    const auto t = h.column("t"), pieces = h.column("pieces");
    std::optional<double> since;  // pieces may touch once more before they part for good
    for (std::size_t k = 0; k < t.size(); ++k)
        if (!(pieces[k] > 1.0))
            since.reset();
        else if (!since)
            since = t[k];
    return since;
}

void report(Session& session, const Parameters& p, const PulledBar& bar, const RunRecord& run) {
    const Findings findings(session, bar.prefix);
    const History& h = run.history;
    const Known known = known_of(bar.kind);
    const bool default_case = is_known(session, run);
    const auto t = parted_at(h);
    if (t && bar.load_rate > 0.0) {
        findings.claim("load_at_parting", bar.load_rate * *t, known.parts_at, known.tolerance,
                       "[HH07] 13; recorded values", default_case);
        const double half = 0.5 * static_cast<double>(run.statistics.particles);
        findings.claim("second_piece", h.largest("second_piece"), 0.8 * half, 0.2 * half,
                       "[HH07] 13: two large pieces", default_case);
    }
    const bool stretched = is_recorded_stretching(session, p, run);
    findings.claim(
        "pieces", h.last("pieces"), 3.0, 1.0,
        "another program: two necks, so three pieces; what is between may part once more",
        stretched);
    if (stretched)
        findings.check("difference_of_ends", h.last("largest_piece") - h.last("second_piece"), 0.0,
                       0.0, "both ends lose as much");
    findings.measure_last(h, {"largest_piece", "length"}, "at the end");
    findings.claim("closest_pair", h.smallest("closest_pair"), 0.7, 0.05,
                   "another program: nothing clumps", stretched);
    findings.check_promises(run);
}

void draw(Session& session, const std::vector<PulledBar>& bars,
          const std::vector<RunRecord>& runs) {
    std::vector<ConfigurationPanel> panels;
    const bool several = bars.size() > 1;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const PulledBar& bar = bars[k];
        const std::string title = several ? title_of(bar.kind) + ", " : "";
        for (const auto& state : bar.drawn)
            if (state.there() && state.t < runs[k].statistics.t_end && !(several && state.t == 0.0))
                panels.push_back(panel_of(bar, state.t, state.position, title));
        panels.push_back(panel_of(bar, runs[k].statistics.t_end,
                                  ConstState<2>(bar.model->layout(), runs[k].y).position(), title));
    }
    draw_configurations(
        session, "configurations",
        several ? "A bar under tension" : "A bar under tension: " + title_of(bars.front().kind),
        panels, several ? 2 : 1, "first neighbours lost");
}

}  // namespace tension_test
