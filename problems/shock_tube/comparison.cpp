// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison.hpp"

#include <spam/diagnostics/total_energy.hpp>
#include <spam/problem/motion.hpp>

namespace shock_tube {
namespace {

constexpr std::array works{Work::own, Work::mean};

std::vector<std::string> columns() {
    std::vector<std::string> all{"case"};
    for (const char* quantity : quantities) all.push_back(std::string(quantity) + "_error");
    for (const char* more :
         {"plateau_error", "least_energy_ratio", "energy_change", "right_hand_sides", "end"})
        all.emplace_back(more);
    return all;
}

std::string name_of(int number, Work work, int cells) {
    return fmt::format("toro{}_{}_{}", number, to_string(work), cells);
}

/// Mean of what is exact, by its size.
double size_of(const Tube& tube, double gamma, std::size_t quantity, double t) {
    constexpr int points = 10000;
    double sum = 0.0;
    for (int k = 0; k < points; ++k)
        sum += std::abs(exact_value(tube, gamma, quantity, (k + 0.5) / points - 0.5, t));
    return sum / points;
}

double smallest(const ConstState<1>& state) { return state.energy().minCoeff(); }

/// By what part the worst of the plateaus is wrong; NaN where there are none.
double worst_plateau(const Tube& tube, double gamma, std::span<const double> y, double t) {
    double worst = std::numeric_limits<double>::quiet_NaN();
    for (const Plateau& one : plateaus(tube, gamma, y, t))
        worst = std::fmax(worst, std::abs(one.found - one.exact) / one.scale);
    return worst;
}

std::vector<std::string> row_of(const Parameters& p, int cells, double end) {
    const Tube tube = make_tube(p, cells, false);
    IntegratorOptions options;
    options.dt = p.step(cells);
    const double before = total_energy(*tube.model, tube.y0);
    const double least = smallest({tube.model->layout(), tube.y0});
    Motion<1> motion(*tube.model, tube.y0, options);
    std::string how = "complete";
    try {
        motion.advance_to(end);
    } catch (const GuardStop& stop) {  // energies below zero
        how = fmt::format("stopped: {}", stop.what());
    }
    const bool complete = how == "complete";
    const auto number = [complete](double value) {
        return complete ? fmt::format("{:.5g}", value) : std::string("nan");
    };
    std::vector<std::string> row;
    for (std::size_t k = 0; k < quantities.size(); ++k)
        row.push_back(number(integral_error(tube, p.gamma, k, motion.y(), end) /
                             size_of(tube, p.gamma, k, end)));
    row.push_back(number(worst_plateau(tube, p.gamma, motion.y(), end)));
    row.push_back(number(smallest(motion.state()) / least));
    row.push_back(number(total_energy(*tube.model, motion.y()) / before - 1.0));
    row.push_back(fmt::format("{}", motion.statistics().rhs_evaluations));
    std::replace(how.begin(), how.end(), ',', ';');
    row.push_back(how);
    return row;
}

struct Line {
    int number;
    Work work;
    bool standard;  ///< something is claimed of it
    std::vector<double> cells{}, plateau{}, energy_change{}, least{};
    std::array<std::vector<double>, quantities.size()> error{};
    std::string end{};

