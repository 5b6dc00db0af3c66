// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parts.hpp>
#include <spam/neighbors/cluster_cells.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// f(cell) for the cells of a region, in the order of their numbers.
template <int Dim, int Axis = 0, class Region, class F>
void for_each_cell(const std::array<std::size_t, Dim>& count, const Region& region,
                   std::size_t place, const F& f) {
    for (std::size_t k = region.from[Axis]; k < region.to[Axis]; ++k)
        if constexpr (Axis + 1 < Dim)
            for_each_cell<Dim, Axis + 1>(count, region, (place + k) * count[Axis + 1], f);
        else
            f(place + k);
}

}  // namespace

template <int Dim>
std::array<std::size_t, 2> ClusterCells<Dim>::Region::longest() const {
    std::array<std::size_t, 2> found{0, to[0] - from[0]};
    for (std::size_t a = 1; a < Dim; ++a)
        if (to[a] - from[a] > found[1]) found = {a, to[a] - from[a]};
    return found;
}

template <int Dim>
bool ClusterCells<Dim>::Corners::hold(const Bounds<Dim>& bounds, double reach) const {
    bool all = true;
    for (std::size_t a = 0; a < Dim; ++a)
        all = all && bounds.centre[a] - bounds.half[a] - reach >= low[a] &&
              bounds.centre[a] + bounds.half[a] + reach <= high[a];
    return all;
}

template <int Dim>
typename ClusterCells<Dim>::Region ClusterCells<Dim>::everywhere() const {
    return {{}, count_};
}

template <int Dim>
typename ClusterCells<Dim>::Corners ClusterCells<Dim>::corners(const Region& region) const {
    Corners all;
    all.low.fill(infinite), all.high.fill(-infinite);
    for_each_cell<Dim>(count_, region, 0, [&](std::size_t c) {
        for (std::size_t a = 0; a < Dim; ++a) {
            all.low[a] = std::min(all.low[a], corners_[c].low[a]);
            all.high[a] = std::max(all.high[a], corners_[c].high[a]);
        }
    });
    return all;
}

template <int Dim>
std::span<const std::uint32_t> ClusterCells<Dim>::clusters(const Region& region) const {
    std::size_t c = 0;
    for (std::size_t a = 0; a < Dim; ++a) c = c * count_[a] + region.from[a];
    return {clusters_.data() + first_[c], clusters_.data() + first_[c + 1]};
}

template <int Dim>
std::size_t ClusterCells<Dim>::cell(std::size_t a, double at) const {
    const double last = static_cast<double>(count_[a]) - 1.0;
    return static_cast<std::size_t>(std::clamp((at - origin_[a]) * per_edge_[a], 0.0, last));
}

/// Cells of about eight clusters. In smaller ones less is found that is not near, but going down to them
/// takes longer.
template <int Dim>
void ClusterCells<Dim>::divide(const Input& in) {
    std::array<double, Dim> extent;
    for (std::size_t a = 0; a < Dim; ++a) {
        double low = infinite, high = -infinite;
        for (std::size_t c = 0; c < in.boxes.size(); ++c)
            low = std::min(low, in.boxes[c].centre[a]),
            high = std::max(high, in.boxes[c].centre[a]);
        origin_[a] = low;
        extent[a] = high > low ? high - low : 0.0;
    }
    double side = std::pow(8.0 * static_cast<double>(in.width) * in.volume, 1.0 / Dim);
    const double most =
        64.0 + static_cast<double>(in.boxes.size());  // far apart: fewer, larger ones
    for (double total = infinite; total > most; side *= 1.2) {
        total = 1.0;
        for (std::size_t a = 0; a < Dim; ++a) {
            const double cells = std::clamp(std::round(extent[a] / side), 1.0, 1e9);
            count_[a] = static_cast<std::size_t>(cells);
            per_edge_[a] = extent[a] > 0.0 ? cells / extent[a] : 0.0;
            total *= cells;
        }
    }
}

