// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice_search.hpp"
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
ClusterView ClusterList<Dim>::behind_wall(int a, bool upper) const {
    BehindWall& wall = behind_[static_cast<std::size_t>(2 * a + (upper ? 1 : 0))];
    if (wall.build != builds_) {
        wall.build = builds_;
        wall.entries.clear();
        wall.range.resize(range_of_.size());
        const auto owned = static_cast<std::uint32_t>(order_.size());
        for (std::size_t c = 0; c < range_of_.size(); ++c) {
            const auto first = static_cast<std::uint32_t>(wall.entries.size());
            for (const std::uint32_t entry : entries(c))
                if (entry >= owned * stride_ && ghosts_.behind(entry / stride_ - owned, a, upper))
                    wall.entries.push_back(entry);
            wall.range[c] = {first, static_cast<std::uint32_t>(wall.entries.size()) - first};
        }
        wall.entries.insert(wall.entries.end(), 2, 0);  // sweeps look one ahead
        wall.slices.assign(slice_of_.size(), wall.entries.data());
    }
    return {size_, range_of_.size(), order_.data(), wall.range.data(), wall.slices.data()};
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
    at_home_.resize(Dim, motion_.then().cols());
    periods_.assign(Dim * size_, 0);
    home_.periods = periods_.data();
    std::array<double, Dim> inverse{};
    for (int a = 0; a < Dim; ++a) {
        home_.length[a] = box_.length(a);
        home_.last_place[a] = box_.last_place(a);
        home_.places[a] = box_.periodic(a) ? 1.0 / box_.last_place(a) : 0.0;
        inverse[static_cast<std::size_t>(a)] = box_.periodic(a) ? 1.0 / box_.length(a) : 0.0;
    }
    // A search need not have the last digits right.
    parallel_for(size_, [&](std::size_t i) {
        for (std::size_t a = 0; a < Dim; ++a) {
            double x = motion_.then().data()[Dim * i + a];
            if (const double L = home_.length[a]; L > 0.0) {
                const double k = std::floor(x * inverse[a]);
                periods_[Dim * i + a] = static_cast<std::int32_t>(k);
                x -= k * L;
            }
            at_home_.data()[Dim * i + a] = x;
        }
    });
}

/// Coordinates and bounds for this order of particles; the last slot is repeated until the last
/// cluster is full.
template <int Dim>
void ClusterList<Dim>::gather() {
    const auto width = static_cast<std::size_t>(width_);
    order_.resize((size_ + width - 1) / width * width, size_ > 0 ? order_.back() : 0);
    const Points<Dim>& place = box_.periodic() ? at_home_ : motion_.then();
    for (auto& x : x_) x.resize(order_.size() + 8);  // searches read a register at a time
    parallel_for(order_.size(), [&](std::size_t k) {
        for (std::size_t a = 0; a < Dim; ++a) x_[a][k] = place.data()[Dim * order_[k] + a];
    });
    boxes_.build(x_, width, order_.size() / width);
}

template <int Dim>
void ClusterList<Dim>::gather_strips() {
    take_home();
    strips_.build(box_.periodic() ? at_home_ : motion_.then(), box_);
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
        parallel_for(size_, [&](std::size_t i) {
            const auto first = static_cast<Eigen::Index>(i / width * width),
                       own = static_cast<Eigen::Index>(i);
            for (int a = 0; a < Dim; ++a) {
                if (own == first || !box_.periodic(a)) continue;
                const double apart = at_home_(a, own) - at_home_(a, first), L = box_.length(a);
                if (std::abs(apart) <= 0.5 * L) continue;
                const int k = apart > 0.0 ? 1 : -1;
                periods_[Dim * i + static_cast<std::size_t>(a)] += k;
                at_home_(a, own) -= k * L;
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

template <int Dim>
void ClusterList<Dim>::build(const Eigen::Ref<const Points<Dim>>& position) {
    size_ = static_cast<std::size_t>(position.cols());
    motion_.begin(position);
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
bool ClusterList<Dim>::serves(const Eigen::Ref<const Points<Dim>>& position) {
    if (builds_ == 0 || size_ != static_cast<std::size_t>(position.cols())) return false;
    return motion_.within(0.5 * skin_, position, box_);
}

template class ClusterList<1>;
template class ClusterList<2>;
template class ClusterList<3>;

}  // namespace spam
