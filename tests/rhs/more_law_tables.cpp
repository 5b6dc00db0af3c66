// SPDX-License-Identifier: GPL-3.0-or-later
#include "rhs/more_law_tables.hpp"

namespace spam::test {

const Laws<2> more_plane_laws{
    {"PlaneStressVonMises", solid_of<2>([](const Sample<2>& s) {
         return YieldingSolid<PlaneStressVonMises>(elastic<PlaneStressVonMises>(s), hardening(s));
     })},
    {"SmoothYield of elements",
     [](Sample<2>& s, const Scheme&) {
         add_term<Elements>(
             s, mesh_of(s.model.particles()),
             std::vector<Elements::Material>{
                 {SmoothYield<PlaneStrainVonMises>(elastic<PlaneStrainVonMises>(s), hardening(s)),
                  s.density(),
                  {0.1, 0.3}}});
     }},
    {"cold fluid of elements",
     [](Sample<2>& s, const Scheme&) {
         add_term<Elements>(
             s, mesh_of(s.model.particles()),
             std::vector<Elements::Material>{
                 {Fluid{CavitatingEmbeddedAtom({s.stress(1.0), s.density()}, s.stress(1e-3)),
                        NewtonViscosity{s.viscosity(0.1), s.viscosity(0.3)}},
                  s.density(),
                  {0.1, 0.3}}});
     }},
    {"gas of elements", [](Sample<2>& s, const Scheme&) {
         const auto& law = add_term<Elements>(
             s, mesh_of(s.model.particles()),
             std::vector<Elements::Material>{
                 {Fluid{GammaGas{1.4}, NewtonViscosity{s.viscosity(0.1), s.viscosity(0.3)}},
                  s.density(),
                  {0.1, 0.3},
                  s.temperature(0.2)}});
         s.fluid = [&s, &law](const Points<2>&, const Points<2>& v) {
             auto y = initial_state<2>(s.model, s.density(), s.stress(0.43), at_rest<2>());
             State<2>(s.model.layout(), y).velocity() = v;
             law.warm(y);
             return y;
         };
     }}};

template const Laws<2>& more_laws<2>();

}  // namespace spam::test
