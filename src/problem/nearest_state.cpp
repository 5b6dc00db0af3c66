// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/outline.hpp>
#include <spam/problem/nearest_state.hpp>

#include <cmath>

namespace spam {

void NearestState::offer(double now, std::span<const double> state) {
    if (there() && std::abs(now - wanted) > std::abs(t - wanted)) return;
    t = now;
    y.assign(state.begin(), state.end());
}

namespace {

void remember_all(Archive& archive, std::vector<NearestState>& states) {
    std::vector<NearestState> kept = archive.reading() ? std::vector<NearestState>{} : states;
    archive(kept);
    if (!archive.reading()) return;
    for (NearestState& state : states)
        for (const NearestState& other : kept) {
            const double off = std::abs(other.t - state.wanted);
            if (state.there() && off >= std::abs(state.t - state.wanted)) continue;
            state = {state.wanted, other.t, other.y};
        }
}

}  // namespace

template <int Dim>
Observer<Dim> keep_nearest(std::vector<NearestState>& states) {
    return {.on_snapshot =
                [&states](double t, const Model<Dim>&, std::span<const double> y) {
                    for (NearestState& state : states) state.offer(t, y);
                },
            .memory = [&states](Archive& archive) { remember_all(archive, states); }};
}

template Observer<1> keep_nearest(std::vector<NearestState>&);
template Observer<2> keep_nearest(std::vector<NearestState>&);
template Observer<3> keep_nearest(std::vector<NearestState>&);

ConfigurationPanel speed_panel(const std::string& title, const Model<2>& model,
                               const NearestState& state) {
    const Particles<2>& particles = model.particles();
    const ConstState<2> at(model.layout(), state.y);
    const Points<2> x = at.position();
    std::vector<double> speed;
    for (Eigen::Index i = 0; i < x.cols(); ++i) speed.push_back(at.velocity().col(i).norm());
    const auto ring = outline(particles.reference_position, particles.spacing);
    Points<2> polygon(2, static_cast<Eigen::Index>(ring.size()));
    for (std::size_t i = 0; i < ring.size(); ++i)
        polygon.col(static_cast<Eigen::Index>(i)) = x.col(ring[i]);
    return {title, x, speed, {polygon}};
}

}  // namespace spam
