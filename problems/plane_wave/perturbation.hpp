// SPDX-License-Identifier: GPL-3.0-or-later
// A wave that begins a little otherwise, beside the one that does not.
#pragma once

#include "ringing.hpp"

namespace plane_wave {

/// Displaces all particles by random numbers up to *p.perturb in every component, and the centre of mass by nothing.
template <int Dim>
void perturb(const Parameters& p, Ringing<Dim>& one) {
    const State<Dim> state(one.model->layout(), one.y0);
    Points<Dim> by = Points<Dim>::Zero(Dim, state.position().cols());
    displace<Dim>(by, *p.perturb, p.seed);
    state.position() += centred<Dim>(by);
}

/// Keeps the positions of a wave at every row.
template <int Dim>
Observer<Dim> keep_track(Track<Dim>& track) {
    return {.on_row =
                [&track](double t, const Model<Dim>& model, std::span<const double> y) {
                    track.t.push_back(t);
                    track.x.push_back(ConstState<Dim>(model.layout(), y).position());
                },
            .memory = [&track](Archive& archive) { archive(track.t, track.x); }};
}

/// Of the perturbed one, `distance`: the root of the mean square of displacements from the other one, by `perturb`.
template <int Dim>
Observer<Dim> distance_from(Track<Dim>& track, double perturb) {
    return {
        .columns = {{"distance", [&track](const Model<Dim>&,
                                          std::span<const double>) { return track.distance; }}},
        .on_row = [&track, perturb](double t, const Model<Dim>& model, std::span<const double> y) {
            std::size_t row = 0;
            while (row + 1 < track.t.size() && track.t[row] < t * (1.0 - 1e-9)) ++row;
            track.distance = std::nan("");  // where a run goes on with rows at other times
            if (std::abs(track.t[row] - t) > 1e-9 * t) return;
            const Points<Dim> apart = ConstState<Dim>(model.layout(), y).position() - track.x[row];
            track.distance = std::sqrt(apart.colwise().squaredNorm().mean()) / perturb;
        }};
}

}  // namespace plane_wave
