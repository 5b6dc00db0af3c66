// SPDX-License-Identifier: GPL-3.0-or-later
#include "shot.hpp"

#include <spam/io/csv.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pierced_bar {

std::string_view to_string(ContactKind kind) {
    return kind == ContactKind::none ? "none" : "repulsive";
}

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
    CsvWriter csv(folder / "pieces.csv",
                  {"t", "piece", "particles", "x", "y", "v_x", "v_y", "spin", "inertia",
                   "angular_velocity"});
    for (const auto& row : pieces.rows()) {
        double number = 0.0;
        for (const Piece& one : row.pieces)
            csv.add(std::vector<double>{row.t, ++number, static_cast<double>(one.particles),
                                        one.position.x(), one.position.y(), one.velocity.x(),
                                        one.velocity.y(), one.spin, one.inertia,
                                        one.angular_velocity()});
    }
}

void report(Session& session, const Parameters& p, const RunRecord& run,
            const PiecesInMotion& pieces) {
    const History& h = run.history;
    session.check_promises(run);
    const double momentum = h.first("momentum_x");
    double spin_change = 0.0, longest = 0.0, turned = 0.0;
    for (const auto& flight : pieces.flights()) {
        spin_change = std::max(spin_change, flight.spin_change() / momentum);
        longest = std::max(longest, flight.t.back() - flight.t.front());
        turned = std::max(turned, std::abs(flight.turned()));
    }
    session.measure("spin_change_of_pieces", spin_change, "since they parted");
    session.measure("longest_flight", longest);
    session.measure("largest_angle", turned, "that a piece has turned by since it parted");
    session.measure("plastic_heat", h.last("plastic_heat") / h.first("energy"),
                    "by the energy of the projectile");
    session.measure("pieces", h.last("pieces"));
    session.measure("largest_piece", h.last("largest_piece"));
    session.measure("closest_pair", h.smallest("closest_pair"));
    (void)p;
}

void draw(Session& session, const Parameters& p, const std::vector<breaking::HeatFrame>& frames,
          const RunRecord& run, const PiecesInMotion& pieces) {
    std::vector<ConfigurationPanel> panels;
    for (const auto& frame : frames)
        if (frame.there())
            panels.push_back({fmt::format("t = {:.3g}", frame.t), frame.position, frame.heat, {}});
    session.note_drawn(draw_configurations(session.plots_folder(), "configurations",
                                           "A projectile goes through a bar", panels, 4,
                                           "plastic heat"));
    (void)p;
    (void)run;
    (void)pieces;
}

}  // namespace pierced_bar
