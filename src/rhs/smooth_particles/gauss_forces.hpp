// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "torque_factors.hpp"
#include <spam/core/vec.hpp>
#include <spam/physics/gauss_constraint.hpp>

namespace spam {

/// Gauss' constraint (physics/gauss_constraint.hpp) of every group of a model.
template <int Dim>
class GaussForces {
  public:
    /// Adds the constraint to v_dot. x, u, v, v_dot: Dim x N.
    void constrain(const Groups& groups, const double* x, const double* u, const double* v,
                   double* v_dot);

    /// Of the group that is worst off, when constrain() was called last.
    double health() const;
    bool singular() const;

  private:
    using Law = GaussLaw<Dim>;
    struct Means {
        double mass;
        Vec<Dim> centre, transport, velocity;  ///< of x, u and v, by mass
    };

    ExactGroupSums<1 + 3 * Dim> first_;     ///< mass, mass x, mass u, mass v
    ExactGroupSums<Law::numbers> moments_;  ///< about the centre
    std::vector<Means> means_;
    std::vector<typename Law::Multipliers> multipliers_;
};

/// On a line nothing turns, and the scheme is refused.
template <>
class GaussForces<1> {
  public:
    void constrain(const Groups&, const double*, const double*, const double*, double*) {}
    double health() const { return 1.0; }
    bool singular() const { return false; }
};

}  // namespace spam
