// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/particles.hpp>

#include <Eigen/Geometry>

namespace spam {

/// The velocities of a rigid body, V + omega x (r - R).
template <int Dim>
struct RigidVelocity {
    static constexpr int planes = Dim * (Dim - 1) / 2;
    Point<Dim> R = Point<Dim>::Zero(), V = Point<Dim>::Zero();
    Eigen::Matrix<double, planes, 1> omega = Eigen::Matrix<double, planes, 1>::Zero();

    Point<Dim> at(const Point<Dim>& r) const {
        if constexpr (Dim == 1)
            return V;
        else if constexpr (Dim == 2)
            return V + omega[0] * Point<2>(-(r.y() - R.y()), r.x() - R.x());
        else
            return V + omega.cross(r - R);
    }
};

/// The one with the momentum of the particles and their angular momentum about the centre of mass; no
/// rotation about axes for which they have no moment of inertia.
template <int Dim>
RigidVelocity<Dim> rigid_velocity_of(const std::vector<double>& mass, const ConstState<Dim>& state);

}  // namespace spam
