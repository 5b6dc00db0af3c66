// SPDX-License-Identifier: GPL-3.0-or-later
// Particles that repel each other, inside a region.
#pragma once

#include "region.hpp"
#include <spam/kernel/lucy.hpp>
#include <spam/rhs/pair_potential_model.hpp>

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
///     + d^2/2,   d the distance from the border.
class Wall {
  public:
    Wall(const Region& region, double range);

    /// -grad Phi
    Point<2> force(const Point<2>& r) const;
    double energy(const Point<2>& r) const;
    /// The part of a particle's weight that is outside, 0 to 1: Phi without the spring.
    double weight_outside(const Point<2>& r) const;
    /// The least weight_outside() along the border: 1/2 of one that is straight as far as the range, less
    /// at corners inwards and where what is outside is thin. There little keeps particles in.
    double least_weight_on_border() const;

  private:
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

/// Molecular dynamics with Lucy's weight function as pair potential (rhs/pair_potential_model.hpp),
/// inside a wall: particles have mass 1.
class WalledModel final : public Model<2> {
  public:
    WalledModel(Particles<2> particles, const Region& region, double range);

    void rates(double t, std::span<const double> y, std::span<double> y_dot) override;
    double internal_energy(std::span<const double> y) const override;
    /// What the wall stands for included.
    std::vector<double> density(std::span<const double> y) const override;
    std::optional<Event> event() const override { return inside_.event(); }
    Promises promises() const override;
    double neighbour_forces(std::span<const double> y) const override {
        return inside_.neighbour_forces(y);
    }
    bool smooth() const override { return inside_.smooth(); }
    std::string describe() const override;
    std::vector<Remark> watch(double t, std::span<const double> y) override {
        return inside_.watch(t, y);
    }
    void set_bodies(std::vector<std::int32_t> bodies) override;
    std::string inseparable() const override { return inside_.inseparable(); }
    double fastest_damping() const override { return inside_.fastest_damping(); }
    std::size_t pairs() const override { return inside_.pairs(); }
    double reach() const override { return inside_.reach(); }
    void remember(Archive& archive) override;

  private:
    PairPotentialModel<2> inside_;
    Wall wall_;
};

}  // namespace relaxation
