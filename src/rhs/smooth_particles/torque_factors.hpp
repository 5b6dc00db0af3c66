// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/exact_sum.hpp>
#include <spam/physics/scheme.hpp>
#include <spam/physics/torque_balance.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/sweeps.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace spam {

/// Particles of one kind: their masses, and the group (a body, or all) that keeps its angular
/// momentum.
struct Groups {
    std::span<const double> mass;
    std::span<const std::int32_t> group;
    std::size_t count;
};

/// The factors of torque scaling (physics/torque_balance.hpp), from the torques of the first sweep. On a line
/// nothing has a torque, and schemes that would balance them are refused.
template <int Dim>
class TorqueFactors {
  public:
    TorqueFactors(std::size_t particles, const Scheme& scheme)
        : law_(scheme.angular_momentum),
          positive_(particles),
          negative_(particles) {}

    void take_sums(SweepOutput<Dim>& first) {
        first.positive_torque = positive_.data();
        first.negative_torque = negative_.data();
    }

    /// 6 x N, TorqueParts of one group; made when first asked for.
    double* parts() {
        parts_.resize(TorqueParts::numbers * positive_.size());
        return parts_.data();
    }
    /// Once balanced, what scaling changes of the forces of one group, by parts(). v_dot: 2 x N, e_dot: N.
    void add_parts(double* v_dot, double* e_dot) const;

    /// The scale of every group from its own sums, the same for any number of threads. u, v: 2 x N.
    void balance(const Groups& groups, const double* u, const double* v);

    /// The sums of the first sweep are enough.
    bool wants_sums() const { return false; }
    void go_on(const Groups&) {}

    /// The numbers of columns NegativeFactor and PositiveFactor.
    void write(std::size_t i, std::int32_t group, double* number) const {
        const TorqueScale s = of(i, group);
        number[0] = s.negative;
        number[1] = s.positive;
    }
    std::span<const TorqueScale> scales() const { return scales_; }
    TorqueSearch search() const { return {}; }
    void remember(Memory<Dim>&) {}

  private:
    struct Torques {
        double positive, negative;
    };
    Torques torques_of(std::size_t i) const;
    /// What particle i brings to s_ij of its pairs.
    TorqueScale of(std::size_t i, std::int32_t group) const {
        const TorqueScale scale = scales_[static_cast<std::size_t>(group)];
        if (law_ == AngularMomentum::torque_pair) return scale;
        const double s = positive_[i] < negative_[i] ? scale.negative : scale.positive;
        return {s, s};
    }

    AngularMomentum law_;
    std::vector<double> positive_, negative_, parts_;
    ExactGroupSums<3> sums_;  ///< P, M, X of torque_balance()
    std::vector<TorqueScale> scales_;
};

}  // namespace spam
