// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/external/external.hpp>
#include <spam/external/rigid_velocity.hpp>

namespace spam {

/// What a friction acts against.
enum class FrictionOf {
    internal_motion,  ///< what is not rigid motion
    all_motion        ///< velocity itself: things come to rest in the box they are in
};

/// A friction, to find what a vibrating body comes to rest at. One that leaves rigid motions alone,
///     v_dot_i += -gamma (v_i - V - omega x (r_i - R)),
/// R, V centre of mass and its velocity, omega the rotation with the body's angular momentum about it, has
/// neither force nor torque. In a periodic box, where no rotation is rigid, and against drift there is
///     v_dot_i += -gamma v_i,
/// which lets momenta die out as exp(-gamma t). Either takes energy away, which is booked as work.
template <int Dim>
class Friction final : public External<Dim> {
  public:
    /// `gamma` >= 0 (1/time): what is acted against dies out in a time of about 2/gamma. Throws InputError
    /// for another.
    explicit Friction(double gamma, FrictionOf of = FrictionOf::internal_motion);

    void prepare(const typename External<Dim>::Now& now) override;
    void add(const typename External<Dim>::Now& now, Eigen::Index first,
             Eigen::Index last) const override;
    double damping() const override { return gamma_; }
    std::string inseparable() const override { return "its friction depends on the velocity"; }
    std::string describe() const override;

  private:
    double gamma_;
    FrictionOf of_;
    RigidVelocity<Dim> rigid_;
};

SPAM_COMPILED(extern template class Friction);

}  // namespace spam
