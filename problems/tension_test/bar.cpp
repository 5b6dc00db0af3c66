// SPDX-License-Identifier: GPL-3.0-or-later
#include "bar.hpp"

#include "../breaking/pieces.hpp"
#include <spam/external/distributed_load.hpp>
#include <spam/external/friction.hpp>
#include <spam/picture/draw.hpp>

#include <fmt/format.h>

#include <cmath>

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
    Points<2> x = triangular_block(p.columns, p.rows.value_or(14));
    x.colwise() -= Point<2>(x.rowwise().mean());
    for (auto point : x.colwise()) point.y() *= height(p, point.x());
    auto particles = make_particles<2>(x, 1.0);
    particles.body.assign(particles.size(), 0);
    return particles;
}

/// Everything but the seed.
bool is_known(const Session& session, const RunRecord& run) {
    auto options = Problem::scheme_option_names();
    options.insert(options.end(),
                   {"columns", "rows", "taper", "load-rate", "damping", "yield-stress", "hardening",
                    "failure-strain", "strength", "surface-tension", "core", "core-range",
                    "disorder", "kernel", "range", "t-end"});
    return session.when_default(options) && run.complete;
}

ConfigurationPanel panel_of(const PulledBar& bar, double t, const Points<2>& position,
                            const std::string& title) {
    const FirstNeighbours neighbours(bar.model->particles());
    return {fmt::format("{}t = {:.4g}, load {:.3g}", title, t, bar.load_rate * t),
            position,
            neighbours.lost(position),
            {}};
}

}  // namespace

PulledBar make_bar(const Session& session, const Parameters& p, const Matter& matter) {
    const Known known = known_of(matter.kind);
    const double shorter = 60.0 / p.columns;  // the stress in the middle is as load times length
    PulledBar bar{matter.kind, p.load_rate.value_or(shorter * known.load_rate), known.step,
                  shorter * known.largest_load, make_model(session, matter, {tapered_block(p)})};
    Points<2> x = bar.model->particles().reference_position, pattern = x;
    pattern.row(0) /= 0.5 * p.columns;
    pattern.row(1).setZero();
    bar.model->add(std::make_unique<DistributedLoad<2>>(
        [rate = bar.load_rate](double t) { return rate * t; }, std::move(pattern)));
    const double damping = p.damping.value_or(known.damping);
    if (damping > 0.0)
        bar.model->add(std::make_unique<Friction<2>>(damping, FrictionOf::all_motion));
    disturb(x, matter);
    bar.y0 = start(*bar.model, x, 0.1);
    return bar;
}

std::vector<Column<2>> columns_of(const PulledBar& bar) {
    const std::size_t least = bar.model->particles().size() / 20;
    const auto piece = [least](std::size_t k) {
        return [least, k](const Model<2>& model, std::span<const double> y) {
            const auto sizes = piece_sizes(model, y, least);
            return k < sizes.size() ? static_cast<double>(sizes[k]) : 0.0;
        };
    };
    return {{"pieces",
             [least](const Model<2>& model, std::span<const double> y) {
                 return static_cast<double>(piece_sizes(model, y, least).size());
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
    const History& h = run.history;
    const Known known = known_of(bar.kind);
    const bool default_case = is_known(session, run);
    if (const auto t = parted_at(h)) {
        session.claim({bar.prefix + "load_at_parting", bar.load_rate * *t, known.parts_at,
                       known.tolerance, "[HH07] 13; recorded values"},
                      default_case);
        const double half = 0.5 * static_cast<double>(run.statistics.particles);
        session.claim({bar.prefix + "second_piece", h.largest("second_piece"), 0.8 * half,
                       0.2 * half, "[HH07] 13: two large pieces"},
                      default_case);
    }
    for (const char* name : {"pieces", "largest_piece", "length"})
        session.measure(bar.prefix + name, h.last(name), "at the end");
    session.measure(bar.prefix + "closest_pair", h.smallest("closest_pair"));
    session.check_promises(run, bar.prefix);
    (void)p;
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
    session.note_drawn(draw_configurations(
        session.plots_folder(), "configurations",
        several ? "A bar under tension" : "A bar under tension: " + title_of(bars.front().kind),
        panels, several ? 2 : 1, "first neighbours lost"));
}

}  // namespace tension_test
