// SPDX-License-Identifier: GPL-3.0-or-later
// What the bonds of material vectors bear: the same options in every problem in which they may yield or break.
#pragma once

#include "../common.hpp"
#include <spam/rhs/material_vectors.hpp>

namespace breaking {

using namespace spam;

/// As options give it: of MaterialVectorScheme.
struct BondLimits {
    double yield = 0.0;  ///< of misfits, by the yield strain; 0: they do not flow
    std::optional<double> stretch{}, stress{};  ///< beyond which bonds break

    void apply(MaterialVectorScheme& scheme) const;
};

/// `--bond-yield`, `--stretch-limit` and `--stress-limit`.
void add_bond_options(Options& options, BondLimits& limits);
/// The names of these.
std::vector<std::string> bond_option_names();

}  // namespace breaking
