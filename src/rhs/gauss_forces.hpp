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
    struct Sums {
        CompensatedSum mass, x[2], u[2], v[2], inertia, L, twice_K, L_dot;
        Vec<2> centre() const { return {{x[0] / mass, x[1] / mass}}; }
        Vec<2> transport() const { return {{u[0] / mass, u[1] / mass}}; }
        Vec<2> velocity() const { return {{v[0] / mass, v[1] / mass}}; }
    };
    void measure(const Groups& groups, const double* x, const double* u, const double* v);

    std::vector<Sums> sums_;
    std::vector<GaussMultipliers> multipliers_;
};

}  // namespace spam
