// SPDX-License-Identifier: GPL-3.0-or-later
#include "account.hpp"

#include "../breaking/pieces.hpp"

namespace fragmenting_bar {
namespace {

/// Contacts of particles whose relative speed is that of sound.
constexpr ContactScheme contact{.energy = 1.0};

}  // namespace

Bar make_bar(const Parameters& p, const Scheme& scheme, bool vectors) {
    auto particles = make_particles<2>(p.target.positions(3.0 * scheme.range), 1.0);
    Bar bar;
    if (vectors) {
        auto model = std::make_shared<ParticleModel<2>>(std::move(particles));
        auto matter = p.flowing;
        matter.range = scheme.range;
        breaking::add_flowing_terms(*model, matter, contact);
        bar.title = "material vectors";
        bar.model = std::move(model);
        bar.longest_step = step_of_vectors;
        if (p.compare) bar.call("material_vectors");
    } else {
        const bool pair = scheme.angular_momentum == AngularMomentum::torque_pair;
        const bool balanced = pair || scheme.angular_momentum == AngularMomentum::torque_particle;
        const std::string label = scheme.transport == Transport::plain ? "plain" : "monaghan";
        bar.title = velocity_title(scheme.transport, "v") + torque_title(scheme.angular_momentum);
        bar.model = std::make_shared<SmoothParticleModel<2>>(
            std::move(particles), ElasticSolid::triangular_lattice(), scheme);
        bar.L_kept = balanced && scheme.balance == Balance::body;
        bar.L_tolerance = pair ? 1e-9 : 1e-5;
        if (p.compare) bar.call(label + (pair ? "_torque_pair" : ""));
    }
    bar.y0 = p.target.start(*bar.model);
    return bar;
}

std::vector<Bar> compared(const Parameters& p, Scheme scheme) {
    std::vector<Bar> bars;
    scheme.angular_momentum = AngularMomentum::free;
    for (const Transport transport : {Transport::plain, Transport::monaghan}) {
        scheme.transport = transport;
        bars.push_back(make_bar(p, scheme, false));
    }
    scheme.angular_momentum = AngularMomentum::torque_pair;
    bars.push_back(make_bar(p, scheme, false));
    bars.push_back(make_bar(p, scheme, true));
    return bars;
}

void write_ledger(const RunFolder& folder, const BodyLedger& ledger) {
    CsvWriter csv(folder / "bodies.csv",
                  {"change", "t", "body", "parents", "particles", "mass", "momentum_x",
                   "momentum_y", "angular_momentum", "energy"});
    std::size_t change = 0;
    for (const auto& entry : ledger.entries()) {
        for (std::size_t b = 0; b < entry.bodies.size(); ++b) {
            const BodyTotals& body = entry.bodies[b];
            csv.add(std::vector<double>{
                static_cast<double>(change), entry.t, static_cast<double>(b + 1),
                static_cast<double>(entry.parents[b].size()), static_cast<double>(body.particles),
                body.mass, body.momentum.x(), body.momentum.y(), body.angular_momentum,
                body.energy});
        }
        ++change;
    }
}

namespace {

const BodyTotals& projectile_of(const BodyLedger& ledger) {
    const auto& bodies = ledger.entries().front().bodies;
    return *std::max_element(bodies.begin(), bodies.end(), [](const auto& a, const auto& b) {
        return a.momentum.norm() < b.momentum.norm();
    });
}

/// What came with the projectile, or its momentum by a spacing where that is more.
double L_scale(const BodyLedger& ledger) {
    const BodyTotals& projectile = projectile_of(ledger);
    return std::max(std::abs(projectile.angular_momentum), projectile.momentum.norm());
}

double largest_L_change(const BodyLedger& ledger) {
    double change = 0.0;
    for (const auto& entry : ledger.entries()) change = std::max(change, entry.largest_L_change);
    return change / L_scale(ledger);
}

}  // namespace

void check_account(Session& session, const Bar& bar, const RunRecord& run) {
    const Findings findings(session, bar.prefix);
    const BodyLedger& ledger = *bar.ledger;
    const BodyTotals& projectile = projectile_of(ledger);
    const double L = L_scale(ledger);
    double p_change = 0.0, left_out = 0.0;
    for (const auto& entry : ledger.entries()) {
        const BodyTotals& sum = entry.sum_change;
        p_change = std::max(p_change, entry.largest_momentum_change / projectile.momentum.norm());
        left_out = std::max({left_out, std::abs(sum.mass) / projectile.mass,
                             sum.momentum.norm() / projectile.momentum.norm(),
                             std::abs(sum.angular_momentum) / L,
                             std::abs(sum.energy) / run.history.first("energy")});
    }
    findings.measure("changes_of_bodies", static_cast<double>(ledger.entries().size() - 2),
                     "joined or parted");
    findings.check("left_out_at_changes", left_out, 0.0, 1e-12,
                   "mass, momentum, angular momentum and energy of all bodies, after and before");
    findings.check("momentum_change_of_bodies", p_change, 0.0, 1e-12, "while they were bodies");
    findings.claim(
        "angular_momentum_change_of_bodies", largest_L_change(ledger), 0.0, bar.L_tolerance,
        "[HHM04] IX: each body's own balance",
        bar.L_kept && session.integrator().method == "rk4" &&
            (!session.given("dt") || session.integrator().dt.value_or(0.0) <= bar.longest_step));
}

namespace {

/// What a picture of several shows: no single particles, and by colour what has been torn.
ConfigurationPanel torn_panel(const std::string& title, const Model<2>& model,
                              const Points<2>& position) {
    const auto lost = breaking::FirstNeighbours(model.particles()).lost(position);
    ConfigurationPanel panel{title, {}, {}, {}};
    const auto drawn =
        breaking::particles_of_pieces(position, model.particles().spacing, least_particles);
    panel.position = position(Eigen::all, drawn);
    for (const Eigen::Index i : drawn) panel.colour.push_back(lost[static_cast<std::size_t>(i)]);
    return panel;
}

}  // namespace

void draw(Session& session, const std::vector<Bar>& bars, const std::vector<RunRecord>& runs) {
    std::vector<ConfigurationPanel> panels;
    const bool several = bars.size() > 1;
    for (std::size_t s = 0; s < bars.front().drawn.size(); ++s)
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const NearestState<2>& state = bars[k].drawn[s];
            if (!state.there()) continue;
            if (!several) {
                panels.push_back(
                    speed_panel(fmt::format("t = {:.3g}", state.t), *bars[k].model, state));
                panels.back().outlines.clear();
                continue;
            }
            panels.push_back(torn_panel(s == 0 ? bars[k].title
                                               : fmt::format("{:.0f} pieces, their L to {:.0e}",
                                                             runs[k].history.at(state.t, "pieces"),
                                                             largest_L_change(*bars[k].ledger)),
                                        *bars[k].model, state.position));
        }
    draw_configurations(
        session, "configurations",
        several ? fmt::format("A bar hit by a projectile, at t = {:.3g} and {:.3g}",
                              bars.front().drawn.front().t, bars.front().drawn.back().t)
                : "A bar hit by a projectile",
        panels, several ? runs.size() : panels.size(), several ? "first neighbours lost" : "speed");
}

}  // namespace fragmenting_bar
