// SPDX-License-Identifier: GPL-3.0-or-later
// The same gas between the same plates on a grid that stays where it is: finite differences, [HH07] 12.
#pragma once

#include <spam/integrate/integrator.hpp>
#include <spam/neighbors/box.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace rayleigh_benard {

/// The layer as both methods see it: 2 L wide, L high, between plates of temperature hot (below) and cold. P = rho
/// T, e = T (k = m = 1, two dimensions); gravity g = (hot - cold)/L keeps the density of the conducting layer at 1;
/// viscosity without bulk, eta = kappa.
struct Layer {
    double L = 20.0;
    double rayleigh = 1e4;
    double roll = 0.05;  ///< speed of the rolls at the start
    double hot = 1.5, cold = 0.5;

    double gravity() const { return (hot - cold) / L; }
    /// eta = kappa, from Ra = g L^4 (dlnT/dy)/(nu D_T) at the mean temperature and density, with c_v = 1:
    /// L^2/(eta kappa) between 1.5 and 0.5.
    double eta() const;
    /// Heat conducted by the layer at rest per time, over its whole width.
    double conducted() const { return eta() * (hot - cold) / L * 2.0 * L; }
    double temperature(double y) const { return hot - (hot - cold) * y / L; }
    /// Two rolls that turn against each other, at rest at the plates: u and v.
    double seed_u(double x, double y) const;
    double seed_v(double x, double y) const;
};

/// Cell averages on nx x ny square cells, in conservation form: y = (rho, rho u, rho v, rho (e + v^2/2), each
/// nx ny with x fastest; then the heat given so far by the lower and by the upper plate). Fluxes between
/// cells are made of means and central differences: of second order.
class Grid {
  public:
    /// `cells` from plate to plate, at least 4, in the same box as particles are: images beyond its walls
    /// are the same as theirs.
    Grid(const Layer& layer, const spam::Box<2>& box, int cells);

    std::vector<double> start() const;
    /// dy/dt; NaN where a density is not positive.
    void rates(std::span<const double> y, std::span<double> y_dot);

    int nx() const { return nx_; }
    int ny() const { return ny_; }
    double spacing() const { return d_; }
    const Layer& layer() const { return layer_; }
    /// density, u, v, temperature of every cell
    std::vector<double> field(std::span<const double> y, int which) const;
    double kinetic(std::span<const double> y) const;
    /// As roll_amplitude_column() of the particles.
    double roll_amplitude(std::span<const double> y) const;
    double heat(std::span<const double> y, bool upper) const { return y[4 * cells() + upper]; }

  private:
    std::size_t cells() const {
        return static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_);
    }
    /// Of a cell or, beyond a side of the box, of its image: rho, u, v, T.
    struct Values {
        double rho, u, v, T;
        double P() const { return rho * T; }
    };
    Values at(int i, int j) const;
    Values image(const Values& cell, int axis, bool upper) const;
    /// Of the face between two cells. Where one is beyond a wall, from the two before it.
    double pressure(int i, int j, int axis) const;
    /// What passes a face per length and time, in the direction of the axis; heat is a part of the energy.
    struct Flux {
        double mass, x, y, energy, heat;
    };
    Flux across_x(int i, int j) const;  ///< between (i, j) and (i + 1, j)
    Flux across_y(int i, int j) const;  ///< between (i, j) and (i, j + 1)

    Layer layer_;
    spam::Box<2> box_;
    int nx_, ny_;
    double d_, eta_;
    std::vector<Values> values_;
};

/// A run of the grid: rows at the times given, and where it ended.
struct GridRun {
    std::vector<double> t, kinetic, roll, heat_bottom, heat_top;
    std::vector<double> y;
    spam::Integrator::Statistics statistics;
};
/// By ARKODE's adaptive Runge-Kutta method of order 5, relative tolerance 1e-7. Throws GuardStop where there
/// is no way on.
GridRun run_grid(Grid& grid, const std::vector<double>& times);

}  // namespace rayleigh_benard
