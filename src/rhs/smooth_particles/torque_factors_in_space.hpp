// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "torque_factors.hpp"
#include <spam/physics/torque_balance_in_space.hpp>

namespace spam {

/// The factors of torque scaling in space, by some sums over torques. Those of pairs need a sweep each; those of
/// particles go over particles alone.
template <>
class TorqueFactors<3> {
  public:
    TorqueFactors(std::size_t particles, const Scheme& scheme)
        : by_pair_(scheme.angular_momentum == AngularMomentum::torque_pair),
          own_rate_(scheme.transport == Transport::average),
          moments_(torque_moments * particles),
          factor_(by_pair_ ? 0 : particles) {}

    void take_sums(SweepOutput<3>& first) { first.torque_moments = moments_.data(); }

    /// Begins, with the sums of the first sweep. u, v: 3 x N. Torques of particles are balanced then.
    void balance(const Groups& groups, const double* u, const double* v);
    /// Whether sums with the factors of now are wanted ...
    bool wants_sums() const { return wants_sums_; }
    /// ... and what follows from them.
    void go_on(const Groups& groups);

    /// The numbers of columns NegativeFactor, PositiveFactor, SoundSpeed (left as it is) and TorqueMultiplier.
    void write(std::size_t i, std::int32_t group, double* number) const;

    std::span<const TorqueScale> scales() const { return {}; }
    TorqueSearch search() const;
    /// How many sums there were: of a run, also where it was stopped and goes on.
    void remember(Memory<3>& memory);

  private:
    using Numbers = std::array<double, torque_moments>;
    std::span<const Numbers> sums(const Groups& groups);
    TorqueMoments moments_of(std::size_t i, const Vec<3>& theta) const;

    bool by_pair_, own_rate_, wants_sums_ = false;
    std::vector<double> moments_, factor_;
    ExactGroupSums<torque_moments> sums_;
    ExactGroupSums<3> rates_;
    std::vector<Vec<3>> X_;
    std::vector<TorqueBalance> balances_;
    TorqueSearch search_;
};

}  // namespace spam
