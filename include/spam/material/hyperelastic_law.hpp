// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/core/tensor.hpp>

#include <algorithm>
#include <concepts>
#include <optional>
#include <string>
#include <vector>

namespace spam {

/// The modulus in which penalties on motions that the deformation does not see are measured. It lies between
/// eta and lambda + 2 eta for any Poisson ratio, from -1 to 1/2: below the first, the modulus of transverse
/// waves, such motions would be softer than any that is seen, and free where lambda vanishes; above the second,
/// that of longitudinal waves, they would shorten stable steps.
inline double penalty_modulus(double lambda, double eta) { return std::max(lambda, eta); }

/// A law that knows the stress from the deformation alone, F_ab = d x_a / d X_b: `energy` per volume of
/// the reference configuration, unchanged by rotations F -> Q F; `stress` its derivative, the first
/// Piola-Kirchhoff stress P_ab = d energy / d F_ab; `stiffness` the modulus in which penalties are
/// measured; `describe` names it with its constants. Where F is outside the law the stress is NaN.
template <class Law, int Dim>
concept HyperelasticLaw = requires(const Law law, Mat<Dim> F) {
    { law.energy(F) } -> std::same_as<double>;
    { law.stress(F) } -> std::same_as<Mat<Dim>>;
    { law.stiffness() } -> std::convertible_to<double>;
    { law.describe() } -> std::convertible_to<std::string>;
};

/// One with a memory, whose `history` fields y holds (Role::history): in_state(state) returns what knows
/// `stress(i, F)` and `energy(i, F)` of particle i, the second with all that has been spent on it before, so
/// that the first is its derivative as long as nothing is settled; `settle` looks at particle i after
/// every accepted step and may change its history, but neither its stress nor its energy. Returns whether it did.
template <class Law, int Dim>
concept HyperelasticLawWithMemory = requires(const Law law, std::size_t i, Mat<Dim> F,
                                             const ConstState<Dim>& state,
                                             const State<Dim>& settled) {
    { law.in_state(state).stress(i, F) } -> std::same_as<Mat<Dim>>;
    { law.in_state(state).energy(i, F) } -> std::same_as<double>;
    { law.settle(i, F, settled) } -> std::same_as<bool>;
    { law.history() } -> std::convertible_to<std::vector<Field>>;
    { law.stiffness() } -> std::convertible_to<double>;
    { law.describe() } -> std::convertible_to<std::string>;
};

/// One whose memory has rates (Role::integrated): rates(state, rate)(i, F, F_dot) sets those of particle i, which
/// are 0 before. It
/// returns in_state(state) as above, and settles nothing.
template <class Law, int Dim>
concept HyperelasticLawWithRates = HyperelasticLawWithMemory<Law, Dim> &&
    requires(const Law law, std::size_t i, Mat<Dim> F, const ConstState<Dim>& state,
             const State<Dim>& rate) {
    law.rates(state, rate)(i, F, F);
};

/// One whose memory has rates and is settled too, by the time as well: in_state(t, state), rates(t, state, rate) and
/// settle(t, i, F, state) are otherwise as above.
template <class Law, int Dim>
concept HyperelasticLawInTime = requires(const Law law, double t, std::size_t i, Mat<Dim> F,
                                         const ConstState<Dim>& state, const State<Dim>& rate) {
    { law.in_state(t, state).stress(i, F) } -> std::same_as<Mat<Dim>>;
    { law.in_state(t, state).energy(i, F) } -> std::same_as<double>;
    law.rates(t, state, rate)(i, F, F);
    { law.settle(t, i, F, rate) } -> std::same_as<bool>;
    { law.history() } -> std::convertible_to<std::vector<Field>>;
    { law.stiffness() } -> std::convertible_to<double>;
    { law.describe() } -> std::convertible_to<std::string>;
};

/// One that flows where neighbours remember the material (physics/material_vectors.hpp): flow(F) is the G by
/// which F is returned, F <- F G, where the stress is beyond what the law bears; nothing where it is not. `energy`
/// holds what such a return would spend, and `stress` is its derivative: the return changes neither the
/// stress, stress(F) = stress(F G) G^t, nor the energy with what is spent. `yield_strain`: the deviatoric
/// strain at which it flows, infinite where it does not; `flows`: whether it may flow at all.
template <class Law, int Dim>
concept FlowingLaw = HyperelasticLaw<Law, Dim> && requires(const Law law, Mat<Dim> F) {
    { law.flow(F) } -> std::same_as<std::optional<Mat<Dim>>>;
    { law.yield_strain() } -> std::convertible_to<double>;
    { law.flows() } -> std::same_as<bool>;
};

}  // namespace spam
