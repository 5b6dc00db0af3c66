// SPDX-License-Identifier: GPL-3.0-or-later
#include "rk4.hpp"

namespace spam {

Rk4::Rk4(const Ode& ode, Vector& y, double t0, double dt)
    : FixedSteps(ode, y, t0, dt),
      k_{y.clone(), y.clone(), y.clone(), y.clone()} {}

void Rk4::advance(double h) {
    N_VLinearSum(1.0, y_.get(), 0.5 * h, k_[0].get(), z_.get());
    rates(t_ + 0.5 * h, z_, k_[1]);
    N_VLinearSum(1.0, y_.get(), 0.5 * h, k_[1].get(), z_.get());
    rates(t_ + 0.5 * h, z_, k_[2]);
    N_VLinearSum(1.0, y_.get(), h, k_[2].get(), z_.get());
    rates(t_ + h, z_, k_[3]);

    std::array<double, 5> c{1.0, h / 6.0, h / 3.0, h / 3.0, h / 6.0};
    std::array<N_Vector, 5> v{y_.get(), k_[0].get(), k_[1].get(), k_[2].get(), k_[3].get()};
    N_VLinearCombination(5, c.data(), v.data(), z_.get());
}

std::string Rk4::non_finite_stage(double h) const {
    const std::array<double, 4> times{t_, t_ + 0.5 * h, t_ + 0.5 * h, t_ + h};
    for (std::size_t k = 0; k < k_.size(); ++k)
        if (auto reason = non_finite_rate(k_[k].span(), times[k]); !reason.empty()) return reason;
    return {};
}

}  // namespace spam
