// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/external/external.hpp>

namespace spam {

/// Resistance of a medium that moves with velocity U, proportional to the square of the relative speed:
///     v_dot_i += -c |v_i - U| (v_i - U)          (c: 1/length)
/// For the linear law see Friction. Its work is booked.
template <int Dim>
class Drag final : public External<Dim> {
  public:
    /// Throws InputError for c below 0. `fastest`: the largest relative speed to be expected, for the
    /// stability limit of explicit steps.
    Drag(double c, double fastest, const Point<Dim>& U = Point<Dim>::Zero());

    void add(const typename External<Dim>::Now& now, Eigen::Index first,
             Eigen::Index last) const override {
        const auto v = now.state.velocity();
        auto v_dot = now.rate.velocity();
        for (Eigen::Index i = first; i < last; ++i) {
            const Point<Dim> relative = v.col(i) - U_;
            v_dot.col(i) -= c_ * relative.norm() * relative;
        }
    }
    double damping() const override { return 2.0 * c_ * fastest_; }
    std::string inseparable() const override { return "its drag depends on the velocity"; }
    std::string describe() const override;

  private:
    double c_, fastest_;
    Point<Dim> U_;
};

SPAM_COMPILED(extern template class Drag);

}  // namespace spam
