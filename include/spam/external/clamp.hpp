// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/external/external.hpp>

namespace spam {

/// Particles that are held or driven: they move with a prescribed velocity V(t), zero by default, whatever
/// acts on them,
///     x_dot_i = V(t),   v_dot_i = dV/dt.
/// In y0 their velocities must be V(0). The force that this takes is booked, and its work where they are
/// driven. Comes last in the list of externals.
template <int Dim>
class Clamp final : public External<Dim> {
  public:
    using Motion = std::function<Point<Dim>(double t)>;
    /// Held. `group`: 0 or 1 for each particle; empty: all.
    explicit Clamp(Group group = {}) : group_(std::move(group)) {}
    /// Driven: velocity and its derivative.
    Clamp(Group group, Motion velocity, Motion acceleration)
        : group_(std::move(group)),
          velocity_(std::move(velocity)),
          acceleration_(std::move(acceleration)) {}

    void prepare(const typename External<Dim>::Now& now) override {
        if (velocity_) V_ = velocity_(now.t), V_dot_ = acceleration_(now.t);
    }
    void add(const typename External<Dim>::Now& now, Eigen::Index first,
             Eigen::Index last) const override {
        auto x_dot = now.rate.position(), v_dot = now.rate.velocity();
        for (Eigen::Index i = first; i < last; ++i)
            if (is_in(group_, i)) {
                x_dot.col(i) = V_;
                v_dot.col(i) = V_dot_;
            }
    }
    bool holds(std::size_t i) const override { return is_in(group_, static_cast<Eigen::Index>(i)); }
    std::string describe() const override {
        return velocity_        ? "driven particles"
               : group_.empty() ? "all particles held"
                                : "held particles";
    }
    /// Driven ones need the time in the middle of a step.
    std::string inseparable() const override {
        return velocity_ ? "its driven particles do not move with their forces" : "";
    }

  private:
    Group group_;
    Motion velocity_, acceleration_;
    Point<Dim> V_ = Point<Dim>::Zero(), V_dot_ = Point<Dim>::Zero();
};

}  // namespace spam
