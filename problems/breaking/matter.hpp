// SPDX-License-Identifier: GPL-3.0-or-later
// What a body that is to break is made of, [HH07] 13: the models of the tension test and of the ball that hits
// a plate.
#pragma once

#include "bond_limits.hpp"
#include <spam/rhs/material_vectors.hpp>

namespace breaking {

using namespace spam;

enum class MatterKind {
    pair_md,           ///< molecular dynamics, phi = (2 - r^2)^8 - 2 (2 - r^2)^4
    embedded_atom,     ///< molecular dynamics with potentials of the density, and a core
    spam,              ///< smooth particles of an elastic solid that yields, and a core
    material_vectors,  ///< the same with a vector for each neighbour: a solid that yields and tears
    elements,          ///< finite elements of a solid that yields: a twin with options of its own
    all                ///< the first three, one after the other
};

std::string_view to_string(MatterKind kind);
/// For pictures: "pair potential", "embedded atoms", "SPAM", "material vectors".
std::string title_of(MatterKind kind);

/// As options give it. What is not set is chosen for the model.
struct Matter {
    MatterKind kind = MatterKind::spam;
    std::optional<double> yield_stress{};  ///< Y of solids
    double hardening = 0.0;                ///< H
    std::optional<double> failure_strain{};
    std::optional<double> tension_limit{};                   ///< p_c of material vectors
    double penalty = MaterialVectorScheme::default_penalty;  ///< kappa of material vectors
    BondLimits bonds{};                                      ///< of material vectors
    double strength = 0.2;                                   ///< s_c of embedded atoms
    double surface_tension = 0.1;                            ///< s_g of embedded atoms
    double core = 1.0;                                       ///< e_c
    double core_range = 0.8;
    double disorder = 0.01;  ///< largest random displacement at the start
    int seed = 1;
};

/// Those that make a body of particles.
std::vector<MatterKind> kinds_of(MatterKind kind);

/// Y where it is not given. p_c is as large as Y where that is not.
constexpr double usual_yield_stress = 0.05;

/// `--model`, one of `kinds`, the constants above, and those of the scheme of smooth particles, each refused
/// where it means nothing.
void add_matter_options(Problem& problem, Matter& matter, const std::vector<MatterKind>& kinds);

/// All sites of the lattice not farther than `radius` from the one at the origin, nearest neighbours 1 apart: of the
/// triangular one or, in space, of the face-centred cubic one.
template <int Dim>
Points<Dim> lattice_ball(double radius);

/// A lattice that is not perfect: each coordinate moved by up to `disorder`, the same on every computer.
template <int Dim>
void disturb(Points<Dim>& position, const Matter& matter) {
    displace(position, matter.disorder, matter.seed);
}

/// By what a step that resolves the usual constants is multiplied for these (stiffness.hpp).
double relative_step(const Matter& matter);

/// Bodies one after the other, stored in this order. With `contact` they act on each other by that alone,
/// else as particles of one body do. Throws InputError where the constants make no sense.
template <int Dim = 2>
std::shared_ptr<ParticleModel<Dim>> make_model(const Session& session, const Matter& matter,
                                               const std::vector<Particles<Dim>>& bodies,
                                               const std::optional<ContactScheme>& contact = {});

/// y of a model that is whole: places of `position`, in the order of the model's particles, at rest, of the density
/// of the lattice, without stress or energy. `speed`: how fast things will be, for tolerances.
template <int Dim>
std::vector<double> start(ParticleModel<Dim>& model, const Points<Dim>& position, double speed);

}  // namespace breaking
