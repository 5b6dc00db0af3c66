// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/cluster_boxes.hpp>
#include <spam/neighbors/ghosts.hpp>

#include <array>
#include <cstdint>
#include <memory>

namespace spam {

/// A coordinate far from all of ClusterCells.
inline constexpr float nowhere = 1e9F;

/// What the clusters of a list choose their neighbours from: all slots in ascending number of their particles,
/// images of one particle in the order of Ghosts::itself; and the clusters by cells of space, a few in each.
/// A search that goes down from all cells to single ones, and takes along those slots that are near, keeps their
/// order: nothing is sorted.
template <int Dim>
class ClusterCells {
  public:
    /// As ClusterList has it: positions and slots by number, coordinates by slot.
    struct Input {
        const ClusterBoxes<Dim>& boxes;
        const Ghosts<Dim>& ghosts;
        const Points<Dim>& position;
        std::span<const std::uint32_t> order, slot_of;
        const std::array<std::vector<double>, Dim>& x;
        std::size_t width;  ///< of clusters
        double volume;      ///< roughly the share of space of a particle
        double reach;
        double most_volume;  ///< ClusterBoxes::volume of a cluster that belongs to a cell
    };
    void build(const Input& in);
    /// Without cells: `slots` and `count`.
    void load(const Input& in);

    /// Some cells in a row in every direction: [from, to).
    struct Region {
        std::array<std::size_t, Dim> from, to;
        /// The direction in which there are most cells, and how many.
        std::array<std::size_t, 2> longest() const;
    };
    Region everywhere() const;
    /// Corners of the box around the clusters of a region, moved outwards by the reach; low above high where
    /// there are none.
    struct Corners {
        std::array<double, Dim> low, high;
        bool hold(const Bounds<Dim>& bounds, double reach) const;
    };
    Corners corners(const Region& region) const;
    /// Clusters of the first cell of a region, ascending.
    std::span<const std::uint32_t> clusters(const Region& region) const;
    /// Clusters too large for a cell, ascending.
    const std::vector<std::uint32_t>& large() const { return large_; }

    /// In single precision, because a search may find too many, but as quickly as possible: coordinates from
    /// `middle` in units of 1/scale, none above 1; these are rounded by less than `rounding` together with
    /// what they are compared to. `x` and `slots` may be read up to `lanes` beyond; there x is `nowhere`.
    static constexpr std::size_t lanes = 16;
    static constexpr double rounding = 1e-6;
    std::array<double, Dim> middle{};
    double scale = 1.0;
    std::array<std::vector<float>, Dim> x;
    std::vector<std::uint32_t> slots;
    std::size_t count = 0;
    /// Of every `chunk` of them in a row: the lowest and the highest x by axis. Numbers that follow each other are
    /// near each other where neighbours are looked for quickly: whole chunks are passed over.
    static constexpr std::size_t chunk = 256;
    std::vector<std::array<float, 2 * Dim>> chunks;

  private:
    void divide(const Input& in);
    void assign(const Input& in);
    void bound_chunks();
    std::size_t cell(std::size_t a, double at) const;

    std::array<double, Dim> origin_{}, per_edge_{};
    std::array<std::size_t, Dim> count_{};
    std::vector<Corners> corners_;
    std::vector<std::uint32_t> cell_of_, clusters_, large_;
    std::vector<std::size_t> first_;  ///< of clusters_, by cell
};

/// Those of all slots that are near a region of cells. Memory with nothing in it: there is room for as many as
/// there could be, and what few need of it is all that is touched.
template <int Dim>
struct NearLevel {
    std::array<std::unique_ptr<float[]>, Dim> x;
    std::unique_ptr<std::uint32_t[]> slots;
    std::size_t room = 0;

    /// What was there is lost.
    void provide(std::size_t most) {
        if (room >= most) return;
        for (auto& along : x) along = std::make_unique_for_overwrite<float[]>(most);
        slots = std::make_unique_for_overwrite<std::uint32_t[]>(most);
        room = most;
    }
};

SPAM_COMPILED(extern template class ClusterCells);

}  // namespace spam
