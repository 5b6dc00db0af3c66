// SPDX-License-Identifier: GPL-3.0-or-later
#include "separable.hpp"

#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>

#include <fmt/format.h>

namespace spam {
namespace {
constexpr std::size_t threads_from =
    16384;  // below, to tell other threads of it costs more than the loop
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
    const double *const x = in.data(), *const v = rate.data();
    double* const z = out.data();
    parallel_ranges(
        out.size(),
        [=](std::size_t first, std::size_t last) {
#pragma GCC ivdep  // in and out may be the same: entry by entry that is no hindrance
            for (std::size_t k = first; k < last; ++k) z[k] = x[k] + c * v[k];
        },
        out.size() < threads_from ? 0 : 1);
}

}  // namespace spam
