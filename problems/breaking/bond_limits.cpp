// SPDX-License-Identifier: GPL-3.0-or-later
#include "bond_limits.hpp"

namespace breaking {

void BondLimits::apply(MaterialVectorScheme& scheme) const {
    scheme.bond_yield = yield;
    if (stretch) scheme.stretch_limit = *stretch;
    if (stress) scheme.stress_limit = *stress;
}

void add_bond_options(Options& options, BondLimits& limits) {
    options.number("bond-yield", limits.yield,
                   "largest misfit of a bond, by its length and the yield strain; 0 for any",
                   between(0.0, 1e6));
    options.number("stretch-limit", limits.stretch,
                   "stretch beyond which a bond breaks (default: none)",
                   {[](double x) { return x > 1.0; }, "above 1"});
    options.number("stress-limit", limits.stress,
                   "tension along a bond beyond which it breaks (default: none)",
                   between(1e-6, 1e6));
}

std::vector<std::string> bond_option_names() {
    return {"bond-yield", "stretch-limit", "stress-limit"};
}

}  // namespace breaking
