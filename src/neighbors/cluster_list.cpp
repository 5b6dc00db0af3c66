// SPDX-License-Identifier: GPL-3.0-or-later
#include "../core/levels.hpp"
#include "candidates.hpp"
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
ClusterView ClusterList<Dim>::view() {
    ClusterView view{size_, range_of_.size(), order_.data(), range_of_.data(), slice_of_.data()};
    if (box_.periodic()) {
        find_direct();
        view.direct = direct_.data();
    }
    return view;
}

/// Far enough from the border, wherever particles have drifted since the build: nearest images would
/// be looked for in vain, which takes as long as the rest of a light pass.
template <int Dim>
void ClusterList<Dim>::find_direct() {
    direct_.resize(boxes_.size());
    const Displacement<Dim> drift = displacement();
    const double margin = reach() + skin_;
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
    for (int a = 0; a < Dim; ++a) {
        auto& x = x_[static_cast<std::size_t>(a)];
        x.resize(order_.size());
        parallel_for(order_.size(), [&](std::size_t k) {
            const double unwrapped = built_at_(a, order_[k]);
            x[k] = box_.periodic(a) ? box_.wrap(a, unwrapped) : unwrapped;
        });
    }
    boxes_.build(x_, width, box_);
}

/// Slots for all particles. Their own order is best as long as it keeps neighbours together as well
/// as strips would: in a solid, always.
template <int Dim>
void ClusterList<Dim>::sort() {
    const bool own_order_may_do = strip_volume_ > 0.0 && (in_order_ || builds_ % 16 == 1);
    if (own_order_may_do && builds_ % 64 != 0) {
        order_.resize(size_);
        std::iota(order_.begin(), order_.end(), 0U);
        gather();
        in_order_ = boxes_.mean_volume(reach()) < 1.1 * strip_volume_ && boxes_.sort();
        if (in_order_) return;
    }
    strips_.build(box_.periodic() ? box_.wrapped(built_at_) : built_at_, box_);
    order_.assign(strips_.order().begin(), strips_.order().end());
    in_order_ = false;
    gather();
    strip_volume_ = boxes_.mean_volume(reach());
}

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
            input_.length[a] = list.box_.length(a);
            input_.inverse[a] = list.box_.periodic(a) ? 1.0 / list.box_.length(a) : 0.0;
        }
    }

    /// Some clusters in a row, whose candidates are found together. Returns how many pairs were
    /// found, each from both ends.
    std::size_t run(std::size_t first, std::size_t last) {
        const Bounds<Dim> around = list_.boxes_.around(first, last);
        const bool wraps = list_.boxes_.wraps(around, list_.reach());
        return list_.in_order_ ? among_clusters(first, last, around, wraps)
                               : among_slots(first, last, around, wraps);
    }

    /// Sweeps look one entry ahead. Returns where the entries are.
    const std::uint32_t* finish() {
        if (out_.size() < used_ + 1) out_.resize(used_ + 1);
        out_[used_] = 0;
        return out_.data();
    }

  private:
    std::size_t among_clusters(std::size_t first, std::size_t last, const Bounds<Dim>& around,
                               bool wraps) {
        static thread_local std::vector<std::uint32_t> near_all, near_one;
        near_all.clear();
        list_.boxes_.collect(around, list_.reach(), near_all);
        near_all.resize(search_.keep_near(input_, around, wraps, near_all.data(), near_all.size(),
                                          near_all.data()));
        std::sort(near_all.begin(), near_all.end());
        near_one.resize(near_all.size());
        std::size_t pairs = 0;
        for (std::size_t c = first; c < last; ++c) {
            const std::size_t count = search_.keep_near(
                input_, list_.boxes_[c], wraps, near_all.data(), near_all.size(), near_one.data());
            pairs += search(search_.among_clusters, c, wraps, near_one.data(), count, width_);
        }
        return pairs;
    }

    std::size_t among_slots(std::size_t first, std::size_t last, const Bounds<Dim>& around,
                            bool wraps) {
        static thread_local Candidates candidates;
        Point<Dim> low, high;
        for (int a = 0; a < Dim; ++a) {
            low[a] = around.centre[a] - around.half[a] - list_.reach();
            high[a] = around.centre[a] + around.half[a] + list_.reach();
        }
        candidates.clear();
        list_.strips_.for_each_range(
            low, high, [&](std::uint32_t from, std::uint32_t to) { candidates.add(from, to); });
        candidates.sort(list_.order_.data());
        const auto slots = candidates.slots();
        std::size_t pairs = 0;
        for (std::size_t c = first; c < last; ++c)
            pairs += search(search_.among_slots, c, wraps, slots.data(), slots.size(), 1);
        return pairs;
    }

    /// One cluster, among places of `slots_each` slots.
    std::size_t search(decltype(Search<Dim>::among_slots) function, std::size_t cluster, bool wraps,
                       const std::uint32_t* places, std::size_t count, std::size_t slots_each) {
        const std::size_t most = used_ + count * slots_each;
        if (out_.size() < most) out_.resize(most * 5 / 4);
        std::size_t pairs = 0;
        // The repeated particle of the last cluster counts once.
        const auto members =
            static_cast<unsigned>(std::min(width_, list_.size_ - cluster * width_));
        const std::uint32_t* const end = function(input_, cluster * width_, members, wraps, places,
                                                  count, out_.data() + used_, pairs);
        const std::size_t first = used_;
        used_ = static_cast<std::size_t>(end - out_.data());
        list_.range_of_[cluster] = {static_cast<std::uint32_t>(first),
                                    static_cast<std::uint32_t>(used_ - first)};
        return pairs;
    }

    ClusterList& list_;
    std::size_t width_;
    std::vector<std::uint32_t>& out_;
    Search<Dim> search_;
    SearchInput<Dim> input_;
    std::size_t used_ = 0;
};

template <int Dim>
void ClusterList<Dim>::build(const Eigen::Ref<const Points<Dim>>& position) {
    size_ = static_cast<std::size_t>(position.cols());
    built_at_ = position;
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
    pairs_ = (found - size_) / 2;  // each was found from both ends, each particle found itself
    ++builds_;
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
    return near_build(position);
}

template class ClusterList<1>;
template class ClusterList<2>;
template class ClusterList<3>;

}  // namespace spam
