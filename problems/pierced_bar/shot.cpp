// SPDX-License-Identifier: GPL-3.0-or-later
#include "shot.hpp"

namespace pierced_bar {

Shot make_shot(const Parameters& p) {
    const auto contact = p.repulsion();
    auto particles = make_particles<2>(p.target.positions(3.0 * p.matter.range), 1.0);
    for (std::size_t i = 0; i < particles.size(); ++i)
        particles.body[i] = contact && particles.id[i] >= p.target.of_bar() ? 1 : 0;
    auto model = std::make_shared<ParticleModel<2>>(std::move(particles));
    const auto& law = breaking::add_flowing_terms(*model, p.matter, contact);
    auto y0 = p.target.start(*model);
    model->layout().set_scale(Field::velocity, p.target.speed);
    return {std::move(model), &law, std::move(y0)};
}

std::vector<Column<2>> columns_of(const Shot& shot) {
    using State = std::span<const double>;
    const auto* law = shot.law;
    return {{"plastic_heat", [law](const Model<2>&, State) { return law->heat(); }},
            {"pieces",
             [](const Model<2>& m, State y) {
                 return static_cast<double>(pieces_at(m, y, least_particles).size());
             }},
            {"largest_piece",
             [](const Model<2>& m, State y) {
                 std::size_t most = 0;
                 for (const Piece& piece : pieces_at(m, y, 1))
                     most = std::max(most, piece.particles);
                 return static_cast<double>(most);
             }},
            closest_pair_column<2>()};
}

void write_pieces(const RunFolder& folder, const PiecesInMotion& pieces) {
    CsvWriter csv(folder / "pieces.csv", {"t", "piece", "particles", "x", "y", "v_x", "v_y", "spin",
                                          "inertia", "angular_velocity"});
    for (const auto& row : pieces.rows()) {
        double number = 0.0;
        for (const Piece& one : row.pieces)
            csv.add(std::vector<double>{row.t, ++number, static_cast<double>(one.particles),
                                        one.position.x(), one.position.y(), one.velocity.x(),
                                        one.velocity.y(), one.spin, one.inertia,
                                        one.angular_velocity()});
    }
}

void report(Session& session, const RunRecord& run, const PiecesInMotion& pieces) {
    const Findings findings(session);
    const History& h = run.history;
    findings.check_promises(run);
    const bool known =
        run.complete && session.integrator().method == "rk4" && *session.integrator().dt <= 0.025 &&
        session.when_default({"columns", "rows", "projectile", "speed", "offset", "yield-stress",
                              "tension-limit", "penalty", "range", "bond-yield", "stretch-limit",
                              "stress-limit", "core", "core-range", "contact", "contact-energy",
                              "contact-range"});
    const auto drift = [&](const char* name) {
        for (const Drift& one : run.drifts)
            if (one.name == name) return one.change;
        return HUGE_VAL;
    };
    findings.claim("momentum_change", drift("momentum"), 0.0, 1e-13, "pairwise forces", known);
    findings.claim("angular_momentum_change", drift("angular momentum"), 0.0, 1e-9,
                   "an energy that rotations leave unchanged", known);
    findings.claim("energy_change", drift("energy"), 0.0, 1e-5, "with the heat of flow", known);

    const double momentum = h.first("momentum_x");
    double spin_change = 0.0, longest = 0.0, turned = 0.0;
    for (const auto& flight : pieces.flights()) {
        spin_change = std::max(spin_change, flight.spin_change() / momentum);
        longest = std::max(longest, flight.t.back() - flight.t.front());
        turned = std::max(turned, std::abs(flight.angles().back()));
    }
    findings.claim("spin_change_of_pieces", spin_change, 0.0, 1e-9,
                   "since they parted, by the momentum of the projectile and a spacing",
                   known && run.statistics.t_end >= 200.0);
    findings.claim("pieces", h.last("pieces"), 7.0, 3.0,
                   "connected within the range, five particles or more; recorded",
                   known && run.statistics.t_end >= 200.0);
    findings.measure("longest_flight", longest, "of a piece that nothing has joined or left");
    findings.measure("largest_angle", turned, "that a piece has turned by since it parted");
    findings.measure("plastic_heat", h.last("plastic_heat") / h.first("energy"),
                     "by the energy of the projectile");
    findings.measure("largest_piece", h.last("largest_piece"), "particles");
    findings.measure("closest_pair", h.smallest("closest_pair"));
}

namespace {

/// Few particles have much more heat than all others: colours end where 98 % of all are below.
double largest_colour(const std::vector<NearestState<2>>& drawn) {
    std::vector<double> heat;
    for (const auto& one : drawn) heat.insert(heat.end(), one.values.begin(), one.values.end());
    if (heat.empty()) return 1.0;
    const auto at = heat.begin() + static_cast<std::ptrdiff_t>(0.98 * double(heat.size() - 1));
    std::nth_element(heat.begin(), at, heat.end());
    return std::max(*at, 1e-12);
}

/// Of the largest ones, by how far they have turned since they parted.
CurvePanel angles_of(const PiecesInMotion& pieces) {
    auto flights = pieces.flights();
    std::sort(flights.begin(), flights.end(),
              [](const auto& a, const auto& b) { return a.last.particles > b.last.particles; });
    if (flights.size() > 6) flights.resize(6);
    CurvePanel panel{"pieces since they parted", "t", "angle turned", false, {}};
    for (const auto& flight : flights)
        panel.curves.push_back(
            {fmt::format("{} particles", flight.last.particles), flight.t, flight.angles()});
    return panel;
}

CurvePanel energies_of(const History& h) {
    CurvePanel panel = over_time("energy", h, "energy",
                                 {{"kinetic", "kinetic"},
                                  {"potential", "internal"},
                                  {"plastic heat", "plastic_heat"},
                                  {"sum", "energy"}});
    std::vector<double>&potential = panel.curves[1].y, &heat = panel.curves[2].y;
    for (std::size_t k = 0; k < heat.size(); ++k) potential[k] -= heat[k];
    return panel;
}

}  // namespace

void draw(Session& session, const std::vector<NearestState<2>>& drawn, const RunRecord& run,
          const PiecesInMotion& pieces) {
    const double most = largest_colour(drawn);
    std::vector<ConfigurationPanel> panels;
    for (const auto& state : drawn) {
        if (!state.there()) continue;
        panels.push_back({fmt::format("t = {:.3g}", state.t), state.position, state.values, {}});
        for (double& heat : panels.back().colour) heat = std::clamp(heat, 0.0, most);
    }
    draw_configurations(session, "configurations",
                        "A projectile goes through a bar that flows and breaks", panels,
                        panels.size(), "plastic heat of a particle");
    std::vector<CurvePanel> curves{energies_of(run.history)};
    if (const auto angles = angles_of(pieces); !angles.curves.empty()) curves.push_back(angles);
    draw_curves(session, "curves", "A projectile goes through a bar that flows and breaks", curves);
}

}  // namespace pierced_bar
