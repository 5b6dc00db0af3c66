// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/cluster_cells.hpp>
#include <spam/neighbors/cluster_view.hpp>
#include <spam/neighbors/ghosts.hpp>
#include <spam/neighbors/home.hpp>
#include <spam/neighbors/motion_since.hpp>
#include <spam/neighbors/strip_sort.hpp>

#include <span>
#include <vector>

namespace spam {

/// Neighbours of clusters: `width` particles at a time, next to each other in space, which a sweep
/// computes in the lanes of one register (sweep.hpp). A cluster's list holds every slot j with
/// |r_ij| < range + skin for at least one of its particles i, themselves included, in large flows some
/// more. Slots beyond those of the particles are their images across the borders of the box and behind
/// walls (ghosts.hpp). Entries are in ascending number of the particle, those of several images of one
/// particle in ascending place (Ghosts::itself). Weight functions vanish exactly beyond the range, and
/// adding an exact zero changes no bit, so a sum over the list depends on the particles alone: not on the
/// skin, on when the list was built, nor on the number of threads (tests/rhs/list_order.cpp).
///
/// Where the range is infinite all clusters share one list, of all slots, which serves for ever.
///
/// Slots are the particles' own numbers as long as these keep neighbours together, as in a solid. In a flow
/// they are sorted into strips at every build.
template <int Dim>
class ClusterList {
  public:
    /// `range` > 0, the range of the weight function, or infinite; `skin` >= 0, how much further the list looks;
    /// `width` 1, 2, 4 or 8; `stride`: numbers in a record of the sweeps. Throws InputError when a
    /// range is infinite in a periodic box, a periodic length is so short that a particle would meet more than five
    /// images of another, or two walls face each other within the range.
    ClusterList(double range, double skin, const Box<Dim>& box, int width, std::size_t stride = 1);

    /// For later builds; as in the constructor.
    void set_skin(double skin) { skin_ = skin; }
    double skin() const { return skin_; }

    /// Builds the list for positions Dim x N (finite, not necessarily wrapped). Throws InputError where records of all
    /// particles and images have more than 2^32 numbers.
    void build(const Eigen::Ref<const Points<Dim>>& position);

    /// Whether the list still serves these positions: no particle has moved more than half the skin
    /// since the last build after the best rigid motion is taken off, so that a body that only turns
    /// and flies keeps its list. Where the box is periodic, only a translation is taken off, and none
    /// towards a wall. Never
    /// true where a position is not finite.
    bool serves(const Eigen::Ref<const Points<Dim>>& position);

    /// The particles that have moved by more than half the skin since the build, the rigid motion known last taken
    /// off. Where none has, the list serves.
    Displacement<Dim> displacement() const { return motion_.displacement(0.5 * skin_); }

    /// For sweeps over records whose positions the list serves.
    ClusterView view() const;
    /// Whether an image behind that wall is at a slot (Ghosts::behind). Precondition: the side is not open.
    bool behind(std::size_t slot, int a, bool upper) const {
        return slot >= order_.size() && ghosts_.behind(slot - order_.size(), a, upper);
    }
    std::size_t size() const { return size_; }
    std::size_t clusters() const { return entries_.size(); }
    int width() const { return width_; }
    /// Slot -> particle, `width` entries a cluster; without ghosts.
    std::span<const std::uint32_t> order() const { return order_; }
    /// With ghosts.
    std::size_t slots() const { return order_.size() + ghosts_.size(); }
    /// The particle at a slot, or whose image is there.
    std::uint32_t particle(std::size_t slot) const {
        return slot < order_.size() ? order_[slot] : order_[ghosts_.owner(slot - order_.size())];
    }
    /// Where sweeps see particles: the image that each had when the list was built.
    const Home<Dim>& home() const { return home_; }
    /// Makes the images in records by slot (`stride` numbers each, this list's) those of the particles as
    /// they are now, from number `from` on. To be called before every sweep that reads of neighbours what
    /// has been written since. `valid`, and what is returned: Ghosts::refresh.
    bool refresh(double* records, std::span<const NumberKind> numbers, std::size_t from = 0,
                 bool valid = true) const {
        return ghosts_.refresh(records, stride_, numbers, from, valid);
    }
    /// Neighbours of a cluster: slot times stride, where their records begin.
    std::span<const std::uint32_t> entries(std::size_t cluster) const;
    /// Pairs (undirected) closer than range + skin when the list was built; in large lists sorted into
    /// strips an estimate from every eighth cluster.
    std::size_t pairs() const { return pairs_; }
    std::size_t builds() const { return builds_; }
    const Box<Dim>& box() const { return box_; }

  private:
    class CellSearch;
    std::size_t search();
    void list_all();
    void sort();
    void take_home();
    void gather();
    void gather_in_order();
    void gather_strips();
    void build_images();
    /// Every how many clusters neighbours are looked for particle by particle, and counted; around the
    /// others everything near their bounds is listed. One where the list is not in strips.
    std::size_t counted_each() const { return !in_order_ && boxes_.size() >= 256 ? 8 : 1; }
    const Points<Dim>& place() const { return box_.periodic() ? at_home_ : motion_.then(); }
    /// A little more than the list must hold, whatever rounding does to bounds.
    double reach() const { return (range_ + skin_) * (1.0 + 1e-9); }

    double range_, skin_;
    Box<Dim> box_;
    int width_;
    std::uint32_t stride_;
    std::size_t size_ = 0, pairs_ = 0, builds_ = 0;
    StripSort<Dim> strips_;
    ClusterBoxes<Dim> boxes_;
    bool in_order_ = false;      ///< slots are particle numbers
    double strip_volume_ = 0.0;  ///< mean_volume() of boxes_ when strips were made last
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> slot_of_;  ///< by particle
    ClusterCells<Dim> cells_;
    std::array<std::vector<double>, Dim> x_;  ///< at home, by slot; behind them those of ghosts
    MotionSince<Dim> motion_;                 ///< since the last build
    Points<Dim> at_home_;                     ///< where the box is periodic
    std::vector<std::int32_t> periods_;       ///< Dim x N, taken off there
    Home<Dim> home_;
    Ghosts<Dim> ghosts_;
    std::vector<ClusterView::Entries> entries_;                   ///< by cluster
    std::vector<std::vector<NearLevel<Dim>>> levels_;             ///< of the searches through cells
    std::vector<std::vector<std::vector<std::uint32_t>>> parts_;  ///< pages of entries
};

SPAM_COMPILED(extern template class ClusterList);

}  // namespace spam
