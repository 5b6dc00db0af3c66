// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/cluster_list.hpp>

#include <cstdint>
#include <vector>

namespace spam {

/// The images behind one wall as neighbours of their own: a sweep over them alone finds what the wall gives. They
/// are neighbours of few particles: both are copied together, at a cost that goes by the length of the wall and
/// not by the number of particles. Images of images, at corners, are behind the wall of the last direction
/// (Ghosts::behind): every pair counts once.
template <int Dim>
class BehindWall {
  public:
    /// The lower or the upper wall across direction `axis`, which has images.
    BehindWall(int axis, bool upper) : axis_(axis), upper_(upper) {}

    /// Takes list and records as they are now (`stride` numbers each, by slot of that list). Allocates only after
    /// a build of the list. Returns whether there is anything to sweep.
    bool load(const ClusterList<Dim>& list, const double* records, std::size_t stride);
    /// Of the latest load(): clusters of particles near the wall, whose numbers are places in v_dot and e_dot.
    ClusterView view() const {
        return {particles_, clusters_.size(), order_.data(), clusters_.data()};
    }
    /// Copies: what a sweep writes there is lost with the next load().
    double* records() { return records_.data(); }
    /// visit(record of the particle, record of an image): of the particle at such a place of a list whose clusters have
    /// one particle.
    template <class Visit>
    void each_neighbour(std::size_t at, const Visit& visit) const {
        const std::size_t stride = records_.size() / slots_.size();
        for (std::uint32_t k = 0; k < clusters_[at].count; ++k)
            visit(&records_[at * stride], &records_[clusters_[at].first[k]]);
    }
    std::size_t lanes() const { return order_.size(); }

    bool is(int axis, bool upper) const { return axis_ == axis && upper_ == upper; }

    /// Numbers of the particles that may have images behind the wall for neighbours; ascending.
    std::vector<std::uint32_t> particle{};
    std::vector<std::uint32_t> place{};  ///< where the rates of particle[k] are
    std::vector<double> v_dot{};         ///< Dim a place
    std::vector<double> e_dot{};         ///< one a place
    std::vector<double> not_wanted{};    ///< Dim + 2 a place, for what else a sweep stores

  private:
    void gather(const ClusterList<Dim>& list, std::size_t stride);
    void number_places(const ClusterList<Dim>& list);

    int axis_;
    bool upper_;
    std::size_t build_ = 0;  ///< of which list; 0: of none
    std::size_t particles_ = 0;
    std::vector<std::uint32_t> slots_{};  ///< of the list, by slot here: particles, then images
    std::vector<std::uint32_t> order_{}, entries_{};
    std::vector<ClusterView::Entries> clusters_{};
    std::vector<double> records_{};
};

SPAM_COMPILED(extern template class BehindWall);

}  // namespace spam
