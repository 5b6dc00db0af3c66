// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: motions of a mesh of one-point elements that nothing resists: butterfly and hourglass, [HH01]; 2 s
//
// Motions of a finite-element mesh that no stress resists, the butterfly and the hourglass of [HH01], Fig. 1.
//
//     o---o---o---o---o      n x n elastic elements with one point of integration each, at rest and free, whose
//     |   |   |   |   |      nodes get the velocities
//     o---o---o---o---o
//     |   |   |   |   |          hourglass   s (1, 0) and s (0, 1)      s = (-1)^(i + j) of node i, j
//     o---o---o---o---o          butterfly   s (x, -y)
//     |   |   |   |   |
//     o---o---o---o---o      The velocity gradient at the centre of an element is zero in the first, and a turn
//     |   |   |   |   |      in the second: elements of the two colours of a chequerboard turn against each other.
//     o---o---o---o---o      Neither changes a stress, so both go on for ever.
//
// 1. Counted: velocities of all nodes are mapped to rates of stress by the right-hand side; the null space of
//    that, less the three rigid motions, has three dimensions for n = 2 to 8, and two for n = 1.
// 2. In motion: the kinetic energy of each of the three stays what it is. With a resistance to the hourglass
//    (rhs/elements.hpp) it is gone before the end.
#include "mesh_modes/zero_modes.hpp"

