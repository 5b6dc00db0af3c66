// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "torque_factors.hpp"
#include <spam/core/vec.hpp>
#include <spam/physics/gauss_constraint.hpp>

namespace spam {

/// Gauss' constraint (physics/gauss_constraint.hpp) of every group of a plane model.
class GaussForces {
  public:
    /// Adds the constraint to v_dot. x, u, v, v_dot: 2 x N.
    void constrain(const Groups& groups, const double* x, const double* u, const double* v,
                   double* v_dot);

    /// Of the group that is worst off, when constrain() was called last.
    double health() const;
    bool singular() const;

  private:
    struct Means {
        Vec<2> centre, transport, velocity;  ///< of x, u and v, by mass
    };

    ExactGroupSums<7> first_;    ///< mass, mass x, mass u, mass v
    ExactGroupSums<4> moments_;  ///< about the centre: inertia, L, 2 K, dL/dt
    std::vector<Means> means_;
    std::vector<GaussMultipliers> multipliers_;
};

}  // namespace spam
