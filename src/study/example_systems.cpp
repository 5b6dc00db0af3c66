// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/analysis/plane_wave.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/drawn.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>
#include <spam/study/example_systems.hpp>

#include <cmath>
#include <random>

namespace spam {
namespace {

const double lattice_density = std::sqrt(4.0 / 3.0);

Start<2> begun(std::unique_ptr<Model<2>> model, const VelocityField<2>& velocity) {
    Start<2> start{std::move(model), {}};
    start.y0 = initial_state<2>(*start.model, lattice_density,
                                ElasticSolid::triangular_lattice().eta, velocity);
    return start;
}

Particles<2> hexagon(int size) { return make_particles<2>(triangular_hexagon(size), 1.0); }

std::unique_ptr<Model<2>> smooth_model(int size, const Scheme& scheme) {
    return std::make_unique<SmoothParticleModel<2>>(hexagon(size),
                                                    ElasticSolid::triangular_lattice(), scheme);
}

/// Even between -1 and 1.
double deviate(std::mt19937_64& random) { return 2.0 * drawn(random) - 1.0; }

}  // namespace

Start<2> smooth_hexagon(int size, double speed, const Scheme& scheme) {
    return begun(smooth_model(size, scheme), rigid_rotation(speed / size));
}

Start<2> bonded_hexagon(int size, double speed) {
    return begun(std::make_unique<BondedModel<2>>(hexagon(size), HarmonicSpring{}),
                 rigid_rotation(speed / size));
}

Start<2> lagrangian_hexagon(int size, double speed) {
    const auto law = StVenantKirchhoff::like(ElasticSolid::triangular_lattice());
    return begun(std::make_unique<TotalLagrangianModel<2>>(
                     hexagon(size), law, TotalLagrangianScheme{lattice_density, 3.0, 0.1}),
                 rigid_rotation(speed / size));
}

Start<2> material_vector_hexagon(int size, double speed) {
    const auto law = PolynomialSolid::like(ElasticSolid::triangular_lattice());
    return begun(std::make_unique<MaterialVectorModel<2>>(hexagon(size), law,
                                                          MaterialVectorScheme{lattice_density}),
                 rigid_rotation(speed / size));
}

Start<2> shaken(Start<2> start, double speed) {
    std::mt19937_64 random(7);
    auto v = State<2>(start.model->layout(), start.y0).velocity();
    Points<2> more(2, v.cols());
    for (Eigen::Index i = 0; i < v.cols(); ++i)
        for (int a = 0; a < 2; ++a) more(a, i) = speed * deviate(random);
    v += more.colwise() - more.rowwise().mean();
    return start;
}

Start<2> ringing_lattice(int cells, double amplitude, const Scheme& scheme) {
    StandingWave wave = standing_wave(Polarization::transverse, cells, amplitude, scheme);
    return {std::move(wave.solid.model), std::move(wave.solid.y0)};
}

Start<2> expanding_gas(int cells) {
    const Box<2> box({2.0 * cells, 2.0 * cells});
    auto particles = make_particles<2>(square_lattice<2>({cells, cells}), 1.0, 1.0, box);
    Start<2> start{std::make_unique<PairPotentialModel<2>>(std::move(particles), 6.0, box), {}};
    start.y0 = initial_state<2>(*start.model, 1.0, 1.0, at_rest<2>());
    std::mt19937_64 random(4);
    auto x = State<2>(start.model->layout(), start.y0).position();
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        for (int a = 0; a < 2; ++a) x(a, i) += 0.05 * deviate(random);
    return start;
}

}  // namespace spam
