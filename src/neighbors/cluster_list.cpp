// SPDX-License-Identifier: GPL-3.0-or-later
#include "../core/levels.hpp"
#include "search.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/neighbors/cluster_list.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace spam {

template <int Dim>
ClusterList<Dim>::ClusterList(double range, double skin, const Box<Dim>& box, int width,
                              std::size_t stride)
    : range_(range),
      skin_(skin),
      box_(box),
      width_(width),
      stride_(static_cast<std::uint32_t>(stride)) {
    for (int a = 0; a < Dim; ++a) {
        const double least = 2.0 * (range + skin);
        if (box.periodic(a) && box.length(a) <= least)
            throw InputError(fmt::format(
                "box: periodic length {} of direction {} must exceed 2 (range + skin) = {}; "
                "enlarge the box or shorten --range",
                box.length(a), "xyz"[a], least));
    }
}

template <int Dim>
ClusterView ClusterList<Dim>::view() const {
    return {size_,
            range_of_.size(),
            order_.data(),
            range_of_.data(),
            slice_of_.data(),
            box_.periodic() ? direct_.data() : nullptr};
}

/// Far enough from the border, wherever the motion known takes them: nearest images would be looked
/// for in vain, which takes as long as the rest of a light pass.
template <int Dim>
void ClusterList<Dim>::find_direct() {
    if (!box_.periodic()) return;
    direct_.resize(boxes_.size());
    const Displacement<Dim> drift = displacement();
    // Nobody has moved by more than half the skin beside this: who is in range is within range + skin/2
    // of the bounds of then, and within reach().
    const double margin = reach();
    parallel_for(
        boxes_.size(),
        [&](std::size_t c) {
            bool direct = true;
            for (int a = 0; a < Dim; ++a) {
                if (!box_.periodic(a)) continue;
                const double centre = boxes_[c].centre[a] + drift.shift[a];
                const double most = boxes_[c].half[a] + margin;
                direct = direct && std::floor((centre - most) / box_.length(a)) ==
                                       std::floor((centre + most) / box_.length(a));
            }
            direct_[c] = direct ? 1 : 0;
        },
        static_cast<std::size_t>(width_));
}

template <int Dim>
std::span<const std::uint32_t> ClusterList<Dim>::entries(std::size_t cluster) const {
    const auto& range = range_of_[cluster];
    return {slice_of_[cluster / ClusterView::slice_size] + range.first, range.count};
}

/// Coordinates and bounds for this order of particles; the last slot is repeated until the last
/// cluster is full.
template <int Dim>
void ClusterList<Dim>::gather() {
    const auto width = static_cast<std::size_t>(width_);
    order_.resize((size_ + width - 1) / width * width, size_ > 0 ? order_.back() : 0);
    const Points<Dim>& place = box_.periodic() ? wrapped_ : built_at_;
    for (auto& x : x_) x.resize(order_.size() + 8);  // searches read a register at a time
    parallel_for(order_.size(), [&](std::size_t k) {
        for (std::size_t a = 0; a < Dim; ++a) x_[a][k] = place.data()[Dim * order_[k] + a];
    });
    boxes_.build(x_, width, order_.size() / width, box_);
}

template <int Dim>
void ClusterList<Dim>::gather_strips() {
    strips_.build(box_.periodic() ? wrapped_ : built_at_, box_);
    order_.assign(strips_.order().begin(), strips_.order().end());
    gather();
    strip_volume_ = boxes_.mean_volume(reach());
    typical_volume_ = boxes_.typical_volume(reach());
}

/// Slots for all particles. Their own order is best as long as it keeps neighbours together as well
/// as strips would: in a solid, always.
template <int Dim>
void ClusterList<Dim>::sort() {
    // What strips would give changes slowly, and so does the order of a flow: neither is looked at
    // every time.
    if (builds_ % 64 == 0) gather_strips();
    if (in_order_ || builds_ % 8 == 0) {
        order_.resize(size_);
        std::iota(order_.begin(), order_.end(), 0U);
        gather();
        in_order_ = boxes_.mean_volume(reach()) < 1.1 * strip_volume_ && boxes_.sort();
    }
    if (!in_order_) gather_strips();
}

