// SPDX-License-Identifier: GPL-3.0-or-later
#include "../core/levels.hpp"
#include "search.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/neighbors/cluster_list.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
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
    return {size_, range_of_.size(), order_.data(), range_of_.data(), slice_of_.data()};
}

template <int Dim>
std::span<const std::uint32_t> ClusterList<Dim>::entries(std::size_t cluster) const {
    const auto& range = range_of_[cluster];
    return {slice_of_[cluster / ClusterView::slice_size] + range.first, range.count};
}

/// Slots for all particles, and their coordinates in that order; the last slot is repeated until
/// the last cluster is full.
template <int Dim>
void ClusterList<Dim>::sort(const Eigen::Ref<const Points<Dim>>& position) {
    size_ = static_cast<std::size_t>(position.cols());
    built_at_ = position;
    motion_ = {};
    if (box_.periodic())
        strips_.build(box_.wrapped(built_at_), box_);
    else
        strips_.build(built_at_, box_);
    const auto width = static_cast<std::size_t>(width_);
    const std::size_t clusters = (size_ + width - 1) / width;
    order_.assign(strips_.order().begin(), strips_.order().end());
    in_order_ = true;
    for (std::size_t k = 0; k < size_; ++k) in_order_ = in_order_ && order_[k] == k;
    if (size_ > 0) order_.resize(clusters * width, order_.back());
    for (int a = 0; a < Dim; ++a) {
        auto& x = x_[static_cast<std::size_t>(a)];
        x.resize(order_.size());
        parallel_for(order_.size(), [&](std::size_t k) {
            const double unwrapped = built_at_(a, order_[k]);
            x[k] = box_.periodic(a) ? box_.wrap(a, unwrapped) : unwrapped;
        });
    }
    range_of_.resize(clusters);
    slices_.resize((clusters + ClusterView::slice_size - 1) / ClusterView::slice_size);
    slice_of_.resize(slices_.size());
}

/// Slots in ascending number of particle. Where particles have hardly changed places since they were
/// numbered little is out of order, and insertion is quick; else not.
template <int Dim>
void ClusterList<Dim>::put_in_order(std::uint32_t* first, std::uint32_t* last) const {
    std::ptrdiff_t moves_left = 4 * (last - first);
    for (std::uint32_t* k = first + 1; k < last; ++k) {
        const std::uint32_t moving = *k, number = order_[moving];
        std::uint32_t* to = k;
        for (; to > first && order_[to[-1]] > number; --to) *to = to[-1];
        *to = moving;
        moves_left -= k - to;
        if (moves_left >= 0) continue;
        std::sort(first, last,
                  [&](std::uint32_t a, std::uint32_t b) { return order_[a] < order_[b]; });
        return;
    }
}

/// Entries of the clusters of one slice. Returns how many pairs were found, each from both ends.
template <int Dim>
std::size_t ClusterList<Dim>::search_slice(std::size_t slice) {
    const double cutoff = range_ + skin_;
    SearchInput<Dim> input;
    input.cutoff2 = cutoff * cutoff;
    input.wraps = box_.periodic();
    for (int a = 0; a < Dim; ++a) {
        input.x[a] = x_[static_cast<std::size_t>(a)].data();
        input.length[a] = box_.length(a);
        input.inverse[a] = box_.periodic(a) ? 1.0 / box_.length(a) : 0.0;
    }
    const auto search =
        at_level(instruction_set(), [&](auto level) { return search_for<Dim, level>(width_); });

    std::vector<std::uint32_t>& out = slices_[slice];
    const auto width = static_cast<std::size_t>(width_);
    const std::size_t begin = slice * ClusterView::slice_size;
    const std::size_t end = std::min(begin + ClusterView::slice_size, range_of_.size());
    std::size_t used = 0, pairs = 0;
    std::array<SlotRange, 1024> candidates;
    for (std::size_t c = begin; c < end; ++c) {
        Point<Dim> low, high;
        for (int a = 0; a < Dim; ++a) {
            const double* const x = input.x[a] + c * width;
            const auto [least, most] = std::minmax_element(x, x + width);
            const double reach = cutoff * (1.0 + 1e-12);  // whatever rounding does to a bin
            low[a] = *least - reach;
            high[a] = *most + reach;
        }
        const std::size_t first = used;
        // The repeated particle of the last cluster counts once.
        const auto members = static_cast<unsigned>(std::min(width, size_ - c * width));
        int count = 0;
        const auto flush = [&] {
            std::size_t room = 0;
            for (int k = 0; k < count; ++k) room += candidates[k].last - candidates[k].first;
            if (out.size() < used + room) out.resize(used + room + (used + room) / 4);
            used = static_cast<std::size_t>(search(input, c * width, members, candidates.data(),
                                                   count, out.data() + used, pairs) -
                                            out.data());
            count = 0;
        };
        strips_.for_each_range(low, high, [&](std::uint32_t from, std::uint32_t to) {
            if (count == static_cast<int>(candidates.size())) flush();
            candidates[static_cast<std::size_t>(count++)] = {from, to};
        });
        flush();
        if (!in_order_) put_in_order(out.data() + first, out.data() + used);
        for (std::size_t k = first; k < used; ++k) out[k] *= stride_;
        range_of_[c] = {static_cast<std::uint32_t>(first),
                        static_cast<std::uint32_t>(used - first)};
    }
    // Sweeps look one entry ahead.
    if (out.size() < used + 1) out.resize(used + 1);
    out[used] = 0;
    slice_of_[slice] = out.data();
    return pairs;
}

template <int Dim>
void ClusterList<Dim>::build(const Eigen::Ref<const Points<Dim>>& position) {
    sort(position);
    const std::size_t found = parallel_count(
        slices_.size(), [&](std::size_t slice) { return search_slice(slice); },
        ClusterView::slice_size * static_cast<std::size_t>(width_));
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
    return parallel_count(size_, [&](std::size_t i) { return now.too_far(i, x); }) == 0;
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
