// SPDX-License-Identifier: GPL-3.0-or-later
#include "separable.hpp"

#include <spam/core/error.hpp>

#include <fmt/format.h>

namespace spam {
namespace {
constexpr std::size_t threads_from = 16384;  // below, fork and join cost more than the loop
}

SeparableBlocks separable_blocks(const Ode& ode, const std::string& method) {
    const auto refuse = [&](const std::string& reason) {
        throw InputError(
            fmt::format("integrator: {} advances velocity and position in turn, but {}; use rk4 or "
                        "an adaptive method",
                        method, reason));
    };
    if (!ode.inseparable.empty()) refuse(ode.inseparable);
    const Ode::Block *x = nullptr, *v = nullptr;
    for (const Ode::Block& block : ode.blocks) {
        if (block.name == "position")
            x = &block;
        else if (block.name == "velocity")
            v = &block;
        else
            refuse(fmt::format("y holds {} as well", block.name));
    }
    if (x == nullptr || v == nullptr || x->size != v->size)
        refuse("y does not hold one of each for every particle");
    return {x->first, v->first, x->size, v->first + v->size, ode.accounts};
}

void advance_block(std::span<const double> in, double c, std::span<const double> rate,
                   std::span<double> out) {
#pragma omp parallel for simd schedule(static) if (out.size() >= threads_from)
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = in[k] + c * rate[k];
}

}  // namespace spam
