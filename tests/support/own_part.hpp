// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/particles.hpp>
#include <spam/core/parts.hpp>

namespace spam::test {

/// Those of all particles that this part of a run has (core/parts.hpp); all of them where it is alone.
template <int Dim>
Particles<Dim> own_part(const Particles<Dim>& all) {
    return Parts::here().alone() ? all : all.some(Parts::here().numbers());
}

}  // namespace spam::test
