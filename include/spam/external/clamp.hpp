// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/external/external.hpp>

#include <algorithm>
#include <array>

namespace spam {

/// Particles that are held or driven: they move with a prescribed velocity V(t), zero by default, whatever
/// acts on them,
///     x_dot_i = V(t),   v_dot_i = dV/dt.
/// In y0 their velocities must be V(0). The force that this takes is booked, and its work where they are
/// driven. Of particles that are guided along some axes the other directions stay free. Comes last in the list
/// of externals.
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

    /// Only along this axis, 0 for x; what acts across it moves the particles.
    Clamp& only_along(int axis) {
        for (int a = 0; a < Dim; ++a) along_[static_cast<std::size_t>(a)] = a == axis;
        return *this;
    }

    void prepare(const typename External<Dim>::Now& now) override {
        if (velocity_) V_ = velocity_(now.t), V_dot_ = acceleration_(now.t);
    }
    void add(const typename External<Dim>::Now& now, Eigen::Index first,
             Eigen::Index last) const override {
        auto x_dot = now.rate.position(), v_dot = now.rate.velocity();
        for (Eigen::Index i = first; i < last; ++i)
            if (is_in(group_, now.number(i)))
                for (int a = 0; a < Dim; ++a)
                    if (along_[static_cast<std::size_t>(a)]) {
                        x_dot(a, i) = V_[a];
                        v_dot(a, i) = V_dot_[a];
                    }
    }
    int prescribed_axes(std::size_t i) const override {
        return is_in(group_, static_cast<Eigen::Index>(i))
                   ? static_cast<int>(std::count(along_.begin(), along_.end(), true))
                   : 0;
    }
    std::size_t particles() const override { return group_.size(); }
    std::string describe() const override {
        for (std::size_t a = 0; a < Dim; ++a)
            if (!along_[a])
                return velocity_ ? "particles driven along an axis"
                                 : "particles held along an axis";
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
    std::array<bool, Dim> along_ = [] {
        std::array<bool, Dim> all{};
        all.fill(true);
        return all;
    }();
    Point<Dim> V_ = Point<Dim>::Zero(), V_dot_ = Point<Dim>::Zero();
};

}  // namespace spam
