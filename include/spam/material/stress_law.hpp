// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/core/tensor.hpp>

#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace spam {

/// A law that integrates the stress of one particle: sigma_dot from the velocity gradient
/// (grad v)_ab = d v_b / d x_a and the present stress; `describe` names it with its constants, for
/// the banner of a run. Where it has a double sound_speed(double density), schemes with artificial
/// viscosity can use it.
template <class Law, int Dim>
concept StressLaw = requires(const Law law, Mat<Dim> grad_v, SymTensor<Dim> stress) {
    { law.stress_rate(grad_v, stress) } -> std::same_as<SymTensor<Dim>>;
    { law.describe() } -> std::convertible_to<std::string>;
};

/// One for many particles at a time, where a call for each would cost more than the law itself (a law from
/// another language): fills as many rates as there are gradients and stresses, at most `batch_of_stresses`. Called
/// from several threads; must not throw. NaN: no rate, the run stops there.
template <class Law, int Dim>
concept BatchStressLaw = requires(const Law law, std::span<const Mat<Dim>> grad_v,
                                  std::span<const SymTensor<Dim>> stress,
                                  std::span<SymTensor<Dim>> rate) {
    law.stress_rates(grad_v, stress, rate);
    { law.describe() } -> std::convertible_to<std::string>;
};
inline constexpr std::size_t batch_of_stresses = 256;

/// One with a memory: `history` names the fields that y holds for it (Role::history, or Role::integrated where
/// `rates` finds their rates), and `settle` looks at particle i after every accepted step and may change its
/// stress and history; it returns whether it did.
template <class Law, int Dim>
concept LawWithHistory = StressLaw<Law, Dim> &&
    requires(const Law law, double t, std::size_t i, const State<Dim>& state) {
    { law.history() } -> std::convertible_to<std::vector<Field>>;
    { law.settle(t, i, state) } -> std::same_as<bool>;
};

/// One whose stress is bounded: the stress in y is a trial, and every right-hand side, in forces, work and
/// rates, counts with what the law returns it to; `settle` makes that the stress in y. So settling changes no
/// rate, if returning twice is returning once: return_map(t, state)(i, trial) is the stress of particle i.
template <class Law, int Dim>
concept ReturningLaw = LawWithHistory<Law, Dim> &&
    requires(const Law law, double t, std::size_t i, const ConstState<Dim>& state,
             SymTensor<Dim> trial) {
    { law.return_map(t, state)(i, trial) } -> std::same_as<SymTensor<Dim>>;
};

/// One that returns the particles [first, first + count) at once, return_block(t, state, first, count, stress): the
/// same stresses as return_map()'s, to rounding error, into their places of `stress`, which has those of all.
template <class Law, int Dim>
concept LawThatReturnsBlocks = ReturningLaw<Law, Dim> &&
    requires(const Law law, double t, const ConstState<Dim>& state, std::size_t n, double* stress) {
    law.return_block(t, state, n, n, stress);
};

/// One with more rates than those of its stress: rates(state, rate)(i, grad_v, stress) returns sigma_dot of
/// particle i and sets its further rates; stress_rate() is not called then.
template <class Law, int Dim>
concept LawWithRates = LawWithHistory<Law, Dim> &&
    requires(const Law law, std::size_t i, const ConstState<Dim>& state, const State<Dim>& rate,
             Mat<Dim> grad_v, SymTensor<Dim> stress) {
    { law.rates(state, rate)(i, grad_v, stress) } -> std::same_as<SymTensor<Dim>>;
};

}  // namespace spam
