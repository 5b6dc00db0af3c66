// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parallel.hpp>
#include <spam/neighbors/strip_sort.hpp>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

/// More bins than this would cost more than the particles in them.
double most_bins(std::size_t particles) { return 64.0 + 4.0 * static_cast<double>(particles); }

}  // namespace

template <int Dim>
typename StripSort<Dim>::Int StripSort<Dim>::bin(std::size_t a, double x) const {
    // In doubles first: a corner may lie far outside what an integer holds.
    return static_cast<Int>(std::clamp((x - origin_[a]) * per_edge_[a], 0.0, count_[a] - 1.0));
}

/// Cuts direction a into bins of about `edge`.
template <int Dim>
void StripSort<Dim>::divide(std::size_t a, double edge) {
    // One bin where volumes of cells are beyond all numbers (1e154 apart in the plane).
    const double bins = std::floor(extent_[a] / edge),
                 fit = bins >= 1.0 ? std::min(bins, 1e9) : 1.0;
    count_[a] = static_cast<Int>(fit);
    per_edge_[a] = extent_[a] > 0.0 ? fit / extent_[a] : 0.0;
}

/// From the number of cells that are not empty, cells of about two particles across: true for a
/// filled block, a body of any outline, several bodies far apart.
template <int Dim>
double StripSort<Dim>::volume_per_particle(const Points<Dim>& position) {
    const auto n = static_cast<double>(position.cols());
    double edge = 2.0 * *std::max_element(extent_.begin(), extent_.end()) / std::pow(n, 1.0 / Dim);
    double volume = 1.0;
    for (int attempt = 0; attempt < 4; ++attempt) {
        double total;
        for (;; edge *= 1.3) {
            total = 1.0;
            for (std::size_t a = 0; a < Dim; ++a) divide(a, edge), total *= count_[a];
            if (total <= most_bins(order_.size())) break;
        }
        start_.assign(static_cast<std::size_t>(total), 0);
        double cell_volume = 1.0, occupied = 0.0;
        for (std::size_t a = 0; a < Dim; ++a)
            cell_volume *= per_edge_[a] > 0.0 ? 1.0 / per_edge_[a] : edge;
        for (Eigen::Index i = 0; i < position.cols(); ++i) {
            Int cell = 0;
            for (std::size_t a = 0; a < Dim; ++a)
                cell = cell * count_[a] + bin(a, position(static_cast<Eigen::Index>(a), i));
            auto& seen = start_[static_cast<std::size_t>(cell)];
            occupied += 1.0 - seen;
            seen = 1;
        }
        volume = occupied * cell_volume / n;
        const double better = 2.0 * std::pow(volume, 1.0 / Dim);
        const bool good = better > 0.7 * edge;
        edge = better;
        if (good) break;
    }
    return volume;
}

template <int Dim>
void StripSort<Dim>::choose_bins(const Points<Dim>& position, const Box<Dim>& box) {
    double longest = 0.0;
    for (std::size_t a = 0; a < Dim; ++a) {
        const auto row = position.row(static_cast<Eigen::Index>(a));
        const bool periodic = box.periodic(static_cast<int>(a));
        origin_[a] = periodic ? 0.0 : row.minCoeff();
        extent_[a] = periodic ? box.length(static_cast<int>(a)) : row.maxCoeff() - origin_[a];
        longest = std::max(longest, extent_[a]);
    }
    // A few builds old will do: it decides about the shape of strips only.
    if (sorted_++ % 8 == 0 || volume_of_ != position.cols()) {
        volume_ = longest > 0.0 ? volume_per_particle(position) : 1.0;
        volume_of_ = position.cols();
    }
    const double volume = volume_;
    double width = std::pow(6.0 * volume, 1.0 / Dim);
    double height = volume / std::pow(width, Dim - 1);  // about one particle a bin
    for (;; width *= 1.2, height *= 1.2) {
        double total = 1.0;
        for (std::size_t a = 0; a < Dim; ++a) {
            divide(a, a + 1 < Dim ? width : height);
            total *= count_[a];
        }
        if (total <= most_bins(order_.size())) return;
    }
}

