// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/picture/draw.hpp>
#include <spam/problem/observer.hpp>

namespace spam {

/// A configuration worth drawing: of the snapshots of a run, the one nearest to a wanted time.
template <int Dim>
struct NearestState {
    double wanted;
    double t = -1.0;  ///< of the state kept; below 0 before any was offered
    Points<Dim> position{}, velocity{};

    bool there() const { return t >= 0.0; }
    /// Keeps `state`, at time `now`, where no other is nearer.
    void offer(double now, const ConstState<Dim>& state);
    void remember(Archive& archive) { archive(t, position, velocity); }
};

/// Keeps states at every snapshot of a run, and in its checkpoints. A run that is restarted to a later end
/// may want other times: each then takes the nearest of the states kept. `states` must outlive the run.
template <int Dim>
Observer<Dim> keep_nearest(std::vector<NearestState<Dim>>& states);

/// Particles coloured by speed, the body's outline drawn. Precondition: state.there().
ConfigurationPanel speed_panel(const std::string& title, const Model<2>& model,
                               const NearestState<2>& state);

}  // namespace spam
