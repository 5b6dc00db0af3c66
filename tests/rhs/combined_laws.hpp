// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of matter, further terms and externals that are combined with each other.
#pragma once

#include "support/own_part.hpp"
#include <spam/core/dimensions.hpp>
#include <spam/core/parallel.hpp>
#include <spam/external/clamp.hpp>
#include <spam/external/distributed_load.hpp>
#include <spam/external/drag.hpp>
#include <spam/external/friction.hpp>
#include <spam/external/gravity.hpp>
#include <spam/external/load.hpp>
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

/// The last number is for space alone.
template <int Dim>
Point<Dim> point(double x, double y, double z) {
    return Point<3>(x, y, z).template head<Dim>();
}

/// The triangular lattice, and in space the face-centred cubic one.
template <int Dim>
inline const double site_density = Dim == 2 ? 2.0 / std::sqrt(3.0) : std::sqrt(2.0);
template <int Dim>
Points<Dim> block(bool periodic = false, double spacing = 1.0) {
    if constexpr (Dim == 2)
        return triangular_block(8, periodic ? 6 : 5, spacing);
    else
        return cubic_lattice(CubicLattice::fcc, {3, 2, 2}, spacing).array() +
               (periodic ? 0.3 * spacing : 0.0);  // none at a border
}
/// The periodic box of that block.
template <int Dim>
Box<Dim> full_box(double spacing = 1.0) {
    const double edge = spacing * cubic_edge(CubicLattice::fcc);
    if constexpr (Dim == 2)
        return triangular_box(8, 6, spacing);
    else
        return Box<3>({3.0 * edge, 2.0 * edge, 2.0 * edge});
}

/// A model on the way, and how its y begins. Numbers of laws are those of units in which particles have mass
/// and spacing 1; of `units` they are given in others.
template <int Dim>
struct Sample {
    /// In a periodic box particles fill it.
    explicit Sample(const Box<Dim>& box = {}, const Units& in = {})
        : units(in),
          model(own_part(make_particles<Dim>(block<Dim>(box.periodic(), in.length), in.mass,
                                             in.length, box)),
                box) {
        set_threads(1);  // images behind walls count, and two would wait for each other
    }
    Units units;
    ParticleModel<Dim> model;
    std::function<std::vector<double>(const Points<Dim>&, const Points<Dim>&)> fluid{};
    double speed = 1.0;  ///< times the velocities at the start

    double of(const char* unit) const { return units.of(unit, Dim); }
    double length(double x) const { return x * units.length; }
    double time(double x) const { return x * units.time; }
    double velocity(double x) const { return x * of("l/t"); }
    double acceleration(double x) const { return x * of("l/t^2"); }
    double stress(double x) const { return x * of("m l^(2-D)/t^2"); }
    /// And kappa, where T is energy by mass.
    double viscosity(double x) const { return x * of("m l^(2-D)/t"); }
    double energy(double x) const { return x * of("m l^2/t^2"); }
    double temperature(double x) const { return x * of("l^2/t^2"); }
    double density(double x = site_density<Dim>) const { return x * of("m/l^D"); }
    Scheme scheme(Scheme s) const {
        s.range = length(s.range);
        s.closest_approach = length(s.closest_approach);
        return s;
    }

    std::vector<double> start() {
        const Points<Dim>& x = model.particles().reference_position;
        Points<Dim> v = Points<Dim>::Zero(Dim, x.cols());
        for (Eigen::Index i = 0; i < x.cols(); ++i) {
            Point<3> X = Point<3>::Zero();
            X.head<Dim>() = x.col(i) / units.length;
            if (X[0] >= 1.2)
                v.col(i) = point<Dim>(0.02 * std::sin(0.7 * X[0]) - 0.01 * X[1] + 0.02 * X[2],
                                      0.01 * X[0] + 0.02 * std::cos(0.9 * X[1]) - 0.03 * X[2],
                                      -0.06 * std::sin(0.8 * X[2]) - 0.02 * X[0] + 0.03 * X[1]);
        }
        v *= velocity(speed);
        if (fluid) return fluid(x, v);
        auto y = initial_state<Dim>(model, density(), stress(0.43), at_rest<Dim>());
        State<Dim>(model.layout(), y).velocity() = v;
        return y;
    }
};

