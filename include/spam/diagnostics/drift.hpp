// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/diagnostics/history.hpp>
#include <spam/physics/scheme.hpp>

namespace spam {

/// How one invariant fared against what the scheme promises.
struct Drift {
    std::string name;
    Promise promise;
    double change;  ///< largest change over the run, relative to the invariant's natural size
    double limit;   ///< largest change with which the promise counts as kept
    bool kept() const { return promise == Promise::not_kept || change <= limit; }
};

/// The change with which a promise counts as kept: `integrator_limit`, exact ones 1e-12.
double allowed_change(Promise promise, double integrator_limit);

/// Drifts of mass, momentum, angular momentum and energy over a run. Columns are those of
/// invariants.csv; vectors are compared with `momentum_scale` = sum m |v| and
/// `angular_momentum_scale` = sum m |x||v| (which do not vanish with the conserved sum), the energy
/// with its start or the largest kinetic energy. Limits: allowed_change().
std::vector<Drift> measure_drifts(const History& history, const Promises& promises,
                                  double momentum_scale, double angular_momentum_scale,
                                  double integrator_limit);

}  // namespace spam
