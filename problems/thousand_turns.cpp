// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: the hexagon after 1, 10, 100 and 1,000 turns with material vectors, beside the paper's best; 4 min
//
// The rotating hexagon of [HHM04], 217 particles, speed 0.1 at the corners, turns a thousand times:
//
//     material vectors        leapfrog, dt = 0.3: after 1, 10, 100 and 1,000 nominal turns
//     the paper's best        of its schemes that keep L the one that goes furthest in turns_survived, <v>_Monaghan
//                             with balanced pair torques and viscosity 1, by rk4, dt = 0.1: after 1, 2, 3
//                             and 4. It has clumped after 1.7
//
// The first are as many as --turns, its tenth, hundredth and thousandth part. Every configuration is kept as a table
// of x, y and velocities.
#include "common.hpp"
#include <spam/io/text_file.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/problem/run_in_memory.hpp>
#include <spam/rhs/material_vectors.hpp>

namespace {

using namespace spam;

struct Parameters {
    int size = 8;
    double speed = 0.1, turns = 1000.0;
    double turn() const { return 2.0 * std::numbers::pi * size / speed; }
};

/// One of the two, and when it is looked at.
struct Hexagon {
    std::string name, title;
    std::vector<double> turns;
    IntegratorOptions integrator;
    std::function<std::unique_ptr<Model<2>>(Particles<2>)> model;

