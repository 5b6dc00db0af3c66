// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: free expansion of a gas and the growth of its entropy, [HH01] Figs. 2, 3; 10 s
//
// Free expansion of an ideal gas into four times its room, [HH01].
//
//     +-------------+      n x n smooth particles (64 x 64) of mass and spacing 1 at rest, each off
//     |             |      its site by 0.1 (u - 1/2), in the middle of a periodic box of side 2n. The
//     |    o o o    |      edges of the gas reach the box at t = n/4, the gas of the neighbouring
//     |    o o o    |      box: sound waves cross, and what was ordered motion ends as motion that
//     |    o o o    |      neighbours do not share.
//     |             |
//     +-------------+
//
//     x_dot = v,   v_dot_i = -sum_j m_j (P_i/rho_i^2 + P_j/rho_j^2) grad_i w_ij = -sum_j m_j grad_i w_ij
//     P = rho^2/2,   e = rho/2: the isentrope of a plane ideal gas, no viscosity, no heat flow
//
// Nothing in the equations makes entropy, and yet the gas must end with N k ln 4 more. It is in the
// velocities: what differs from the mean of the neighbours is heat, [HH01] eq 22 (see
// free_expansion/entropy.hpp for its sign),
//     S = N k <ln(e_int/rho)>,   e_int = e + (<v^2> - <v>^2)/2,
// summed over particles (entropy_sum) or integrated over a grid (entropy_grid), as a part of N k ln 4.
// Nothing happens before the gas meets the box; within another n it has nearly all. With the whole v^2
// in place of its fluctuation (entropy_full_v2) streaming passes for heat: 0.4 before anything is mixed.
// It ends below 1 for want of neighbours: each counts itself, and more so in the thin gas.
//
//     --compare          32 x 32, 64 x 64, 128 x 128 on one picture, [HH01] Fig. 3; 1 min. In space
//                        8^3, 12^3, 16^3
//     --dimension 1      twofold expansion on a line, P = rho^3/3, e = rho^2/6, exercise 1
//     --dimension 3      eightfold expansion in space: n^3 particles (16^3) into a box of side 2n,
//                            P = 0.6 rho^(5/3),   e = 0.9 rho^(2/3),   S = N k <ln(e_int^(3/2)/rho)>
//                        as a part of N k ln 8. Pictures show a cut: the layer of sites next to the middle
//                        at the start, and particles within half a spacing of it later; files have all of space
//     --particles 100    exercise 4. Text: from an area of 25 to 100; here from 100 to 400 in units of
//                        half the length, mass 1/4, otherwise the same
//     --ranges density   h = range/rho^(1/D): as many neighbours in the thin gas as in the dense one
//     --cost             seconds against the number of particles, exercise 4
//     --movie            frames, and a film where ffmpeg is installed
#include "free_expansion/gas.hpp"

