// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a cluster list that looks for neighbours.
#pragma once

#include "../core/levels.hpp"
#include "search.hpp"
#include <spam/neighbors/cluster_list.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace spam {

/// Searches for the entries of one slice of clusters.
template <int Dim>
class ClusterList<Dim>::SliceSearch {
  public:
    SliceSearch(ClusterList& list, std::size_t slice)
        : list_(list),
          width_(static_cast<std::size_t>(list.width_)),
          out_(list.slices_[slice]),
          search_(at_level(instruction_set(),
                           [&](auto level) { return search_for<Dim, level>(list.width_); })) {
        const double cutoff = list.range_ + list.skin_;
        input_.cutoff2 = cutoff * cutoff;
        input_.reach2 = list.reach() * list.reach();
        input_.slots = list.size_;
        input_.bounds = list.boxes_.data();
        input_.stride = list.stride_;
        for (int a = 0; a < Dim; ++a) {
            input_.x[a] = list.x_[static_cast<std::size_t>(a)].data();
        }
    }

    /// Some clusters in a row, few enough to be near each other. Returns how many pairs were found,
    /// each from both ends.
    std::size_t run(std::size_t first, std::size_t last) {
        std::size_t pairs = 0;
        if (!list_.in_order_) {
            for (std::size_t c = first; c < last; ++c) pairs += among_strips(c);
            return pairs;
        }
        while (first < last) {
            std::size_t end = first + 1;
            while (end < last && on_one_side(first, end)) ++end;
            find_clusters(first, end);
            for (; first < end; ++first) pairs += among_clusters(first);
        }
        return pairs;
    }

    /// Sweeps look one entry ahead. Returns where the entries are.
    const std::uint32_t* finish() {
        if (out_.size() < used_ + 1) out_.resize(used_ + 1);
        out_[used_] = 0;
        return out_.data();
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
                                                 near_.data(), count, out_.data() + used_, pairs);
        const std::ptrdiff_t particles = end - (out_.data() + used_);
        end = among_ghosts(cluster, end, pairs);
        sort_in(out_.data() + used_ + particles, end);
        finish(cluster, end);
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
        const auto written = static_cast<std::size_t>(out - (out_.data() + used_));
        make_room(written + slots + 8);
        return search_.in_ranges(input_, cluster * width_, members(cluster), ghost_ranges_.data(),
                                 ghost_ranges_.size(), out_.data() + used_ + written, pairs);
    }

    /// Puts the ghosts, `from` to `end`, among the particles before them, by the number of their owner: an
    /// order that no later build changes.
    void sort_in(std::uint32_t* from, std::uint32_t* end) {
        const std::size_t owned = list_.order_.size();
        sorted_.clear();
        for (const std::uint32_t* entry = from; entry != end; ++entry) {
            const std::size_t ghost = *entry / list_.stride_ - owned;
            sorted_.emplace_back(
                std::uint64_t{list_.ghosts_.owner(ghost)} << 32 | list_.ghosts_.which(ghost),
                *entry);
        }
        std::sort(sorted_.begin(), sorted_.end());
        const std::uint32_t* const begin = out_.data() + used_;
        for (auto ghost = sorted_.rbegin(); ghost != sorted_.rend();)
            if (from != begin && from[-1] > (ghost->first >> 32) * list_.stride_)
                *--end = *--from;
            else
                *--end = (ghost++)->second;
    }

    std::size_t among_strips(std::size_t cluster) {
        const Bounds<Dim>& bounds = list_.boxes_[cluster];
        Point<Dim> low, high;
        for (int a = 0; a < Dim; ++a) {
            low[a] = bounds.centre[a] - bounds.half[a] - list_.reach();
            high[a] = bounds.centre[a] + bounds.half[a] + list_.reach();
        }
        ranges_.clear();
        std::size_t slots = 0;
        list_.strips_.for_each_range(low, high, [&](std::uint32_t from, std::uint32_t to) {
            ranges_.push_back({from, to});
            slots += to - from;
        });
        make_room(slots + 8);
        std::size_t pairs = 0;
        std::uint32_t* end = out_.data() + used_;
        const bool counted = cluster % list_.counted_each() == 0;
        // Bounds of members far from each other hold many who are near none of them.
        if (counted ||
            ClusterBoxes<Dim>::volume(bounds, list_.reach()) > 2.0 * list_.typical_volume_)
            end = search_.in_ranges(input_, cluster * width_, members(cluster), ranges_.data(),
                                    ranges_.size(), end, pairs);
        else
            end = search_.around_bounds(input_, bounds, ranges_.data(), ranges_.size(), end);
        finish(cluster, among_ghosts(cluster, end, pairs));
        return counted ? pairs : 0;
    }

    /// The repeated particle of the last cluster counts once.
    unsigned members(std::size_t cluster) const {
        return static_cast<unsigned>(std::min(width_, list_.size_ - cluster * width_));
    }
    void make_room(std::size_t slots) {
        if (out_.size() < used_ + slots) out_.resize((used_ + slots) * 5 / 4);
    }
    void finish(std::size_t cluster, const std::uint32_t* end) {
        const std::size_t first = used_;
        used_ = static_cast<std::size_t>(end - out_.data());
        list_.range_of_[cluster] = {static_cast<std::uint32_t>(first),
                                    static_cast<std::uint32_t>(used_ - first)};
    }

    ClusterList& list_;
    std::size_t width_;
    std::vector<std::uint32_t>& out_;
    Search<Dim> search_;
    SearchInput<Dim> input_;
    std::size_t used_ = 0;
    std::vector<std::uint32_t> near_group_, near_;
    std::vector<SlotRange> ranges_, ghost_ranges_;
    /// Of ghosts: the owner's slot and which of its images, as one number that sorts fast; entry.
    std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted_;
};

}  // namespace spam
