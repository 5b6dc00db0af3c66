// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/outline.hpp>
#include <spam/problem/sight.hpp>

#include <cmath>

namespace spam {

void Sight::look(double now, const Model<2>& model, std::span<const double> y) {
    if (t >= 0.0 && std::abs(now - wanted) > std::abs(t - wanted)) return;
    const ConstState<2> state(model.layout(), y);
    t = now;
    position = state.position();
    speed.clear();
    for (Eigen::Index i = 0; i < position.cols(); ++i)
        speed.push_back(state.velocity().col(i).norm());
}

void remember(Archive& archive, std::vector<Sight>& sights) {
    std::vector<Sight> kept = archive.reading() ? std::vector<Sight>{} : sights;
    archive(kept);
    if (!archive.reading()) return;
    for (Sight& sight : sights)
        for (const Sight& other : kept) {
            const double off = std::abs(other.t - sight.wanted);
            if (sight.t >= 0.0 && off >= std::abs(sight.t - sight.wanted)) continue;
            sight = {sight.wanted, other.t, other.position, other.speed};
        }
}

ConfigurationPanel Sight::panel(const std::string& title, const Particles<2>& particles) const {
    const auto ring = outline(particles.reference_position, particles.spacing);
    Points<2> polygon(2, static_cast<Eigen::Index>(ring.size()));
    for (std::size_t i = 0; i < ring.size(); ++i)
        polygon.col(static_cast<Eigen::Index>(i)) = position.col(ring[i]);
    return {title, position, speed, {polygon}};
}

}  // namespace spam
