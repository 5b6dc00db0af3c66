// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../common.hpp"

namespace cavity {

using namespace spam;

/// A velocity along the lid, by that of the lid, at a height by the side.
struct LinePoint {
    double y, u;
};

/// On the vertical centre line at Re = 100: Ghia, Ghia and Shin, J. Comput. Phys. 48, 387 (1982), table I. Up
/// to 0.005 off the solution of the equations.
std::span<const LinePoint> ghia();
/// The same of Marchi, Suero and Araki, J. Braz. Soc. Mech. Sci. Eng. 31, 186 (2009): grids of up to 1024 x 1024
/// extrapolated; to the digits given. tests/problem/cavity_reference.cpp finds it again.
std::span<const LinePoint> converged();

/// Velocities along the lid at x = L/2 and these heights (both by the side), from particles and their images
/// behind the walls (diagnostics/field_interpolation.hpp) with the weight function of the scheme.
std::vector<double> centre_line(const Model<2>& model, const Scheme& scheme, double side,
                                double speed, std::span<const double> y,
                                const std::vector<double>& heights);

/// Velocities on the centre line at Ghia's heights, at those of converged() and, for pictures, at even ones: at
/// the latest row, and in the mean over the rows since `since`.
class CentreLine {
  public:
    CentreLine(const Scheme& scheme, double side, double speed, double since);

    /// Fills it in, and is part of checkpoints; columns `off_ghia_now`, `off_converged_now`: the largest
    /// differences at the latest row, where `known`. Must not outlive this.
    Observer<2> observer(bool known);

    std::vector<double> mean() const;  ///< at all of them
    /// The even heights, and the mean there.
    std::pair<std::vector<double>, std::vector<double>> profile() const;
    /// Largest differences of velocities at all heights.
    static double off_ghia(const std::vector<double>& u);
    static double off_converged(const std::vector<double>& u);  ///< see off_ghia()

  private:
    Scheme scheme_;
    double side_, speed_, since_;
    std::vector<double> heights_, latest_, sum_;
    std::int64_t rows_ = 0;
};

}  // namespace cavity
