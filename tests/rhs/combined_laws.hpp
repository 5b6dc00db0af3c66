// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of matter, further terms and externals that are combined with each other.
#pragma once

#include "support/own_part.hpp"
#include <spam/core/dimensions.hpp>
#include <spam/external/clamp.hpp>
#include <spam/external/distributed_load.hpp>
#include <spam/external/drag.hpp>
#include <spam/external/friction.hpp>
#include <spam/external/gravity.hpp>
#include <spam/external/load.hpp>
#include <spam/external/rigid_velocity.hpp>
#include <spam/external/rigid_wall.hpp>
#include <spam/external/thermostat.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/hencky_solid.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/material/stress_in_reference.hpp>
#include <spam/material/yielding_solid.hpp>
#include <spam/rhs/artificial_viscosity.hpp>
#include <spam/rhs/contact.hpp>
#include <spam/rhs/density_potentials.hpp>
#include <spam/rhs/elements.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/reflected_pairs.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <map>

namespace spam::test {

inline const double site_density = 2.0 / std::sqrt(3.0);

/// A model on the way, and how its y begins. Numbers of laws are those of units in which particles have mass
/// and spacing 1; of `units` they are given in others.
struct Sample {
    /// In a periodic box particles fill it.
    explicit Sample(const Box<2>& box = {}, const Units& in = {})
        : units(in),
          model(own_part(make_particles<2>(triangular_block(8, box.periodic() ? 6 : 5, in.length),
                                           in.mass, in.length, box)),
                box) {}
    Units units;
    ParticleModel<2> model;
    std::function<std::vector<double>(const Points<2>&, const Points<2>&)> fluid{};
    double speed = 1.0;  ///< times the velocities at the start

    double of(const char* unit) const { return units.of(unit, 2); }
    double length(double x) const { return x * units.length; }
    double time(double x) const { return x * units.time; }
    double velocity(double x) const { return x * of("l/t"); }
    double acceleration(double x) const { return x * of("l/t^2"); }
    double stress(double x) const { return x * of("m/t^2"); }
    double viscosity(double x) const {
        return x * of("m/t");
    }  ///< and kappa, where T is energy by mass
    double energy(double x) const { return x * of("m l^2/t^2"); }
    double temperature(double x) const { return x * of("l^2/t^2"); }
    double density() const { return site_density * of("m/l^2"); }
    Scheme scheme(Scheme s) const {
        s.range = length(s.range);
        s.closest_approach = length(s.closest_approach);
        return s;
    }

