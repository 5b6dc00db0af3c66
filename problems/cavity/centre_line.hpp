// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/scheme.hpp>
#include <spam/problem/observer.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cavity {

using namespace spam;

/// A velocity along the lid, by that of the lid, at a height by the side.
struct LinePoint {
    double y, u;
};

/// On the vertical centre line at Re = 100: Ghia, Ghia and Shin, J. Comput. Phys. 48, 387 (1982), table I.
std::span<const LinePoint> ghia();

/// Velocities along the lid at x = L/2 and these heights (both by the side), from particles and their images
/// behind the walls (diagnostics/field_interpolation.hpp) with the weight function of the scheme.
std::vector<double> centre_line(const Model<2>& model, const Scheme& scheme, double speed,
                                std::span<const double> y, const std::vector<double>& heights);

/// Velocities on the centre line at Ghia's heights and, for pictures, at even ones: at the latest row, and in
/// the mean over the rows since `since`.
class CentreLine {
  public:
    CentreLine(const Scheme& scheme, double speed, double since);

    /// Fills it in, and is part of checkpoints; column `off_ghia_now`: the largest difference from Ghia's points
    /// at the latest row, where `known`. Must not outlive this.
    Observer<2> observer(bool known);

    const std::vector<double>& heights() const { return heights_; }  ///< Ghia's, then even ones
    std::vector<double> mean() const;
    /// Of velocities at heights().
    static double off_ghia(const std::vector<double>& u);

  private:
    Scheme scheme_;
    double speed_, since_;
    std::vector<double> heights_, latest_, sum_;
    std::int64_t rows_ = 0;
};

}  // namespace cavity
