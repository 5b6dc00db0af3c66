// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of more_laws.hpp, for more_law_tables.cpp and more_law_tables_in_space.cpp.
#pragma once

#include "rhs/more_laws.hpp"
#include <spam/material/cavitation.hpp>
#include <spam/material/flowing_solid.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/material/isentropic_gas.hpp>
#include <spam/material/johnson_cook.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/material/perzyna.hpp>
#include <spam/material/smooth_hencky_solid.hpp>
#include <spam/material/smooth_yield.hpp>
#include <spam/material/van_der_waals_isotherm.hpp>
#include <spam/rhs/ellipses.hpp>
#include <spam/rhs/reaction.hpp>

namespace spam::test {

template <int Dim, class MakeLaw>
Build<Dim> lagrangian_of(const MakeLaw& make) {
    return [make](Sample<Dim>& s, const Scheme&) {
        add_term<TotalLagrangian<Dim>>(s, make(s),
                                       TotalLagrangianScheme{s.density(), s.length(3.0)});
    };
}
template <int Dim>
JohnsonCook johnson_cook(const Sample<Dim>& s) {
    JohnsonCook law{s.stress(1e-3), s.stress(0.1), 0.5};
    law.C = 0.1;
    law.rate_0 = 1e-3 / s.units.time;
    law.T_melt = 10.0;  // in kelvins, whatever the units
    law.heat_capacity = s.temperature(1e-3);
    law.density = s.density();
    return law;
}

/// Between two bodies, a column apart.
template <int Dim>
void add_contact(Sample<Dim>& s) {
    std::vector<std::int32_t> body;
    const auto& x = s.model.particles().reference_position;
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        body.push_back(x(0, i) < s.length(Dim == 2 ? 3.9 : 1.9) ? 0 : 1);
    s.model.set_bodies(body);
    add_term<Contact<Dim>>(s, ContactScheme{s.energy(0.2), s.length(1.0)});
}

template <int Dim>
const Laws<Dim>& more_laws() {
    static const Laws<Dim> table{
        {"VonMises, which breaks", solid_of<Dim>([](const Sample<Dim>& s) {
             return YieldingSolid<RadialVonMises<Dim>>(elastic<RadialVonMises<Dim>>(s),
                                                       hardening(s),
                                                       {.plastic_strain = 0.01,
                                                        .largest_stress = s.stress(3e-3),
                                                        .tension = s.stress(2e-3)});
         })},
        {"JohnsonCook", solid_of<Dim>([](const Sample<Dim>& s) {
             return YieldingSolid<StrainedVonMises<Dim>, JohnsonCook>(
                 elastic<StrainedVonMises<Dim>>(s), johnson_cook(s));
         })},
        {"Perzyna", solid_of<Dim>([](const Sample<Dim>& s) {
             return YieldingSolid<RadialVonMises<Dim>, Perzyna>(elastic<RadialVonMises<Dim>>(s),
                                                                {hardening(s), s.time(0.3)});
         })},
        {"SmoothYield", solid_of<Dim>([](const Sample<Dim>& s) {
             return SmoothYield<StrainedVonMises<Dim>>(elastic<StrainedVonMises<Dim>>(s),
                                                       hardening(s));
         })},
        {"HenckySolid", lagrangian_of<Dim>([](const Sample<Dim>& s) {
             return HenckySolid<StrainedVonMises<Dim>>(elastic<StrainedVonMises<Dim>>(s),
                                                       hardening(s));
         })},
        {"SmoothHenckySolid", lagrangian_of<Dim>([](const Sample<Dim>& s) {
             return SmoothHenckySolid<StrainedVonMises<Dim>>(elastic<StrainedVonMises<Dim>>(s),
                                                             hardening(s));
         })},
        {"PolynomialSolid, lagrangian",
         lagrangian_of<Dim>([](const Sample<Dim>& s) { return elastic<PolynomialSolid>(s); })},
        {"StVenantKirchhoff, auxetic", lagrangian_of<Dim>([](const Sample<Dim>& s) {
             return elastic<StVenantKirchhoff>(s, -0.1);
         })},
        {"FlowingSolid, which breaks",
         [](Sample<Dim>& s, const Scheme&) {
             MaterialVectorScheme scheme{s.density(), s.length(2.5)};
             scheme.bond_yield = 3.0;
             scheme.stretch_limit = 1.02;
             scheme.stress_limit = s.stress(1e-3);
             add_term<MaterialVectors<Dim>>(
                 s, FlowingSolid{elastic<PolynomialSolid>(s), s.stress(1e-3), s.stress(2e-3)},
                 scheme);
         }},
        {"GammaGas", fluid_of<Dim>([](const Sample<Dim>&) { return GammaGas{1.4}; })},
        {"IsentropicGas", fluid_of<Dim>([](const Sample<Dim>& s) {
             return IsentropicGas{s.stress(0.7), s.density(), 1.7};
         })},
        {"LucyGas",
         fluid_of<Dim>([](const Sample<Dim>& s) { return LucyGas{s.of("l^2 l^D/t^2 m")}; })},
        {"VanDerWaals", fluid_of<Dim>([](const Sample<Dim>& s) {
             const double b = s.of("l^D/m");
             return VanDerWaals{0.3 * s.temperature(1.0) * b, 0.4 * b};
         })},
        {"EmbeddedAtom", fluid_of<Dim>([](const Sample<Dim>& s) {
             return EmbeddedAtom{s.stress(1.0), s.density()};
         })},
        {"Cavitating", fluid_of<Dim>([](const Sample<Dim>& s) {
             return Cavitating<EmbeddedAtom>{{s.stress(1.0), s.density()}, s.stress(1e-3)};
         })},
        {"CavitatingEmbeddedAtom, friction by pairs",
         [](Sample<Dim>& s, const Scheme& scheme) {
             Fluid fluid{CavitatingEmbeddedAtom({s.stress(1.0), s.density()}, s.stress(1e-3)),
                         NewtonViscosity{s.viscosity(0.1), s.viscosity(0.3)}};
             fluid.by_pairs = true;
             add_fluid(s, fluid, scheme);
         }},
        {"OwnRanges of VanDerWaals",
         [](Sample<Dim>& s, const Scheme&) {
             const double b = s.of("l^D/m");
             auto& law = add_term<OwnRanges<Dim>>(
                 s, Fluid{VanDerWaals{0.3 * s.temperature(1.0) * b, 0.4 * b}},
                 VariableRangeScheme{2.5, Kernel::w5, true});
             s.fluid = [&law, T = s.temperature(0.2)](const Points<Dim>& x, const Points<Dim>& v) {
                 return law.start(x, v, T);
             };
         }},
        {"DensityPotentialTerm with all of its parts",
         [](Sample<Dim>& s, const Scheme&) {
             const double u = s.of("l^4 l^D l^D/t^2 m");
             add_term<DensityPotentialTerm<Dim>>(
                 s, DensityPotentials{
                        CavitatingEmbeddedAtom({s.stress(1.0), s.density()}, s.stress(1e-3)),
                        0.02 * u, 0.03 * u * s.of("l^2"),
                        CorePotential{s.energy(0.1), s.length(1.1)}, Kernel::w5, s.length(3.0)});
         }},
        {"DensityPotentialTerm of a VanDerWaalsIsotherm",
         [](Sample<Dim>& s, const Scheme&) {
             const double b = s.of("l^D/m"), T = s.temperature(0.2);
             add_term<DensityPotentialTerm<Dim>>(
                 s, DensityPotentials{.state = VanDerWaalsIsotherm{0.3 * T * b, 0.4 * b, T},
                                      .range = s.length(3.0)});
         }},
        {"Contact of two bodies", [](Sample<Dim>& s, const Scheme&) { add_contact(s); }},
        {"LongRange in a gas",
         [](Sample<Dim>& s, const Scheme& scheme) {
             add_fluid(s, {IdealGas{}}, scheme);
             add_term<LongRange<Dim>>(
                 s, LongRangeScheme{-0.05 * s.of("l^3/t^2 m"), s.length(0.3), {}});
         }},
        {"Reaction in a gas",
         [](Sample<Dim>& s, const Scheme& scheme) {
             add_fluid(s, {IdealGas{}}, scheme);
             add_term<Reaction<Dim>>(s, ReactionScheme{.diffusivity = 0.3 * s.of("l^2/t"),
                                                       .rate = 0.7 / s.units.time,
                                                       .heat = s.temperature(0.4),
                                                       .range = s.length(3.0)});
             s.fluid = [&s, before = s.fluid](const Points<Dim>& x, const Points<Dim>& v) {
                 auto y = before(x, v);
                 double* const c = State<Dim>(s.model.layout(), y).find(field_kind::concentration);
                 for (Eigen::Index i = 0; i < x.cols(); ++i)
                     c[i] = 0.5 + 0.4 * std::sin(x(0, i) / s.units.length);
                 return y;
             };
         }},
        {"Ellipses", [](Sample<Dim>& s, const Scheme&) {
             auto& law = add_term<Ellipses<Dim>>(
                 s, Fluid{GammaGas{1.4}},
                 EllipseScheme{.range = s.length(3.0), .largest_aspect = 1.2});
             s.fluid = [&law, T = s.temperature(0.2)](const Points<Dim>& x, const Points<Dim>& v) {
                 return law.start(x, v, T);
             };
         }}};
    return table;
}

}  // namespace spam::test
