// SPDX-License-Identifier: GPL-3.0-or-later
// A bar and the projectile that flies at it: where they are at the start.
#pragma once

#include <spam/spam.hpp>

namespace spam {

struct Target {
    int columns = 8, rows = 60;  ///< of the bar
    int projectile = 5;          ///< n of a hexagon
    double speed = 1.0;          ///< of the projectile
    double offset = 8.0;         ///< of its centre above the middle of the bar

    /// How long a run is that takes `usual` at the usual speed: the projectile goes equally far.
    double time(double usual) const { return usual * Target{}.speed / speed; }
    std::int64_t of_bar() const { return static_cast<std::int64_t>(columns) * rows; }
    /// The bar centred on the origin, the projectile left of it by `gap`; the bar's particles first.
    Points<2> positions(double gap) const;
    /// y of a model of these particles, whose ids are places in positions(): only the projectile moves.
    std::vector<double> start(Model<2>& model) const;
};

/// `--columns`, `--rows`, `--projectile`, `--speed` and `--offset`.
void add_target_options(Options& options, Target& target);

/// Smaller where it is a smoke test, but what is given.
void make_small(const Session& session, Target& target);

/// Throws InputError where the projectile would go beyond `range` in a step, or in an interval between rows, in
/// which bodies are searched for.
void refuse_tunnelling(const Session& session, const Target& target, double range,
                       double row_interval);

}  // namespace spam
