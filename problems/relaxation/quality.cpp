// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality.hpp"

#include <spam/core/exact_sum.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <algorithm>
#include <cmath>

namespace relaxation {

std::vector<double> Ruler::density(const Points<2>& x) const {
    const Lucy<2> w(range);
    const PairList<2> pairs(x, range, {});
    std::vector<double> rho;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        rho.push_back(wall_.weight_outside(x.col(i)));
        for (const std::uint32_t j : pairs.neighbours(static_cast<std::size_t>(i)))
            rho.back() += w.value((x.col(i) - x.col(j)).norm());
    }
    return rho;
}

std::vector<int> Ruler::neighbours(const Points<2>& x) const {
    const PairList<2> pairs(x, next_shell, {});
    std::vector<int> count;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        count.push_back(static_cast<int>(pairs.neighbours(i).size()) - 1);  // itself
    return count;
}

std::vector<double> Ruler::distances_from_border(const Points<2>& x) const {
    std::vector<double> distance;
    for (const auto& r : x.colwise()) distance.push_back(region_.distance(r));
    return distance;
}

int Ruler::outside(const Points<2>& x) const {
    int count = 0;
    for (const auto& r : x.colwise()) count += region_.contains(r) ? 0 : 1;
    return count;
}

double scatter(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    if (n < 2.0) return std::nan("");
    const double mean = exact_sum(values.size(), [&](std::size_t i) { return values[i]; }) / n;
    const double squares = exact_sum(
        values.size(), [&](std::size_t i) { return (values[i] - mean) * (values[i] - mean); });
    return std::sqrt(squares / n) / mean;
}

/// Most particles have another one within next_shell; those that have none are looked at again, farther
/// off each time.
double mean_nearest(const Points<2>& x) {
    std::vector<double> nearest(static_cast<std::size_t>(x.cols()), HUGE_VAL);
    std::size_t missing = nearest.size();
    for (double reach = Ruler::next_shell; missing > 0 && std::isfinite(reach); reach *= 2.0) {
        const PairList<2> pairs(x, reach, {});
        for (std::size_t i = 0; i < nearest.size(); ++i) {
            if (std::isfinite(nearest[i])) continue;
            const auto r = x.col(static_cast<Eigen::Index>(i));
            for (const std::uint32_t j : pairs.neighbours(i))
                if (j != i) nearest[i] = std::min(nearest[i], (x.col(j) - r).norm());
            if (std::isfinite(nearest[i])) --missing;
        }
    }
    return exact_sum(nearest.size(), [&](std::size_t i) { return nearest[i]; }) /
           static_cast<double>(nearest.size());
}

Quality measure(const Ruler& ruler, const Points<2>& x) {
    const auto rho = ruler.density(x), distance = ruler.distances_from_border(x);
    const auto neighbours = ruler.neighbours(x);
    std::vector<double> interior;
    double off_border = 0.0, six = 0.0;
    for (std::size_t i = 0; i < rho.size(); ++i) {
        if (distance[i] > Ruler::range) interior.push_back(rho[i]);
        if (distance[i] > Ruler::next_shell) {
            ++off_border;
            six += neighbours[i] == 6 ? 1.0 : 0.0;
        }
    }
    return {scatter(rho), scatter(interior), mean_nearest(x),
            off_border > 0.0 ? six / off_border : std::nan(""), ruler.outside(x)};
}

}  // namespace relaxation
