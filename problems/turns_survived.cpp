// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: how many turns each scheme keeps the rotating hexagon, up to 100; 2 min on 2 cores
//
// The question that [HHM04] leaves open: how far does each of its schemes go, and what goes further?
// The rotating hexagon turns until its shape is lost (rms distance from the best-fit hexagon half a
// spacing) or it has clumped (two particles nearer than 0.3 spacings), at most `turns` turns:
//
//     molecular dynamics          the reference
//     the paper's schemes         v, <v>, <v>_Monaghan; torques of particles or pairs balanced
//     with viscosity, reflection  added to the best of them
//     total Lagrangian            sums over initial neighbours: beyond the paper. It keeps its shape
//                                 because it cannot do otherwise: no new neighbours, no flow, no
//                                 fragments
//     material vectors            sums over present neighbours with a memory: they may change
//
// Is a late state a function of the input, or one sample of a chaotic ensemble? turns_to_noise is how many turns pass
// until a difference of 1e-16 has grown to one, as Lyapunov exponents say.
#include "common.hpp"
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/problem/run_in_memory.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/study/lyapunov.hpp>

#include <thread>

namespace {

using namespace spam;
using std::numbers::pi;

constexpr double rows_per_turn = 48.0;

struct Parameters {
    int size = 8;
    double speed = 0.1, turns = 100.0;
    int jobs = all_cores();
    double turn() const { return 2.0 * pi * size / speed; }
};

struct Contestant {
    std::string name, title;
    enum Kind { springs, smooth, lagrangian, vectors } kind;
    Scheme scheme{};
};

std::vector<Contestant> contestants() {
    using enum AngularMomentum;
    const auto plain = Transport::plain, average = Transport::average,
               monaghan = Transport::monaghan;
    std::vector<Contestant> all{{"molecular_dynamics", "molecular dynamics", Contestant::springs}};
    const auto add = [&](const char* name, const char* title, const Scheme& scheme) {
        all.push_back({name, title, Contestant::smooth, scheme});
    };
    const Scheme best{.transport = monaghan, .angular_momentum = torque_pair};
    Scheme reflected = best, viscous = best;
    reflected.closest_approach = 0.7;
    viscous.viscosity = 1.0;
    add("plain", "v", {.transport = plain});
    add("plain_pair", "v, pair torque", {.transport = plain, .angular_momentum = torque_pair});
    add("average", "⟨v⟩", {.transport = average});
    add("average_pair", "⟨v⟩, pair torque",
        {.transport = average, .angular_momentum = torque_pair});
    add("monaghan", "⟨v⟩ Monaghan", {.transport = monaghan});
    add("monaghan_particle", "⟨v⟩ Monaghan, particle torque",
        {.transport = monaghan, .angular_momentum = torque_particle});
    add("monaghan_pair", "⟨v⟩ Monaghan, pair torque", best);
    add("monaghan_pair_reflected", "the same, reflected at 0.7", reflected);
    add("monaghan_pair_viscous", "the same, viscosity 1 instead", viscous);
    all.push_back({"total_lagrangian", "total Lagrangian", Contestant::lagrangian});
    all.push_back({"material_vectors", "material vectors", Contestant::vectors});
    return all;
}

std::unique_ptr<Model<2>> model_of(const Parameters& p, const Contestant& one) {
    auto particles = make_particles<2>(triangular_hexagon(p.size), 1.0);
    const auto solid = ElasticSolid::triangular_lattice();
    if (one.kind == Contestant::springs)
        return std::make_unique<BondedModel<2>>(std::move(particles), HarmonicSpring{});
    if (one.kind == Contestant::lagrangian)
        return std::make_unique<TotalLagrangianModel<2>>(
            std::move(particles), StVenantKirchhoff::like(solid),
            TotalLagrangianScheme{triangular_density, 3.0, 0.1});
    if (one.kind == Contestant::vectors)
        return std::make_unique<MaterialVectorModel<2>>(
            std::move(particles), PolynomialSolid::like(solid),
            MaterialVectorScheme{.density = triangular_density});
    return std::make_unique<SmoothParticleModel<2>>(std::move(particles), solid, one.scheme);
}

const std::vector<std::string> columns{"case",         "turns_survived", "end",
                                       "L_final",      "energy_change",  "largest_shape_error",
                                       "closest_pair", "turns_to_noise", "seconds"};

/// Turns until a difference of 1e-16 has grown to one, by the leading exponent of each quarter of a turn; where that
/// takes longer than `turns` or ten, by the mean exponent of the second half of these. Empty where tangents jump or
/// steps are adaptive, "never" where differences do not grow.
std::string turns_to_noise(const Parameters& p, const Contestant& one,
                           const IntegratorOptions& integrator, double turns) {
    const auto model = model_of(p, one);
    const auto y0 = lattice_state(*model, rigid_rotation(p.speed / p.size));
    // Two turns at least, also of what has lost its shape: differences grow on.
    const double measured = std::min(10.0, std::max(turns, std::min(p.turns, 2.0)));
    for (const auto& block : model->layout().blocks()) model->layout().set_scale(block.field, 1.0);
    LyapunovSpectrum found;
    try {
        found = lyapunov_spectrum<2>(*model, y0, integrator,
                                     {.duration = measured * p.turn(),
                                      .interval = p.turn() / 250.0,
                                      .window = std::min(0.25, measured / 8.0) * p.turn()});
    } catch (const InputError&) {
        return {};
    } catch (const GuardStop&) {
        return {};
    }
    double left = 16.0 * std::numbers::ln10, late = 0.0, t = 0.0, late_from = 0.0;
    for (const auto& window : found.windows) {
        const double rate = window.exponents.front(), grown = rate * (window.t - t);
        if (grown >= left) return fmt::format("{:.4g}", (t + left / rate) / p.turn());
        left -= grown;
        if (2.0 * t < found.windows.back().t)
            late_from = window.t;
        else
            late += grown;
        t = window.t;
    }
    const double rate = late / (t - late_from);
    return rate > 0.0 ? fmt::format("{:.4g}", (t + left / rate) / p.turn()) : "never";
}

/// Nothing where a signal interrupted it.
std::optional<std::vector<std::string>> turn_hexagon(const Parameters& p, const Contestant& one,
                                                     const IntegratorOptions& integrator) {
    std::shared_ptr<Model<2>> model = model_of(p, one);
    auto y0 = lattice_state(*model, rigid_rotation(p.speed / p.size));
    Plan<2> plan;
    plan.t_end = p.turns * p.turn();
    plan.output_every = p.turn() / rows_per_turn;
    plan.snapshot_every = plan.t_end;
    plan.observe({.columns = {closest_pair_column<2>(), shape_error_column<2>()},
                  .enough = [](const History& h) { return !survival(h).whole; }});
    const RunRecord run =
        run_in_memory<2>({std::move(model), std::move(y0), std::move(plan)}, integrator);
    const std::string& stopped = run.statistics.stopped;
    if (stopped.starts_with("signal")) return {};
    const History& h = run.history;
    // As asked for, to the last digit, where it came to the end.
    const double turns = run.complete && survival(h).whole ? p.turns : h.last("t") / p.turn();
    return std::vector<std::string>{
        turns == p.turns ? fmt::format("{}", turns) : fmt::format("{:.6g}", turns),
        stopped.empty() ? std::string(survival(h).end) : "stopped: " + stopped,
        fmt::format("{:.15g}", h.last("angular_momentum") / h.first("angular_momentum")),
        fmt::format("{:.3g}", h.largest_change("energy") / h.first("energy")),
        fmt::format("{:.4g}", h.largest("shape_error")),
        fmt::format("{:.4g}", h.smallest("closest_pair")),
        turns_to_noise(p, one, integrator, turns),
        fmt::format("{:.1f}", run.statistics.wall_seconds)};
}

/// Of the last row in which the hexagon was whole: one that loses its shape in the very last row has not
/// survived.
double turns_whole(const StudyTable::Row& row) {
    return std::max(0.0, number_in_cell(row, 1) - (row[2] == "whole" ? 0.0 : 1.0 / rows_per_turn));
}

/// The error of RK4 grows with the turns, and as the fourth power of the angle by which a step turns: a
/// hexagon of size 2 loses 0.08 of that, 1e-10 are allowed of the standard case with 100 turns. Nothing is
/// claimed where steps are so long that more than a hundredth would be allowed, and of survival nothing near the speed
/// of sound.
void claim_survival(Session& session, const Parameters& p, const StudyTable::Row& row) {
    const IntegratorOptions& integrator = session.integrator();
    const double angle = p.speed / p.size * integrator.dt.value_or(1.0);
    const double allowed = std::max(1e-12, 0.41 * p.turns * std::pow(angle, 4));
    session.claim({row.front() + "_survives", turns_whole(row), p.turns, 1e-9 * p.turns,
                   "all the turns asked for"},
                  allowed <= 0.01 && p.speed <= 0.5);
    session.claim({row.front() + "_L_drift", std::abs(number_in_cell(row, 3) - 1.0), 0.0, allowed,
                   "to the error of RK4"},
                  integrator.method == "rk4" && allowed <= 0.01);
}

void draw(Session& session, const Parameters& p, const std::vector<Contestant>& all,
          const std::vector<StudyTable::Row>& rows) {
    BarChart chart{"turns survived", true, {}};
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const bool whole = rows[k][2] == "whole";
        chart.bars.push_back({all[k].title, number_in_cell(rows[k], 1),
                              fmt::format("{:.3g}{}, L {:.2f}, {}", number_in_cell(rows[k], 1),
                                          whole ? "+" : "", number_in_cell(rows[k], 3), rows[k][2]),
                              all[k].kind == Contestant::smooth    ? 3
                              : all[k].kind == Contestant::springs ? 1
                                                                   : 2});
    }
    draw_bars(session, "turns_survived",
              fmt::format("Rotating hexagon, {} particles: turns until its shape is lost",
                          1 + 3 * p.size * (p.size + 1)),
              chart);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("turns_survived", "how many turns each scheme keeps the rotating hexagon");
    problem.units(lattice_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("size", p.size, "n of the hexagon, which has 1 + 3n + 3n^2 particles",
                    between(2, 200));
    options.number(
        "speed", p.speed, "speed of the corners of the hexagon",
        {[](double v) { return v >= 1e-6 && v <= 1.0; },
         "between 1e-06 and 1 (nothing that turns as fast as sound, 1.06, keeps its shape)"});
    options.number("turns", p.turns, "largest number of nominal turns", positive());
    add_jobs_option(options, p.jobs, "number of cases computed at the same time");

    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("size", p.size, 2);
        session.smoke_default("turns", p.turns, 0.5);
        const auto all = contestants();
        std::vector<StudyTask> tasks;
        for (const Contestant& one : all)
            tasks.push_back({one.name, [&] { return turn_hexagon(p, one, session.integrator()); }});
        refuse_endless(session.integrator(), p.turns * p.turn());
        StudyTable table = session.begin_study(
            "turns_survived", columns,
            {fmt::format("{} cases, hexagon of {} particles, at most {:g} turns, {} at a time",
                         tasks.size(), 1 + 3 * p.size * (p.size + 1), p.turns, p.jobs)});
        if (!session.run_study(table, tasks, p.jobs)) return;

        const auto rows = table.rows(tasks);
        for (const auto& row : rows)
            session.measure(row.front() + "_turns", number_in_cell(row, 1), row[2]);
        for (const auto& row : rows)
            if (!row[7].empty() && row[7] != "never")
                session.measure(row.front() + "_turns_to_noise", number_in_cell(row, 7),
                                "until 1e-16 has grown to one");
        for (const std::size_t k : {std::size_t{0}, rows.size() - 2, rows.size() - 1})
            claim_survival(session, p, rows[k]);
        if (session.plots()) draw(session, p, all, rows);
    });
}
