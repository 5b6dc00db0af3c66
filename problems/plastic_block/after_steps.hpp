// SPDX-License-Identifier: GPL-3.0-or-later
// Yielding as it is done where stresses are not returned within right-hand sides: elastic steps, and after each
// the return. Of first order, with an error ten times that of laws that return in every stage, and plastic work
// taken at stresses beyond the surface. Here to be compared with them.
#pragma once

#include <spam/material/hencky_solid.hpp>
#include <spam/material/yielding_solid.hpp>

namespace plastic_block {

using namespace spam;

/// A law of trial stresses whose right-hand sides take them for stresses.
struct AfterSteps {
    YieldingSolid<PlaneVonMises> law;

    SymTensor<2> stress_rate(const Mat<2>& grad_v, const SymTensor<2>& stress) const {
        return law.stress_rate(grad_v, stress);
    }
    double sound_speed(double density) const { return law.sound_speed(density); }
    std::string describe() const { return law.describe() + ", returned after steps only"; }
    std::vector<Field> history() const { return law.history(); }
    bool settle(double t, std::size_t i, const State<2>& state) const {
        return law.settle(t, i, state);
    }
};

/// The same of logarithmic strain.
class LogarithmicAfterSteps {
  public:
    static constexpr bool keeps_energy = false;  // the return takes more than it books
    LogarithmicAfterSteps(const PlaneVonMises& surface, const LinearHardening& flow)
        : law_(surface, flow),
          elastic_(surface, LinearHardening{1e300}) {}

    auto in_state(const ConstState<2>& state) const { return elastic_.in_state(state); }
    bool settle(std::size_t i, const Mat<2>& F, const State<2>& state) const {
        return law_.settle(i, F, state);
    }
    std::vector<Field> history() const { return law_.history(); }
    double stiffness() const { return law_.stiffness(); }
    std::string describe() const { return law_.describe() + ", returned after steps only"; }

  private:
    HenckySolid<PlaneVonMises> law_, elastic_;
};

}  // namespace plastic_block
