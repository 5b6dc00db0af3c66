// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/external/external.hpp>

namespace spam {

/// A force that follows time, the same by mass for all particles of a group: v_dot_i += a(t)
/// (length/time^2). Its work is booked.
template <int Dim>
class Load final : public External<Dim> {
  public:
    /// `acceleration` must be a function of t alone and without steps, or adaptive methods lose their
    /// order there. `group`: 0 or 1 for each particle; empty: all.
    Load(std::function<Point<Dim>(double t)> acceleration, Group group = {})
        : acceleration_(std::move(acceleration)),
          group_(std::move(group)) {}

    void prepare(const typename External<Dim>::Now& now) override { a_ = acceleration_(now.t); }
    void add(const typename External<Dim>::Now& now, Eigen::Index first,
             Eigen::Index last) const override {
        auto v_dot = now.rate.velocity();
        for (Eigen::Index i = first; i < last; ++i)
            if (is_in(group_, now.number(i))) v_dot.col(i) += a_;
    }
    std::string inseparable() const override {
        return "the work of its load depends on velocities";
    }
    std::size_t particles() const override { return group_.size(); }
    std::string describe() const override { return "a load that depends on time"; }

  private:
    std::function<Point<Dim>(double)> acceleration_;
    Group group_;
    Point<Dim> a_ = Point<Dim>::Zero();
};

}  // namespace spam
