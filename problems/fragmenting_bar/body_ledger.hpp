// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>

#include <vector>

namespace spam {

/// What one body has.
struct BodyTotals {
    std::size_t particles = 0;
    double mass = 0.0;
    Point<2> momentum = Point<2>::Zero();
    double angular_momentum = 0.0;  ///< about the origin
    double energy = 0.0;            ///< sum m (e + v^2/2); kinetic where particles carry no energy

    void remember(Archive& a) { a(particles, mass, momentum, angular_momentum, energy); }
};

/// Of every body of a plane model, by its number. Sums are exact (ExactSum).
std::vector<BodyTotals> totals_of_bodies(const Model<2>& model, std::span<const double> y);

/// Accounts for bodies that part and join, [HHM04] IX: which they were, which they are, and what each kept
/// in between. Bodies are connected parts within the model's reach and a margin for how far they move
/// until bodies are searched for again: so they never act on each other.
class BodyLedger {
  public:
    struct Entry {
        double t;                        ///< of the change; the first entry is the start
        std::vector<BodyTotals> bodies;  ///< from then on
        /// By body, which of the bodies before it came from, ascending; empty at the start.
        std::vector<std::vector<std::size_t>> parents;
        /// Of any body since it came into being, until this change.
        double largest_L_change = 0.0, largest_momentum_change = 0.0;
        BodyTotals sum_change;  ///< over all bodies, after minus before: nothing may be left out

        void remember(Archive& a) {
            a(t, bodies, parents, largest_L_change, largest_momentum_change, sum_change);
        }
    };

    /// Finds the bodies anew. Where they have changed the model is given the new ones and an entry is
    /// made; returns whether they have. `until_next`: time to the next search, >= 0.
    bool find_bodies(double t, Model<2>& model, std::span<const double> y, double until_next);

    /// Closes the account at the end of a run: an entry with the bodies as they are.
    void close(double t, const Model<2>& model, std::span<const double> y);

    const std::vector<Entry>& entries() const { return entries_; }
    void remember(Archive& archive) { archive(entries_); }

  private:
    void settle(Entry& entry, const std::vector<BodyTotals>& had) const;
    std::vector<Entry> entries_;
};

}  // namespace spam
