// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/elastic_solid.hpp>
#include <spam/material/yielding_solid.hpp>
#include <spam/rhs/elements.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/meshes.hpp>

#include <cmath>
#include <memory>
#include <random>

namespace spam::test {

inline const double lattice_density = std::sqrt(4.0 / 3.0);
inline const ElasticSolid elastic{0.5, 0.4};

inline YieldingSolid<PlaneVonMises> yielding(double Y, double failure_strain = Failure::never) {
    return {PlaneVonMises{0.5, 0.4}, LinearHardening{Y, 0.02},
            Failure{.plastic_strain = failure_strain}};
}

/// columns x rows elements whose inner nodes are moved at random: no element is like another.
inline Mesh distorted_mesh(int columns, int rows, double by = 0.2, unsigned seed = 7) {
    Mesh mesh = rectangle_mesh(columns, rows);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(-by, by);
    for (double& x : mesh.node.reshaped()) x += u(random);
    return mesh;
}

inline std::unique_ptr<ParticleModel<2>> model_of(const std::vector<Mesh>& meshes,
                                                  const spam::Material<2>& law,
                                                  const HourglassControl& control = {}) {
    MeshedBodies bodies = make_nodes(meshes, lattice_density);
    auto model = std::make_unique<ParticleModel<2>>(std::move(bodies.nodes));
    model->add_term<Elements>(std::move(bodies.element),
                              std::vector<Elements::Material>{{law, lattice_density, control}});
    return model;
}

/// At rest, free of stress.
inline std::vector<double> start_of(ParticleModel<2>& model, const VelocityField<2>& velocity) {
    return initial_state<2>(model, lattice_density, 0.4, velocity);
}

/// Every number of y random but for the positions.
inline std::vector<double> random_elements(ParticleModel<2>& model, double stress,
                                           unsigned seed = 5) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    auto y = start_of(model,
                      [&](const Point<2>&) { return Point<2>(0.1 * u(random), 0.1 * u(random)); });
    const State<2> elements = State<2>(model.layout(), y).elements();
    for (double& s : elements.stress().reshaped()) s = stress * u(random);
    if (elements.has(field_kind::hourglass_force))
        for (double& q : elements.field(field_kind::hourglass_force).reshaped())
            q = stress * u(random);
    if (elements.has(field_kind::plastic_strain))
        for (double& e : elements.field(field_kind::plastic_strain).reshaped())
            e = 0.1 + 0.1 * u(random);
    return y;
}

}  // namespace spam::test
