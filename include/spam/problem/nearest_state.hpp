// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/picture/draw.hpp>
#include <spam/problem/observer.hpp>

#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace spam {

/// A configuration worth drawing: of the snapshots of a run, the one nearest to a wanted time.
template <int Dim>
struct NearestState {
    double wanted;
    double t = -1.0;  ///< of the state kept; below 0 before any was offered
    Points<Dim> position{}, velocity{};
    std::vector<double> values{};  ///< what is drawn in colours, where that is asked for

    bool there() const { return t >= 0.0; }
    /// Whether it should be replaced by the state at this time: no worse than what is kept.
    bool wants(double time) const;
    void remember(Archive& archive) { archive(t, position, velocity, values); }
};

/// The states wanted at these parts of `whole`, as of the end of a run.
template <int Dim>
std::vector<NearestState<Dim>> states_at(const std::vector<double>& parts, double whole);

/// What is drawn in colours: a number for each particle, or for each element.
template <int Dim>
using ValuesOfState =
    std::function<std::vector<double>(const Model<Dim>& model, std::span<const double> y)>;

/// Keeps states at every snapshot of a run, with `values_of` of each where it is given, and in its checkpoints.
/// A run that is restarted to a later end may want other times: each then takes the nearest of the states kept.
/// `states` must outlive the run.
template <int Dim>
Observer<Dim> keep_nearest(std::vector<NearestState<Dim>>& states,
                           std::type_identity_t<ValuesOfState<Dim>> values_of = {});

/// Particles coloured by speed, the body's outline drawn. Precondition: state.there().
ConfigurationPanel speed_panel(const std::string& title, const Model<2>& model,
                               const NearestState<2>& state);

}  // namespace spam
