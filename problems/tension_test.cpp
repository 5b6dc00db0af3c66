// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a tapered bar is pulled apart from within, by molecules and by smooth particles, [HH07] 13; 10 s
//
// Tension test, [HH07] 13: a bar of `columns` x `rows` particles of a triangular lattice, its heights 10 % less
// at the middle, with a load on every particle that grows with time, under friction.
//
//     <- <- < o o o o o o > -> ->
//     <- <- <  o o o o o  > -> ->       m v_dot_i = ... + m f(t) X_i/(L/2) e_x - m gamma v_i,   f = load-rate t
//     <- <- < o o o o o o > -> ->       X_i: place at the start, L = `columns`
//
// Forces at the ends alone would tear off the ends.
//
//     --model pair_md        molecules: breaks
//     --model embedded_atom  potentials of the density, a core, and a strength by the curvature: ductile
//     --model spam           smooth particles of an elastic, perfectly plastic solid, and a core: necks, then parts
//
// [HH07] shows bars at t = 620 (molecules), 375 to 875 (smooth particles) and 10,000 to 20,000 (embedded
// atoms). load-rate makes of these times the loads at which the three are known to part: 1/1500, 1e-5 and 1e-6.
// Without a core smooth particles clump before that.
#include "breaking/matter.hpp"
#include "breaking/pieces.hpp"
#include <spam/external/distributed_load.hpp>
#include <spam/external/friction.hpp>
#include <spam/picture/draw.hpp>
#include <spam/problem/nearest_state.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace breaking;

struct Parameters {
    Matter matter;
    int columns = 60, rows = 14;
    double taper = 0.1;
    std::optional<double> load_rate, damping;
};

/// What differs from model to model, and what is known of it.
struct Known {
    double load_rate;
    double damping;
    double dt;
    double largest_load;  ///< at the end
    double parts_at, tolerance;
};

Known known_of(MatterKind kind) {
    switch (kind) {
        case MatterKind::pair_md:
            return {0.005, 0.1, 0.01, 0.5, 0.42, 0.03};
        case MatterKind::embedded_atom:
            return {1e-6, 0.1, 0.25, 0.022, 0.01725, 0.00225};
        case MatterKind::spam:
            break;
    }
    return {1e-5, 0.1, 0.25, 0.01, 0.0073, 0.0012};
}

struct PulledBar {
    std::shared_ptr<ParticleModel<2>> model;
    std::vector<double> y0;
    double load_rate;

    double load(double t) const { return load_rate * t; }
};

Points<2> tapered_block(const Parameters& p) {
    Points<2> x = triangular_block(p.columns, p.rows);
    x.colwise() -= Point<2>(x.rowwise().mean());
    const double half = x.row(0).cwiseAbs().maxCoeff();
    for (auto point : x.colwise()) point.y() *= 1.0 - p.taper * (1.0 - std::abs(point.x()) / half);
    return x;
}

PulledBar make_bar(const Session& session, const Parameters& p) {
    const Known known = known_of(p.matter.kind);
    PulledBar bar;
    bar.load_rate = p.load_rate.value_or(known.load_rate);
    auto particles = make_particles<2>(tapered_block(p), 1.0);
    particles.body.assign(particles.size(), 0);
    Points<2> pattern = Points<2>::Zero(2, particles.reference_position.cols());
    pattern.row(0) = particles.reference_position.row(0) / (0.5 * p.columns);
    bar.model = make_model(session, p.matter, std::move(particles));
    bar.model->add(std::make_unique<DistributedLoad<2>>(
        [rate = bar.load_rate](double t) { return rate * t; }, std::move(pattern)));
    const double damping = p.damping.value_or(known.damping);
    if (damping > 0.0)
        bar.model->add(std::make_unique<Friction<2>>(damping, FrictionOf::all_motion));
    Points<2> x = bar.model->particles().reference_position;
    disturb(x, p.matter);
    bar.y0 = start(*bar.model, x, 0.1);
    return bar;
}

