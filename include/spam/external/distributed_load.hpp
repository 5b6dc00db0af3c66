// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/error.hpp>
#include <spam/external/external.hpp>

namespace spam {

/// A load inside a body, another one for every particle, that grows and falls with time as a whole:
///     v_dot_i += f(t) b_i                                                          (length/time^2)
/// What b gives in the sum is the force on the whole: none where sum m b is zero. Its work is booked.
template <int Dim>
class DistributedLoad final : public External<Dim> {
  public:
    /// `size`: f, of t alone and without steps, or adaptive methods lose their order there. `pattern`: b
    /// (Dim x N), by number of the particle. Throws InputError where that is empty or not finite.
    DistributedLoad(std::function<double(double t)> size, Points<Dim> pattern)
        : size_(std::move(size)),
          pattern_(std::move(pattern)) {
        if (pattern_.cols() == 0 || !pattern_.allFinite())
            throw InputError("load: give a finite load for every particle");
    }

    void prepare(const typename External<Dim>::Now& now) override { f_ = size_(now.t); }
    void add(const typename External<Dim>::Now& now, Eigen::Index first,
             Eigen::Index last) const override {
        auto v_dot = now.rate.velocity();
        for (Eigen::Index i = first; i < last; ++i)
            v_dot.col(i) += f_ * pattern_.col(now.number(i));
    }
    std::string inseparable() const override {
        return "the work of its load depends on velocities";
    }
    std::size_t particles() const override { return static_cast<std::size_t>(pattern_.cols()); }
    std::string describe() const override {
        return "a load that depends on time and on the particle";
    }

  private:
    std::function<double(double)> size_;
    Points<Dim> pattern_;
    double f_ = 0.0;
};

}  // namespace spam