/// Each cluster to the cell where its middle is.
template <int Dim>
void ClusterCells<Dim>::assign(const Input& in) {
    std::size_t cells = 1;
    for (const std::size_t n : count_) cells *= n;
    Corners nobody;
    nobody.low.fill(infinite), nobody.high.fill(-infinite);
    corners_.assign(cells, nobody);
    cell_of_.resize(in.boxes.size());
    first_.assign(cells + 2, 0);
    large_.clear();
    constexpr std::uint32_t none = 0xffffffff;
    for (std::size_t c = 0; c < in.boxes.size(); ++c) {
        const Bounds<Dim>& of = in.boxes[c];
        cell_of_[c] = none;
        if (!(ClusterBoxes<Dim>::volume(of, in.reach) <= in.most_volume)) {
            large_.push_back(static_cast<std::uint32_t>(c));
            continue;
        }
        std::size_t at = 0;
        for (std::size_t a = 0; a < Dim; ++a) at = at * count_[a] + cell(a, of.centre[a]);
        cell_of_[c] = static_cast<std::uint32_t>(at);
        ++first_[at + 2];
        Corners& around = corners_[at];
        for (std::size_t a = 0; a < Dim; ++a) {
            const double most = of.half[a] + in.reach;
            around.low[a] = std::min(around.low[a], of.centre[a] - most);
            around.high[a] = std::max(around.high[a], of.centre[a] + most);
        }
    }
    for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
    clusters_.resize(in.boxes.size() - large_.size());
    for (std::size_t c = 0; c < cell_of_.size(); ++c)
        if (cell_of_[c] != none)
            clusters_[first_[cell_of_[c] + 1]++] = static_cast<std::uint32_t>(c);
}

/// All slots by number.
template <int Dim>
void ClusterCells<Dim>::load(const Input& in) {
    const std::size_t owned = in.slot_of.size();
    const Ghosts<Dim>& ghosts = in.ghosts;
    count = owned + ghosts.size();
    double largest = in.reach;
    for (std::size_t a = 0; a < Dim; ++a) {
        double low = infinite, high = -infinite;
        const auto look = [&](std::size_t from, std::size_t to) {
            for (std::size_t k = from; k < to; ++k)
                low = std::min(low, in.x[a][k]), high = std::max(high, in.x[a][k]);
        };
        look(0, owned);
        look(ghosts.slot(0), ghosts.slot(ghosts.size()));
        middle[a] = owned > 0 ? 0.5 * low + 0.5 * high : 0.0;
        largest = std::max(largest, high - middle[a]);
        x[a].resize(count + lanes);
    }
    scale = 1.0 / largest;
    slots.resize(count + lanes);

    std::size_t place = 0, ghost = 0;
    std::array<float*, Dim> to;
    for (std::size_t a = 0; a < Dim; ++a) to[a] = x[a].data();
    const auto enter = [to, from = middle, by = scale, of = slots.data(), &place](
                           std::size_t slot, const auto& coordinate) {
        for (std::size_t a = 0; a < Dim; ++a)
            to[a][place] = static_cast<float>((coordinate(a) - from[a]) * by);
        of[place++] = static_cast<std::uint32_t>(slot);
    };
    for (auto& coordinate : x)
        std::fill_n(coordinate.begin() + static_cast<std::ptrdiff_t>(count), lanes, nowhere);
    const Parts& parts = Parts::here();
    constexpr std::uint32_t none = 0xffffffff;
    const auto number = [&] { return ghost < ghosts.size() ? ghosts.number(ghost) : none; };
    std::uint32_t next = number();
    const auto enter_ghost = [&] {
        const std::size_t slot = ghosts.slot(ghost++);
        enter(slot, [&](std::size_t a) { return in.x[a][slot]; });
        next = number();
    };
    for (std::uint32_t i = 0; i < owned; ++i) {
        const std::uint32_t own_number = parts.number(i);
        while (next < own_number ||
               (next == own_number && ghosts.which(ghost) < Ghosts<Dim>::itself))
            enter_ghost();
        const double* const own = in.position.data() + Dim * std::size_t{i};
        enter(in.slot_of[i], [&](std::size_t a) { return own[a]; });
        while (next == own_number) enter_ghost();
    }
    while (next != none) enter_ghost();
}

template <int Dim>
void ClusterCells<Dim>::bound_chunks() {
    chunks.resize((count + chunk - 1) / chunk);
    for (std::size_t c = 0; c < chunks.size(); ++c)
        for (std::size_t a = 0; a < Dim; ++a) {
            const float* const from = x[a].data();
            float low = nowhere, high = -nowhere;
            for (std::size_t k = c * chunk; k < std::min(count, (c + 1) * chunk); ++k)
                low = std::min(low, from[k]), high = std::max(high, from[k]);
            chunks[c][2 * a] = low, chunks[c][2 * a + 1] = high;
        }
}

template <int Dim>
void ClusterCells<Dim>::build(const Input& in) {
    divide(in);
    assign(in);
    load(in);
    bound_chunks();
}

SPAM_COMPILED(template class ClusterCells);

}  // namespace spam
