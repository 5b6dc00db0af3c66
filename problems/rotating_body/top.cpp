// SPDX-License-Identifier: GPL-3.0-or-later
#include "top.hpp"

#include <gsl/gsl_sf_elljac.h>

#include <cmath>

namespace rotating_body {

using spam::Point;

FreeTop::FreeTop(const Point<3>& inertia, double omega_1, double omega_2) {
    const double I1 = inertia[0], I2 = inertia[1], I3 = inertia[2];
    // 2 E I_3 - L^2 and L^2 - 2 E I_1, as sums that round-off cannot spoil. L^2 - 2 E I_2 = -I_1 (I_2 - I_1) omega_1^2
    // is never positive: omega stays near axis 1.
    const double below = I1 * (I3 - I1) * omega_1 * omega_1 + I2 * (I3 - I2) * omega_2 * omega_2;
    const double above = I2 * (I2 - I1) * omega_2 * omega_2;
    largest_ = {std::sqrt(below / (I1 * (I3 - I1))), omega_2, std::sqrt(above / (I3 * (I3 - I1)))};
    rate_ = std::sqrt((I2 - I1) * below / (I1 * I2 * I3));
    k2_ = (I3 - I2) * above / ((I2 - I1) * below);
    quarter_ = std::comp_ellint_1(std::sqrt(k2_)) / rate_;
}

/// omega_2 begins at its largest value, and omega_3 at 0: sn(K) = 1, cn(K) = 0.
Point<3> FreeTop::omega(double t) const {
    double sn = 0.0, cn = 0.0, dn = 0.0;
    gsl_sf_elljac_e(rate_ * (t + quarter_), k2_, &sn, &cn, &dn);
    return {largest_[0] * dn, largest_[1] * sn, largest_[2] * cn};
}

}  // namespace rotating_body
