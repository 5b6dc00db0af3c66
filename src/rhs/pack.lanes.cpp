// SPDX-License-Identifier: GPL-3.0-or-later
#include "pack.hpp"

#include <spam/core/parallel.hpp>
#include <spam/core/tensor.hpp>
#include <spam/physics/mean_density.hpp>

namespace spam {
namespace {

template <int Dim>
[[gnu::always_inline]] inline std::size_t pack_density(const PackInput<Dim>& in, std::size_t i,
                                                       double* record) {
    constexpr auto n = static_cast<std::size_t>(symmetric_size(Dim));
    const double rho = in.rho[i], scale = 1.0 / (rho * rho);
    record[2 * Dim + 1] = EitherMean::number(in.mean_density, rho);
    for (std::size_t k = 0; k < n; ++k) record[2 * Dim + 2 + k] = scale * in.sigma[i * n + k];
    return static_cast<std::size_t>(!(rho > 0.0));
}

template <int Dim>
[[gnu::always_inline]] inline std::size_t pack_motion(const PackInput<Dim>& in, std::size_t i,
                                                      double* record) {
    // Read before anything is written: for all the compiler knows that may change what is read.
    const double* const from = in.x + Dim * i;
    double x[Dim];
    for (std::size_t a = 0; a < Dim; ++a) x[a] = from[a];
    const std::size_t far = in.displacement.too_far(i, x);
    for (std::size_t a = 0; a < Dim; ++a) record[a] = x[a];
    for (std::size_t a = 0; a < Dim; ++a) record[Dim + a] = in.v[Dim * i + a];
    record[2 * Dim] = in.m[i];
    return far;
}

/// Counts in one number, `far` in the lower half: fewer than 2^32 particles have slots.
template <class Body>
PackCount count(std::size_t slots, const Body& body) {
    const std::size_t both = parallel_count(slots, body);
    return {both & 0xffffffffU, both >> 32};
}

template <int Dim>
PackCount pack(const PackInput<Dim>& whole, bool density_only, double* records) {
    const PackInput<Dim> in = whole;  // a copy that the stores below cannot be suspected to change
    if (density_only)
        return count(in.slots, [=](std::size_t slot) {
            return pack_density(in, in.order[slot], records + slot * in.stride) << 32;
        });
    const auto motion = [=](std::size_t slot) {
        return pack_motion(in, in.order[slot], records + slot * in.stride);
    };
    PackCount counted =
        in.rho == nullptr ? count(in.slots, motion) : count(in.slots, [=](std::size_t slot) {
            const std::size_t i = in.order[slot];
            double* const record = records + slot * in.stride;
            return pack_motion(in, i, record) + (pack_density(in, i, record) << 32);
        });
    if (in.box->periodic())
        parallel_for(in.slots, [=](std::size_t slot) {
            for (int a = 0; a < Dim; ++a) {
                double& x = records[slot * in.stride + static_cast<std::size_t>(a)];
                if (in.box->periodic(a)) x = in.box->wrap(a, x);
            }
        });
    return counted;
}

}  // namespace

template <int Dim, InstructionSet Level>
Pack<Dim> pack_for() {
    return pack<Dim>;
}

template Pack<1> pack_for<1, InstructionSet::SPAM_LEVEL>();
template Pack<2> pack_for<2, InstructionSet::SPAM_LEVEL>();
template Pack<3> pack_for<3, InstructionSet::SPAM_LEVEL>();

}  // namespace spam