namespace {

using namespace mesh_modes;

struct Parameters {
    int elements = 4;
    double speed = 1e-12;
    HourglassControl control{0.1, 0.0};
};

struct Moving : Variant<2> {
    Mode mode;
    bool resisted;
};

/// A single element cannot turn against another one.
std::vector<Mode> modes_of(int n) {
    if (n == 1) return {Mode::hourglass_x, Mode::hourglass_y};
    return {Mode::hourglass_x, Mode::hourglass_y, Mode::butterfly};
}

std::vector<Moving> make_moving(const Parameters& p) {
    std::vector<Moving> all;
    for (const bool resisted : {false, true})
        for (const Mode mode : modes_of(p.elements)) {
            Moving one{{}, mode, resisted};
            one.call(fmt::format("{}_{}", to_string(mode), resisted ? "resisted" : "free"));
            one.model = make_mesh(p.elements, resisted ? p.control : HourglassControl{});
            one.y0 = initial_state<2>(*one.model, 1.0, p.speed, at_rest<2>());
            State<2>(one.model->layout(), one.y0).velocity() =
                p.speed * velocities(*one.model, mode);
            one.model->layout().set_scale(Field::velocity, p.speed);
            one.model->layout().set_scale(Field::energy, p.speed * p.speed);
            all.push_back(std::move(one));
        }
    return all;
}

/// Meshes of 1 x 1 to 8 x 8 and the one that moves.
void count_modes(Session& session, const Parameters& p) {
    const Findings findings(session);
    std::vector<int> sizes{1, 2, 3, 4, 5, 6, 7, 8};
    if (p.elements > 8) sizes.push_back(p.elements);
    double gap = HUGE_VAL;
    for (const int n : sizes) {
        const auto mesh = make_mesh(n, {});
        const ZeroModes found = zero_modes(*mesh);
        gap = std::min(gap, found.gap);
        findings.check(fmt::format("zero_modes_{}", n), static_cast<double>(found.count),
                       n == 1 ? 2.0 : 3.0, 0.0,
                       n == 1 ? "8 velocities, 3 rigid motions, 3 strains"
                              : "[HH01], Fig. 1: the hourglass in two directions, the butterfly");
    }
    findings.measure("gap_of_singular_values", gap, "between modes that cost energy and others");
    const auto mesh = make_mesh(p.elements, {});
    for (const Mode mode : modes_of(p.elements))
        findings.check(fmt::format("{}_stress_rate", to_string(mode)),
                       stress_rate(*mesh, velocities(*mesh, mode)), 0.0, 1e-14,
                       "velocity gradients at centres are zero or turns");
}

void report(Session& session, const Parameters& p, const Moving& one, const RunRecord& run) {
    const History& h = run.history;
    const Findings findings(session, one.prefix);
    const double start = h.first("kinetic");
    // Turned by more than a little, elements of one colour spread those of the other.
    const double turned = p.speed * run.statistics.t_end * run.statistics.t_end;
    if (!one.resisted)
        findings.claim("kinetic_change", h.largest_change("kinetic") / start, 0.0, 1e-14,
                       "no stress resists it", one.mode != Mode::butterfly || turned < 1e-8);
    else
        findings.claim("kinetic_left", h.last("kinetic") / start, 0.0,
                       one.mode == Mode::butterfly ? 1e-3 : 1e-9,
                       "what resists the hourglass brakes it",
                       session.when_default({"elements", "speed", "hourglass-viscosity",
                                             "hourglass-stiffness", "t-end"}));
    findings.check_promises(run);
}

/// The nodes moved so that the fastest go a quarter of a side; elements coloured by how far they have turned, in
/// degrees.
ConfigurationPanel panel_of(const Moving& one, const std::string& title) {
    const Points<2>& X = one.model->particles().reference_position;
    const auto elements = one.model->quadrilaterals();
    const Points<2> moved = 0.25 * velocities(*one.model, one.mode);
    ConfigurationPanel panel{title, X + moved, turns(*one.model, moved), {}, {}};
    for (double& turn : panel.colour) turn *= 180.0 / std::numbers::pi;
    panel.elements.assign(elements.begin(), elements.end());
    panel.outlines.push_back(
        rectangle(Point<2>::Constant(X.minCoeff()), Point<2>::Constant(X.maxCoeff())));
    return panel;
}

void draw(Session& session, const Parameters& p, const std::vector<Moving>& all,
          const std::vector<RunRecord>& runs) {
    std::vector<ConfigurationPanel> panels;
    CurvePanel kinetic =
        frame("resisted: kinetic energy, in parts of the first", "t", "K/K₀", true);
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const std::string name = all[k].mode == Mode::butterfly     ? "butterfly, s (x, -y)"
                                 : all[k].mode == Mode::hourglass_x ? "hourglass, s (1, 0)"
                                                                    : "hourglass, s (0, 1)";
        if (!all[k].resisted) {
            panels.push_back(panel_of(all[k], name));
            continue;
        }
        const auto K = runs[k].history.column("kinetic");
        kinetic.curves.push_back({name, runs[k].history.column("t"), divided(K, K.front())});
    }
    const auto title =
        fmt::format("Motions that no stress resists, {0} x {0} elements", p.elements);
    draw_configurations(session, "modes", title, panels, panels.size(), "turned, degrees",
                        ColourScale::about_zero);
    draw_curves(session, "kinetic", title, {kinetic});
}

void compute(Session& session, const Parameters& p) {
    // What resists the hourglass vibrates with the root of its stiffness.
    session.prefer_step(0.05 / std::max(1.0, 1.5 * std::sqrt(p.control.stiffness)));
    auto all = make_moving(p);
    const auto runs = run_all(session, all, [&](const Moving&) {
        return Plan<2>{.t_end = session.common().smoke ? 10.0 : 40.0};
    });
    if (runs.size() < all.size() || !runs.back().complete) return;
    count_modes(session, p);
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, all[k], runs[k]);
    if (session.plots()) draw(session, p, all, runs);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("mesh_modes",
                    "motions of a mesh of one-point elements that nothing resists, [HH01]", 0.05);
    problem.units(lattice_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("elements", p.elements, "the mesh is elements x elements", between(1, 16));
    options.number("speed", p.speed, "of the fastest node", between(1e-100, 1e-3));
    options.number("hourglass-viscosity", p.control.viscosity,
                   "of what resists the hourglass, in parts of rho sqrt(A) c/4",
                   between(0.0, 100.0));
    options.number("hourglass-stiffness", p.control.stiffness,
                   "of what resists the hourglass, in parts of rho c^2/4", between(0.0, 100.0));
    return problem.main(argc, argv, [&](Session& session) { compute(session, p); });
}
