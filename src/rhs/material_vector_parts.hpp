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

    BondSweeps<Dim> sweeps;
    BondTable<Dim> table;
    double N0 = 0.0;  ///< tr N/D of a whole particle
    std::vector<double> x{}, volume{}, heat{};
    double stiffness = 0.0;  ///< c_k/V_k = kappa eta/N0
    std::vector<std::uint32_t> numbers{};
    std::vector<unsigned char> left{};  ///< by block
    std::size_t watched = 0;            ///< states that watch() was shown
    bool warned = false;

    double little() const { return 1e-13 * N0; }
    BondView<Dim> view() {
        BondView<Dim> view = table.view();
        view.little = little();
        return view;
    }
    /// find(first, last) for blocks of groups, then give(first, last), as soon as everybody who has bonds with
    /// the block has been found: what was found of bonds is then still in the cache. Every thread has blocks
    /// that follow each other, and leaves to the end those with bonds beyond.
    template <class Find, class Give>
    void for_blocks(const Find& find, const Give& give) {
        const std::size_t groups = table.groups(), blocks = table.blocks();
        const auto of_block = [&](const auto& body, std::size_t b) {
            const std::size_t each = table.block / static_cast<std::size_t>(sweeps.lanes);
            body(b * each, std::min(groups, (b + 1) * each));
        };
        const std::size_t shares = std::min(blocks, static_cast<std::size_t>(set_threads(0)));
        left.assign(blocks, 0);
        parallel_for(
            shares,
            [&](std::size_t share) {
                const std::size_t begin = share * blocks / shares,
                                  end = (share + 1) * blocks / shares;
                std::size_t next = begin;
                for (std::size_t b = begin; b < end; ++b) {
                    of_block(find, b);
                    for (; next <= b; ++next) {
                        const auto& reach = table.reach(next);
                        if (reach.first < begin || reach.last >= end)
                            left[next] = 1;
                        else if (reach.last <= b)
                            of_block(give, next);
                        else
                            break;
                    }
                }
            },
            (table.particles() + shares - 1) / shares);
        parallel_for(
            blocks,
            [&](std::size_t b) {
                if (left[b] != 0) of_block(give, b);
            },
            table.block);
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
