// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_ledger.hpp"

#include <spam/core/exact_sum.hpp>
#include <spam/neighbors/connected_parts.hpp>

#include <algorithm>
#include <cmath>

namespace spam {

std::vector<BodyTotals> totals_of_bodies(const Model<2>& model, std::span<const double> y) {
    struct Sums {
        std::size_t particles = 0;
        ExactSum mass, px, py, L, energy;
    };
    const ConstState<2> state(model.layout(), y);
    const auto& particles = model.particles();
    std::vector<Sums> sums(static_cast<std::size_t>(particles.bodies()));
    for (std::size_t k = 0; k < particles.size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        const double m = particles.mass[k];
        const Point<2> x = state.position().col(i), v = state.velocity().col(i);
        Sums& s = sums[static_cast<std::size_t>(particles.body[k])];
        ++s.particles;
        s.mass += m;
        s.px += m * v.x();
        s.py += m * v.y();
        s.L += m * x.x() * v.y();
        s.L += -m * x.y() * v.x();
        s.energy += 0.5 * m * v.squaredNorm();
        if (state.has(Field::energy)) s.energy += m * state.energy()(0, i);
    }
    std::vector<BodyTotals> totals;
    for (const Sums& s : sums)
        totals.push_back({s.particles, s.mass, Point<2>(s.px, s.py), s.L, s.energy});
    return totals;
}

namespace {

BodyTotals total(const std::vector<BodyTotals>& bodies) {
    BodyTotals sum;
    for (const BodyTotals& b : bodies) {
        sum.particles += b.particles;
        sum.mass += b.mass;
        sum.momentum += b.momentum;
        sum.angular_momentum += b.angular_momentum;
        sum.energy += b.energy;
    }
    return sum;
}

std::vector<std::vector<std::size_t>> parents_of(const std::vector<std::int32_t>& bodies,
                                                 const std::vector<std::int32_t>& before,
                                                 std::size_t count) {
    std::vector<std::vector<std::size_t>> parents(count);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        parents[static_cast<std::size_t>(bodies[i])].push_back(static_cast<std::size_t>(before[i]));
    for (auto& list : parents) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return parents;
}

}  // namespace

/// What the bodies had until now, against what they came into being with.
void BodyLedger::settle(Entry& entry, const std::vector<BodyTotals>& had) const {
    const auto& born = entries_.back().bodies;
    for (std::size_t b = 0; b < had.size(); ++b) {
        entry.largest_L_change = std::max(
            entry.largest_L_change, std::abs(had[b].angular_momentum - born[b].angular_momentum));
        entry.largest_momentum_change =
            std::max(entry.largest_momentum_change, (had[b].momentum - born[b].momentum).norm());
    }
}

bool BodyLedger::find_bodies(double t, Model<2>& model, std::span<const double> y,
                             double until_next) {
    const ConstState<2> state(model.layout(), y);
    // Two particles come nearer by no more than twice the largest speed; a tenth for its growth.
    const double margin = 2.2 * state.velocity().colwise().norm().maxCoeff() * until_next;
    auto bodies = connected_parts<2>(state.position(), model.reach() + margin, model.box());
    const auto before = model.particles().body;
    const bool first = entries_.empty();
    if (!first && bodies == before) return false;

    Entry entry;
    entry.t = t;
    const auto had = totals_of_bodies(model, y);
    if (!first) settle(entry, had);
    model.set_bodies(bodies);
    entry.bodies = totals_of_bodies(model, y);
    const BodyTotals now = total(entry.bodies), then = total(had);
    entry.sum_change = {now.particles - then.particles, now.mass - then.mass,
                        now.momentum - then.momentum, now.angular_momentum - then.angular_momentum,
                        now.energy - then.energy};
    entry.parents.resize(entry.bodies.size());
    if (!first) entry.parents = parents_of(bodies, before, entry.bodies.size());
    entries_.push_back(std::move(entry));
    return true;
}

void BodyLedger::close(double t, const Model<2>& model, std::span<const double> y) {
    Entry entry;
    entry.t = t;
    entry.bodies = totals_of_bodies(model, y);
    settle(entry, entry.bodies);
    for (std::size_t b = 0; b < entry.bodies.size(); ++b) entry.parents.push_back({b});
    entries_.push_back(std::move(entry));
}

}  // namespace spam
