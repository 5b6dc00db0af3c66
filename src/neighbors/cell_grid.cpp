// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/neighbors/cell_grid.hpp>

#include <algorithm>
#include <cmath>

namespace spam {

template <int Dim>
void CellGrid<Dim>::build(const Points<Dim>& position, double edge, const Box<Dim>& box) {
    const auto n = static_cast<std::size_t>(position.cols());
    std::array<double, Dim> origin{}, extent{}, per_edge{};
    for (int a = 0; a < Dim; ++a) {
        const auto k = static_cast<std::size_t>(a);
        periodic_[k] = box.periodic(a);
        origin[k] = box.periodic(a) ? 0.0 : (n > 0 ? position.row(a).minCoeff() : 0.0);
        extent[k] = box.periodic(a) ? box.length(a)
                                    : (n > 0 ? position.row(a).maxCoeff() - origin[k] : 0.0);
    }
    // Coarsen until the grid has no more than about four cells a particle.
    const double most = 64.0 + 4.0 * static_cast<double>(n);
    for (double total = most + 1.0; total > most; edge *= 1.5) {
        total = 1.0;
        for (std::size_t k = 0; k < Dim; ++k) {
            const double fit = std::max(1.0, std::floor(extent[k] / edge));
            total *= fit;
            cells_[k] = static_cast<std::int32_t>(std::min(fit, most));
            per_edge[k] = extent[k] > 0.0 ? fit / extent[k] : 0.0;
        }
    }
    std::size_t total = 1;
    for (const auto c : cells_) total *= static_cast<std::size_t>(c);

    cell_of_.resize(n);
    order_.resize(n);
    start_.assign(total + 1, 0);
    for (std::size_t i = 0; i < n; ++i) {
        std::int32_t cell = 0;
        for (int a = Dim - 1; a >= 0; --a) {
            const auto k = static_cast<std::size_t>(a);
            const double x = (position(a, static_cast<Eigen::Index>(i)) - origin[k]) * per_edge[k];
            const auto c = std::clamp(static_cast<std::int32_t>(x), 0, cells_[k] - 1);
            cell = cell * cells_[k] + c;
        }
        cell_of_[i] = cell;
        ++start_[static_cast<std::size_t>(cell) + 1];
    }
    for (std::size_t c = 0; c < total; ++c) start_[c + 1] += start_[c];
    cursor_.assign(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < n; ++i)
        order_[cursor_[static_cast<std::size_t>(cell_of_[i])]++] = static_cast<std::uint32_t>(i);
}

template class CellGrid<1>;
template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace spam
