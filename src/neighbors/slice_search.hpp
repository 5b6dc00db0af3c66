// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a cluster list that looks for neighbours where slots are numbers.
#pragma once

#include "list_part.hpp"

#include <cmath>
#include <utility>

namespace spam {

/// Clusters that follow each other. Neighbours are looked for among clusters, in ascending order; their
/// images are put between them.
template <int Dim>
class ClusterList<Dim>::SliceSearch : public ClusterList<Dim>::Part {
    using Part = ClusterList<Dim>::Part;
    using Part::begin, Part::keep, Part::input_, Part::list_, Part::make_room, Part::members;
    using Part::search_, Part::width_;

  public:
    using Part::finish;
    using Part::Part;

    /// Some clusters in a row, few enough to be near each other. Returns how many pairs were found,
    /// each from both ends.
    std::size_t run(std::size_t first, std::size_t last) {
        std::size_t pairs = 0;
        while (first < last) {
            std::size_t end = first + 1;
            while (end < last && on_one_side(first, end)) ++end;
            find_clusters(first, end);
            for (; first < end; ++first) pairs += among_clusters(first);
        }
        return pairs;
    }

  private:
    /// Clusters at opposite borders of a periodic box may be neighbours, but bounds around both would be as large
    /// as the box and hold everybody.
    bool on_one_side(std::size_t c, std::size_t d) const {
        for (int a = 0; a < Dim; ++a) {
            const auto axis = static_cast<std::size_t>(a);
            const double apart = list_.boxes_[d].centre[axis] - list_.boxes_[c].centre[axis];
            if (list_.box_.periodic(a) && std::abs(apart) > 0.5 * list_.box_.length(a))
                return false;
        }
        return true;
    }

    /// Clusters that may be near some of a group.
    void find_clusters(std::size_t first, std::size_t last) {
        const Bounds<Dim> around = list_.boxes_.around(first, last);
        near_group_.clear();
        list_.boxes_.collect(around, list_.reach(), near_group_);
        near_group_.resize(search_.keep_near(input_, around, near_group_.data(), near_group_.size(),
                                             near_group_.data()));
        std::sort(near_group_.begin(), near_group_.end());
        near_.resize(near_group_.size());
    }

    std::size_t among_clusters(std::size_t cluster) {
        const std::size_t count = search_.keep_near(
            input_, list_.boxes_[cluster], near_group_.data(), near_group_.size(), near_.data());
        make_room(count * width_);
        std::size_t pairs = 0;
        std::uint32_t* end = search_.in_clusters(input_, cluster * width_, members(cluster),
                                                 near_.data(), count, begin(), pairs);
        const std::ptrdiff_t particles = end - begin();
        end = among_ghosts(cluster, end, pairs);
        sort_in(begin() + particles, end);
        keep(cluster, end);
        return pairs;
    }

    /// Appends the ghosts near the cluster to the entries that end at `out`.
    std::uint32_t* among_ghosts(std::size_t cluster, std::uint32_t* out, std::size_t& pairs) {
        const Bounds<Dim>& bounds = list_.boxes_[cluster];
        if (!list_.ghosts_.near(bounds, list_.reach())) return out;
        ghost_ranges_.clear();
        std::size_t slots = 0;
        list_.ghosts_.for_each_range(bounds, list_.reach(),
                                     [&](std::uint32_t from, std::uint32_t to) {
                                         ghost_ranges_.push_back({from, to});
                                         slots += to - from;
                                     });
        const auto written = static_cast<std::size_t>(out - begin());
        make_room(written + slots + 8);
        return search_.in_ranges(input_, cluster * width_, members(cluster), ghost_ranges_.data(),
                                 ghost_ranges_.size(), begin() + written, pairs);
    }

    /// Puts the ghosts, `from` to `end`, among the particles before them, by the number of their owner and
    /// which of its images they are.
    void sort_in(std::uint32_t* from, std::uint32_t* end) {
        const std::size_t owned = list_.order_.size();
        sorted_.clear();
        for (const std::uint32_t* entry = from; entry != end; ++entry) {
            const std::size_t ghost = *entry / list_.stride_ - owned;
            sorted_.emplace_back(
                std::uint64_t{list_.ghosts_.owner(ghost)} << 32 | list_.ghosts_.which(ghost),
                *entry);
        }
        if (sorted_.empty()) return;
        std::sort(sorted_.begin(), sorted_.end());
        const std::uint32_t* const first = begin();
        for (auto ghost = sorted_.rbegin(); ghost != sorted_.rend(); ++ghost) {
            const auto which = static_cast<std::uint32_t>(ghost->first);
            const std::uint64_t least =
                (ghost->first >> 32) * list_.stride_ + (which > Ghosts<Dim>::itself ? 1 : 0);
            while (from != first && from[-1] >= least) *--end = *--from;
            *--end = ghost->second;
        }
    }

    std::vector<std::uint32_t> near_group_, near_;
    std::vector<SlotRange> ghost_ranges_;
    /// Of ghosts: the owner's slot and which of its images, as one number that sorts fast; entry.
    std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted_;
};

}  // namespace spam
