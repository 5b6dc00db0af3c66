// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>

#include <span>

namespace spam {

/// x -> to + rotation (x - from)
template <int Dim>
struct RigidMotion {
    Eigen::Matrix<double, Dim, Dim> rotation = Eigen::Matrix<double, Dim, Dim>::Identity();
    Point<Dim> from = Point<Dim>::Zero();
    Point<Dim> to = Point<Dim>::Zero();

    template <class P>
    Point<Dim> operator()(const P& x) const {
        return to + rotation * (x - from);
    }
    void remember(auto& archive) { archive(rotation, from, to); }
};

/// The motion that brings the points `from` nearest to the points `to` (least squares, proper
/// rotations only; Kabsch's construction). Both Dim x N.
template <int Dim>
RigidMotion<Dim> best_rigid_motion(const Eigen::Ref<const Points<Dim>>& from,
                                   const Eigen::Ref<const Points<Dim>>& to);

/// Of the values (Dim x N) by mass (N): the centre of mass, or its velocity.
template <int Dim>
Point<Dim> mean_by_mass(std::span<const double> mass, const Eigen::Ref<const Points<Dim>>& values);

/// The translation alone.
template <int Dim>
RigidMotion<Dim> best_translation(const Eigen::Ref<const Points<Dim>>& from,
                                  const Eigen::Ref<const Points<Dim>>& to);

}  // namespace spam
