// SPDX-License-Identifier: GPL-3.0-or-later
// What a body has broken into, for problems in which bodies break.
#pragma once

#include "../common.hpp"

namespace breaking {

using namespace spam;

/// Particles of one piece are linked by pairs that are nearer than this, in spacings of the lattice: between
/// first and second neighbours of a triangular lattice.
constexpr double piece_reach = 1.5;

using Piece = std::vector<std::uint32_t>;  ///< its particles, in order

/// Linked by pairs nearer than `reach`, a length, in the order of their first particles.
template <int Dim>
std::vector<Piece> pieces_of(const Model<Dim>& model, std::span<const double> y, double reach);

/// How many particles each piece has, the largest first; pieces of fewer than `least` are left out.
/// `reach`: in spacings.
template <int Dim>
std::vector<std::size_t> piece_sizes(const Model<Dim>& model, std::span<const double> y,
                                     std::size_t least = 1, double reach = piece_reach);

/// The particles at `position` (2 x N) that are of pieces of `least` or more: single ones fly far, and pictures
/// that show them show little else.
std::vector<Eigen::Index> particles_of_pieces(const Points<2>& position, double spacing,
                                              std::size_t least);

/// Pairs of particles of one body that are neighbours in the reference configuration, to see which of them
/// have parted.
template <int Dim>
class FirstNeighbours {
  public:
    explicit FirstNeighbours(const Particles<Dim>& particles);

    /// Of every particle the share of its first neighbours that is farther than piece_reach away from it at
    /// `position` (Dim x N): 0 in a body that is whole, however it is turned, 1 of a particle that has lost all of
    /// them or had none.
    std::vector<double> lost(const Points<Dim>& position) const;

  private:
    std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs_;
    Eigen::ArrayXd count_;  ///< of every particle's neighbours
    double reach_;
};

}  // namespace breaking
