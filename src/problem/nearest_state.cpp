// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/outline.hpp>
#include <spam/problem/nearest_state.hpp>

#include <cmath>

namespace spam {

template <int Dim>
bool NearestState<Dim>::wants(double time) const {
    return !there() || std::abs(time - wanted) <= std::abs(t - wanted);
}

template <int Dim>
std::vector<NearestState<Dim>> states_at(const std::vector<double>& parts, double whole) {
    std::vector<NearestState<Dim>> states;
    for (const double part : parts) states.push_back({part * whole});
    return states;
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
            state = {state.wanted, other.t, other.position, other.velocity, other.values};
        }
}

}  // namespace

template <int Dim>
Observer<Dim> keep_nearest(std::vector<NearestState<Dim>>& states,
                           std::type_identity_t<ValuesOfState<Dim>> values_of) {
    const auto keep = [&states, values_of](double t, const Model<Dim>& model,
                                           std::span<const double> y) {
        const ConstState<Dim> now(model.layout(), y);
        for (auto& state : states)
            if (state.wants(t))
                state = {state.wanted, t, now.position(), now.velocity(),
                         values_of ? values_of(model, y) : std::vector<double>{}};
    };
    return {.on_snapshot = keep,
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

#define SPAM_INSTANTIATE(D)                                                              \
    template struct NearestState<D>;                                                     \
    template std::vector<NearestState<D>> states_at(const std::vector<double>&, double); \
    template Observer<D> keep_nearest(std::vector<NearestState<D>>&, ValuesOfState<D>);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
