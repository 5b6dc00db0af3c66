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
bool ClusterBoxes<Dim>::alike() const {
    std::array<double, Dim> limit{};
    for (std::size_t a = 0; a < Dim; ++a) {
        for (const auto& b : bounds_) limit[a] += b.half[a];
        limit[a] *= 4.0 / static_cast<double>(bounds_.size());
    }
    std::size_t large = 0;
    for (const auto& b : bounds_) {
        bool is_large = false;
        for (std::size_t a = 0; a < Dim; ++a) is_large = is_large || b.half[a] > limit[a];
        large += is_large ? 1 : 0;
    }
    return large <= 16 || large * large <= bounds_.size();
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

SPAM_COMPILED(template class ClusterBoxes);

}  // namespace spam
