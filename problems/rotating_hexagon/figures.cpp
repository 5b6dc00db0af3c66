// SPDX-License-Identifier: GPL-3.0-or-later
// Figures 4 to 7 of [HHM04], with the letters of their captions:
//
//     Fig. 4  after 2pi/3    a MD, b summed density, c continuity density
//     Fig. 5  2pi/3  a <v>              e <v>_Monaghan    continuity
//             2pi    b                  f
//             2pi/3  c                  g                 chain rule
//             2pi    d                  h
//     Fig. 6  L(t) of a, b and of e, f of Fig. 5
//     Fig. 7  after 2pi      a <v>      c <v>_Monaghan    torques of pairs balanced
//                            b          d                 torques of particles balanced
#include "hexagon.hpp"

namespace rotating_hexagon {
namespace {

/// One panel: which hexagon, when, and what is written above it.
struct Panel {
    std::size_t hexagon;
    double turns;
    std::string title;
};

struct Layout {
    std::size_t columns;
    std::vector<Panel> panels;
};

Layout layout_of(int figure) {
    constexpr double third = 1.0 / 3.0;
    if (figure == 4)
        return {3,
                {{0, third, "(a) molecular dynamics, 2π/3"},
                 {1, third, "(b) SPAM, summed density, 2π/3"},
                 {2, third, "(c) SPAM, continuity, 2π/3"}}};
    if (figure == 5)
        return {2,
                {{0, third, "(a) ⟨v⟩, continuity, 2π/3"},
                 {1, third, "(e) ⟨v⟩ Monaghan, continuity, 2π/3"},
                 {0, 1.0, "(b) ⟨v⟩, continuity, 2π"},
                 {1, 1.0, "(f) ⟨v⟩ Monaghan, continuity, 2π"},
                 {2, third, "(c) ⟨v⟩, chain rule, 2π/3"},
                 {3, third, "(g) ⟨v⟩ Monaghan, chain rule, 2π/3"},
                 {2, 1.0, "(d) ⟨v⟩, chain rule, 2π"},
                 {3, 1.0, "(h) ⟨v⟩ Monaghan, chain rule, 2π"}}};
    return {2,
            {{0, 1.0, "(a) ⟨v⟩, pair torques"},
             {1, 1.0, "(c) ⟨v⟩ Monaghan, pair torques"},
             {2, 1.0, "(b) ⟨v⟩, particle torques"},
             {3, 1.0, "(d) ⟨v⟩ Monaghan, particle torques"}}};
}

/// Of the paper's weight nothing is said.
std::string title_of(const Session& session, int figure, const RunRecord& run) {
    const Scheme& scheme = session.scheme();
    const bool usual = scheme.kernel == Kernel::lucy && scheme.range == 3.0;
    return fmt::format(
        "[HHM04] Fig. {}: {} particles{}", figure, run.statistics.particles,
        usual ? "" : fmt::format(", {} of range {:g}", to_string(scheme.kernel), scheme.range));
}

void draw_momentum(Session& session, const std::vector<Hexagon>& hexagons,
                   const std::vector<RunRecord>& runs) {
    CurvePanel panel = frame("continuity density", "t", "angular momentum L");
    for (std::size_t k = 0; k < runs.size(); ++k)
        panel.curves.push_back(over_time(hexagons[k].title, runs[k].history, "angular_momentum"));
    draw_curves(session, "figure_6", title_of(session, 6, runs.front()), {panel});
}

double lost_after(const History& h, double t) {
    return 1.0 - h.at(t, "angular_momentum") / h.first("angular_momentum");
}

/// The figure as it is in the paper.
bool is_the_papers(const Session& session, const Parameters& p) {
    const Scheme& scheme = session.scheme();
    const auto& integrator = session.integrator();
    return p.size == 8 && p.speed == 0.1 &&
           p.turns == turns_of_figure(static_cast<int>(*p.figure)) &&
           scheme.kernel == Kernel::lucy && scheme.range == 3.0 && scheme.viscosity == 0.0 &&
           scheme.closest_approach == 0.0 && scheme.mean_density == MeanDensityKind::arithmetic &&
           integrator.method == "rk4" && *integrator.dt <= 0.1;
}

/// The second of two is better: its shape error is a part of the other's, which part is as found here.
void check_better(Session& session, const Parameters& p, const RunRecord& worse,
                  const RunRecord& better, double part, double tolerance, const char* source) {
    session.claim({fmt::format("shape_error_of_{}_by_{}", better.label, worse.label),
                   better.history.last("shape_error") / worse.history.last("shape_error"), part,
                   tolerance, source},
                  is_the_papers(session, p));
}

}  // namespace

double turns_of_figure(int figure) { return figure == 4 ? 1.0 / 3.0 : 1.0; }

std::vector<Hexagon> hexagons_of_figure(const Parameters& p, const Scheme& standard) {
    std::vector<Hexagon> all;
    const auto add = [&](const char* label, ModelKind kind, Density density, Transport transport,
                         AngularMomentum momentum) {
        Scheme scheme = standard;
        scheme.density = density;
        scheme.transport = transport;
        scheme.angular_momentum = momentum;
        all.push_back(make_hexagon(p, kind, scheme, label));
    };
    constexpr auto spam = ModelKind::spam, md = ModelKind::md;
    constexpr auto continuity = Density::continuity, chain_rule = Density::chain_rule;
    constexpr auto plain = Transport::plain, average = Transport::average,
                   monaghan = Transport::monaghan;
    constexpr auto free = AngularMomentum::free, pair = AngularMomentum::torque_pair,
                   particle = AngularMomentum::torque_particle;
    const int figure = static_cast<int>(*p.figure);
    if (figure == 4) {
        add("md", md, continuity, plain, free);
        add("summed", spam, Density::summed, plain, free);
        add("continuity", spam, continuity, plain, free);
    } else if (figure == 7) {
        add("average_torque_pair", spam, continuity, average, pair);
        add("monaghan_torque_pair", spam, continuity, monaghan, pair);
        add("average_torque_particle", spam, continuity, average, particle);
        add("monaghan_torque_particle", spam, continuity, monaghan, particle);
    } else {
        add("average", spam, continuity, average, free);
        add("monaghan", spam, continuity, monaghan, free);
    }
    if (figure == 5) {
        add("average_chain_rule", spam, chain_rule, average, free);
        add("monaghan_chain_rule", spam, chain_rule, monaghan, free);
    }
    return all;
}

void check_figure(Session& session, const Parameters& p, const std::vector<RunRecord>& runs) {
    for (const auto& run : runs)
        if (!run.complete) return;
    const int figure = static_cast<int>(*p.figure);
    if (figure == 4) {
        for (const std::size_t k : {1U, 2U})
            for (const int degrees : {60, 120})
                session.measure(
                    fmt::format("{}_angular_momentum_lost_at_{}_degrees", runs[k].label, degrees),
                    lost_after(runs[k].history, p.turn() * degrees / 360.0),
                    degrees == 60 ? "measured; [HHM04] VI: 1 %" : "measured; [HHM04] VI: 5 %");
        check_better(session, p, runs[1], runs[2], 0.62, 0.1,
                     "[HHM04] VI: the lattice persists better");
    }
    if (figure == 5 || figure == 7)
        for (std::size_t k = 0; k + 1 < runs.size(); k += 2)
            check_better(session, p, runs[k], runs[k + 1], 0.38, 0.05,
                         "[HHM04] Fig. 5: enhanced stability");
}

void draw_figure(Session& session, const Parameters& p, const std::vector<Hexagon>& hexagons,
                 const std::vector<RunRecord>& runs) {
    const int figure = static_cast<int>(*p.figure);
    if (figure == 6) return draw_momentum(session, hexagons, runs);
    const Layout layout = layout_of(figure);
    std::vector<ConfigurationPanel> panels;
    for (const Panel& panel : layout.panels) {
        if (panel.hexagon >= runs.size()) continue;  // interrupted
        const Hexagon& hexagon = hexagons[panel.hexagon];
        for (const NearestState<2>& state : hexagon.drawn)
            if (std::abs(state.wanted - panel.turns * p.turn()) < 1e-6 * p.turn())
                panels.push_back(speed_panel(panel.title, *hexagon.model, state));
    }
    draw_configurations(session, fmt::format("figure_{}", figure),
                        title_of(session, figure, runs.front()), panels, layout.columns, "speed");
}

}  // namespace rotating_hexagon
