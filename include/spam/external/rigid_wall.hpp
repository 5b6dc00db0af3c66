// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/external/external.hpp>

namespace spam {

/// A plane that no particle passes, rigid and without friction, which may move: particles nearer to it than s
/// feel
///     phi = e_w (1 - d/s)^4,   F = (4 e_w/s) (1 - d/s)^3 n,   d = n . x - h(t) < s,
/// d being the distance from the plane on the side of the normal n. Three continuous derivatives; on the
/// other side, d < 0, it only pushes harder. Masses have no part in it. Unlike walls of the box
/// (neighbors/wall.hpp) it makes no images, and serves any law of matter.
///
/// A plane at rest is a potential, whose energy belongs to the run. One that moves does work on the particles,
/// which is booked: the energy of the particles less the work is kept, without that of phi itself.
template <int Dim>
class RigidWall final : public External<Dim> {
  public:
    /// h(t), the plane's place along the normal; continuous.
    using Place = std::function<double(double t)>;
    /// `normal` need not be of length 1. Throws InputError for a normal of no direction, a place that is not
    /// finite, and an energy or a range that is not above 0.
    RigidWall(const Point<Dim>& normal, double place, double energy, double range);
    RigidWall(const Point<Dim>& normal, Place place, double energy, double range);

    void prepare(const typename External<Dim>::Now& now) override {
        if (moving_) h_ = moving_(now.t);
    }
    void add(const typename External<Dim>::Now& now, Eigen::Index first,
             Eigen::Index last) const override {
        const auto x = now.state.position();
        auto v_dot = now.rate.velocity();
        for (Eigen::Index i = first; i < last; ++i) {
            const double q = 1.0 - (normal_.dot(x.col(i)) - h_) / range_;
            if (q <= 0.0) continue;
            const double F = 4.0 * energy_ / range_ * q * q * q;
            v_dot.col(i) += F / now.particles.mass[static_cast<std::size_t>(i)] * normal_;
        }
    }
    bool potential() const override { return !moving_; }
    double energy_at(const Particles<Dim>&, std::size_t, const Point<Dim>& x) const override {
        const double q = 1.0 - (normal_.dot(x) - h_) / range_;
        return q > 0.0 ? energy_ * q * q * q * q : 0.0;
    }
    /// The work that it books is a matter of velocities.
    std::string inseparable() const override {
        return moving_ ? "the work of its moving wall depends on velocities" : "";
    }
    std::string describe() const override;

  private:
    Point<Dim> normal_;
    Place moving_;
    double h_, energy_, range_;
};

SPAM_COMPILED(extern template class RigidWall);

}  // namespace spam
