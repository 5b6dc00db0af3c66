// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/external/external.hpp>

namespace spam {

/// A constant acceleration of all particles, v_dot_i += g (length/time^2), with the potential
/// -sum m g . x. Where particles move with v the energy of the run contains it; where they move with an
/// average, what gravity gives is booked as work instead.
template <int Dim>
class Gravity final : public External<Dim> {
  public:
    /// Throws InputError for a g that is not finite.
    explicit Gravity(const Point<Dim>& g);

    void add(const typename External<Dim>::Now& now, Eigen::Index first,
             Eigen::Index last) const override {
        now.rate.velocity().middleCols(first, last - first).colwise() += g_;
    }
    bool potential() const override { return true; }
    double energy_at(const Particles<Dim>& particles, std::size_t i,
                     const Point<Dim>& x) const override {
        return -particles.mass[i] * g_.dot(x);
    }
    std::string describe() const override;

  private:
    Point<Dim> g_;
};

SPAM_COMPILED(extern template class Gravity);

}  // namespace spam
