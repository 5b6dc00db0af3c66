// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a cluster list that looks for neighbours.
#pragma once

#include "../core/levels.hpp"
#include "search.hpp"
#include <spam/core/look_ahead.hpp>
#include <spam/neighbors/cluster_list.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace spam {

/// Goes down from all cells of clusters to single ones, half by half, and takes along the slots that are near.
template <int Dim>
class ClusterList<Dim>::CellSearch {
    using Cells = ClusterCells<Dim>;

  public:
    /// Levels of the way down: memory. Entries are written to pages, which stay where they are: one long
    /// vector would be copied as it grows, and leave holes of its size behind in memory.
    using Levels = std::vector<NearLevel<Dim>>;
    using Pages = std::vector<std::vector<std::uint32_t>>;
    CellSearch(ClusterList& list, Pages& pages, Levels& levels)
        : list_(list),
          cells_(list.cells_),
          levels_(levels),
          pages_(pages),
          search_(at_level(instruction_set(),
                           [&](auto level) { return search_for<Dim, level>(list.width_); })) {
        const double cutoff = list.range_ + list.skin_;
        input_.cutoff2 = cutoff * cutoff;
        input_.stride = list.stride_;
        candidates_.scale = cells_.scale;
        candidates_.reach = list.reach() * cells_.scale * (1.0 + Cells::rounding) + Cells::rounding;
        for (std::size_t a = 0; a < Dim; ++a) {
            input_.x[a] = list.x_[a].data();
            candidates_.middle[a] = cells_.middle[a];
        }
    }

    /// The part of that number of 2^bits. Returns how many pairs were found around the clusters that are
    /// counted, each from both ends.
    std::size_t run(std::size_t part, unsigned bits) {
        part_ = part, bits_ = bits;
        if (cells_.count == 0) return 0;
        for (std::size_t a = 0; a < Dim; ++a) candidates_.x[a] = cells_.x[a].data();
        candidates_.slots = cells_.slots.data();
        candidates_.count = cells_.count;
        candidates_.chunks = cells_.chunks.data();
        descend(cells_.everywhere(), candidates_, cells_.large(), 0);
        return pairs_;
    }

    /// To be called when all clusters of the part have their entries.
    void finish() {
        if (page_ < pages_.size()) std::fill_n(&pages_[page_][used_], entries_ahead, 0U);
    }

  private:
    using Region = typename Cells::Region;
    static constexpr std::size_t in_cache = 10000;

    /// `large`: clusters for whose neighbours these are enough.
    void descend(const Region& region, const Candidates<Dim>& from,
                 const std::vector<std::uint32_t>& large, unsigned depth) {
        // What several parts see the first of them does.
        const bool mine = depth >= bits_ || part_ >> depth == 0;
        const auto [axis, longest] = region.longest();
        if (longest == 1) {
            if (!mine) return;
            for (const std::uint32_t cluster : cells_.clusters(region))
                search(cluster, from, cluster % list_.counted_each() == 0);
            for (const std::uint32_t cluster : large) search(cluster, from, true);
            return;
        }
        std::array<Region, 2> halves{region, region};
        halves[0].to[axis] = halves[1].from[axis] = region.from[axis] + longest / 2;
        std::array<typename Cells::Corners, 2> corners{cells_.corners(halves[0]),
                                                       cells_.corners(halves[1])};
        std::array<std::vector<std::uint32_t>, 2> fit;
        for (const std::uint32_t cluster : large)
            if (corners[0].hold(list_.boxes_[cluster], list_.reach()))
                fit[0].push_back(cluster);
            else if (corners[1].hold(list_.boxes_[cluster], list_.reach()))
                fit[1].push_back(cluster);
            else if (mine)
                search(cluster, from, true);
        for (std::size_t half = 0; half < 2; ++half) {
            if (depth < bits_ && (part_ >> depth & 1U) != half) continue;
            if (corners[half].low[0] > corners[half].high[0]) continue;
            // More than the cache holds are not copied again and again: chunks of all lead to fewer at once.
            const bool many = from.chunks != nullptr && from.count >> (depth + 1) > in_cache;
            descend(halves[half], many ? from : narrow(corners[half], from, depth), fit[half],
                    depth + 1);
        }
    }

    /// Those between the corners.
    Candidates<Dim> narrow(const typename Cells::Corners& corners, const Candidates<Dim>& from,
                           unsigned depth) {
        if (levels_.size() <= depth) levels_.resize(depth + 1);
        NearLevel<Dim>& level = levels_[depth];
        const std::size_t most = from.count + Candidates<Dim>::lanes;
        Candidates<Dim> near = from;
        float low[Dim], high[Dim];
        float* x[Dim];
        level.provide(most);
        for (std::size_t a = 0; a < Dim; ++a) {
            near.x[a] = x[a] = level.x[a].get();
            const auto unit = [&](double c) { return (c - cells_.middle[a]) * cells_.scale; };
            low[a] = static_cast<float>(unit(corners.low[a]) - Cells::rounding);
            high[a] = static_cast<float>(unit(corners.high[a]) + Cells::rounding);
        }
        near.slots = level.slots.get();
        near.chunks = nullptr;
        near.count = search_.narrow(from, low, high, x, level.slots.get());
        return near;
    }

    /// Every neighbour of the cluster and, if not exactly, some more.
    void search(std::size_t cluster, const Candidates<Dim>& from, bool exactly) {
        const Bounds<Dim>& bounds = list_.boxes_[cluster];
        const std::size_t most = from.count + Candidates<Dim>::lanes;
        std::uint32_t* const begin = room_for(most);
        if (!exactly) {
            keep(cluster, begin, search_.near_bounds(from, bounds, input_.stride, begin));
            return;
        }
        if (near_.size() < most) near_.resize(most);
        const auto count = static_cast<std::size_t>(
            search_.near_bounds(from, bounds, 1, near_.data()) - near_.data());
        // The repeated particle of the last cluster counts once.
        const auto width = static_cast<std::size_t>(list_.width_);
        const auto members = static_cast<unsigned>(std::min(width, list_.size_ - cluster * width));
        std::size_t pairs = 0;
        keep(cluster, begin,
             search_.near_members(input_, cluster * width, members, near_.data(), count, begin,
                                  pairs));
        if (cluster % list_.counted_each() == 0) pairs_ += pairs;
    }

    std::uint32_t* room_for(std::size_t entries) {
        constexpr std::size_t usual = 2048;
        if (page_ < pages_.size() && pages_[page_].size() < used_ + entries + entries_ahead) {
            finish();
            ++page_;
            used_ = 0;
        }
        if (page_ == pages_.size()) pages_.emplace_back();
        if (pages_[page_].size() < used_ + entries + entries_ahead)
            pages_[page_].resize(std::max(usual, used_ + entries + entries_ahead));
        return pages_[page_].data() + used_;
    }
    void keep(std::size_t cluster, const std::uint32_t* begin, const std::uint32_t* end) {
        const auto count = static_cast<std::size_t>(end - begin);
        used_ += count;
        list_.entries_[cluster] = {begin, static_cast<std::uint32_t>(count)};
    }

    ClusterList& list_;
    const Cells& cells_;
    Levels& levels_;
    Pages& pages_;
    Search<Dim> search_;
    SearchInput<Dim> input_;
    Candidates<Dim> candidates_;
    std::size_t part_ = 0, pairs_ = 0, page_ = 0, used_ = 0;
    unsigned bits_ = 0;
    std::vector<std::uint32_t> near_;
};

}  // namespace spam
