// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/physics/scheme.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

void Scheme::validate(int dim) const {
    if (!(range > 0.0) || !std::isfinite(range))
        throw InputError(fmt::format("range: {} is not a positive length; try --range 3", range));
    if (!(closest_approach >= 0.0) || !std::isfinite(closest_approach))
        throw InputError(fmt::format(
            "closest-approach: {} is not a distance; try --closest-approach 0.7, or 0 for none",
            closest_approach));
    if (density == Density::chain_rule && transport == Transport::plain)
        throw InputError(
            "density: chain_rule differs from continuity only when particles move with an averaged "
            "velocity; add --transport average or monaghan, or use --density continuity");
    if (angular_momentum == AngularMomentum::torque_pair && dim != 2)
        throw InputError(
            fmt::format("angular-momentum: torque_pair is a plane law (one rotation axis), this "
                        "problem has {} dimension{}; use --angular-momentum free",
                        dim, dim == 1 ? "" : "s"));
}

Promises Scheme::promises(int dim) const {
    Promises p;
    if (angular_momentum == AngularMomentum::torque_pair || dim == 1)
        p.angular_momentum = Promise::integrator_error;
    return p;
}

std::string Scheme::describe() const {
    std::string words = fmt::format(
        "density {}, transport {}, {} mean density, angular momentum {}, {} weight of range {}",
        to_string(density), to_string(transport), to_string(mean_density),
        to_string(angular_momentum), to_string(kernel), range);
    if (closest_approach > 0.0)
        words += fmt::format(", approaching pairs reflected at {}", closest_approach);
    return words;
}

std::string_view to_string(Density d) {
    switch (d) {
        case Density::continuity:
            return "continuity";
        case Density::summed:
            return "summed";
        case Density::chain_rule:
            break;
    }
    return "chain_rule";
}

std::string_view to_string(Transport t) {
    switch (t) {
        case Transport::plain:
            return "plain";
        case Transport::average:
            return "average";
        case Transport::monaghan:
            break;
    }
    return "monaghan";
}

std::string_view to_string(MeanDensityKind m) {
    return m == MeanDensityKind::arithmetic ? "arithmetic" : "geometric";
}

std::string_view to_string(AngularMomentum a) {
    return a == AngularMomentum::free ? "free" : "torque_pair";
}

std::string_view to_string(Kernel) { return "lucy"; }

std::string_view to_string(Promise p) {
    switch (p) {
        case Promise::exact:
            return "exact";
        case Promise::integrator_error:
            return "to integrator error";
        case Promise::not_kept:
            break;
    }
    return "not kept";
}

}  // namespace spam