    std::vector<double> start() {
        const Points<2>& x = model.particles().reference_position;
        Points<2> v(2, x.cols());
        for (Eigen::Index i = 0; i < x.cols(); ++i) {
            const Point<2> X = x.col(i) / units.length;
            v(0, i) = X[0] < 1.2 ? 0.0 : 0.02 * std::sin(0.7 * X[0]) - 0.01 * X[1];
            v(1, i) = X[0] < 1.2 ? 0.0 : 0.01 * X[0] + 0.02 * std::cos(0.9 * X[1]);
        }
        v *= velocity(speed);
        if (fluid) return fluid(x, v);
        auto y = initial_state<2>(model, density(), stress(0.43),
                                  [](const Point<2>&) { return Point<2>::Zero().eval(); });
        State<2>(model.layout(), y).velocity() = v;
        return y;
    }
};

using Build = std::function<void(Sample&, const Scheme&)>;

inline void add_fluid(Sample& s, const Fluid& fluid, const Scheme& scheme) {
    auto& law = s.model.add_term<SmoothParticles<2>>(fluid, scheme);
    s.fluid = [&law, T = s.temperature(0.2)](const Points<2>& x, const Points<2>& v) {
        return law.start(x, v, T);
    };
}

/// Laws that a scheme belongs to.
inline const std::map<std::string, Build> with_scheme{
    {"SmoothParticles, solid",
     [](Sample& s, const Scheme& scheme) {
         s.model.add_term<SmoothParticles<2>>(ElasticSolid{s.stress(0.43), s.stress(0.43)}, scheme);
     }},
    {"SmoothParticles, solid that yields",
     [](Sample& s, const Scheme& scheme) {
         s.model.add_term<SmoothParticles<2>>(
             YieldingSolid<PlaneStrainVonMises>({s.stress(0.43), s.stress(0.43)},
                                                LinearHardening{s.stress(1e-3), s.stress(0.1)}),
             scheme);
     }},
    {"SmoothParticles, gas",
     [](Sample& s, const Scheme& scheme) { add_fluid(s, {IdealGas{}}, scheme); }},
    {"SmoothParticles, gas, friction and work of its own stress",
     [](Sample& s, Scheme scheme) {
         scheme.work = Work::own;
         add_fluid(s, {IdealGas{}, NewtonViscosity{s.viscosity(0.1), s.viscosity(0.3)}}, scheme);
     }},
    {"SmoothParticles, fluid with friction and conduction", [](Sample& s, const Scheme& scheme) {
         add_fluid(s,
                   {IdealGas{}, NewtonViscosity{s.viscosity(0.1), s.viscosity(0.3)},
                    FourierConduction{s.viscosity(0.2)}},
                   scheme);
     }}};

inline void add_lucy(Sample& s, double range) {
    s.model.add_term<WeightPotential<2>>(s.length(range), s.of("l^4/t^2") / s.units.mass);
}
inline void add_springs(Sample& s) {
    s.model.add_term<Springs<2>>(HarmonicSpring{s.stress(1.0), s.length(1.0)});
}

/// Between the rows of triangular_block(8, ...), whose numbers are the ids.
inline std::vector<Quadrilateral> mesh_of(const Particles<2>& particles) {
    const auto most = std::max_element(particles.id.begin(), particles.id.end());
    std::vector<std::uint32_t> stored(static_cast<std::size_t>(*most) + 1);
    for (std::uint32_t k = 0; k < stored.size(); ++k)
        stored[static_cast<std::size_t>(particles.id[k])] = k;
    std::vector<Quadrilateral> mesh;
    for (std::size_t i = 0; i + 9 < stored.size(); ++i)
        if (i % 8 != 7) mesh.push_back({stored[i], stored[i + 1], stored[i + 9], stored[i + 8]});
    return mesh;
}

/// Laws that make a body by themselves.
inline const std::map<std::string, Build> without_scheme{
    {"OwnRanges",
     [](Sample& s, const Scheme&) {
         auto& law = s.model.add_term<OwnRanges<2>>(Fluid{IdealGas{}}, VariableRangeScheme{});
         s.fluid = [&law, T = s.temperature(0.2)](const Points<2>& x, const Points<2>& v) {
             return law.start(x, v, T);
         };
     }},
    {"DensityPotentialTerm",
     [](Sample& s, const Scheme&) {
         s.model.add_term<DensityPotentialTerm<2>>(DensityPotentials{
             .state = EmbeddedAtom{s.stress(1.0), s.density()}, .range = s.length(3.0)});
     }},
    {"Elements",
     [](Sample& s, const Scheme&) {
         s.model.add_term<Elements>(
             mesh_of(s.model.particles()),
             std::vector<Elements::Material>{
                 {YieldingSolid<PlaneVonMises>({s.stress(0.43), s.stress(0.43)},
                                               LinearHardening{s.stress(1e-3), s.stress(0.1)}),
                  s.density(),
                  {0.1, 0.1}}});
     }},
    {"Cohesion",
     [](Sample& s, const Scheme&) {
         s.model.add_term<Cohesion<2>>(CohesivePotential{s.energy(1.0), s.length(1.0)});
     }},
    {"WeightPotential", [](Sample& s, const Scheme&) { add_lucy(s, 3.0); }},
    {"TotalLagrangian",
     [](Sample& s, const Scheme&) {
         s.model.add_term<TotalLagrangian<2>>(StVenantKirchhoff{s.stress(0.43), s.stress(0.43)},
                                              TotalLagrangianScheme{s.density(), s.length(3.0)});
     }},
    {"TotalLagrangian, solid that yields",
     [](Sample& s, const Scheme&) {
         s.model.add_term<TotalLagrangian<2>>(
             HenckySolid<PlaneVonMises>({s.stress(0.43), s.stress(0.43)},
                                        LinearHardening{s.stress(1e-3), s.stress(0.1)}),
             TotalLagrangianScheme{s.density(), s.length(3.0)});
     }},
    {"TotalLagrangian, stress by its rate, yields",
     [](Sample& s, const Scheme&) {
         s.model.add_term<TotalLagrangian<2>>(
             StressInReference<YieldingSolid<PlaneStrainVonMises>, 2>(
                 {{s.stress(0.43), s.stress(0.43)}, LinearHardening{s.stress(1e-3), s.stress(0.1)}},
                 s.density(), s.stress(0.43)),
             TotalLagrangianScheme{s.density(), s.length(3.0)});
     }},
    {"MaterialVectors",
     [](Sample& s, const Scheme&) {
         s.model.add_term<MaterialVectors<2>>(PolynomialSolid{s.stress(0.43), s.stress(0.43)},
                                              MaterialVectorScheme{s.density(), s.length(3.0)});
     }},
    {"Springs", [](Sample& s, const Scheme&) { add_springs(s); }}};

/// What is put on top.
inline const std::map<std::string, std::function<void(Sample&)>> further{
    {"", [](Sample&) {}},
    {"Core",
     [](Sample& s) {
         s.model.add_term<Core<2>>(CorePotential{s.energy(0.1), s.length(1.1)});
     }},
    {"Contact",
     [](Sample& s) {
         s.model.add_term<Contact<2>>(ContactScheme{s.energy(0.2), s.length(1.0), s.length(1.2)});
     }},
    {"Springs", [](Sample& s) { add_springs(s); }},
    {"ArtificialViscosity",
     [](Sample& s) {
         s.model.add_term<ArtificialViscosity<2>>(
             ArtificialViscosity<2>::Constants{.range = s.length(3.0),
                                               .density = s.density(),
                                               .sound_speed = s.velocity(1.2),
                                               .kernel = Kernel::w4});
     }},
    {"ReflectedPairs", [](Sample& s) { s.model.add_term<ReflectedPairs<2>>(s.length(0.5)); }},
    {"WeightPotential", [](Sample& s) { add_lucy(s, 2.5); }},
    {"DensityPotentialTerm", [](Sample& s) {
         s.model.add_term<DensityPotentialTerm<2>>(
             DensityPotentials{.surface_tension = 0.02 * s.of("l^8/t^2") / s.units.mass,
                               .kernel = Kernel::w4,
                               .range = s.length(3.0)});
     }}};

inline const std::map<std::string, std::function<void(Sample&)>> externals{
    {"", [](auto&) {}},
    {"Gravity",
     [](Sample& s) {
         s.model.add(std::make_unique<Gravity<2>>(s.acceleration(1.0) * Point<2>(0.003, -0.01)));
     }},
    {"Friction", [](Sample& s) { s.model.add(std::make_unique<Friction<2>>(0.1 / s.units.time)); }},
    {"Drag",
     [](Sample& s) {
         s.model.add(std::make_unique<Drag<2>>(0.5 / s.units.length, s.velocity(1.0),
                                               s.velocity(1.0) * Point<2>(0.1, 0.0)));
     }},
    {"Thermostat",
     [](Sample& s) {
         s.model.add(std::make_unique<Thermostat<2>>(s.energy(1e-3), 0.3 / s.units.time));
     }},
    {"Load",
     [](Sample& s) {
         s.model.add(
             std::make_unique<Load<2>>([a = s.acceleration(1.0), T = s.units.time](double t) {
                 return Point<2>(a * Point<2>(0.01 * t / T, 0.02));
             }));
     }},
    {"DistributedLoad",
     [](Sample& s) {
         s.model.add(std::make_unique<DistributedLoad<2>>(
             [a = 1.0 / (s.units.time * s.units.time), T = s.units.time](double t) {
                 return a * (0.01 + 0.02 * t / T);
             },
             s.model.particles().reference_position));
     }},
    {"RigidWall",
     [](Sample& s) {
         s.model.add(std::make_unique<RigidWall<2>>(
             Point<2>(0.9, 0.4),
             [L = s.units.length, T = s.units.time](double t) { return L * (0.1 * t / T - 0.2); },
             s.energy(0.2), s.length(1.0)));
     }},
    {"Clamp", [](Sample& s) {
         s.model.add(std::make_unique<Clamp<2>>(
             select<2>(s.model.particles(),
                       [most = s.length(1.2)](const Point<2>& x) { return x.x() < most; })));
     }}};

}  // namespace spam::test
