// SPDX-License-Identifier: GPL-3.0-or-later
// What laws of fluids ask of the fluids they are given, one or several.
#pragma once

#include <spam/material/fluid.hpp>
#include <spam/physics/fluid_record.hpp>
#include <spam/physics/pair_friction.hpp>
#include <spam/physics/scheme.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace spam {

/// Whether it has friction or conduction, of gradients or of pairs.
bool by_gradients(const Fluid& fluid);
bool by_pairs(const Fluid& fluid);
bool conducts(const Fluid& fluid);
inline bool diffuses(const Fluid& fluid) { return fluid.diffuses(); }
/// Whether its energy is a function of its density.
inline bool cold(const Fluid& fluid) { return fluid.state.cold; }
bool any(const std::vector<Fluid>& fluids, bool (*is)(const Fluid&));

/// "a | b"
std::string describe(const std::vector<Fluid>& fluids);
/// That of particle i, by Particles::material.
inline const Fluid& fluid_of(const std::vector<Fluid>& fluids,
                             const std::vector<std::int32_t>& material, std::size_t i) {
    return fluids[material.empty() ? 0 : static_cast<std::size_t>(material[i])];
}

/// Throws InputError for friction or conduction by which entropy would decrease, and for conduction without a
/// temperature.
void check_fluid(const Fluid& fluid, int dim);
/// The same for each of several, of which there must be one at least; and for friction of pairs in some and of
/// gradients in others, or a conducting one beside one without a temperature.
void check_fluids(const std::vector<Fluid>& fluids, int dim);
/// Throws InputError where smooth particles of these fluids do not go with the scheme.
void check_scheme(const std::vector<Fluid>& fluids, const Scheme& scheme);
/// Whether its forces have parts across r_ij.
bool has_shear(const Fluid& fluid);
/// For passes over pairs (physics/pair_friction.hpp). Inline: of a particle's constants no others are written.
inline void set_pair_constants(const Fluid& fluid, PassConstants& constants) {
    if (const auto& newton = fluid.viscosity) {
        constants.shear = newton->eta;
        constants.second_viscosity = newton->lambda;
    }
    if (fluid.conduction) constants.conductivity = fluid.conduction->kappa;
}
/// The last columns of records of fluids that may differ (FrictionRecord, RubbingRangeRecord): their numbers from
/// `from` on.
inline constexpr int pair_factors = 3;
template <class R, int Dim, int from>
void write_pair_factors(const Fluid& fluid, double* number) {
    static_assert(R::template at<column::ShearViscosity> == from &&
                  R::template at<column::LongitudinalViscosity> == from + 1 &&
                  R::template at<column::ConductionFactor> == from + 2);
    PassConstants constants;
    set_pair_constants(fluid, constants);
    number[0] = constants.shear;
    number[1] = 2.0 * constants.shear + constants.second_viscosity;
    number[2] = PairConduction::with(constants).twice_kappa;
}
/// What the sum over F of pairs is multiplied by in the rate at which neighbours that move against each other, and what
/// they differ in temperature, come to rest (physics/pair_friction.hpp), by 2/rho^2; 0 without.
double pair_damping(const Fluid& fluid, int dim, double rho, double e);

/// f(material, first, count) for the runs of equal material among the entries [first, first + count) of
/// `material`; one run where that is empty.
template <class F>
void for_each_material(const std::vector<std::int32_t>& material, std::size_t first,
                       std::size_t count, const F& f) {
    if (material.empty()) {
        if (count > 0) f(std::size_t{0}, first, count);
        return;
    }
    for (std::size_t end = first + count; first < end;) {
        std::size_t next = first + 1;
        while (next < end && material[next] == material[first]) ++next;
        f(static_cast<std::size_t>(material[first]), first, next - first);
        first = next;
    }
}

}  // namespace spam