/// Bins follow each other as an ox ploughs: every other strip is gone through backwards, so that bins next
/// to each other in the sequence touch, and so do the particles at its turns.
template <int Dim>
struct StripSort<Dim>::Sequence {
    explicit Sequence(const StripSort& strips)
        : origin(strips.origin_),
          per_edge(strips.per_edge_),
          count(strips.count_) {
        for (std::size_t a = 0; a < Dim; ++a) last[a] = count[a] - 1.0;
    }
    std::uint32_t place(const double* x) const {
        Int place = 0;
        for (std::size_t a = 0; a < Dim; ++a) {
            const double at = (x[a] - origin[a]) * per_edge[a];
            const Int k = static_cast<Int>(std::min(std::max(at, 0.0), last[a]));
            const bool backwards = (place & 1) != 0;
            place = place * count[a] + (backwards ? count[a] - 1 - k : k);
        }
        return static_cast<std::uint32_t>(place);
    }
    std::array<double, Dim> origin, per_edge, last;
    std::array<Int, Dim> count;
};

template <int Dim>
void StripSort<Dim>::build(const Points<Dim>& position, const Box<Dim>& box,
                           std::uint32_t unsorted) {
    const auto n = static_cast<std::size_t>(position.cols());
    order_.resize(n);
    bin_of_.resize(n);
    if (n == 0) {  // one empty bin: there are no coordinates to look at, no space to share
        origin_.fill(0.0), per_edge_.fill(0.0), count_.fill(1);
        start_.assign(3, 0);
        return;
    }
    choose_bins(position, box);
    std::size_t bins = 1;
    for (const Int c : count_) bins *= static_cast<std::size_t>(c);

    parallel_for(n, [sequence = Sequence(*this), x = position.data(),
                     to = bin_of_.data()](std::size_t i) { to[i] = sequence.place(x + Dim * i); });
    // A counting sort: start_[b] is where bin b - 1 begins, then, filled, where b begins.
    start_.assign(bins + 2, 0);
    for (std::size_t i = 0; i < n; ++i) ++start_[bin_of_[i] + 2];
    for (std::size_t b = 2; b < bins + 2; ++b) start_[b] += start_[b - 1];
    for (std::size_t i = 0; i < n; ++i)
        order_[start_[bin_of_[i] + 1]++] = static_cast<std::uint32_t>(i);

    const auto rows = static_cast<std::size_t>(count_[Dim - 1]);
    parallel_for(
        bins / rows,
        [&](std::size_t strip) {
            const double sign = strip % 2 != 0 ? -1.0 : 1.0;
            for (std::size_t b = strip * rows; b < (strip + 1) * rows; ++b)
                if (start_[b + 1] - start_[b] > unsorted) sort_bin(b, position, sign);
        },
        rows);
}

/// The particles of bin b by their last coordinate, upwards where sign = 1, downwards where it is -1; those
/// at the same one by number.
template <int Dim>
void StripSort<Dim>::sort_bin(std::size_t b, const Points<Dim>& position, double sign) {
    const auto last = position.row(Dim - 1);
    const std::uint32_t begin = start_[b], end = start_[b + 1];
    // Bins hold about one particle. Where some have been flung far apart the others may all be in one.
    constexpr std::uint32_t most_for_insertion = 64;
    if (end - begin > most_for_insertion) {
        std::sort(order_.begin() + begin, order_.begin() + end,
                  [&](std::uint32_t i, std::uint32_t j) {
                      return sign * last[i] < sign * last[j] || (last[i] == last[j] && i < j);
                  });
        return;
    }
    for (std::uint32_t k = begin + 1; k < end; ++k) {
        const std::uint32_t moving = order_[k];
        std::uint32_t to = k;
        for (; to > begin && sign * last[order_[to - 1]] > sign * last[moving]; --to)
            order_[to] = order_[to - 1];
        order_[to] = moving;
    }
}

SPAM_COMPILED(template class StripSort);

}  // namespace spam