template <int Dim>
using Build = std::function<void(Sample<Dim>&, const Scheme&)>;
template <int Dim>
using Laws = std::map<std::string, Build<Dim>>;
template <int Dim>
using Add = std::function<void(Sample<Dim>&)>;

template <class Term, int Dim, class... Arguments>
Term& add_term(Sample<Dim>& s, Arguments&&... arguments) {
    return s.model.template add_term<Term>(std::forward<Arguments>(arguments)...);
}
template <class External, int Dim, class... Arguments>
void add_external(Sample<Dim>& s, Arguments&&... arguments) {
    s.model.add(std::make_unique<External>(std::forward<Arguments>(arguments)...));
}
template <int Dim>
void add_fluid(Sample<Dim>& s, const Fluid& fluid, const Scheme& scheme) {
    auto& law = add_term<SmoothParticles<Dim>>(s, fluid, scheme);
    s.fluid = [&law, T = s.temperature(0.2)](const Points<Dim>& x, const Points<Dim>& v) {
        return law.start(x, v, T);
    };
}

/// The surface of three directions: plane strain, or in space.
template <int Dim>
using StrainedVonMises = RadialVonMises<Dim, Dim == 2>;
/// 0.43 and 0.43, or another lambda.
template <class Solid, int Dim>
Solid elastic(const Sample<Dim>& s, double lambda = 0.43) {
    return {s.stress(lambda), s.stress(0.43)};
}
template <int Dim>
LinearHardening hardening(const Sample<Dim>& s) {
    return {s.stress(1e-3), s.stress(0.1)};
}

template <int Dim>
void add_lucy(Sample<Dim>& s, double range) {
    add_term<WeightPotential<Dim>>(s, s.length(range), s.of("l^2 l^D/t^2 m"));
}
template <int Dim>
void add_springs(Sample<Dim>& s) {
    add_term<Springs<Dim>>(s, HarmonicSpring{s.of("m/t^2"), s.length(1.0)});
}

/// Between the rows of triangular_block(8, ...), whose numbers are the ids.
inline std::vector<Quadrilateral> mesh_of(const Particles<2>& particles) {
    const auto id = Parts::here().by_number(std::span<const std::int64_t>(particles.id));
    std::vector<std::uint32_t> stored(
        static_cast<std::size_t>(*std::max_element(id.begin(), id.end())) + 1);
    for (std::uint32_t k = 0; k < id.size(); ++k) stored[static_cast<std::size_t>(id[k])] = k;
    std::vector<Quadrilateral> mesh;
    for (std::size_t i = 0; i + 9 < stored.size(); ++i)
        if (i % 8 != 7) mesh.push_back({stored[i], stored[i + 1], stored[i + 9], stored[i + 8]});
    return mesh;
}

/// Laws that a scheme belongs to, laws that make a body by themselves, and those that there are in the plane alone.
/// Defined in law_tables.hpp and compiled once: each law of each is a model of its own.
template <int Dim>
const Laws<Dim>& with_scheme();
template <int Dim>
const Laws<Dim>& without_scheme();
extern const Laws<2> plane_laws;
/// What is put on top, and what acts from outside.
template <int Dim>
const std::map<std::string, Add<Dim>>& further();
template <int Dim>
const std::map<std::string, Add<Dim>>& externals();

template <int Dim>
Laws<Dim> merged(Laws<Dim> all, const Laws<Dim>& more, [[maybe_unused]] const Laws<2>& plane) {
    all.insert(more.begin(), more.end());
    if constexpr (Dim == 2) all.insert(plane.begin(), plane.end());
    return all;
}
template <int Dim>
Laws<Dim> all_laws() {
    return merged(with_scheme<Dim>(), without_scheme<Dim>(), plane_laws);
}

}  // namespace spam::test
