// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/physics/scheme.hpp>

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>

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
    if (angular_momentum != AngularMomentum::free && dim == 1)
        throw InputError(
            fmt::format("angular-momentum: {} keeps what turns, and on a line nothing does; use "
                        "--angular-momentum free",
                        to_string(angular_momentum)));
    if (!(viscosity >= 0.0) || !std::isfinite(viscosity))
        throw InputError(fmt::format(
            "viscosity: {} must be 0 (none) or a positive number; try --viscosity 1", viscosity));
    if (work == Work::own && balances_torques())
        throw InputError(fmt::format(
            "work: own gives each particle the work of its own stress, and the forces that {} adds "
            "belong to no stress; use --work mean, or --angular-momentum free",
            to_string(angular_momentum)));
    if (transport == Transport::shifting) validate_shifting();
}

/// Shifting is for fluids that fill their box: no angular momentum is kept there.
void Scheme::validate_shifting() const {
    if (!(shifting > 0.0) || !std::isfinite(shifting))
        throw InputError(fmt::format(
            "shifting: {} must be a positive number; try --shifting 1, or --transport plain for none",
            shifting));
    if (density == Density::chain_rule)
        throw InputError(
            "density: chain_rule is the rate of the summed density, which shifting needs no detour to; "
            "use --density continuity or summed");
    if (angular_momentum != AngularMomentum::free)
        throw InputError(fmt::format(
            "angular-momentum: {} is for bodies in open space, and shifting for fluids that "
            "fill their box; use --angular-momentum free",
            to_string(angular_momentum)));
    if (work == Work::own)
        throw InputError(
            "work: own is for gases in which shocks run, and shifting for fluids that are hardly "
            "compressed; use --work mean, or --transport plain");
    if (closest_approach > 0.0)
        throw InputError(
            "closest-approach: shifting parts particles by itself, and moves on those that are "
            "reflected; leave --closest-approach out");
}

void Scheme::validate_distances(double spacing) const {
    if (closest_approach > 0.0 && closest_approach < 1e-3 * spacing)
        throw InputError(
            fmt::format("closest-approach: {} must be 0 (none) or at least a thousandth of the "
                        "particle spacing "
                        "{}; 0.5 to 0.9 spacings are usual",
                        closest_approach, spacing));
    if (closest_approach >= spacing)
        throw InputError(fmt::format(
            "closest-approach: {} must be below the particle spacing {}: particles that are "
            "nearer from the start are not reflected; 0.5 to 0.9 spacings are usual",
            closest_approach, spacing));
}

Promises Scheme::promises(int dim) const {
    Promises p;
    // Gauss' principle lets L go wherever it is singular.
    if (balances_torques() || dim == 1) p.angular_momentum = Promise::integrator_error;
    return p;
}

std::string Scheme::describe() const {
    std::string more, strength;
    if (transport == Transport::shifting) strength = fmt::format(" of strength {}", shifting);
    if (balance == Balance::global) more += " over all bodies";
    if (angular_momentum == AngularMomentum::gauss && gauss_singular == GaussSingular::stop)
        more += " until it is singular";
    if (work == Work::own) more += ", work of the own pressure";
    if (viscosity > 0.0) more += fmt::format(", viscosity {}", viscosity);
    if (closest_approach > 0.0)
        more += fmt::format(", approaching pairs reflected at {}", closest_approach);
    return fmt::format(
        "density {}, transport {}{}, {} mean density, angular momentum {}{}, {} weight of range {}",
        to_string(density), to_string(transport), strength, to_string(mean_density),
        to_string(angular_momentum), more, to_string(kernel), range);
}

namespace {

/// Names in the order of the enumerators.
template <class E>
std::string_view name_of(E e, std::initializer_list<std::string_view> names) {
    return names.begin()[static_cast<std::size_t>(e)];
}

}  // namespace

std::string_view to_string(Density d) { return name_of(d, {"continuity", "summed", "chain_rule"}); }
std::string_view to_string(Transport t) {
    return name_of(t, {"plain", "average", "monaghan", "shifting"});
}
std::string_view to_string(MeanDensityKind m) { return name_of(m, {"arithmetic", "geometric"}); }
std::string_view to_string(AngularMomentum a) {
    return name_of(a, {"free", "gauss", "torque_particle", "torque_pair"});
}
std::string_view to_string(Balance b) { return name_of(b, {"body", "global"}); }
std::string_view to_string(GaussSingular g) { return name_of(g, {"skip", "stop"}); }
std::string_view to_string(Work w) { return name_of(w, {"mean", "own"}); }
std::string_view to_string(Promise p) {
    return name_of(p, {"exact", "to integrator error", "not kept"});
}

}  // namespace spam
