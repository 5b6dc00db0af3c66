// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/particles.hpp>
#include <spam/core/parts.hpp>

namespace spam::test {

/// Those of all particles that this part of a run has (core/parts.hpp); all of them where it is alone.
template <int Dim>
Particles<Dim> own_part(Particles<Dim> all) {
    if (Parts::here().alone()) return all;
    Particles<Dim> own = all;
    const auto numbers = Parts::here().numbers();
    own.reference_position.resize(Dim, static_cast<Eigen::Index>(numbers.size()));
    own.mass.clear();
    own.id.clear();
    own.body.clear();
    for (const std::uint32_t i : numbers) {
        own.reference_position.col(static_cast<Eigen::Index>(own.mass.size())) =
            all.reference_position.col(i);
        own.mass.push_back(all.mass[i]);
        own.id.push_back(all.id[i]);
        own.body.push_back(all.body[i]);
    }
    return own;
}

}  // namespace spam::test
