// SPDX-License-Identifier: GPL-3.0-or-later
#include "leapfrog.hpp"

#include "separable.hpp"

#include <utility>

namespace spam {
Leapfrog::Leapfrog(const Ode& ode, Vector& y, double t0, double dt)
    : FixedSteps(ode, y, t0, dt),
      a_(y.clone()),
      a_end_(y.clone()) {
    const SeparableBlocks blocks = separable_blocks(ode, "leapfrog");
    x_ = blocks.position;
    v_ = blocks.velocity;
    n_ = blocks.size;
}

void Leapfrog::begin() {
    if (!known_) rates(t_, y_, a_);
    known_ = true;
}

void Leapfrog::advance(double h) {
    const auto y = std::as_const(y_).span();
    const auto z = z_.span();
    const auto v = z.subspan(v_, n_);
    advance_block(y.subspan(v_, n_), 0.5 * h, a_.span().subspan(v_, n_), v);
    advance_block(y.subspan(x_, n_), h, v, z.subspan(x_, n_));
    rates(t_ + h, z_, a_end_);
    advance_block(v, 0.5 * h, a_end_.span().subspan(v_, n_), v);
}

}  // namespace spam