    bool complete() const { return end.empty(); }
    /// From the coarsest to the finest.
    double order(std::size_t k) const {
        return std::log(error[k].front() / error[k].back()) /
               std::log(cells.back() / cells.front());
    }
};

void print(Session& session, const std::vector<Line>& lines) {
    session.terminal().say(fmt::format(
        "Mean |found - exact| by mean |exact| with {:g} particles, and order from {:g} on",
        lines.front().cells.back(), lines.front().cells.front()));
    std::string heading = "test work ";
    for (const char* quantity : quantities) heading += fmt::format("{:>18}", quantity);
    session.terminal().say(heading + "   plateaus");
    for (const Line& line : lines) {
        std::string row = fmt::format("{:4} {:5}", line.number, to_string(line.work));
        for (std::size_t k = 0; k < quantities.size(); ++k)
            row += line.complete()
                       ? fmt::format("{:11.5f} ({:4.2f})", line.error[k].back(), line.order(k))
                       : fmt::format("{:>18}", "-");
        session.terminal().say(row + (line.complete() ? fmt::format("{:9.4f}", line.plateau.back())
                                                      : "   " + line.end));
    }
}

void draw(Session& session, const Parameters& p, const std::vector<Line>& lines) {
    LogLogPicture picture;
    picture.title =
        fmt::format("Toro's five tests, γ = {:g}: errors against the exact solution", p.gamma);
    for (std::size_t k = 0; k < quantities.size(); ++k) {
        LogLogPanel panel{quantities[k], "particles", "mean |found - exact| / mean |exact|", {}};
        for (const Line& line : lines)
            if (line.complete())
                panel.curves.push_back({static_cast<std::size_t>(line.number - 1),
                                        line.work == Work::mean, line.cells, line.error[k]});
        picture.panels.push_back(std::move(panel));
    }
    for (int number = 1; number <= toro_tests; ++number) picture.key.push_back(toro(number).title);
    picture.note =
        "full: work of the own pressure; open: of the mean pressure, where runs reach their end";
    draw_log_log(session, "errors", picture);
}

void report(Session& session, const std::vector<Line>& lines) {
    for (const Line& line : lines) {
        const Findings findings(session,
                                fmt::format("toro{}_{}_", line.number, to_string(line.work)));
        if (line.work == Work::own)
            findings.claim("complete", line.complete() ? 1.0 : 0.0, 1.0, 0.0,
                           "no particle can lack heat", line.standard);
        if (!line.complete()) continue;
        for (std::size_t k = 0; k < quantities.size(); ++k) {
            findings.measure(std::string(quantities[k]) + "_error", line.error[k].back());
            findings.measure(std::string(quantities[k]) + "_order", line.order(k));
        }
        findings.measure("least_energy_ratio", line.least.back(),
                         "of the coldest particle, by that at the start");
        if (std::isfinite(line.plateau.back()))
            findings.claim("plateau_error", line.plateau.back(), 0.0, 0.03,
                           "the exact solution of Riemann's problem",
                           line.standard && toro(line.number).resolved);
        findings.check("energy_change", line.energy_change.back(), 0.0, 1e-6,
                       "both forms keep the energy, RK4 to its accuracy");
    }
}

}  // namespace

void compare(Session& session, const Parameters& given) {
    const bool smoke = session.common().smoke;
    const std::vector<int> sizes = smoke ? std::vector{50, 100} : std::vector{400, 800, 1600, 3200};
    std::vector<StudyTask> tasks;
    std::vector<Parameters> all;
    for (int number = 1; number <= toro_tests; ++number)
        for (const Work work : works) {
            Parameters p = given;
            p.toro = number;
            p.settle(session);
            p.scheme.work = work;
            all.push_back(p);
            for (const int cells : sizes)
                tasks.push_back({name_of(number, work, cells), [p, cells, smoke] {
                                     return row_of(p, cells, p.setting.t_end / (smoke ? 10 : 1));
                                 }});
        }
    StudyTable table = session.begin_study(
        "comparison", columns(),
        {fmt::format("Toro's five tests with {} to {} particles, by both forms of the work",
                     sizes.front(), sizes.back()),
         fmt::format("{} runs, {} at a time", tasks.size(), given.jobs)},
        true);
    if (!session.run_study(table, tasks, given.jobs)) return;
    std::vector<Line> lines;
    const auto names = columns();
    const auto rows = table.rows(tasks);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Parameters& p = all[k / sizes.size()];
        if (k % sizes.size() == 0)
            lines.push_back(
                {*p.toro, p.scheme.work, p.standard(session) && session.when_default({"gamma"})});
        Line& line = lines.back();
        const auto number = [&](std::string_view name) { return number_of(rows[k], names, name); };
        line.cells.push_back(sizes[k % sizes.size()]);
        for (std::size_t q = 0; q < quantities.size(); ++q)
            line.error[q].push_back(number(std::string(quantities[q]) + "_error"));
        line.plateau.push_back(number("plateau_error"));
        line.least.push_back(number("least_energy_ratio"));
        line.energy_change.push_back(number("energy_change"));
        const std::string& end = cell_of(rows[k], names, "end");
        if (end != "complete" && line.end.empty()) line.end = end;
    }
    report(session, lines);
    print(session, lines);
    if (session.plots()) draw(session, given, lines);
}

}  // namespace shock_tube
