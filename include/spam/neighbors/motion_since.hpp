// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/rigid_motion.hpp>
#include <spam/neighbors/box.hpp>
#include <spam/neighbors/displacement.hpp>

namespace spam {

/// How far particles have moved since a time when something was found of their neighbours, the best rigid
/// motion of all taken off: a body that only turns and flies keeps what was found. Where the box is periodic, only
/// a translation is taken off, and none towards a wall.
template <int Dim>
class MotionSince {
  public:
    /// Takes these positions, Dim x N, as those from which particles move; `motion` where it is known already.
    void begin(const Eigen::Ref<const Points<Dim>>& position, const RigidMotion<Dim>& motion = {});
    const Points<Dim>& then() const { return then_; }
    /// The one that was good enough last. What within() says depends on it: on whether a better one is looked for.
    const RigidMotion<Dim>& motion() const { return motion_; }

    /// Whether no particle has moved farther than that. Never true where a position is not finite.
    bool within(double distance, const Eigen::Ref<const Points<Dim>>& position,
                const Box<Dim>& box);
    /// Which particles have moved farther, the rigid motion known last taken off. Where none has, in any part of the
    /// run, within() is true.
    Displacement<Dim> displacement(double distance) const;

  private:
    bool none_beyond(double distance, const Eigen::Ref<const Points<Dim>>& position) const;

    Points<Dim> then_;
    RigidMotion<Dim> motion_;  ///< since then, roughly
};

SPAM_COMPILED(extern template class MotionSince);

}  // namespace spam
