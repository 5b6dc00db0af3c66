// SPDX-License-Identifier: GPL-3.0-or-later
// For *.lanes.cpp: what makes the records of a sweep.
#pragma once

#include <spam/core/parallel.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/physics/record.hpp>
#include <spam/rhs/sweeps.hpp>

namespace spam {
inline namespace SPAM_LANES {

/// Density and stress of one particle. Returns 1 where the density is not positive.
template <int Dim, class R>
SPAM_INLINE std::size_t pack_density(const PackInput<Dim>& in, std::size_t i, double* record) {
    [[maybe_unused]] constexpr auto n = static_cast<std::size_t>(symmetric_size(Dim));
    const double rho = in.rho[i];
    [[maybe_unused]] const double scale = 1.0 / (rho * rho);
    record[R::template at<column::Density>] = EitherMean::number(in.mean_density, rho);
    if constexpr (R::template has<column::Stress>)
        for (std::size_t k = 0; k < n; ++k)
            record[R::template at<column::Stress> + k] = scale * in.sigma[i * n + k];
    return static_cast<std::size_t>(!(rho > 0.0));
}

/// Position, velocity and mass of one particle. Returns 1 where it has gone too far for the list.
template <int Dim, class R>
SPAM_INLINE std::size_t pack_motion(const PackInput<Dim>& in, std::size_t i, double* record) {
    // Read before anything is written: for all the compiler knows that may change what is read.
    const double* const from = in.x + Dim * i;
    double x[Dim];
    for (std::size_t a = 0; a < Dim; ++a) x[a] = from[a];
    const std::size_t far = in.displacement.too_far(i, x);
    for (std::size_t a = 0; a < Dim; ++a) record[a] = x[a];
    if constexpr (R::template has<column::Velocity>)
        for (int a = 0; a < Dim; ++a)
            record[R::template at<column::Velocity> + a] =
                in.v[Dim * i + static_cast<std::size_t>(a)];
    record[R::template at<column::Mass>] = in.m[i];
    return far;
}

template <int Dim, class R>
PackCount pack_record(const PackInput<Dim>& whole, bool density_only, double* records) {
    const PackInput<Dim> in = whole;  // a copy that the stores below cannot be suspected to change
    // Both counts in one number, `far` in the lower half: fewer than 2^32 particles have slots. What is
    // packed is known when this is compiled: choosing for every particle would cost.
    const auto count = [&](auto motion, auto density) {
        return parallel_count(in.order.size(), [=](std::size_t slot) {
            const std::size_t i = in.order[slot];
            double* const record = records + slot * in.stride;
            std::size_t far = 0, invalid = 0;
            if constexpr (motion) far = pack_motion<Dim, R>(in, i, record);
            if constexpr (density && R::template has<column::Density>)
                invalid = pack_density<Dim, R>(in, i, record);
            return far + (invalid << 32);
        });
    };
    constexpr std::true_type yes;
    constexpr std::false_type no;
    const std::size_t both = density_only        ? count(no, yes)
                             : in.rho != nullptr ? count(yes, yes)
                                                 : count(yes, no);
    if (!density_only && in.home->periods != nullptr)
        parallel_for(in.order.size(), [=, home = *in.home](std::size_t slot) {
            double* const x = records + slot * in.stride;
            for (std::size_t a = 0; a < Dim; ++a) x[a] = home(in.order[slot], a, x[a]);
        });
    return {both & 0xffffffffU, both >> 32};
}

/// A copy with a name of its own in every instruction set.
template <class R>
constexpr auto kinds_of = R::kinds;
template <int Dim, class R>
constexpr Pack<Dim> pack{
    pack_record<Dim, R>, kinds_of<R>,
    static_cast<std::size_t>(R::template has<column::Velocity> ? MotionRecord<Dim>::numbers
                                                               : PointRecord<Dim>::numbers),
    R::template has<column::Density>};

}  // namespace SPAM_LANES
}  // namespace spam
