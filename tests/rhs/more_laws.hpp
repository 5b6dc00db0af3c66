// SPDX-License-Identifier: GPL-3.0-or-later
// The laws of material that combinations.hpp has not, each with what holds it.
#pragma once

#include "rhs/combinations.hpp"
#include <spam/material/cavitation.hpp>
#include <spam/material/flowing_solid.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/material/isentropic_gas.hpp>
#include <spam/material/johnson_cook.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/material/perzyna.hpp>
#include <spam/material/smooth_hencky_solid.hpp>
#include <spam/material/smooth_yield.hpp>
#include <spam/material/van_der_waals.hpp>

namespace spam::test {

/// 0.43 and 0.43, or another lambda.
template <class Solid>
Solid elastic(const Sample& s, double lambda = 0.43) {
    return {s.stress(lambda), s.stress(0.43)};
}
inline LinearHardening hardening(const Sample& s) { return {s.stress(1e-3), s.stress(0.1)}; }

template <class MakeLaw>
Build solid_of(const MakeLaw& make) {
    return [make](Sample& s, const Scheme& scheme) {
        s.model.add_term<SmoothParticles<2>>(make(s), scheme);
    };
}
template <class MakeLaw>
Build lagrangian_of(const MakeLaw& make) {
    return [make](Sample& s, const Scheme&) {
        s.model.add_term<TotalLagrangian<2>>(make(s),
                                             TotalLagrangianScheme{s.density(), s.length(3.0)});
    };
}
template <class MakeLaw>
Build fluid_of(const MakeLaw& make) {
    return [make](Sample& s, const Scheme& scheme) { add_fluid(s, {make(s)}, scheme); };
}

inline JohnsonCook johnson_cook(const Sample& s) {
    JohnsonCook law{s.stress(1e-3), s.stress(0.1), 0.5};
    law.C = 0.1;
    law.rate_0 = 1e-3 / s.units.time;
    law.T_melt = 10.0;  // in kelvins, whatever the units
    law.heat_capacity = s.temperature(1e-3);
    law.density = s.density();
    return law;
}

/// Between two bodies, a column apart.
inline void add_contact(Sample& s) {
    std::vector<std::int32_t> body;
    const auto& x = s.model.particles().reference_position;
    for (Eigen::Index i = 0; i < x.cols(); ++i) body.push_back(x(0, i) < s.length(3.9) ? 0 : 1);
    s.model.set_bodies(body);
    s.model.add_term<Contact<2>>(ContactScheme{s.energy(0.2), s.length(1.0)});
}

inline const std::map<std::string, Build> more_laws{
    {"PlaneVonMises, which breaks", solid_of([](const Sample& s) {
         return YieldingSolid<PlaneVonMises>(
             elastic<PlaneVonMises>(s), hardening(s),
             {.plastic_strain = 0.01, .largest_stress = s.stress(3e-3), .tension = s.stress(2e-3)});
     })},
    {"PlaneStressVonMises", solid_of([](const Sample& s) {
         return YieldingSolid<PlaneStressVonMises>(elastic<PlaneStressVonMises>(s), hardening(s));
     })},
    {"JohnsonCook", solid_of([](const Sample& s) {
         return YieldingSolid<PlaneStrainVonMises, JohnsonCook>(elastic<PlaneStrainVonMises>(s),
                                                                johnson_cook(s));
     })},
    {"Perzyna", solid_of([](const Sample& s) {
         return YieldingSolid<PlaneVonMises, Perzyna>(elastic<PlaneVonMises>(s),
                                                      {hardening(s), s.time(0.3)});
     })},
    {"SmoothYield", solid_of([](const Sample& s) {
         return SmoothYield<PlaneStrainVonMises>(elastic<PlaneStrainVonMises>(s), hardening(s));
     })},
    {"HenckySolid, plane strain", lagrangian_of([](const Sample& s) {
         return HenckySolid<PlaneStrainVonMises>(elastic<PlaneStrainVonMises>(s), hardening(s));
     })},
    {"SmoothHenckySolid", lagrangian_of([](const Sample& s) {
         return SmoothHenckySolid<PlaneStrainVonMises>(elastic<PlaneStrainVonMises>(s),
                                                       hardening(s));
     })},
    {"PolynomialSolid, lagrangian",
     lagrangian_of([](const Sample& s) { return elastic<PolynomialSolid>(s); })},
    {"StVenantKirchhoff, auxetic",
     lagrangian_of([](const Sample& s) { return elastic<StVenantKirchhoff>(s, -0.1); })},
    {"FlowingSolid, which breaks",
     [](Sample& s, const Scheme&) {
         MaterialVectorScheme scheme{s.density(), s.length(2.5)};
         scheme.bond_yield = 3.0;
         scheme.stretch_limit = 1.02;
         scheme.stress_limit = s.stress(1e-3);
         s.model.add_term<MaterialVectors<2>>(
             FlowingSolid{elastic<PolynomialSolid>(s), s.stress(1e-3), s.stress(2e-3)}, scheme);
     }},
    {"SmoothYield of elements",
     [](Sample& s, const Scheme&) {
         s.model.add_term<Elements>(
             mesh_of(s.model.particles()),
             std::vector<Elements::Material>{
                 {SmoothYield<PlaneStrainVonMises>(elastic<PlaneStrainVonMises>(s), hardening(s)),
                  s.density(),
                  {0.1, 0.3}}});
     }},
    {"GammaGas", fluid_of([](const Sample&) { return GammaGas{1.4}; })},
    {"IsentropicGas", fluid_of([](const Sample& s) {
         return IsentropicGas{s.stress(0.7), s.density(), 1.7};
     })},
    {"LucyGas", fluid_of([](const Sample& s) { return LucyGas{s.of("l^4/t^2") / s.units.mass}; })},
    {"VanDerWaals", fluid_of([](const Sample& s) {
         const double b = s.of("l^2") / s.units.mass;
         return VanDerWaals{0.3 * s.temperature(1.0) * b, 0.4 * b};
     })},
    {"EmbeddedAtom", fluid_of([](const Sample& s) {
         return EmbeddedAtom{s.stress(1.0), s.density()};
     })},
    {"Cavitating", fluid_of([](const Sample& s) {
         return Cavitating<EmbeddedAtom>{{s.stress(1.0), s.density()}, s.stress(1e-3)};
     })},
    {"CavitatingEmbeddedAtom, friction by pairs",
     [](Sample& s, const Scheme& scheme) {
         Fluid fluid{CavitatingEmbeddedAtom({s.stress(1.0), s.density()}, s.stress(1e-3)),
                     NewtonViscosity{s.viscosity(0.1), s.viscosity(0.3)}};
         fluid.by_pairs = true;
         add_fluid(s, fluid, scheme);
     }},
    {"OwnRanges of VanDerWaals",
     [](Sample& s, const Scheme&) {
         const double b = s.of("l^2") / s.units.mass;
         auto& law = s.model.add_term<OwnRanges<2>>(
             Fluid{VanDerWaals{0.3 * s.temperature(1.0) * b, 0.4 * b}},
             VariableRangeScheme{2.5, Kernel::w5, true});
         s.fluid = [&law, T = s.temperature(0.2)](const Points<2>& x, const Points<2>& v) {
             return law.start(x, v, T);
         };
     }},
    {"DensityPotentialTerm with all of its parts",
     [](Sample& s, const Scheme&) {
         const double u = s.of("l^8/t^2") / s.units.mass;
         s.model.add_term<DensityPotentialTerm<2>>(DensityPotentials{
             CavitatingEmbeddedAtom({s.stress(1.0), s.density()}, s.stress(1e-3)), 0.02 * u,
             0.03 * u * s.of("l^2"), CorePotential{s.energy(0.1), s.length(1.1)}, Kernel::w5,
             s.length(3.0)});
     }},
    {"Contact of two bodies", [](Sample& s, const Scheme&) { add_contact(s); }}};

}  // namespace spam::test
