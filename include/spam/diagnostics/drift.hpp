// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/archive.hpp>
#include <spam/diagnostics/history.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/physics/scheme.hpp>

namespace spam {

/// How one invariant fared against what the scheme promises.
struct Drift {
    /// "mass", "momentum", "angular momentum", "energy".
    std::string name;
    /// What the scheme promises of it.
    Promise promise;
    double change;  ///< largest change over the run, in parts of `scale`
    double limit;   ///< largest change with which the promise counts as kept
    /// What changes are divided by, in the units of the invariant (measure_drifts).
    double scale = 1.0;
    /// Whether the promise was kept; true where none was given.
    bool kept() const { return promise == Promise::not_kept || change <= limit; }
};

/// The change with which a promise counts as kept: `integrator_limit`, exact ones 1e-12.
double allowed_change(Promise promise, double integrator_limit);

/// Against what changes are judged, gathered row by row.
struct DriftScales {
    /// Largest so far: sum m |v|, sum m |x||v|.
    double momentum = 0.0, angular_momentum = 0.0;
    /// Time integrals of InvariantScales' force, torque and power, from row to row.
    double impulse = 0.0, torque = 0.0, work = 0.0;
    /// Largest so far of what the energy may swing by with a symplectic method; 0 with others.
    double swing = 0.0;

    void add(double t, const InvariantScales& now);
    /// Of a row: the energy may be off by dt^2 `by_square`.
    void add_swing(double dt, double by_square);
    void remember(Archive& archive);

  private:
    double t_ = 0.0;
    InvariantScales before_{};
    bool begun_ = false;
};

/// A number that is watched: a column of invariants.csv less what externals and walls have given of it.
struct WatchedChange {
    /// That it is (a part of): "mass", "momentum", "angular momentum", "energy".
    std::string invariant;
    std::string axis;   ///< "x", "y" or "z"; empty where there is one number
    std::string given;  ///< what was taken off: "impulse"; empty where nothing acts from outside
    std::vector<double> change;  ///< since the first row, row by row

    /// "momentum y less impulse"; without the axis: of all parts.
    std::string name(bool with_axis = true) const;
};

/// All that is watched in these rows: every component of every invariant. None of a run without rows.
std::vector<WatchedChange> watched_changes(const History& history);

/// Drifts of mass, momentum, angular momentum and energy over a run, the last three less what externals
/// have given (Invariants::energy_balance() and the like); none of a run without rows.
/// Columns are those of invariants.csv; vectors are compared with sum m |v| and sum m |x||v|, the
/// energy with its start or the largest kinetic energy. Where particles hardly move, what rounding
/// leaves of the forces between neighbours is more than that: 1e-15 of what they exchange in the time
/// of the run (momentum, angular momentum, work) is allowed for. Limits: allowed_change(). A symplectic method
/// keeps an energy of its own; from this E differs by dt^2 times accelerations for ever, twice which is allowed.
std::vector<Drift> measure_drifts(const History& history, const Promises& promises,
                                  const DriftScales& scales, double integrator_limit);

}  // namespace spam