/// Searches for the entries of one slice of clusters.
template <int Dim>
class ClusterList<Dim>::SliceSearch {
  public:
    SliceSearch(ClusterList& list, std::size_t slice)
        : list_(list),
          width_(static_cast<std::size_t>(list.width_)),
          periodic_(list.box_.periodic()),
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
            input_.length[a] = list.box_.length(a);
            input_.inverse[a] = list.box_.periodic(a) ? 1.0 / list.box_.length(a) : 0.0;
        }
    }

    /// Some clusters in a row, few enough to be near each other. Returns how many pairs were found,
    /// each from both ends.
    std::size_t run(std::size_t first, std::size_t last) {
        std::size_t pairs = 0;
        if (list_.in_order_) find_clusters(first, last);
        for (std::size_t c = first; c < last; ++c) {
            const bool wraps = list_.boxes_.wraps(list_.boxes_[c], list_.reach());
            pairs += list_.in_order_ ? among_clusters(c, wraps) : among_strips(c, wraps);
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
    /// Clusters that may be near some of a group.
    void find_clusters(std::size_t first, std::size_t last) {
        const Bounds<Dim> around = list_.boxes_.around(first, last);
        near_group_.clear();
        list_.boxes_.collect(around, list_.reach(), near_group_);
        near_group_.resize(search_.keep_near(input_, around, periodic_, near_group_.data(),
                                             near_group_.size(), near_group_.data()));
        std::sort(near_group_.begin(), near_group_.end());
        near_.resize(near_group_.size());
    }

    std::size_t among_clusters(std::size_t cluster, bool wraps) {
        const std::size_t count =
            search_.keep_near(input_, list_.boxes_[cluster], periodic_, near_group_.data(),
                              near_group_.size(), near_.data());
        make_room(count * width_);
        std::size_t pairs = 0;
        finish(cluster, search_.in_clusters(input_, cluster * width_, members(cluster), wraps,
                                            near_.data(), count, out_.data() + used_, pairs));
        return pairs;
    }

    std::size_t among_strips(std::size_t cluster, bool wraps) {
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
        std::uint32_t* const out = out_.data() + used_;
        const bool counted = cluster % list_.counted_each() == 0;
        // Bounds of members far from each other hold many who are near none of them.
        if (counted ||
            ClusterBoxes<Dim>::volume(bounds, list_.reach()) > 2.0 * list_.typical_volume_)
            finish(cluster, search_.in_ranges(input_, cluster * width_, members(cluster), wraps,
                                              ranges_.data(), ranges_.size(), out, pairs));
        else
            finish(cluster, search_.around_bounds(input_, bounds, wraps, ranges_.data(),
                                                  ranges_.size(), out));
        if (!counted) pairs = 0;
        return pairs;
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
    bool periodic_;  ///< bounds of others may lie across a border that is out of reach
    std::vector<std::uint32_t>& out_;
    Search<Dim> search_;
    SearchInput<Dim> input_;
    std::size_t used_ = 0;
    std::vector<std::uint32_t> near_group_, near_;
    std::vector<SlotRange> ranges_;
};

template <int Dim>
void ClusterList<Dim>::build(const Eigen::Ref<const Points<Dim>>& position) {
    size_ = static_cast<std::size_t>(position.cols());
    built_at_ = position;
    if (box_.periodic()) wrapped_ = box_.wrapped(built_at_);
    motion_ = {};
    sort();
    constexpr std::size_t slice_size = ClusterView::slice_size;
    range_of_.resize(boxes_.size());
    slices_.resize((boxes_.size() + slice_size - 1) / slice_size);
    slice_of_.resize(slices_.size());
    const auto width = static_cast<std::size_t>(width_);
    const std::size_t group = std::max<std::size_t>(1, 32 / width);
    const std::size_t found = parallel_count(
        slices_.size(),
        [&](std::size_t slice) {
            SliceSearch search(*this, slice);
            const std::size_t end = std::min((slice + 1) * slice_size, boxes_.size());
            std::size_t pairs = 0;
            for (std::size_t c = slice * slice_size; c < end; c += group)
                pairs += search.run(c, std::min(c + group, end));
            slice_of_[slice] = search.finish();
            return pairs;
        },
        slice_size * width);
    // Each pair was found from both ends, each particle found itself.
    std::size_t counted = 0;
    for (std::size_t c = 0; c < boxes_.size(); c += counted_each())
        counted += std::min(width, size_ - c * width);
    pairs_ = counted == 0 ? 0
                          : static_cast<std::size_t>(static_cast<double>(found - counted) * 0.5 *
                                                         static_cast<double>(size_) /
                                                         static_cast<double>(counted) +
                                                     0.5);
    ++builds_;
    find_direct();
}

template <int Dim>
Displacement<Dim> ClusterList<Dim>::displacement() const {
    Displacement<Dim> d;
    const Point<Dim> shift = motion_.to - motion_.rotation * motion_.from;
    for (int a = 0; a < Dim; ++a) {
        d.shift[a] = shift[a];
        for (int b = 0; b < Dim; ++b) d.rotation[a][b] = motion_.rotation(a, b);
    }
    d.then = built_at_.data();
    d.limit2 = 0.25 * skin_ * skin_;
    return d;
}

template <int Dim>
bool ClusterList<Dim>::near_build(const Eigen::Ref<const Points<Dim>>& position) const {
    const Displacement<Dim> now = displacement();
    const double* const x = position.data();
    return parallel_count(size_, [&](std::size_t i) { return now.too_far(i, x + Dim * i); }) == 0;
}

template <int Dim>
bool ClusterList<Dim>::serves(const Eigen::Ref<const Points<Dim>>& position) {
    if (builds_ == 0 || size_ != static_cast<std::size_t>(position.cols())) return false;
    // Any rigid motion will do for the criterion: a better one is looked for when the last one is
    // used up.
    if (near_build(position)) return true;
    motion_ = box_.periodic() ? best_translation<Dim>(built_at_, position)
                              : best_rigid_motion<Dim>(built_at_, position);
    find_direct();
    return near_build(position);
}

template class ClusterList<1>;
template class ClusterList<2>;
template class ClusterList<3>;

}  // namespace spam