    std::string file(std::size_t number) const {
        return fmt::format("{}_{:g}_turns.csv", name, turns[number]);
    }
};

std::vector<Hexagon> hexagons(const Parameters& p, bool smoke) {
    const auto solid = ElasticSolid::triangular_lattice();
    const double part = smoke ? 0.01 : 1.0;
    return {{"material_vectors",
             "material vectors",
             {0.001 * p.turns, 0.01 * p.turns, 0.1 * p.turns, p.turns},
             {.method = "leapfrog", .dt = 0.3},
             [solid](Particles<2> particles) {
                 return std::make_unique<MaterialVectorModel<2>>(
                     std::move(particles), PolynomialSolid::like(solid),
                     MaterialVectorScheme{.density = triangular_density});
             }},
            {"monaghan_pair_viscous",
             "paper's best",
             {part, 2.0 * part, 3.0 * part, 4.0 * part},
             {.method = "rk4", .dt = 0.1},
             [solid](Particles<2> particles) {
                 return std::make_unique<SmoothParticleModel<2>>(
                     std::move(particles), solid,
                     Scheme{.transport = Transport::monaghan,
                            .angular_momentum = AngularMomentum::torque_pair,
                            .viscosity = 1.0});
             }}};
}

const std::vector<std::string> columns{"case",         "turns_survived", "end",
                                       "shape_error",  "closest_pair",   "angular_momentum_drift",
                                       "energy_drift", "seconds"};

std::unique_ptr<Model<2>> make_model(const Parameters& p, const Hexagon& one) {
    return one.model(make_particles<2>(triangular_hexagon(p.size), 1.0));
}

void keep(const RunFolder& folder, const std::string& name, const NearestState<2>& state) {
    folder.write(name, [&](std::ostream& out) {
        out << "x,y,velocity_x,velocity_y\n";
        for (Eigen::Index i = 0; i < state.position.cols(); ++i)
            out << fmt::format("{:.17g},{:.17g},{:.17g},{:.17g}\n", state.position(0, i),
                               state.position(1, i), state.velocity(0, i), state.velocity(1, i));
    });
}

NearestState<2> kept(const RunFolder& folder, const std::string& name, std::size_t particles) {
    const auto n = static_cast<Eigen::Index>(particles);
    NearestState<2> state{0.0, 0.0, Points<2>(2, n), Points<2>(2, n)};
    CsvReader table(text_file((folder / name).string(), "out", "a table of a configuration"), name,
                    {"out", "begin anew with --force"});
    if (table.next()) table.keep_as_header();
    for (Eigen::Index i = 0; i < n && table.next(); ++i)
        for (Eigen::Index a = 0; a < 2; ++a) {
            state.position(a, i) = table.number(static_cast<std::size_t>(a));
            state.velocity(a, i) = table.number(static_cast<std::size_t>(2 + a));
        }
    return state;
}

/// Nothing where a signal interrupted it.
std::optional<StudyTable::Row> turn(const Parameters& p, const Hexagon& one,
                                    const RunFolder& folder) {
    std::shared_ptr<Model<2>> model = make_model(p, one);
    auto y0 = lattice_state(*model, rigid_rotation(p.speed / p.size));
    auto states = states_at<2>(one.turns, p.turn());
    Plan<2> plan;
    plan.t_end = one.turns.back() * p.turn();
    plan.output_every = std::min(p.turn() / 16.0, plan.t_end / 16.0);
    plan.snapshot_every = one.turns.front() * p.turn();
    plan.record({closest_pair_column<2>(), shape_error_column<2>()});
    plan.observe(keep_nearest<2>(states));
    const RunRecord run =
        run_in_memory<2>({std::move(model), std::move(y0), std::move(plan)}, one.integrator);
    if (run.statistics.stopped.starts_with("signal")) return {};
    for (std::size_t k = 0; k < states.size(); ++k) keep(folder, one.file(k), states[k]);
    const History& h = run.history;
    const auto drift = [&](const char* name) {  // throughout: nothing ever happens
        return h.largest_change(name) / std::abs(h.first(name));
    };
    return StudyTable::Row{fmt::format("{:.6g}", survival(h).t / p.turn()),
                           run.statistics.stopped.empty() ? std::string(survival(h).end)
                                                          : "stopped: " + run.statistics.stopped,
                           fmt::format("{:.6g}", h.largest("shape_error")),
                           fmt::format("{:.6g}", h.smallest("closest_pair")),
                           fmt::format("{:.6g}", drift("angular_momentum")),
                           fmt::format("{:.6g}", drift("energy")),
                           fmt::format("{:.1f}", run.statistics.wall_seconds)};
}

void draw(Session& session, const Parameters& p, const std::vector<Hexagon>& all) {
    std::vector<ConfigurationPanel> panels;
    for (const Hexagon& one : all) {
        const auto model = make_model(p, one);
        const auto& reference = model->particles().reference_position;
        for (std::size_t k = 0; k < one.turns.size(); ++k) {
            const auto state = kept(session.folder(), one.file(k), model->particles().size());
            panels.push_back(speed_panel(fmt::format("{}, {:g} turn{}", one.title, one.turns[k],
                                                     one.turns[k] == 1.0 ? "" : "s"),
                                         *model, state));
            // of a body that has lost its shape it would be a tangle
            if (shape_error<2>(reference, state.position, 1.0) > 0.5)
                panels.back().outlines.clear();
        }
    }
    draw_configurations(
        session, "thousand_turns",
        fmt::format("Rotating elastic hexagon, {} particles", 1 + 3 * p.size * (p.size + 1)),
        panels, all.front().turns.size(), "speed");
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("thousand_turns",
                    "the rotating hexagon with material vectors, beside the paper's best scheme");
    problem.units(lattice_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("size", p.size, "n of the hexagon, which has 1 + 3n + 3n^2 particles",
                    between(2, 200));
    options.number("speed", p.speed, "speed of the corners of the hexagon", between(1e-6, 1.0));
    options.number("turns", p.turns, "nominal turns with material vectors", positive());

    return problem.main(argc, argv, [&](Session& session) {
        const bool smoke = session.common().smoke;
        session.smoke_default("size", p.size, 2);
        session.smoke_default("turns", p.turns, 2.0);
        const auto all = hexagons(p, smoke);
        std::vector<StudyTask> tasks;
        for (const Hexagon& one : all) {
            refuse_endless(one.integrator, one.turns.back() * p.turn());
            tasks.push_back({one.name, [&] { return turn(p, one, session.folder()); }});
        }
        StudyTable table = session.begin_study(
            "thousand_turns", columns,
            {fmt::format("hexagon of {} particles, {:g} and {:g} turns",
                         1 + 3 * p.size * (p.size + 1), all[0].turns.back(), all[1].turns.back()),
             fmt::format("integrator  {}, dt = {:g}; {}, dt = {:g}", all[0].integrator.method,
                         *all[0].integrator.dt, all[1].integrator.method, *all[1].integrator.dt)},
            true);
        if (!session.run_study(table, tasks, static_cast<int>(tasks.size()))) return;

        for (const auto& row : table.rows(tasks)) {
            session.measure(row.front() + "_turns_survived",
                            number_of(row, columns, "turns_survived"), row[2]);
            for (const char* name :
                 {"shape_error", "closest_pair", "angular_momentum_drift", "energy_drift"})
                session.measure(row.front() + "_" + name, number_of(row, columns, name));
        }
        const auto own = table.rows(tasks).front();
        const bool known = session.when_default({"size", "speed"}) && p.turns >= 1.0;
        session.claim({"shape_error", number_of(own, columns, "shape_error"), 0.0, 0.0216,
                       "elastic breathing alone, tests/drift/material_vectors.cpp"},
                      known);
        session.check({"angular_momentum_drift", number_of(own, columns, "angular_momentum_drift"),
                       0.0, 1e-12, "the energy knows no axes"});
        session.claim({"energy_drift", number_of(own, columns, "energy_drift"), 0.0, 5e-6,
                       "bounded, as leapfrog's is"},
                      known);
        if (session.plots()) draw(session, p, all);
    });
}
