// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_search.hpp"
#include <spam/core/error.hpp>
#include <spam/core/instruction_set.hpp>
#include <spam/core/look_ahead.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/parts.hpp>
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
    if (std::isinf(range) && box.periodic())
        throw InputError(
            "box: forces of infinite range have no sum over the images of a periodic box; leave out the periods, "
            "or use a potential of finite range");
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
                "{}: the wall is {:g} from the {} one, not more than the range {:g}, and images of images "
                "would have no end; move the walls apart, or shorten --range",
                name_of_side(a, true), upper.at - lower.at, name_of_side(a, false), range));
    }
}

template <int Dim>
ClusterView ClusterList<Dim>::view() const {
    return {size_, entries_.size(), order_.data(), entries_.data()};
}

template <int Dim>
std::span<const std::uint32_t> ClusterList<Dim>::entries(std::size_t cluster) const {
    return {entries_[cluster].first, entries_[cluster].count};
}

/// Where a part of a run begins its period along direction a, in periods: half of one below the middle of its
/// particles. One of them that has left the box by a border is then still beside the others, and the bounds of a part
/// are no wider than the part. The middle is near enough after two turns, and no bit of a sum depends on it.
template <int Dim>
double begin_of_period(const Points<Dim>& x, const Box<Dim>& box, int a) {
    double middle = x(a, 0);
    for (int turn = 0; turn < 2; ++turn) {
        double total = 0.0;
        for (Eigen::Index i = 0; i < x.cols(); ++i) total += box.nearest_image(a, x(a, i) - middle);
        middle += total / static_cast<double>(x.cols());
    }
    return middle / box.length(a) - 0.5;
}

/// All particles into the box.
template <int Dim>
void ClusterList<Dim>::take_home() {
    if (!box_.periodic()) return;
    at_home_.resize(Dim, motion_.then().cols());
    periods_.assign(Dim * size_, 0);
    home_.periods = periods_.data();
    std::array<double, Dim> length{}, inverse{}, begin{};
    const bool whole = Parts::here().alone() || size_ == 0;
    for (int a = 0; a < Dim; ++a) {
        home_.length[a] = length[static_cast<std::size_t>(a)] = box_.length(a);
        home_.last_place[a] = box_.last_place(a);
        home_.places[a] = box_.periodic(a) ? 1.0 / box_.last_place(a) : 0.0;
        inverse[static_cast<std::size_t>(a)] = box_.periodic(a) ? 1.0 / box_.length(a) : 0.0;
        if (box_.periodic(a) && !whole)
            begin[static_cast<std::size_t>(a)] = begin_of_period(motion_.then(), box_, a);
    }
    // A search need not have the last digits right.
    parallel_for(size_, [length, inverse, begin, from = motion_.then().data(), to = at_home_.data(),
                         periods = periods_.data()](std::size_t i) {
        for (std::size_t a = 0; a < Dim; ++a) {
            const double q = from[Dim * i + a] * inverse[a] - begin[a];
            auto k = static_cast<std::int32_t>(std::clamp(q, -2e9, 2e9));  // else no number
            k -= q < k ? 1 : 0;
            periods[Dim * i + a] = k;
            to[Dim * i + a] = from[Dim * i + a] - k * length[a];
        }
    });
}

/// Coordinates and bounds for this order of particles; the last slot is repeated until the last
/// cluster is full.
template <int Dim>
void ClusterList<Dim>::gather() {
    const auto width = static_cast<std::size_t>(width_);
    order_.resize((size_ + width - 1) / width * width, size_ > 0 ? order_.back() : 0);
    for (auto& x : x_) x.resize(order_.size() + 8);  // searches read a register at a time
    parallel_for(order_.size(), [&](std::size_t k) {
        for (std::size_t a = 0; a < Dim; ++a) x_[a][k] = place().data()[Dim * order_[k] + a];
    });
    boxes_.build(x_, width, order_.size() / width);
}

