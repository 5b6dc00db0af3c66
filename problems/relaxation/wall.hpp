// SPDX-License-Identifier: GPL-3.0-or-later
// What keeps particles that repel each other inside a region.
#pragma once

#include "region.hpp"
#include <spam/external/external.hpp>
#include <spam/kernel/lucy.hpp>

#include <cstdint>
#include <vector>

namespace relaxation {

/// The outside of a region, filled evenly with matter at rest, one unit of mass per area, that repels
/// particles as they repel each other. Where the inside is as dense the border is then no surface: no
/// layers, no thinning. With Lucy's w,
///     Phi(r) = integral over the outside of w(r - s) dA,   -grad Phi = -closed integral of w n ds,
/// n pointing outwards. The integral over the border needs only what is nearer than the range.
/// Deep in that matter nothing pushes any more, and particles that begin on top of each other are fast
/// enough to get there; so in the outside a spring pulls back to the border, where nothing is at rest:
///     + 1/closed integral of |r - s|^-3 ds,
/// which is d^2/2 at distance d of a straight border. Half the square of the distance from the nearest side will
/// not do: between two sides its force jumps, an error of the energy of first order in the step.
class OuterMatter final : public External<2> {
  public:
    OuterMatter(const Region& region, double range);

    void add(const Now& now, Eigen::Index first, Eigen::Index last) const override {
        const auto x = now.state.position();
        auto v_dot = now.rate.velocity();  // of particles of mass 1
        for (Eigen::Index i = first; i < last; ++i) v_dot.col(i) += force(x.col(i));
    }
    bool potential() const override { return true; }
    double energy_at(const Particles<2>&, std::size_t, const Point<2>& x) const override {
        return energy(x);
    }
    void add_density(const ConstState<2>& state, std::vector<double>& rho) const override;
    std::string describe() const override { return "inside a wall of the same density"; }

    /// -grad Phi
    Point<2> force(const Point<2>& r) const;
    double energy(const Point<2>& r) const;
    /// The part of a particle's weight that is outside, 0 to 1: Phi without the spring.
    double weight_outside(const Point<2>& r) const;
    /// The least weight_outside() along the border: 1/2 of one that is straight as far as the range, less
    /// at corners inwards and where what is outside is thin. There little keeps particles in.
    double least_weight_on_border() const;

  private:
    struct Spring {
        double energy = 0.0;
        Point<2> force = Point<2>::Zero();
    };
    Spring spring(const Point<2>& r) const;
    /// A short straight piece of the border.
    struct Piece {
        Point<2> from, to, normal;  ///< normal times length
    };
    template <class Visit>
    void for_each_near(const Point<2>& r, const Visit& visit) const;
    std::size_t cell(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }

    Region region_;
    Lucy<2> weight_;
    std::vector<Piece> pieces_;         ///< cell by cell
    std::vector<std::uint32_t> start_;  ///< of each cell's pieces
    Point<2> corner_;                   ///< of the grid of cells, as wide as the range
    int columns_, rows_;
};

}  // namespace relaxation
