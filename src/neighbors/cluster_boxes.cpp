// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parallel.hpp>
#include <spam/neighbors/cluster_boxes.hpp>

#include <algorithm>

namespace spam {

template <int Dim>
void ClusterBoxes<Dim>::build(const std::array<std::vector<double>, Dim>& x, std::size_t width,
                              std::size_t clusters) {
    bounds_.resize(clusters);
    parallel_for(
        bounds_.size(),
        [&](std::size_t c) {
            for (std::size_t a = 0; a < Dim; ++a) {
                const double* const p = x[a].data() + c * width;
                double low = 0.0, high = 0.0;  // from the first member
                for (std::size_t l = 1; l < width; ++l) {
                    low = std::min(low, p[l] - p[0]);
                    high = std::max(high, p[l] - p[0]);
                }
                bounds_[c].half[a] = 0.5 * (high - low);
                bounds_[c].centre[a] = p[0] + 0.5 * (high + low);
            }
        },
        width);
}

template <int Dim>
bool ClusterBoxes<Dim>::sort() {
    std::array<double, Dim> limit{};
    for (std::size_t a = 0; a < Dim; ++a) {
        for (const auto& b : bounds_) limit[a] += b.half[a];
        limit[a] *= 4.0 / static_cast<double>(bounds_.size());
    }
    sorted_.clear();
    large_.clear();
    largest_half_.fill(0.0);
    for (std::size_t c = 0; c < bounds_.size(); ++c) {
        bool large = false;
        for (std::size_t a = 0; a < Dim; ++a) large = large || bounds_[c].half[a] > limit[a];
        (large ? large_ : sorted_).push_back(static_cast<std::uint32_t>(c));
        if (large) continue;
        for (std::size_t a = 0; a < Dim; ++a)
            largest_half_[a] = std::max(largest_half_[a], bounds_[c].half[a]);
    }
    if (large_.size() > 16 && large_.size() * large_.size() > bounds_.size()) return false;
    Points<Dim> centres(Dim, static_cast<Eigen::Index>(sorted_.size()));
    for (std::size_t k = 0; k < sorted_.size(); ++k)
        for (int a = 0; a < Dim; ++a)
            centres(a, static_cast<Eigen::Index>(k)) =
                bounds_[sorted_[k]].centre[static_cast<std::size_t>(a)];
    centres_.build(centres, {});
    return true;
}

template <int Dim>
Bounds<Dim> ClusterBoxes<Dim>::around(std::size_t first, std::size_t last) const {
    Bounds<Dim> all = bounds_[first];
    for (std::size_t a = 0; a < Dim; ++a) {
        double low = -all.half[a], high = all.half[a];
        for (std::size_t c = first + 1; c < last; ++c) {
            const double s = bounds_[c].centre[a] - bounds_[first].centre[a];
            low = std::min(low, s - bounds_[c].half[a]);
            high = std::max(high, s + bounds_[c].half[a]);
        }
        all.half[a] = 0.5 * (high - low);
        all.centre[a] += 0.5 * (high + low);
    }
    return all;
}

template <int Dim>
void ClusterBoxes<Dim>::collect(const Bounds<Dim>& bounds, double reach,
                                std::vector<std::uint32_t>& found) const {
    Point<Dim> low, high;
    for (std::size_t a = 0; a < Dim; ++a) {
        // A little more, whatever rounding does to a bin.
        const double most = (reach + bounds.half[a] + largest_half_[a]) * (1.0 + 1e-12);
        low[static_cast<Eigen::Index>(a)] = bounds.centre[a] - most;
        high[static_cast<Eigen::Index>(a)] = bounds.centre[a] + most;
    }
    const auto order = centres_.order();
    centres_.for_each_range(low, high, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t k = first; k < last; ++k) found.push_back(sorted_[order[k]]);
    });
    found.insert(found.end(), large_.begin(), large_.end());
}

template <int Dim>
double ClusterBoxes<Dim>::mean_volume(double reach) const {
    double sum = 0.0;
    for (const auto& b : bounds_) sum += volume(b, reach);
    return sum / static_cast<double>(std::max<std::size_t>(1, bounds_.size()));
}

template <int Dim>
double ClusterBoxes<Dim>::typical_volume(double reach) const {
    double sum = 0.0;
    for (const auto& b : bounds_) sum += 1.0 / volume(b, reach);
    return static_cast<double>(bounds_.size()) / std::max(sum, 1e-300);
}

template class ClusterBoxes<1>;
template class ClusterBoxes<2>;
template class ClusterBoxes<3>;

}  // namespace spam