namespace {

using namespace free_expansion;

/// Cells along an edge from --particles, where that was given.
void settle_particles(Session& session, Parameters& p) {
    if (!p.particles) return;
    const int n = *p.particles;
    const int edge = static_cast<int>(std::lround(std::pow(n, 1.0 / p.dimension)));
    const auto of_edge = [&p](int cells) {
        return static_cast<int>(std::lround(std::pow(cells, p.dimension)));
    };
    if (of_edge(edge) != n) {
        const int below = of_edge(edge) < n ? edge : edge - 1;
        refuse("particles: {} is not a {}; near it are {} and {}", n,
               p.dimension == 2 ? "square" : "cube", of_edge(below), of_edge(below + 1));
    }
    if (session.given("cells") && session.given("particles") && p.cells != edge)
        refuse("particles: {} and --cells {} contradict; leave one out", n, p.cells);
    p.cells = edge;
    session.leave_out_of_case({"cells"});
}

/// Options that have no meaning beside others.
void add_rules(Options& options, const Parameters& p) {
    options.exclude("compare", {"cells", "particles", "movie"},
                    "has no effect with {by} (three sizes); leave one out");
    options.exclude("cost", {"compare"}, "has no effect with {by} (five sizes); leave one out",
                    true);
    options.exclude("cost", {"cells", "particles", "movie"},
                    "has no effect with {by} (five sizes); leave one out");
    options.exclude("cost", {"restart"},
                    "times that --cost measured are of one run; start it again without --restart");
    options.only_when(
        {"movie"}, {}, [&p] { return p.dimension > 1; },
        "has no effect with --dimension 1; leave one out");
    options.only_when(
        {"compare", "cost"}, {}, [&p] { return p.dimension > 1 || !(p.compare || p.cost); },
        "has no effect with --dimension 1; leave one out");
    options.exclude("no-plots", {"movie"}, "has no effect with --no-plots; leave one out");
}

template <int Dim>
Plan<Dim> plan_of(Session& session, Gas<Dim>& gas, const Parameters& p, double t_end, int largest) {
    using Values = std::span<const double>;
    const auto folder = [&session, &gas] {
        return gas.label.empty() ? session.folder() : session.folder().inside(gas.label);
    };
    Plan<Dim> plan;
    plan.t_end = t_end;
    plan.output_every = t_end / (p.compare ? 192.0 : 96.0);
    // Often enough for the configurations drawn, and no more than 48 files.
    plan.snapshot_every = std::max(std::min(largest / 8.0, t_end / 4.0), t_end / 48.0);
    plan.record(entropy_columns(gas));
    plan.observe(keep_nearest<Dim>(gas.drawn));
    plan.observe({.on_snapshot = [&gas, folder](double t, const Model<Dim>&,
                                                Values y) { write_fields(folder(), gas, t, y); },
                  .memory = [&gas](Archive& archive) { archive(gas.field_times); }});
    if constexpr (Dim > 1)
        if (p.movie)
            plan.observe({.on_row =
                              [&gas, &session, folder](double t, const Model<Dim>&, Values y) {
                                  session.note_drawn(draw_frame(folder(), gas, gas.frames++, t, y));
                              },
                          .memory = [&gas](Archive& archive) { archive(gas.frames); }});
    return plan;
}

template <int Dim>
void run(Session& session, const Parameters& p) {
    const bool smoke = session.common().smoke;
    std::vector<int> sizes{p.cells};
    if (p.compare) sizes = smoke || Dim == 3 ? std::vector{8, 12, 16} : std::vector{32, 64, 128};
    std::vector<Gas<Dim>> gases;
    for (const int cells : sizes) {
        gases.push_back(make_gas<Dim>(cells, p));
        if (!p.compare) continue;
        gases.back().call(fmt::format("n{}", cells));
    }
    const double plateau = Dim == 1   ? 3.0 * sizes.back()
                           : Dim == 3 ? 4.0 * sizes.back()
                                      : std::max(1.5 * sizes.back(), 60.0);
    const double t_end = session.end(plateau, 24.0);
    const auto runs = run_all(session, gases, [&](Gas<Dim>& gas) {
        return plan_of(session, gas, p, t_end, sizes.back());
    });
    for (std::size_t k = 0; k < runs.size(); ++k) check(session, p, gases[k], runs[k]);
    if (p.movie) make_movie(session, session.folder());
    if (!session.plots()) return;
    draw_entropy(session, gases, runs);
    if (runs.size() == gases.size()) draw(session, gases.back());
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("free_expansion", "free expansion of a gas and its entropy, [HH01]", 0.25,
                    "0.25, on a line 0.125, in space 0.2, or shorter where the range is short");
    problem.units(fluid_units());
    Parameters p;
    auto& options = problem.options();
    options.integer(
        "dimension", p.dimension,
        "2: fourfold expansion in the plane; 1: twofold expansion on a line; 3: eightfold "
        "expansion in space",
        between(1, 3));
    options.integer("cells", p.cells,
                    "particles along an edge of the gas, at spacing 1 (default in space: 16)",
                    between(2, 4000));
    options.integer(
        "particles", p.particles,
        "number of particles, in the plane a square number, in space a cube; instead of "
        "--cells",
        between(4, 16000000));
    options.choice<Walls>("walls", p.walls, {Walls::periodic, Walls::mirror},
                          "boundary of the box");
    const Sides sides(options, {"walls", "walls", "walls", "walls", "walls", "walls"},
                      {.temperatures = false, .own = "walls", .stands_for = "what --walls says"});
    p.sides = &sides;
    options.only_when(
        {"bottom", "top"}, {"dimension"}, [&p] { return p.dimension > 1; },
        "has no meaning with {by}; a line has a left and a right end");
    options.only_when(
        {"front", "back"}, {"dimension"}, [&p] { return p.dimension == 3; },
        "has no meaning with {by}; these sides are of a box in space");
    options.choice<Kernel>("kernel", p.kernel, all_kernels(), "weight function");
    options.number("range", p.range,
                   "range h: pairs farther apart do not interact (default in space: 4)",
                   positive());
    options.choice<Ranges>("ranges", p.ranges, {Ranges::fixed, Ranges::density},
                           "range of a particle: the same for all, or range/rho^(1/dimension), "
                           "larger in the thin gas");
    options.integer("seed", p.seed, "seed of the random offsets from the lattice",
                    between(0, 1000000000));
    options.flag("compare", p.compare, "compare three sizes in one picture, [HH01] Fig. 3");
    options.flag("cost", p.cost,
                 "measure seconds against the number of particles, [HH01] exercise 4");
    options.flag("movie", p.movie, "draw the frames of a film");
    options.exclude_from_case({"movie"});
    add_rules(options, p);

    return problem.main(argc, argv, [&](Session& session) {
        p.only_described = session.common().dry_run;
        options.command_line_wins({"particles"}, {"cells"});
        options.command_line_wins({"cells"}, {"particles"});
        const bool of_space = p.dimension == 3, follow = p.ranges == Ranges::density;
        if (of_space && !session.given("range")) p.range = 4.0;
        // On a line of fewer, ranges that follow the density come to fill half of the box.
        if (!session.given("cells") && !p.particles && (of_space || session.common().smoke))
            p.cells = of_space && session.common().smoke ? (follow ? 10 : 8)
                      : p.dimension == 1 && follow       ? 64
                                                         : 16;
        settle_particles(session, p);
        if (of_space && p.cells > 251)
            refuse("cells: {} by {} by {} are too many particles; use at most 251 in space",
                   p.cells, p.cells, p.cells);
        session.prefer_step(p.dimension == 1   ? step_for<1>(p)
                            : p.dimension == 2 ? step_for<2>(p)
                                               : step_for<3>(p));
        if (p.cost) return of_space ? measure_cost<3>(session, p) : measure_cost<2>(session, p);
        p.dimension == 1   ? run<1>(session, p)
        : p.dimension == 2 ? run<2>(session, p)
                           : run<3>(session, p);
    });
}
