// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/diagnostics/field_grid.hpp>
#include <spam/diagnostics/field_interpolation.hpp>
#include <spam/diagnostics/wall_images.hpp>

#include <functional>
#include <vector>

namespace spam {

/// Which motion counts as heat beside the energy e that the particles carry.
enum class Heat {
    fluctuation,  ///< (<v^2> - <v>^2)/2: what a smooth flow does not show
    all_motion    ///< <v^2>/2: sound and streaming too, "a substantial error" [HH01] Fig. 3
};

/// Entropy of an ideal gas from its smooth particles, [HH01] eq 22 (printed there with a minus sign):
///     s = (D/2) ln(e_int / rho^(2/D)),   e_int = e + (<v^2> - <v>^2)/2,
///     <f>(r) = sum_j m_j f_j w(|r - r_j|) / sum_j m_j w(|r - r_j|)
/// per particle, in units of k, up to a constant: (3/2, 1, 1/2) ln e for the velocities of D = 3, 2, 1
/// and -ln rho for the room. The gas does not stream in the mean of its neighbours: what it loses of
/// their pressure and of its visible motion comes back as fluctuation.
template <int Dim>
class GasEntropy {
  public:
    /// Particles as they are now: `mass`, `density` (summed, themselves included), `energy` (per mass),
    /// N each; `position`, `velocity` Dim x N. Throws InputError as FieldInterpolation.
    GasEntropy(const AnyWeight<Dim>& weight, const std::vector<double>& mass,
               const Points<Dim>& position, const Points<Dim>& velocity,
               const std::vector<double>& density, const std::vector<double>& energy,
               const Box<Dim>& box);

    /// sum m_i s_i / sum m_i with rho and e of the particles, <v> and <v^2> at their places.
    double of_particles(Heat heat) const;

    /// Integral of rho s over the nodes of a periodic grid / sum m, with rho(r), <v>, <v^2> there, and
    /// e(rho) of the gas where density alone decides. Where there is no gas there is no entropy.
    double on_grid(const FieldGrid<Dim>& grid, Heat heat,
                   const std::function<double(double rho)>& energy) const;
    /// Likewise, of any gas, with <e>.
    double on_grid(const FieldGrid<Dim>& grid, Heat heat) const;

  private:
    template <class Energy>
    double integral(const FieldGrid<Dim>& grid, Heat heat, const Energy& energy) const;

    const Eigen::MatrixXd& sums_at_particles() const;

    WallImages<Dim> images_;
    FieldInterpolation<Dim> fields_;  ///< of particles and images
    Points<Dim> position_;
    Eigen::VectorXd mass_, density_, energy_;
    Eigen::MatrixXd carried_;               ///< 1, e, v, v^2 in rows, for each of these
    mutable Eigen::MatrixXd at_particles_;  ///< their sums there, once they have been asked for
};

SPAM_COMPILED(extern template class GasEntropy);

}  // namespace spam
