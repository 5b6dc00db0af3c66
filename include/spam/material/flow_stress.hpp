// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <string>

namespace spam {

/// What the yield stress of a solid depends on, all of one particle.
struct FlowState {
    double plastic_strain;     ///< eps_p
    double rate = 0.0;         ///< of eps_p
    double temperature = 0.0;  ///< where the law is thermal
    double modulus = 0.0;      ///< of the return: 4 eta in the plane, 3 eta in space
};

/// A yield stress. `rate_dependent`: whether it depends on the rate (it is 0 then at no rate of any use, and the
/// particle remembers the time of its last step); `thermal`: whether on the temperature; `linear`: whether
/// it is linear in plastic strain and rate, so that no root has to be searched. `work(from, d)` is the integral of it
/// over the plastic strain from `from` to from + d at no rate, for laws with an energy.
template <class Law>
concept FlowStress = requires(const Law law, FlowState state, double x) {
    { law.yield_stress(state) } -> std::same_as<double>;
    { law.work(x, x) } -> std::same_as<double>;
    { law.describe() } -> std::convertible_to<std::string>;
    { Law::rate_dependent } -> std::convertible_to<bool>;
    { Law::thermal } -> std::convertible_to<bool>;
    { Law::linear } -> std::convertible_to<bool>;
    law.validate();
};

}  // namespace spam
