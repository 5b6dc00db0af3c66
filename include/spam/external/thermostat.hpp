// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/external/external.hpp>
#include <spam/external/rigid_velocity.hpp>

namespace spam {

/// A bath that brings the kinetic temperature of the fluctuations,
///     kT = sum m |v - V|^2 / (D (N - 1)),
/// to a given one in a time 1/gamma (Berendsen et al., J. Chem. Phys. 81 (1984) 3684):
///     v_dot_i += -gamma/2 (1 - kT_0/kT) (v_i - V),    d kT/dt = -gamma (kT - kT_0).
/// V is the velocity of the centre of mass, which it leaves alone; rotations it damps. What it gives is
/// booked as heat.
template <int Dim>
class Thermostat final : public External<Dim> {
  public:
    /// Throws InputError for kT_0 (mass length^2/time^2) or gamma (1/time) that are not positive.
    Thermostat(double kT_0, double gamma);

    void prepare(const typename External<Dim>::Now& now) override;
    void add(const typename External<Dim>::Now& now, Eigen::Index first,
             Eigen::Index last) const override {
        const auto v = now.state.velocity();
        auto v_dot = now.rate.velocity();
        for (Eigen::Index i = first; i < last; ++i) v_dot.col(i) += factor_ * (v.col(i) - V_);
    }
    bool thermal() const override { return true; }
    double damping() const override { return 0.5 * gamma_; }
    std::string inseparable() const override { return "its thermostat depends on the velocity"; }
    std::string describe() const override;

  private:
    double kT_0_, gamma_;
    double factor_ = 0.0;
    Point<Dim> V_ = Point<Dim>::Zero();
};

SPAM_COMPILED(extern template class Thermostat);

}  // namespace spam