std::vector<Column<2>> columns_of(const PulledBar& bar, std::size_t least) {
    const auto piece = [least](std::size_t k) {
        return [least, k](const Model<2>& model, std::span<const double> y) {
            const auto sizes = piece_sizes(model, y, least);
            return k < sizes.size() ? static_cast<double>(sizes[k]) : 0.0;
        };
    };
    (void)bar;
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

/// The first row in which there is more than one piece; none where there is none.
std::optional<double> parted_at(const History& h) {
    const auto t = h.column("t"), pieces = h.column("pieces");
    for (std::size_t k = 0; k < t.size(); ++k)
        if (pieces[k] > 1.0) return t[k];
    return {};
}

void report(Session& session, const Parameters& p, const PulledBar& bar, const RunRecord& run) {
    const History& h = run.history;
    const Known known = known_of(p.matter.kind);
    if (const auto t = parted_at(h))
        session.claim(
            {"load_at_parting", bar.load(*t), known.parts_at, known.tolerance, "[HH07] 13"},
            session.when_default({"columns"}));
    for (const char* name : {"pieces", "largest_piece", "second_piece", "length"})
        session.measure(name, h.last(name), "at the end");
    session.measure("closest_pair", h.smallest("closest_pair"));
    session.check_promises(run);
}

void draw(Session& session, const Parameters& p, const PulledBar& bar,
          const std::vector<NearestState<2>>& states, const RunRecord& run) {
    const FirstNeighbours neighbours(bar.model->particles());
    std::vector<ConfigurationPanel> panels;
    const auto add = [&](double t, const Points<2>& x) {
        panels.push_back(
            {fmt::format("t = {:.4g}, load {:.3g}", t, bar.load(t)), x, neighbours.lost(x), {}});
    };
    for (const auto& state : states)
        if (state.there()) add(state.t, state.position);
    add(run.statistics.t_end, ConstState<2>(bar.model->layout(), run.y).position());
    session.note_drawn(draw_configurations(session.plots_folder(), "configurations",
                                           "A bar under tension: " + title_of(p.matter.kind),
                                           panels, 1, "first neighbours lost"));
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("tension_test", "a tapered bar under tension, [HH07] 13", 0.25);
    Parameters p;
    auto& options = problem.options();
    options.integer("columns", p.columns, "particles along the bar", between(8, 2000));
    options.integer("rows", p.rows, "particles across the bar", between(4, 200));
    options.number("taper", p.taper, "how much lower the bar is at its middle, by its height",
                   between(0.0, 0.5));
    options.number("load-rate", p.load_rate,
                   "growth of the load at the ends by time (default: that of the model)",
                   positive());
    options.number("damping", p.damping, "rate of the friction, gamma (default 0.05)",
                   non_negative());
    add_matter_options(problem, p.matter);
    return problem.main(argc, argv, [&](Session& session) {
        if (session.common().smoke) {
            if (!session.given("columns")) p.columns = 16;
            if (!session.given("rows")) p.rows = 6;
        }
        const Known known = known_of(p.matter.kind);
        session.prefer_step(known.dt);
        PulledBar bar = make_bar(session, p);
        Plan<2> plan;
        plan.t_end = known.largest_load / bar.load_rate;
        plan.output_every = plan.t_end / 1000.0;
        plan.snapshot_every = plan.t_end / 40.0;
        const std::size_t least = bar.model->particles().size() / 20;
        plan.record(columns_of(bar, least));
        plan.observe({.enough = [](const History& h) {
            const auto t = parted_at(h);
            return t && h.last("t") >= 1.03 * *t;
        }});
        std::vector<NearestState<2>> drawn;
        for (const double part : {0.0, 0.5, 0.75}) drawn.push_back({part * plan.t_end});
        plan.observe(keep_nearest<2>(drawn));
        const auto run = session.run(*bar.model, bar.y0, std::move(plan));
        report(session, p, bar, run);
        if (session.plots()) draw(session, p, bar, drawn, run);
    });
}
