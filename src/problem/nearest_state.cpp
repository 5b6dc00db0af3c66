// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/outline.hpp>
#include <spam/problem/nearest_state.hpp>

#include <cmath>

namespace spam {

template <int Dim>
void NearestState<Dim>::offer(double now, const ConstState<Dim>& state) {
    if (there() && std::abs(now - wanted) > std::abs(t - wanted)) return;
    t = now;
    position = state.position();
    velocity = state.velocity();
}

namespace {

template <int Dim>
void remember_all(Archive& archive, std::vector<NearestState<Dim>>& states) {
    auto kept = archive.reading() ? std::vector<NearestState<Dim>>{} : states;
    archive(kept);
    if (!archive.reading()) return;
    for (auto& state : states)
        for (const auto& other : kept) {
            const double off = std::abs(other.t - state.wanted);
            if (state.there() && off >= std::abs(state.t - state.wanted)) continue;
            state = {state.wanted, other.t, other.position, other.velocity};
        }
}

}  // namespace

template <int Dim>
Observer<Dim> keep_nearest(std::vector<NearestState<Dim>>& states) {
    return {.on_snapshot =
                [&states](double t, const Model<Dim>& model, std::span<const double> y) {
                    for (auto& state : states) state.offer(t, {model.layout(), y});
                },
            .memory = [&states](Archive& archive) { remember_all(archive, states); }};
}

ConfigurationPanel speed_panel(const std::string& title, const Model<2>& model,
                               const NearestState<2>& state) {
    const Particles<2>& particles = model.particles();
    std::vector<double> speed;
    for (Eigen::Index i = 0; i < state.velocity.cols(); ++i)
        speed.push_back(state.velocity.col(i).norm());
    const auto ring = outline(particles.reference_position, particles.spacing);
    Points<2> polygon(2, static_cast<Eigen::Index>(ring.size()));
    for (std::size_t i = 0; i < ring.size(); ++i)
        polygon.col(static_cast<Eigen::Index>(i)) = state.position.col(ring[i]);
    return {title, state.position, speed, {polygon}};
}

#define SPAM_INSTANTIATE(D)          \
    template struct NearestState<D>; \
    template Observer<D> keep_nearest(std::vector<NearestState<D>>&);
SPAM_INSTANTIATE(1)
SPAM_INSTANTIATE(2)
SPAM_INSTANTIATE(3)

}  // namespace spam
