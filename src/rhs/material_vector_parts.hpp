// SPDX-License-Identifier: GPL-3.0-or-later
// What the sources of MaterialVectors share.
#pragma once

#include "bond_table.hpp"
#include <spam/core/parallel.hpp>
#include <spam/physics/material_vectors.hpp>
#include <spam/rhs/material_vectors.hpp>

#include <algorithm>

namespace spam {

template <int Dim>
struct MaterialVectors<Dim>::Parts {
    using Record = BondRecord<Dim>;
    static constexpr std::size_t block = 128;  ///< particles whose bonds stay in the cache

    BondSweeps<Dim> sweeps;
    BondTable<Dim> table;
    double N0 = 0.0;  ///< tr N/D of a whole particle
    std::vector<double> x{}, volume{}, heat{};
    double stiffness = 0.0;  ///< c_k/V_k = kappa eta/N0
    std::vector<std::uint32_t> numbers{};

    double little() const { return 1e-13 * N0; }
    BondView<Dim> view() {
        BondView<Dim> view = table.view();
        view.little = little();
        return view;
    }
    /// body(first, last) for blocks of groups.
    template <class Body>
    void for_groups(const Body& body) {
        const std::size_t groups = table.groups(),
                          each = block / static_cast<std::size_t>(sweeps.lanes);
        parallel_for((groups + each - 1) / each,
                     [&](std::size_t b) { body(b * each, std::min(groups, (b + 1) * each)); },
                     block);
    }
};

/// What the bonds of one particle say, in plain numbers: for what is not done in every right-hand side.
template <int Dim>
struct MaterialVectors<Dim>::Fit {
    Mat<Dim> F;
    SymTensor<Dim> K;  ///< N^-1
    double misfit = 0.0;
};

}  // namespace spam
