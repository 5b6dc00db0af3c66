// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/cell_grid.hpp>

namespace spam {

/// For every particle i the particles j with |r_ij| < range + skin at the time of building, i
/// itself included, in **ascending j**. Weight functions vanish exactly beyond the range, and
/// adding an exact zero changes no bit, so a sum over the list depends on the positions alone:
/// neither on the skin, nor on when the list was built, nor on the number of threads.
template <int Dim>
class PairList {
  public:
    /// `range` > 0, the range of the weight function; `skin` >= 0, how much further the list looks.
    /// Throws InputError when a periodic length is not above 2 (range + skin).
    PairList(double range, double skin, const Box<Dim>& box);

    /// Builds the list for positions Dim x N (finite, not necessarily wrapped).
    void build(const Points<Dim>& position);

    /// Rebuilds only if some particle has moved more than half the skin since the last build.
    /// Returns whether it did.
    bool update(const Points<Dim>& position);

    std::span<const std::uint32_t> neighbours(std::size_t i) const {
        return {entries_.data() + start_[i], start_[i + 1] - start_[i]};
    }
    std::size_t size() const { return start_.empty() ? 0 : start_.size() - 1; }
    /// Directed entries, self included.
    std::size_t entries() const { return entries_.size(); }
    std::size_t builds() const { return builds_; }
    double range() const { return range_; }
    const Box<Dim>& box() const { return box_; }

  private:
    template <class Visit>
    void for_each_within(std::size_t i, const Visit& visit) const;

    double range_, skin_;
    Box<Dim> box_;
    CellGrid<Dim> grid_;
    Points<Dim> wrapped_, built_at_;
    std::vector<std::size_t> start_;
    std::vector<std::uint32_t> entries_;
    std::size_t builds_ = 0;
};

extern template class PairList<1>;
extern template class PairList<2>;
extern template class PairList<3>;

}  // namespace spam
