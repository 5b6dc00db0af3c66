// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: the 72 algorithm combinations of the 2004 paper on the rotating hexagon; 4 min on 2 cores
//
// All combinations of [HHM04] IX on the rotating hexagon:
//
//     closest approach    none | reflected at R                     2
//     viscosity           none | alpha                              2
//     density             continuity | summed                       2
//     transport           v | <v> | <v>_Monaghan                    3
//     angular momentum    Gauss | torques of particles | of pairs   3      2 x 2 x 2 x 3 x 3 = 72
//
// Each turns until its shape is lost (rms distance from the best-fit hexagon half a spacing) or it has
// clumped (two particles nearer than 0.3 spacings), at most `turns` turns; the first turn is always
// completed. One row of sweep.csv each. A sweep that was stopped, even by kill -9, goes on with the
// same command.
#include "common.hpp"
#include <spam/io/study_table.hpp>
#include <spam/problem/run_in_memory.hpp>

#include <thread>

namespace {

using namespace spam;
using std::numbers::pi;

struct Parameters {
    int size = 8;
    double speed = 0.1, turns = 10.0, range = 3.0;
    double viscosity = 1.0, closest_approach = 0.7;
    int jobs = all_cores();

    double omega() const { return speed / size; }
    double turn() const { return 2.0 * pi / omega(); }
    /// What RK4 loses of L in a turn grows as speed^2.7 dt^4.4 (measured with 7 particles, speeds of 0.1 to 0.5 and
    /// steps of 0.05 to 0.5): with this step it is that of 0.1 at the speed of the paper.
    double step() const { return 0.1 * std::min(1.0, std::pow(0.1 / speed, 2.0 / 3.0)); }
};

/// In the order of the paper's list, the last varying fastest.
std::vector<Scheme> combinations(const Parameters& p) {
    std::vector<Scheme> all;
    for (const double closest : {0.0, p.closest_approach})
        for (const double viscosity : {0.0, p.viscosity})
            for (const auto density : {Density::continuity, Density::summed})
                for (const auto transport :
                     {Transport::plain, Transport::average, Transport::monaghan})
                    for (const auto law : {AngularMomentum::gauss, AngularMomentum::torque_particle,
                                           AngularMomentum::torque_pair})
                        all.push_back({.density = density,
                                       .transport = transport,
                                       .angular_momentum = law,
                                       .viscosity = viscosity,
                                       .closest_approach = closest,
                                       .range = p.range});
    return all;
}

std::string broken_promises(const RunRecord& run) {
    std::string broken;
    for (const Drift& drift : run.drifts)
        if (!drift.kept()) broken += (broken.empty() ? "broken: " : " and ") + drift.name;
    return broken.empty() ? "kept" : broken;
}

/// One combination that was tried.
struct Trial {
    const Parameters& p;
    const Scheme& scheme;
    RunRecord run;

