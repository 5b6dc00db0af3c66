// SPDX-License-Identifier: GPL-3.0-or-later
// The free motion of a rigid body, as of a top that nothing holds.
#pragma once

#include <spam/core/state.hpp>

namespace rotating_body {

/// A rigid body with moments of inertia I about its axes 1, 2, 3, I_1 < I_2 < I_3, that begins with angular velocity
/// (omega_1, omega_2, 0), omega_2 not 0. Jacobi's solution of Euler's equations; Landau and Lifshitz, Mechanics,
/// section 37.
class FreeTop {
  public:
    FreeTop(const spam::Point<3>& inertia, double omega_1, double omega_2);

    /// In the axes of the body.
    spam::Point<3> omega(double t) const;
    /// Until omega_2 is 0 for the first time; twice as long, and it is 0 again. Infinite where omega_1 is 0.
    double quarter() const { return quarter_; }

  private:
    spam::Point<3> largest_;
    double rate_, k2_, quarter_;
};

}  // namespace rotating_body
