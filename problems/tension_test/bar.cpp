// SPDX-License-Identifier: GPL-3.0-or-later
#include "bar.hpp"

#include "../breaking/pieces.hpp"
#include <spam/external/distributed_load.hpp>
#include <spam/external/friction.hpp>

namespace tension_test {
namespace {

/// Distance along the bar: in a row, or in space of layers of a face-centred cubic lattice along its cells' edges.
template <int Dim>
const double apart = Dim == 2 ? 1.0 : std::sqrt(0.5);

/// What differs from model to model, and the load at which 840 particles part at that rate; in space molecules alone,
/// 960 of them: what a section bears.
struct Known {
    double load_rate, damping, step, largest_load;
    double parts_at, tolerance;
};

template <int Dim>
Known known_of(MatterKind kind) {
    switch (kind) {
        case MatterKind::pair_md:
            if (Dim == 3) return {0.025, 0.1, 0.005, 3.0, 1.894, 0.15};
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
template <int Dim>
double height(const Parameters& p, double x) {
    const double half = 0.5 * (p.columns - (Dim == 2 ? 0.5 : 1.0)) * apart<Dim>;
    return 1.0 - p.taper * (1.0 - std::abs(x) / half);
}

/// In space every second site of a simple cubic lattice, whose first neighbours are among the others.
template <int Dim>
Particles<Dim> tapered_block(const Parameters& p) {
    Points<Dim> x;
    if constexpr (Dim == 2) {
        x = triangular_block(p.columns, p.rows.value_or(14));
    } else {
        const int rows = p.rows.value_or(8);
        const Points<3> all = square_lattice<3>({p.columns, rows, rows}, apart<3>);
        std::vector<Eigen::Index> taken;
        for (Eigen::Index k = 0; k < all.cols(); ++k)
            if (std::lround(all.col(k).sum() / apart<3>) % 2 == 0) taken.push_back(k);
        x = all(Eigen::all, taken);
    }
    x = centred<Dim>(x);
    for (auto point : x.colwise()) point.template tail<Dim - 1>() *= height<Dim>(p, point.x());
    return one_body(make_particles<Dim>(x, 1.0));
}

/// Everything but the seed.
template <int Dim>
bool is_known(const Session& session, const Parameters& p, MatterKind kind, const RunRecord& run) {
    if (Dim == 3 && kind != MatterKind::pair_md) return false;
    auto options = Problem::scheme_option_names();
    options.insert(
        options.end(),
        {"rows",          "taper",          "load-rate",  "damping",         "yield-stress",
         "hardening",     "failure-strain", "strength",   "surface-tension", "core",
         "core-range",    "disorder",       "kernel",     "range",           "t-end",
         "tension-limit", "penalty",        "bond-yield", "stretch-limit",   "stress-limit"});
    return session.when_default(options) && p.columns == (Dim == 2 ? 60 : 30) && run.complete;
}

/// Another program's bar of 50 x 14, with its penalty.
bool is_recorded_stretching(const Session& session, const Parameters& p, const RunRecord& run) {
    return run.complete && run.statistics.t_end >= 300.0 && p.end_speed == 0.4 && p.columns == 50 &&
           p.taper == 0.0 && p.matter.yield_stress == 0.03 && p.matter.tension_limit == 0.06 &&
           p.matter.disorder == 0.0 && p.matter.penalty == 1.0 &&
           session.when_default({"rows", "range", "core", "core-range", "bond-yield",
                                 "stretch-limit", "stress-limit"});
}

/// In colours the share of its first neighbours that a particle has lost.
template <int Dim>
ConfigurationPanel panel_of(const Parameters& p, const PulledBar<Dim>& bar, double t,
                            const Points<Dim>& position, const std::string& title) {
    ConfigurationPanel panel;
    panel.title = fmt::format("{}t = {:.4g}", title, t);
    if (bar.load_rate > 0.0) panel.title += fmt::format(", load {:.3g}", bar.load_rate * t);
    const auto& particles = bar.model->particles();
    const Points<Dim>& X = particles.reference_position;
    const auto lost = FirstNeighbours<Dim>(particles).lost(position);
    std::vector<Eigen::Index> shown;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        const double z = X(Dim - 1, i) / height<Dim>(p, X(0, i)) / apart<Dim>;
        if (Dim == 3 && !(z > -0.2 && z < 0.8)) continue;
        shown.push_back(i);
        panel.colour.push_back(lost[static_cast<std::size_t>(i)]);
    }
    panel.position = position.template topRows<2>()(Eigen::all, shown);
    return panel;
}

/// A load that grows with time and with the distance from the middle, under friction.
template <int Dim>
void add_load(ParticleModel<Dim>& model, const Parameters& p, double rate, double damping) {
    Points<Dim> pattern = model.particles().reference_position;
    pattern.row(0) /= 0.5 * p.columns * apart<Dim>;
    pattern.template bottomRows<Dim - 1>().setZero();
    model.add(std::make_unique<DistributedLoad<Dim>>([rate](double t) { return rate * t; },
                                                     std::move(pattern)));
    if (damping > 0.0) model.add(std::make_unique<Friction<Dim>>(damping, FrictionOf::all_motion));
}

/// Free and without a load, with a velocity along it in proportion to the place.
template <int Dim>
PulledBar<Dim> make_stretching_bar(const Session& session, const Parameters& p,
                                   const Matter& matter) {
    PulledBar<Dim> bar{{}, matter.kind, 0.0, 0.05, 2.4 * p.columns * apart<Dim> / *p.end_speed};
    bar.model = make_model<Dim>(session, matter, {tapered_block<Dim>(p)});
    Points<Dim> x = bar.model->particles().reference_position;
    disturb(x, matter);
    bar.y0 = start(*bar.model, x, *p.end_speed);
    const State<Dim> state(bar.model->layout(), bar.y0);
    const auto& X = bar.model->particles().reference_position;
    state.velocity().row(0) = (*p.end_speed / X.row(0).maxCoeff()) * X.row(0);
    return bar;
}

}  // namespace

template <int Dim>
PulledBar<Dim> make_bar(const Session& session, const Parameters& p, const Matter& matter) {
    if (p.end_speed) return make_stretching_bar<Dim>(session, p, matter);
    const Known known = known_of<Dim>(matter.kind);
    // The stress in the middle is as load times length.
    const double shorter = (Dim == 2 ? 60.0 : 30.0) / p.columns;
    const double rate = p.load_rate.value_or(shorter * known.load_rate);
    const double step = known.step * breaking::relative_step(matter);
    PulledBar<Dim> bar{{}, matter.kind, rate, step, shorter * known.largest_load / rate};
    bar.model = make_model<Dim>(session, matter, {tapered_block<Dim>(p)});
    add_load(*bar.model, p, rate, p.damping.value_or(known.damping));
    Points<Dim> x = bar.model->particles().reference_position;
    disturb(x, matter);
    bar.y0 = start(*bar.model, x, 0.1);
    return bar;
}

template <int Dim>
std::vector<Column<Dim>> columns_of(const PulledBar<Dim>& bar) {
    const std::size_t least = bar.model->particles().size() / 20;
    // What is drawn out far is still one where nothing has come between.
    const double reach =
        bar.kind == MatterKind::material_vectors ? bar.model->reach() : piece_reach;
    using Y = std::span<const double>;
    const auto sizes = [least, reach](const Model<Dim>& model, Y y) {
        return piece_sizes(model, y, least, reach);
    };
    const auto piece = [sizes](std::size_t k) {
        return [sizes, k](const Model<Dim>& model, Y y) {
            const auto all = sizes(model, y);
            return k < all.size() ? static_cast<double>(all[k]) : 0.0;
        };
    };
    return {{"pieces", [sizes](const Model<Dim>& model,
                               Y y) { return static_cast<double>(sizes(model, y).size()); }},
            {"largest_piece", piece(0)},
            {"second_piece", piece(1)},
            {"length",
             [](const Model<Dim>& model, Y y) {
                 const auto x = ConstState<Dim>(model.layout(), y).position().row(0);
                 return x.maxCoeff() - x.minCoeff();
             }},
            closest_pair_column<Dim>()};
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

template <int Dim>
void report(Session& session, const Parameters& p, const PulledBar<Dim>& bar,
            const RunRecord& run) {
    const Findings findings(session, bar.prefix);
    const History& h = run.history;
    const Known known = known_of<Dim>(bar.kind);
    const bool default_case = is_known<Dim>(session, p, bar.kind, run);
    const auto t = parted_at(h);
    if (t && bar.load_rate > 0.0) {
        findings.claim("load_at_parting", bar.load_rate * *t, known.parts_at, known.tolerance,
                       Dim == 2 ? "[HH07] 13; recorded values" : "what the bonds of a section bear",
                       default_case);
        const double half = 0.5 * static_cast<double>(run.statistics.particles);
        findings.claim("second_piece", h.largest("second_piece"), 0.8 * half, 0.2 * half,
                       "[HH07] 13: two large pieces", default_case);
    }
    const bool stretched = Dim == 2 && is_recorded_stretching(session, p, run);
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

template <int Dim>
void draw(Session& session, const Parameters& p, const std::vector<PulledBar<Dim>>& bars,
          const std::vector<RunRecord>& runs) {
    std::vector<ConfigurationPanel> panels;
    const bool several = bars.size() > 1;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const PulledBar<Dim>& bar = bars[k];
        const std::string title = several ? title_of(bar.kind) + ", " : "";
        for (const auto& state : bar.drawn)
            if (state.there() && state.t < runs[k].statistics.t_end && !(several && state.t == 0.0))
                panels.push_back(panel_of<Dim>(p, bar, state.t, state.position, title));
        panels.push_back(panel_of<Dim>(p, bar, runs[k].statistics.t_end,
                                       ConstState<Dim>(bar.model->layout(), runs[k].y).position(),
                                       title));
    }
    const std::string title = Dim == 2 ? "A bar under tension" : "A bar's middle layer";
    draw_configurations(session, "configurations",
                        several ? title : title + ": " + title_of(bars.front().kind), panels,
                        several ? 2 : 1, "first neighbours lost");
}

template PulledBar<2> make_bar(const Session&, const Parameters&, const Matter&);
template PulledBar<3> make_bar(const Session&, const Parameters&, const Matter&);
template std::vector<Column<2>> columns_of(const PulledBar<2>&);
template std::vector<Column<3>> columns_of(const PulledBar<3>&);
template void report(Session&, const Parameters&, const PulledBar<2>&, const RunRecord&);
template void report(Session&, const Parameters&, const PulledBar<3>&, const RunRecord&);
template void draw(Session&, const Parameters&, const std::vector<PulledBar<2>>&,
                   const std::vector<RunRecord>&);
template void draw(Session&, const Parameters&, const std::vector<PulledBar<3>>&,
                   const std::vector<RunRecord>&);

}  // namespace tension_test