    const History& history() const { return run.history; }
    Survival survived() const { return survival(run.history); }
    double one_turn() const { return std::min(p.turn(), history().last("t")); }
    /// L(t)/L(0) at the end.
    double L() const {
        return history().last("angular_momentum") / history().first("angular_momentum");
    }
    double L_after_turn() const {
        return history().at(one_turn(), "angular_momentum") / history().first("angular_momentum");
    }
    std::string end() const {
        if (!run.statistics.stopped.empty()) return "stopped: " + run.statistics.stopped;
        // A hexagon that has stopped turning is no success.
        if (survived().whole && std::abs(L()) < 0.5) return "whole, but L lost";
        return std::string(survived().end);
    }
};

std::string number(double x) { return fmt::format("{:.6g}", x); }
std::string precise(double x) { return fmt::format("{:.15g}", x); }
std::string number_or_none(double x) { return x > 0.0 ? number(x) : "none"; }

/// A column of sweep.csv beside the name of the case: what it is called, and what a trial has there.
struct SweepColumn {
    const char* name;
    std::function<std::string(const Trial&)> cell;
};

const std::vector<SweepColumn> sweep_columns{
    {"closest_approach", [](const Trial& a) { return number_or_none(a.scheme.closest_approach); }},
    {"viscosity", [](const Trial& a) { return number_or_none(a.scheme.viscosity); }},
    {"density", [](const Trial& a) { return std::string(to_string(a.scheme.density)); }},
    {"transport", [](const Trial& a) { return std::string(to_string(a.scheme.transport)); }},
    {"angular_momentum",
     [](const Trial& a) { return std::string(to_string(a.scheme.angular_momentum)); }},
    {"turns_survived", [](const Trial& a) { return number(a.survived().t / a.p.turn()); }},
    {"end", [](const Trial& a) { return a.end(); }},
    {"L_after_turn", [](const Trial& a) { return precise(a.L_after_turn()); }},
    {"L_final", [](const Trial& a) { return precise(a.L()); }},
    {"energy_change",
     [](const Trial& a) {
         return number(a.history().largest_change("energy") /
                       std::abs(a.history().first("energy")));
     }},
    {"shape_error_after_turn",
     [](const Trial& a) { return number(a.history().at(a.one_turn(), "shape_error")); }},
    {"closest_pair", [](const Trial& a) { return number(a.history().smallest("closest_pair")); }},
    {"t_end", [](const Trial& a) { return number(a.run.statistics.t_end); }},
    {"steps", [](const Trial& a) { return fmt::format("{}", a.run.statistics.steps); }},
    {"events", [](const Trial& a) { return fmt::format("{}", a.run.statistics.events); }},
    {"promise", [](const Trial& a) { return broken_promises(a.run); }},
    {"seconds",
     [](const Trial& a) { return fmt::format("{:.2f}", a.run.statistics.wall_seconds); }}};

std::vector<std::string> names_of_columns() {
    std::vector<std::string> names{"case"};
    for (const auto& column : sweep_columns) names.emplace_back(column.name);
    return names;
}

/// Nothing where a signal interrupted it.
std::optional<std::vector<std::string>> turn_hexagon(const Parameters& p, const Scheme& scheme,
                                                     const IntegratorOptions& integrator) {
    SmoothParticleModel<2> model(make_particles<2>(triangular_hexagon(p.size), 1.0),
                                 ElasticSolid::triangular_lattice(), scheme);
    auto y0 = lattice_state(model, rigid_rotation(p.omega()));
    Plan<2> plan;
    plan.t_end = p.turns * p.turn();
    plan.output_every = p.turn() / 48.0;
    plan.snapshot_every = plan.t_end;
    plan.observe({.columns = {closest_pair_column<2>(), shape_error_column<2>()},
                  .enough = [&p](const History& h) {
                      return h.last("t") >= 0.999 * p.turn() && !survival(h).whole;
                  }});
    const Trial trial{
        p, scheme,
        run_in_memory<2>({kept_elsewhere<2>(model), std::move(y0), std::move(plan)}, integrator)};
    if (trial.run.statistics.stopped.starts_with("signal")) return {};
    std::vector<std::string> cells;
    for (const auto& column : sweep_columns) cells.push_back(column.cell(trial));
    return cells;
}

std::string name_of(const Scheme& s) {
    return fmt::format(
        "{}{}{}-{}-{}", to_string(s.density), s.closest_approach > 0.0 ? "-reflected" : "",
        s.viscosity > 0.0 ? "-viscous" : "", to_string(s.transport), to_string(s.angular_momentum));
}

const std::string& words(const StudyTable::Row& row, std::string_view column) {
    return cell_of(row, names_of_columns(), column);
}
double cell(const StudyTable::Row& row, std::string_view column) {
    return number_of(row, names_of_columns(), column);
}

/// Cells: turns survived, and L after one turn.
void draw(Session& session, const Parameters& p, const std::vector<StudyTable::Row>& rows) {
    HeatMap map;
    map.rows = {{"closest approach", {"none", fmt::format("R = {:g}", p.closest_approach)}},
                {"viscosity", {"none", fmt::format("α = {:g}", p.viscosity)}},
                {"density", {"continuity", "summed"}}};
    map.columns = {{"transport", {"v", "⟨v⟩", "⟨v⟩ Monaghan"}},
                   {"angular momentum", {"Gauss", "particle", "pair"}}};
    map.value_label = "turns survived";
    map.log_value = true;
    for (const auto& row : rows) {
        map.value.push_back(std::abs(cell(row, "L_final")) < 0.5 ? std::nan("")
                                                                 : cell(row, "turns_survived"));
        map.text.push_back(fmt::format("{:.2g}{}\nL {:.2f}", cell(row, "turns_survived"),
                                       words(row, "end").starts_with("whole") ? "+" : "",
                                       cell(row, "L_after_turn")));
    }
    draw_heat_map(
        session, "sweep",
        fmt::format("Turns until the hexagon (n = {}) is lost, and L/L(0) after one turn. Grey: at "
                    "the end more than half of L was lost",
                    p.size),
        map);
}

/// Best first, as a table in words.
void say_ranking(Session& session, std::vector<StudyTable::Row> rows) {
    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
        return cell(a, "turns_survived") > cell(b, "turns_survived");
    });
    auto& terminal = session.terminal();
    terminal.say("");
    terminal.say(
        fmt::format("{:<52}{:>6}  {:>9}  {:>8}  {}", "case", "turns", "L(1 turn)", "dE/E", "end"));
    for (std::size_t k = 0; k < std::min<std::size_t>(rows.size(), 12); ++k)
        terminal.say(fmt::format("{:<52}{:>6.2f}  {:>9.4f}  {:>8.0e}  {}", rows[k].front(),
                                 cell(rows[k], "turns_survived"), cell(rows[k], "L_after_turn"),
                                 cell(rows[k], "energy_change"), words(rows[k], "end")));
    terminal.say(fmt::format("... all {} in sweep.csv", rows.size()));
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("algorithm_sweep", "the 72 algorithm combinations of [HHM04] IX");
    problem.units(lattice_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("size", p.size, "n of the hexagon, which has 1 + 3n + 3n^2 particles",
                    between(1, 200));
    options.number("speed", p.speed, "speed of the corners of the hexagon", between(1e-6, 0.5));
    options.number("turns", p.turns, "largest number of nominal turns", at_least(1.0));
    options.number("range", p.range, "range h of Lucy's weight function", between(1.1, 20.0));
    options.number("viscosity", p.viscosity, "coefficient alpha of the combinations with viscosity",
                   between(1e-6, 100.0));
    options.number("closest-approach", p.closest_approach,
                   "distance of closest approach of the combinations with reflection",
                   between(0.01, 1.0));
    add_jobs_option(options, p.jobs, "number of combinations computed at the same time");

    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("size", p.size, 1);
        session.smoke_default("turns", p.turns, 1.0);
        if (p.step() < 0.1) session.prefer_step(p.step());
        const auto schemes = combinations(p);
        std::vector<StudyTask> tasks;
        for (const Scheme& scheme : schemes) {
            scheme.validate(2);  // and what the model has to say, before anything is written
            SmoothParticleModel<2>(make_particles<2>(triangular_hexagon(1), 1.0),
                                   ElasticSolid::triangular_lattice(), scheme);
            tasks.push_back({name_of(scheme), [&p, &session, scheme] {
                                 return turn_hexagon(p, scheme, session.integrator());
                             }});
        }
        refuse_endless(session.integrator(), p.turns * p.turn());
        StudyTable table = session.begin_study(
            "sweep", names_of_columns(),
            {fmt::format(
                "{} combinations, hexagon of {} particles, at most {:g} turns, {} at a time",
                tasks.size(), 1 + 3 * p.size * (p.size + 1), p.turns, p.jobs)});
        if (!session.run_study(table, tasks, p.jobs)) return;

        const auto rows = table.rows(tasks);
        say_ranking(session, rows);
        double best = 0.0, kept = 0.0, worst_pair = 0.0, whole = 0.0, lost = 0.0;
        for (const auto& row : rows) {
            if (std::abs(cell(row, "L_final")) >= 0.5)
                best = std::max(best, cell(row, "turns_survived"));
            kept += words(row, "promise") == "kept" ? 1.0 : 0.0;
            whole += words(row, "end") == "whole" ? 1.0 : 0.0;
            lost += words(row, "end") == "whole, but L lost" ? 1.0 : 0.0;
            if (words(row, "angular_momentum") == "torque_pair" &&
                words(row, "transport") != "plain" && words(row, "closest_approach") == "none")
                worst_pair = std::max(worst_pair, std::abs(cell(row, "L_final") - 1.0));
        }
        session.measure("combinations", static_cast<double>(rows.size()),
                        "[HHM04] IX: 2 x 2 x 2 x 3 x 3");
        // Longer steps show the method's error.
        const auto& by = session.integrator();
        session.claim(
            {"pair_torque_largest_L_change", worst_pair, 0.0, 1e-9 * std::max(10.0, p.turns),
             "[HHM04] VIII: exact, with averaged velocities"},
            by.method == "rk4" && by.dt.value_or(0.0) <= p.step());
        session.measure("promises_kept", kept, "of the 72");
        session.measure("whole_to_the_end", whole, "of the 72");
        session.measure("whole_but_L_lost", lost, "of the 72: they have almost stopped rotating");
        session.measure("turns_survived_best", best, "with at least half of L");
        if (session.plots()) draw(session, p, rows);
    });
}
