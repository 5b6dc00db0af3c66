// SPDX-License-Identifier: GPL-3.0-or-later
// Points for tests of lists.
#pragma once

#include <spam/neighbors/cluster_list.hpp>

#include <random>
#include <vector>

namespace spam::test {

/// Dim x n, even in [0, size).
template <int Dim>
Points<Dim> random_points(Eigen::Index n, double size, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(0.0, size);
    Points<Dim> points(Dim, n);
    for (auto& x : points.reshaped()) x = u(random);
    return points;
}

/// The points in the order in which a list would put them.
template <int Dim>
Points<Dim> renumbered(const Points<Dim>& x, const Box<Dim>& box) {
    ClusterList<Dim> list(1.0, 0.1, box, 8);
    list.build(x);
    return x(Eigen::all, std::vector<int>(list.order().begin(), list.order().begin() + x.cols()));
}

}  // namespace spam::test
