// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexagon.hpp"

namespace rotating_hexagon {

void draw(Session& session, const Parameters& p, const std::vector<Hexagon>& hexagons,
          const std::vector<RunRecord>& runs) {
    std::vector<ConfigurationPanel> panels;
    for (std::size_t s = 0; s < hexagons.front().drawn.size(); ++s)
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const NearestState<2>& state = hexagons[k].drawn[s];
            const std::string angle = state.wanted == p.turn() / 3.0
                                          ? std::string("2π/3")
                                          : fmt::format("{:.3g} turn", state.t / p.turn());
            panels.push_back(speed_panel(fmt::format("{}, {}", hexagons[k].title, angle),
                                         *hexagons[k].model, state));
        }
    draw_configurations(
        session, "configurations",
        fmt::format("Rotating elastic hexagon, {} particles", runs.front().statistics.particles),
        panels, runs.size() > 1 ? runs.size() : panels.size(), "speed");

    CurvePanel momentum = frame("angular momentum", "turns", "L(t) / L(0)");
    CurvePanel energy = frame("energy", "turns", "|E(t) - E(0)| / E(0)", true);
    CurvePanel shape = frame("shape", "turns", "shape error / spacing", true);
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const History& h = runs[k].history;
        const std::string& title = hexagons[k].title;
        const auto turns = divided(h.column("t"), p.turn());
        auto drift = h.column("energy");
        for (double& E : drift) E = (E - h.first("energy")) / h.first("energy");
        const auto L = divided(h.column("angular_momentum"), h.first("angular_momentum"));
        momentum.curves.push_back({title, turns, L});
        energy.curves.push_back({title, turns, drift});
        shape.curves.push_back({title, turns, h.column("shape_error")});
    }
    draw_curves(session, "curves", "Rotating elastic hexagon", {momentum, energy, shape});
}

void write_comparison(const RunFolder& folder, const std::vector<RunRecord>& runs) {
    std::vector<std::string> names{"t"};
    for (const auto& run : runs)
        for (const char* what : {"angular_momentum_ratio", "energy_drift", "shape_error"})
            names.push_back(fmt::format("{}_{}", run.label, what));
    CsvWriter csv(folder / "comparison.csv", names);
    for (const double t : runs.front().history.column("t")) {
        std::vector<double> row{t};
        for (const auto& run : runs) {
            const History& h = run.history;
            row.push_back(h.at(t, "angular_momentum") / h.first("angular_momentum"));
            row.push_back((h.at(t, "energy") - h.first("energy")) / h.first("energy"));
            row.push_back(h.at(t, "shape_error"));
        }
        csv.add(row);
    }
}

}  // namespace rotating_hexagon
