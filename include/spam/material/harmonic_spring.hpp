// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace spam {

/// Pair potential of the molecular-dynamics twin, [HHM04] VI: phi(r) = kappa (r - d)^2 / 2,
/// F = -phi'(r) = kappa (d - r).
struct HarmonicSpring {
    double kappa = 1.0;
    double rest_length = 1.0;

    double energy(double r) const { return 0.5 * kappa * (r - rest_length) * (r - rest_length); }
    double force(double r) const { return kappa * (rest_length - r); }
};

}  // namespace spam
