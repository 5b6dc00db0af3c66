// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of combined_laws.hpp, for law_tables.cpp and law_tables_in_space.cpp.
#pragma once

#include "rhs/combined_laws.hpp"

namespace spam::test {

/// Laws that a scheme belongs to.
template <int Dim>
const Laws<Dim>& with_scheme() {
    static const Laws<Dim> table{
        {"SmoothParticles, solid",
         [](Sample<Dim>& s, const Scheme& scheme) {
             add_term<SmoothParticles<Dim>>(s, elastic<ElasticSolid>(s), scheme);
         }},
        {"SmoothParticles, solid that yields",
         [](Sample<Dim>& s, const Scheme& scheme) {
             add_term<SmoothParticles<Dim>>(s,
                                            YieldingSolid<StrainedVonMises<Dim>>(
                                                elastic<StrainedVonMises<Dim>>(s), hardening(s)),
                                            scheme);
         }},
        {"SmoothParticles, gas",
         [](Sample<Dim>& s, const Scheme& scheme) { add_fluid(s, {IdealGas{Dim}}, scheme); }},
        {"SmoothParticles, gas, friction by pairs and work of its own stress",
         [](Sample<Dim>& s, Scheme scheme) {
             scheme.work = Work::own;
             Fluid fluid{IdealGas{Dim}, NewtonViscosity{s.viscosity(0.1), s.viscosity(0.3)},
                         FourierConduction{s.viscosity(0.2)}};
             fluid.by_pairs = true;
             add_fluid(s, fluid, scheme);
         }},
        {"SmoothParticles, fluid with friction and conduction",
         [](Sample<Dim>& s, const Scheme& scheme) {
             add_fluid(s,
                       {IdealGas{Dim}, NewtonViscosity{s.viscosity(0.1), s.viscosity(0.3)},
                        FourierConduction{s.viscosity(0.2)}},
                       scheme);
         }}};
    return table;
}

/// Laws that make a body by themselves.
template <int Dim>
const Laws<Dim>& without_scheme() {
    static const Laws<Dim> table{
        {"OwnRanges",
         [](Sample<Dim>& s, const Scheme&) {
             auto& law = add_term<OwnRanges<Dim>>(s, Fluid{IdealGas{Dim}}, VariableRangeScheme{});
             s.fluid = [&law, T = s.temperature(0.2)](const Points<Dim>& x, const Points<Dim>& v) {
                 return law.start(x, v, T);
             };
         }},
        {"OwnRanges, friction and conduction by pairs",
         [](Sample<Dim>& s, const Scheme&) {
             Fluid fluid{IdealGas{Dim}, NewtonViscosity{s.viscosity(0.1), s.viscosity(0.3)},
                         FourierConduction{s.viscosity(0.2)}};
             fluid.by_pairs = true;
             auto& law = add_term<OwnRanges<Dim>>(s, fluid, VariableRangeScheme{3.0, Kernel::w4});
             s.fluid = [&law, T = s.temperature(0.2)](const Points<Dim>& x, const Points<Dim>& v) {
                 return law.start(x, v, T);
             };
         }},
        {"DensityPotentialTerm",
         [](Sample<Dim>& s, const Scheme&) {
             add_term<DensityPotentialTerm<Dim>>(
                 s, DensityPotentials{.state = EmbeddedAtom{s.stress(1.0), s.density()},
                                      .range = s.length(3.0)});
         }},
        {"Cohesion",
         [](Sample<Dim>& s, const Scheme&) {
             add_term<Cohesion<Dim>>(s, CohesivePotential{s.energy(1.0), s.length(1.0)});
         }},
        {"WeightPotential", [](Sample<Dim>& s, const Scheme&) { add_lucy(s, 3.0); }},
        {"TotalLagrangian",
         [](Sample<Dim>& s, const Scheme&) {
             add_term<TotalLagrangian<Dim>>(s, elastic<StVenantKirchhoff>(s),
                                            TotalLagrangianScheme{s.density(), s.length(3.0)});
         }},
        {"TotalLagrangian, solid that yields",
         [](Sample<Dim>& s, const Scheme&) {
             add_term<TotalLagrangian<Dim>>(
                 s, HenckySolid<RadialVonMises<Dim>>(elastic<RadialVonMises<Dim>>(s), hardening(s)),
                 TotalLagrangianScheme{s.density(), s.length(3.0)});
         }},
        {"TotalLagrangian, stress by its rate, yields",
         [](Sample<Dim>& s, const Scheme&) {
             add_term<TotalLagrangian<Dim>>(
                 s,
                 StressInReference<YieldingSolid<StrainedVonMises<Dim>>, Dim>(
                     {elastic<StrainedVonMises<Dim>>(s), hardening(s)}, s.density(),
                     s.stress(0.43)),
                 TotalLagrangianScheme{s.density(), s.length(3.0)});
         }},
        {"MaterialVectors",
         [](Sample<Dim>& s, const Scheme&) {
             add_term<MaterialVectors<Dim>>(s, elastic<PolynomialSolid>(s),
                                            MaterialVectorScheme{s.density(), s.length(3.0)});
         }},
        {"Springs", [](Sample<Dim>& s, const Scheme&) { add_springs(s); }}};
    return table;
}

/// What is put on top.
template <int Dim>
const std::map<std::string, Add<Dim>>& further() {
    static const std::map<std::string, Add<Dim>> table{
        {"", [](Sample<Dim>&) {}},
        {"Core",
         [](Sample<Dim>& s) {
             add_term<Core<Dim>>(s, CorePotential{s.energy(0.1), s.length(1.1)});
         }},
        {"Contact",
         [](Sample<Dim>& s) {
             add_term<Contact<Dim>>(s, ContactScheme{s.energy(0.2), s.length(1.0), s.length(1.2)});
         }},
        {"Springs", [](Sample<Dim>& s) { add_springs(s); }},
        {"ArtificialViscosity",
         [](Sample<Dim>& s) {
             add_term<ArtificialViscosity<Dim>>(
                 s, typename ArtificialViscosity<Dim>::Constants{.range = s.length(3.0),
                                                                 .density = s.density(),
                                                                 .sound_speed = s.velocity(1.2),
                                                                 .kernel = Kernel::w4});
         }},
        {"ReflectedPairs", [](Sample<Dim>& s) { add_term<ReflectedPairs<Dim>>(s, s.length(0.5)); }},
        {"WeightPotential", [](Sample<Dim>& s) { add_lucy(s, 2.5); }},
        {"DensityPotentialTerm", [](Sample<Dim>& s) {
             add_term<DensityPotentialTerm<Dim>>(
                 s, DensityPotentials{.surface_tension = 0.02 * s.of("l^4 l^D l^D/t^2 m"),
                                      .kernel = Kernel::w4,
                                      .range = s.length(3.0)});
         }}};
    return table;
}

template <int Dim>
const std::map<std::string, Add<Dim>>& externals() {
    static const std::map<std::string, Add<Dim>> table{
        {"", [](Sample<Dim>&) {}},
        {"Gravity",
         [](Sample<Dim>& s) {
             add_external<Gravity<Dim>>(s, s.acceleration(1.0) * point<Dim>(0.003, -0.01, 0.007));
         }},
        {"Friction", [](Sample<Dim>& s) { add_external<Friction<Dim>>(s, 0.1 / s.units.time); }},
        {"Drag",
         [](Sample<Dim>& s) {
             add_external<Drag<Dim>>(s, 0.5 / s.units.length, s.velocity(1.0),
                                     s.velocity(1.0) * point<Dim>(0.1, 0.0, 0.05));
         }},
        {"Thermostat",
         [](Sample<Dim>& s) {
             add_external<Thermostat<Dim>>(s, s.energy(1e-3), 0.3 / s.units.time);
         }},
        {"Load",
         [](Sample<Dim>& s) {
             add_external<Load<Dim>>(s, [a = s.acceleration(1.0), T = s.units.time](double t) {
                 return Point<Dim>(a * point<Dim>(0.01 * t / T, 0.02, -0.01));
             });
         }},
        {"DistributedLoad",
         [](Sample<Dim>& s) {
             add_external<DistributedLoad<Dim>>(
                 s,
                 [a = 1.0 / (s.units.time * s.units.time), T = s.units.time](double t) {
                     return a * (0.01 + 0.02 * t / T);
                 },
                 of_whole<Dim>(s.model.particles().reference_position));
         }},
        {"RigidWall",
         [](Sample<Dim>& s) {
             add_external<RigidWall<Dim>>(
                 s, point<Dim>(0.9, 0.4, 0.3),
                 [L = s.units.length, T = s.units.time](double t) {
                     return L * (0.1 * t / T - 0.2);
                 },
                 s.energy(0.2), s.length(1.0));
         }},
        {"Clamp", [](Sample<Dim>& s) {
             const auto left = [most = s.length(1.2)](const Point<Dim>& x) { return x.x() < most; };
             add_external<Clamp<Dim>>(s, of_whole(select<Dim>(s.model.particles(), left)));
         }}};
    return table;
}

}  // namespace spam::test
