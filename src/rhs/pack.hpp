// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/instruction_set.hpp>
#include <spam/neighbors/box.hpp>
#include <spam/neighbors/displacement.hpp>
#include <spam/physics/scheme.hpp>

#include <cstddef>
#include <cstdint>

namespace spam {

/// Fields by number of particle, and the slots that their records go to.
template <int Dim>
struct PackInput {
    const std::uint32_t* order;  ///< slot -> particle
    std::size_t slots;
    const double *x, *v, *m;
    const double* rho;    ///< null where it is not known yet
    const double* sigma;  ///< D(D+1)/2 each
    const Box<Dim>* box;
    Displacement<Dim> displacement;
    std::size_t stride;
    MeanDensityKind mean_density;
};

/// How many particles ...
struct PackCount {
    std::size_t far = 0;      ///< have gone too far for the list
    std::size_t invalid = 0;  ///< have a density that is not positive
};

/// Writes the records: x (wrapped), v, m, rho (or EitherMean's number) and A = sigma/rho^2
/// (physics/record.hpp). Without rho the last two are left alone; with `density_only` the others are.
template <int Dim>
using Pack = PackCount (*)(const PackInput<Dim>&, bool density_only, double* records);

/// Defined in pack.lanes.cpp for every level.
template <int Dim, InstructionSet Level>
Pack<Dim> pack_for();

}  // namespace spam
