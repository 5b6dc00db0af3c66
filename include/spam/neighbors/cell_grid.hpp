// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/box.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace spam {

/// Particles sorted into cells at least `edge` wide, so that all within `edge` of a particle lie in
/// its own and the adjacent cells. Particles of a cell keep ascending index.
/// A body flung far apart would need more cells than particles: the cells grow instead, which costs
/// time, never memory.
template <int Dim>
class CellGrid {
  public:
    /// Positions Dim x N, wrapped into the box where it is periodic, all finite.
    void build(const Points<Dim>& position, double edge, const Box<Dim>& box);

    /// Appends the indices of particles in the cells around particle i, i itself included.
    template <class Visit>
    void for_each_near(std::size_t i, const Visit& visit) const {
        std::array<std::int32_t, Dim> centre{};
        std::int32_t cell = cell_of_[i];
        for (int a = 0; a < Dim; ++a) {
            centre[static_cast<std::size_t>(a)] = cell % cells(a);
            cell /= cells(a);
        }
        visit_axis(Dim - 1, 0, centre, visit);
    }

    std::int32_t cells(int a) const { return cells_[static_cast<std::size_t>(a)]; }

  private:
    template <class Visit>
    void visit_axis(int a, std::int32_t base, const std::array<std::int32_t, Dim>& centre,
                    const Visit& visit) const {
        const std::int32_t n = cells(a);
        const std::int32_t c = centre[static_cast<std::size_t>(a)];
        const bool wraps = periodic_[static_cast<std::size_t>(a)];
        // With fewer than three cells around a periodic direction, c - 1 and c + 1 would coincide.
        const std::int32_t lo = wraps ? (n >= 3 ? c - 1 : 0) : (c > 0 ? c - 1 : 0);
        const std::int32_t hi = wraps ? (n >= 3 ? c + 1 : n - 1) : (c < n - 1 ? c + 1 : n - 1);
        for (std::int32_t k = lo; k <= hi; ++k) {
            const std::int32_t next = base * n + (k + n) % n;
            if (a > 0) {
                visit_axis(a - 1, next, centre, visit);
                continue;
            }
            const auto cell = static_cast<std::size_t>(next);
            for (std::uint32_t p = start_[cell]; p < start_[cell + 1]; ++p) visit(order_[p]);
        }
    }

    std::array<std::int32_t, Dim> cells_{};
    std::array<bool, Dim> periodic_{};
    std::vector<std::int32_t> cell_of_;
    std::vector<std::uint32_t> start_, order_, cursor_;
};

extern template class CellGrid<1>;
extern template class CellGrid<2>;
extern template class CellGrid<3>;

}  // namespace spam
