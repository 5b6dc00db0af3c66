// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluids.hpp"

#include <spam/core/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

/// Of lambda by eta, where it is made of a bulk viscosity.
constexpr double rounding = 1e-14;

/// Where friction and conduction are those of pairs.
void check_pairs(const std::vector<Fluid>& fluids, const Scheme& scheme) {
    if (any(fluids, by_pairs) && scheme.balances_torques() && any(fluids, has_shear))
        throw InputError(
            "friction: that of pairs is no stress, and balanced torques scale what of stresses acts across r_ij; "
            "take lambda = eta, by which pairs act along r_ij, or friction by gradients, or --angular-momentum "
            "free");
}

void check_shifting(const std::vector<Fluid>& fluids, const Scheme& scheme) {
    if (scheme.transport == Transport::shifting && fluids.size() > 1)
        throw InputError(
            "transport: shifting would mix fluids, and several are given; use --transport plain, or "
            "one fluid");
}

void check_work(const std::vector<Fluid>& fluids, const Scheme& scheme) {
    if (scheme.work == Work::mean || any(fluids, [](const Fluid& f) { return f.state.thermal; }))
        return;
    throw InputError(fmt::format(
        "work: own is for laws with a temperature, and the pressure of ({}) does not depend on the "
        "energy: no particle can lack heat; use --work mean",
        fluids.front().state.describe()));
}

/// <v> changes the angular momentum, and without shear the torques that are to make up for it are rounding
/// errors.
void check_torques(const std::vector<Fluid>& fluids, const Scheme& scheme) {
    if (!scheme.balances_torques() || scheme.transport != Transport::average) return;
    if (any(fluids, has_shear)) return;
    throw InputError(fmt::format(
        "angular-momentum: {} scales what of the forces acts across r_ij, of which a fluid without friction, or "
        "with that of pairs along r_ij, has nothing; use --angular-momentum free, or --transport plain or monaghan, which keep it",
        to_string(scheme.angular_momentum)));
}

void check_temperature(const Fluid& fluid) {
    if (fluid.state.thermal) return;
    throw InputError(fmt::format(
        "conduction: needs a temperature, and the law ({}) has none; use an ideal gas or van der "
        "Waals, or leave the conductivity out",
        fluid.state.describe()));
}

}  // namespace

bool by_gradients(const Fluid& fluid) { return fluid.diffuses() && !fluid.by_pairs; }
bool by_pairs(const Fluid& fluid) { return fluid.diffuses() && fluid.by_pairs; }

bool any(const std::vector<Fluid>& fluids, bool (*is)(const Fluid&)) {
    return std::any_of(fluids.begin(), fluids.end(), is);
}

bool conducts(const Fluid& fluid) { return fluid.conduction && fluid.conduction->kappa > 0.0; }

bool has_shear(const Fluid& fluid) {
    const auto& newton = fluid.viscosity;
    return newton && newton->eta > 0.0 &&
           !(fluid.by_pairs && std::abs(newton->eta - newton->lambda) <= rounding * newton->eta);
}

void check_fluid(const Fluid& fluid, int dim) {
    const auto refuse_negative = [](const char* name, double value) {
        if (!(value >= 0.0) || !std::isfinite(value))
            throw InputError(fmt::format(
                "{}: {:g} must be 0 or positive, or entropy would decrease", name, value));
    };
    if (fluid.viscosity) {
        refuse_negative("shear viscosity", fluid.viscosity->eta);
        const double bulk = fluid.viscosity->bulk_viscosity(dim);
        // lambda = -eta in the plane is exactly no bulk viscosity, up to rounding.
        if (std::abs(bulk) > rounding * fluid.viscosity->eta)
            refuse_negative("bulk viscosity", bulk);
        if (fluid.by_pairs &&
            std::abs(fluid.viscosity->lambda) > fluid.viscosity->eta * (1.0 + rounding))
            throw InputError(fmt::format(
                "friction: that of pairs needs -eta <= lambda <= eta, and eta = {:g}, lambda = {:g}; "
                "choose another bulk viscosity",
                fluid.viscosity->eta, fluid.viscosity->lambda));
    }
    if (!fluid.conduction) return;
    refuse_negative("conductivity", fluid.conduction->kappa);
    if (conducts(fluid)) check_temperature(fluid);
}

void check_fluids(const std::vector<Fluid>& fluids, int dim) {
    if (fluids.empty()) throw InputError("material: none is given; give one at least");
    for (const Fluid& fluid : fluids) {
        check_fluid(fluid, dim);
        if (any(fluids, conducts)) check_temperature(fluid);
    }
    if (any(fluids, by_pairs) && any(fluids, by_gradients))
        throw InputError(
            "friction: some of the fluids have that of pairs and others that of gradients, and no law says what "
            "acts between the two; set by_pairs of all that have friction or conduction, or of none");
}

void check_scheme(const std::vector<Fluid>& fluids, const Scheme& scheme) {
    check_pairs(fluids, scheme);
    check_shifting(fluids, scheme);
    check_work(fluids, scheme);
    check_torques(fluids, scheme);
}

std::string describe(const std::vector<Fluid>& fluids) {
    std::string words;
    for (const Fluid& fluid : fluids) words += (words.empty() ? "" : " | ") + fluid.describe();
    return words;
}

double pair_damping(const Fluid& fluid, int dim, double rho, double e) {
    if (!fluid.by_pairs) return 0.0;
    double most = 0.0;
    if (const auto& newton = fluid.viscosity)
        most = newton->eta - newton->lambda + (dim + 2.0) / dim * (newton->lambda + newton->eta);
    if (fluid.conduction)
        most = std::max(most, 2.0 * fluid.conduction->kappa / fluid.state.heat_capacity(rho, e));
    return most;
}

}  // namespace spam
