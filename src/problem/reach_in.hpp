// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/problem/rezoning.hpp>

#include <span>
#include <vector>

namespace spam {

/// How far particles act on each other in this state. Ranges of their own follow the state that a model was asked for
/// last: in a run that may be a stage of its method, and among several processes the model of the whole is never asked.
/// A model made for this one question says the same everywhere, and leaves no trace in neighbour lists of the run.
template <int Dim>
double reach_in(const Rezoning<Dim>& rezoning, const Model<Dim>& model, std::span<const double> y) {
    if (rezoning.range > 0.0) return rezoning.range;
    const auto twin = rezoning.make(model.particles());
    // Accounts of externals, the last of y, have no say in it.
    std::vector<double> state(y.begin(), y.end()), rates(twin->layout().size());
    state.resize(rates.size());
    twin->rates(0.0, state, rates);
    return twin->reach();
}

}  // namespace spam
