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
        const double least = 0.2 * (range + skin);
        if (box.periodic(a) && !(box.length(a) > least))
            throw InputError(fmt::format(
                "box: periodic length {} of direction {} must exceed (range + skin)/5 = {}; enlarge "
                "the box or shorten --range",
                box.length(a), "xyz"[a], least));
        const auto &lower = box.wall(a, false), &upper = box.wall(a, true);
        if (!lower.open() && !upper.open() && !(upper.at - lower.at > range))
            throw InputError(fmt::format(
                "wall: the two across direction {} are {} apart, not more than the range {}, and would "
                "see images of images without end; move them apart or shorten --range",
                "xyz"[a], upper.at - lower.at, range));
    }
}

template <int Dim>
ClusterView ClusterList<Dim>::view() const {
    return {size_, range_of_.size(), order_.data(), range_of_.data(), slice_of_.data()};
}

template <int Dim>
Home<Dim> ClusterList<Dim>::home() const {
    Home<Dim> home;
    if (!box_.periodic()) return home;
    home.periods = periods_.data();
    for (int a = 0; a < Dim; ++a) {
        home.length[a] = box_.length(a);
        home.last_place[a] = box_.last_place(a);
        home.places[a] = box_.periodic(a) ? 1.0 / box_.last_place(a) : 0.0;
    }
    return home;
}

template <int Dim>
std::span<const std::uint32_t> ClusterList<Dim>::entries(std::size_t cluster) const {
    const auto& range = range_of_[cluster];
    return {slice_of_[cluster / ClusterView::slice_size] + range.first, range.count};
}

/// Everybody into the box.
template <int Dim>
void ClusterList<Dim>::take_home() {
    if (!box_.periodic()) return;
    at_home_.resize(Dim, built_at_.cols());
    periods_.assign(Dim * size_, 0);
    const Home<Dim> home = this->home();
    parallel_for(size_, [&](std::size_t i) {
        const auto column = static_cast<Eigen::Index>(i);
        for (int a = 0; a < Dim; ++a) {
            std::int32_t& k = periods_[Dim * i + static_cast<std::size_t>(a)];
            double x = built_at_(a, column);
            if (box_.periodic(a)) k = static_cast<std::int32_t>(std::floor(x / box_.length(a)));
            x = home(i, static_cast<std::size_t>(a), x);
            at_home_(a, column) = x;
        }
    });
}

/// Coordinates and bounds for this order of particles; the last slot is repeated until the last
/// cluster is full.
template <int Dim>
void ClusterList<Dim>::gather() {
    const auto width = static_cast<std::size_t>(width_);
    order_.resize((size_ + width - 1) / width * width, size_ > 0 ? order_.back() : 0);
    const Points<Dim>& place = box_.periodic() ? at_home_ : built_at_;
    for (auto& x : x_) x.resize(order_.size() + 8);  // searches read a register at a time
    parallel_for(order_.size(), [&](std::size_t k) {
        for (std::size_t a = 0; a < Dim; ++a) x_[a][k] = place.data()[Dim * order_[k] + a];
    });
    boxes_.build(x_, width, order_.size() / width);
}

template <int Dim>
void ClusterList<Dim>::gather_strips() {
    take_home();
    strips_.build(box_.periodic() ? at_home_ : built_at_, box_);
    order_.assign(strips_.order().begin(), strips_.order().end());
    gather();
    strip_volume_ = boxes_.mean_volume(reach());
    typical_volume_ = boxes_.typical_volume(reach());
}

/// Slots are particle numbers. Members of a cluster stay together across a border of the box: all take the
/// image nearest to the first one's.
template <int Dim>
void ClusterList<Dim>::gather_in_order() {
    order_.resize(size_);
    std::iota(order_.begin(), order_.end(), 0U);
    take_home();
    if (box_.periodic()) {
        const auto width = static_cast<std::size_t>(width_);
        const Home<Dim> home = this->home();
        parallel_for(size_, [&](std::size_t i) {
            const auto first = static_cast<Eigen::Index>(i / width * width),
                       own = static_cast<Eigen::Index>(i);
            for (int a = 0; a < Dim; ++a) {
                if (own == first || !box_.periodic(a)) continue;
                const double apart = at_home_(a, own) - at_home_(a, first);
                const auto k = static_cast<std::int32_t>(std::nearbyint(apart / box_.length(a)));
                if (k == 0) continue;
                const auto axis = static_cast<std::size_t>(a);
                periods_[Dim * i + axis] += k;
                at_home_(a, own) = home(i, axis, built_at_(a, own));
            }
        });
    }
    gather();
}

/// Slots for all particles. Their own order is best as long as it keeps neighbours together as well
/// as strips would: in a solid, always.
template <int Dim>
void ClusterList<Dim>::sort() {
    // What strips would give changes slowly, and so does the order of a flow: neither is looked at
    // every time.
    if (builds_ % 64 == 0) gather_strips();
    if (in_order_ || builds_ % 8 == 0) {
        gather_in_order();
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
        if (list_.in_order_) find_clusters(first, last);
        for (std::size_t c = first; c < last; ++c)
            pairs += list_.in_order_ ? among_clusters(c) : among_strips(c);
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
        std::uint32_t* const ghosts = end;
        end = among_ghosts(cluster, end, pairs);
        if (ghosts != end) sort_by_number(end);
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

    /// Images among particles, by the number of their owner: an order that no later build changes.
    void sort_by_number(std::uint32_t* end) {
        const std::size_t owned = list_.order_.size();
        const auto key = [&](std::uint32_t entry) {
            const std::size_t slot = entry / list_.stride_;
            if (slot < owned) return std::pair(static_cast<std::uint32_t>(slot), 0U);
            return std::pair(list_.ghosts_.owner(slot - owned), list_.ghosts_.which(slot - owned));
        };
        std::sort(out_.data() + used_, end,
                  [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
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
};

template <int Dim>
void ClusterList<Dim>::build(const Eigen::Ref<const Points<Dim>>& position) {
    size_ = static_cast<std::size_t>(position.cols());
    built_at_ = position;
    motion_ = {};
    sort();
    ghosts_.build(box_, reach(), size_, order_.size(), x_);
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
    motion_ = box_.periodic() || box_.walled() ? best_translation<Dim>(built_at_, position)
                                               : best_rigid_motion<Dim>(built_at_, position);
    for (int a = 0; a < Dim; ++a)  // walls stay where they are
        if (box_.walled(a)) motion_.to[a] = motion_.from[a];
    return near_build(position);
}

template class ClusterList<1>;
template class ClusterList<2>;
template class ClusterList<3>;

}  // namespace spam
