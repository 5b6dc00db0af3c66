// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/neighbors/strip_order.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace spam {

template <int Dim>
std::vector<std::uint32_t> strip_order(const Points<Dim>& position, double width) {
    const auto n = static_cast<std::size_t>(position.cols());
    using Key = std::array<double, Dim>;  // strip numbers, then the last coordinate
    std::vector<Key> key(n);
    for (std::size_t i = 0; i < n; ++i)
        for (int a = 0; a < Dim; ++a) {
            const double x = position(a, static_cast<Eigen::Index>(i));
            key[i][static_cast<std::size_t>(a)] = a + 1 < Dim ? std::floor(x / width) : x;
        }
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return key[a] < key[b]; });
    return order;
}

template std::vector<std::uint32_t> strip_order(const Points<1>&, double);
template std::vector<std::uint32_t> strip_order(const Points<2>&, double);
template std::vector<std::uint32_t> strip_order(const Points<3>&, double);

}  // namespace spam