template <int Dim>
void ClusterList<Dim>::gather_strips() {
    take_home();
    strips_.build(place(), Parts::here().alone() ? box_ : Box<Dim>(), 3);
    order_.assign(strips_.order().begin(), strips_.order().end());
    slot_of_.resize(size_);
    for (std::size_t slot = 0; slot < size_; ++slot)
        slot_of_[order_[slot]] = static_cast<std::uint32_t>(slot);
    gather();
    strip_volume_ = boxes_.mean_volume(reach());
}

/// Slots are particle numbers. Members of a cluster stay together across a border of the box: all take the
/// image nearest to the first one's.
template <int Dim>
void ClusterList<Dim>::gather_in_order() {
    order_.resize(size_);
    std::iota(order_.begin(), order_.end(), 0U);
    slot_of_ = order_;
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
        in_order_ = boxes_.mean_volume(reach()) < 1.1 * strip_volume_ && boxes_.alike();
    }
    if (!in_order_) gather_strips();
}

/// Returns the number of pairs found around the clusters that are counted.
template <int Dim>
std::size_t ClusterList<Dim>::search() {
    // Bounds of members far from each other hold many particles that are near none of them.
    cells_.build({boxes_, ghosts_, place(), order_, slot_of_, x_, static_cast<std::size_t>(width_),
                  strips_.volume(), reach(), 2.0 * boxes_.typical_volume(reach())});
    unsigned bits = 0;  // some parts for each thread
    std::size_t threads = 1;
    if (set_threads(0) > 1 && size_ >= parallel_threshold) {
        threads = static_cast<std::size_t>(set_threads(0));
        while (bits < 10 && std::size_t{1} << bits < 4 * threads) ++bits;
    }
    parts_.resize(std::size_t{1} << bits);
    levels_.resize(threads);
    instruction_set();  // refuses a wrong SPAM_ISA before threads search
    return parallel_count(
        threads,
        [&](std::size_t thread) {
            std::size_t pairs = 0;
            for (std::size_t part = thread * parts_.size() / threads;
                 part < (thread + 1) * parts_.size() / threads; ++part) {
                CellSearch search(*this, parts_[part], levels_[thread]);
                pairs += search.run(part, bits);
                search.finish();
            }
            return pairs;
        },
        bits > 0 ? parallel_threshold : 0);
}

/// Behind particles whose slots are known. Entries are slots times the stride, in 32 bits.
template <int Dim>
void ClusterList<Dim>::build_images() {
    ghosts_.build(box_, reach(), place(), slot_of_, order_.size(), x_);
    const std::uint64_t numbers = std::uint64_t{slots()} * stride_, most = std::uint64_t{1} << 32U;
    if (numbers > most)
        throw InputError(fmt::format(
            "neighbours: {} particles with images, of {} numbers each, are more than the {} that a list can point "
            "to; take fewer particles, or more processes (--ranks)",
            slots(), stride_, most));
}

/// Of an infinite range.
template <int Dim>
void ClusterList<Dim>::list_all() {
    gather_in_order();
    build_images();
    cells_.load({boxes_, ghosts_, place(), order_, slot_of_, x_, static_cast<std::size_t>(width_),
                 0.0, reach(), 0.0});
    parts_.assign(1, {{}});
    std::vector<std::uint32_t>& all = parts_.front().front();
    all.resize(cells_.count + entries_ahead);
    for (std::size_t k = 0; k < cells_.count; ++k) all[k] = cells_.slots[k] * stride_;
    entries_.assign(boxes_.size(), {all.data(), static_cast<std::uint32_t>(cells_.count)});
    pairs_ = size_ > 0 ? size_ * (cells_.count - 1) / 2 : 0;
    ++builds_;
}

template <int Dim>
void ClusterList<Dim>::build(const Eigen::Ref<const Points<Dim>>& position) {
    size_ = static_cast<std::size_t>(position.cols());
    motion_.begin(position);
    if (std::isinf(range_)) return list_all();
    sort();
    build_images();
    entries_.resize(boxes_.size());
    const std::size_t found = search();
    // Each pair was found from both ends, each particle found itself.
    std::size_t counted = 0;
    const auto width = static_cast<std::size_t>(width_);
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

SPAM_COMPILED(template class ClusterList);

}  // namespace spam
