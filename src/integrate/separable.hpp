// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/integrate/integrator.hpp>

namespace spam {

/// Where positions and velocities lie in y = (x, v, accounts). Accounts take the kicks of velocities: what
/// externals that depend on positions alone give to momentum and angular momentum is then kept exactly.
struct SeparableBlocks {
    std::size_t position, velocity, size, account, accounts;
};

/// Throws InputError where dx/dt = v and dv/dt = a(x) do not make up the ode; `method` for the message.
SeparableBlocks separable_blocks(const Ode& ode, const std::string& method);

/// out = in + c rate, entry by entry.
void advance_block(std::span<const double> in, double c, std::span<const double> rate,
                   std::span<double> out);

}  // namespace spam
