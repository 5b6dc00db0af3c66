// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over bonds that a right-hand side waits for: each function is defined in
// bond_sweeps.lanes.cpp, for every instruction set.
#pragma once

#include "../../core/levels.hpp"
#include <spam/core/instruction_set.hpp>
#include <spam/neighbors/cluster_view.hpp>
#include <spam/physics/material_vectors.hpp>

#include <cstddef>
#include <cstdint>

namespace spam {

/// What the loops know of a table of bonds; only `renew` writes anything but t. Particles are taken `lanes` at a
/// time, a group; bond m of all of them lies together, after those before m. A particle with fewer bonds than
/// others of its group has bonds with itself behind its own, of weight 0. Sums run over the bonds of a particle in
/// their order: what has no weight adds an exact zero and leaves no trace.
template <int Dim>
struct BondView {
    static constexpr std::size_t vector_numbers = Dim + 1;  ///< X and g, each number for all lanes

    std::size_t particles;
    const std::size_t* first;    ///< by group: where its bonds begin
    std::uint32_t* partner;      ///< by bond
    std::uint32_t* reverse;      ///< by bond: which place in t is that of the partner's bond
    double* vectors;             ///< by bond
    const double* x;             ///< Dim by particle, also of those that fill the last group
    double* t;                   ///< Dim by place: r, each number for all lanes; then forces
    const std::uint32_t* shift;  ///< by block of particles: from a bond to its place in t
    std::size_t block;           ///< groups of a block
    double inverse_range;
    double little;                            ///< of FitSolver
    double length[Dim], inverse_length[Dim];  ///< of the box, 0 where it is free

    /// The place in t of the first of the bonds that lie together from there on.
    std::size_t place(std::size_t group, std::size_t bond) const {
        return static_cast<std::uint32_t>(bond + shift[group / block]);
    }
};

/// The place in t, among those of W bonds that lie together, of the one in a lane: even lanes first, because
/// registers fall apart and come together so.
constexpr std::size_t place_of_lane(std::size_t lane, std::size_t lanes) {
    return lane / 2 + lane % 2 * (lanes / 2);
}

/// What right-hand sides find of a particle, number by number: F, G, N^-1, H and c. Held for a block of groups
/// at a time, while their bonds are in the cache.
template <int Dim>
struct BondRecord {
    static constexpr std::size_t square = Dim * Dim, symmetric = Dim * (Dim + 1) / 2;
    static constexpr std::size_t F = 0, G = square, K = 2 * square, H = K + symmetric,
                                 c = H + symmetric, numbers = c + 1;
};

/// What tells which one or two particles are missing from a row, number by number: how many others there are, the
/// sum of their numbers and that of the squares of these; exact below ten million particles.
struct NeighbourSums {
    static constexpr std::size_t count = 0, sum = 1, squares = 2, numbers = 3;
};

/// What an update of rows wants to know of a group, by group, and of its particles.
template <int Dim>
struct BondRenewal {
    double reach2;  ///< of rows, squared
    double N0;      ///< of a whole particle; 0 where there are no bonds yet
    MaterialWeight weight;
    double*
        missing;  ///< by particle: NeighbourSums within the reach; in the end those of what rows lack
    double* anchoring;  ///< by particle: F^-1, or 1 where there is none
    struct Lanes {
        unsigned char fewer;  ///< which lanes have fewer bonds left than neighbours
        unsigned char idle;   ///< which have bonds within the range that weigh nothing
        unsigned gone;        ///< how many bonds have become vacancies
    };
    Lanes* found;
};

/// For the groups [first, last), whose records begin with that of the first one.
template <int Dim>
struct BondSweeps {
    int lanes = 0;
    /// F and N^-1 of every record; r into t.
    void (*fit)(const BondView<Dim>&, double* records, std::size_t first,
                std::size_t last) = nullptr;
    /// The same without t, for loops in any order.
    void (*gradients)(const BondView<Dim>&, double* records, std::size_t first,
                      std::size_t last) = nullptr;
    /// t, by F, G, H and c; v_dot_i = sum_j t_ij. `whole`: H = 0 in all.
    void (*forces)(const BondView<Dim>&, const double* records, bool whole, double* v_dot,
                   std::size_t first, std::size_t last) = nullptr;
    /// v_dot_i = (v_dot_i - sum_j t_ji)/m_i
    void (*gather)(const BondView<Dim>&, const double* mass, double* v_dot, std::size_t first,
                   std::size_t last) = nullptr;
};

/// What is not done in every right-hand side, for the groups [first, last).
template <int Dim>
struct BondUpdates {
    /// NeighbourSums of the others that are nearer than the reach, by particle, of the clusters [first, last) of a
    /// list of so many lanes. `records`: Dim + 1 coordinates and the particle's number by slot.
    void (*count)(const ClusterView&, const double* records, double reach2, double* neighbours,
                  std::size_t first, std::size_t last) = nullptr;
    /// What an update of rows does to the bonds that are there: those whose partners are not nearer than the reach
    /// become vacancies; others beyond the range, which weigh nothing, get X = F^-1 r.
    void (*renew)(const BondView<Dim>&, const BondRenewal<Dim>&, std::size_t first,
                  std::size_t last) = nullptr;
    /// By F of records: a bit for every lane of a group that has a bond of weight with |e|^2 > misfit2 |F X|^2 or
    /// |r|^2 > stretch2 |X|^2; `found` begins with that of the first group.
    void (*beyond)(const BondView<Dim>&, const double* records, double misfit2, double stretch2,
                   unsigned char* found, std::size_t first, std::size_t last) = nullptr;
    /// By F of records: sum w |e|^2, in the place of c. For energies, and for right-hand sides of groups with
    /// particles that are not whole.
    void (*misfits)(const BondView<Dim>&, double* records, std::size_t first,
                    std::size_t last) = nullptr;
};

template <int Dim, InstructionSet Level>
BondSweeps<Dim> bond_sweeps(bool periodic);
template <int Dim, InstructionSet Level>
BondUpdates<Dim> bond_updates(bool periodic);

}  // namespace spam
