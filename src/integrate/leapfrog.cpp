// SPDX-License-Identifier: GPL-3.0-or-later
#include "leapfrog.hpp"

#include "separable.hpp"

#include <utility>

namespace spam {
Leapfrog::Leapfrog(const Ode& ode, Vector& y, double t0, double dt)
    : FixedSteps(ode, y, t0, dt),
      at_(separable_blocks(ode, "leapfrog")),
      a_(y.clone()),
      a_end_(y.clone()) {}

void Leapfrog::begin() {
    if (!known_) rates(t_, y_, a_);
    known_ = true;
}

void Leapfrog::advance(double h) {
    const auto y = std::as_const(y_).span();
    const auto z = z_.span();
    const auto kick = [&](std::span<const double> from, std::span<const double> rate,
                          std::size_t first, std::size_t size) {
        advance_block(from.subspan(first, size), 0.5 * h, rate.subspan(first, size),
                      z.subspan(first, size));
    };
    kick(y, a_.span(), at_.velocity, at_.size);
    kick(y, a_.span(), at_.account, at_.accounts);
    const auto v = z.subspan(at_.velocity, at_.size);
    advance_block(y.subspan(at_.position, at_.size), h, v, z.subspan(at_.position, at_.size));
    rates(t_ + h, z_, a_end_);
    kick(z, a_end_.span(), at_.velocity, at_.size);
    kick(z, a_end_.span(), at_.account, at_.accounts);
}

}  // namespace spam
