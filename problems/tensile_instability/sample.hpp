// SPDX-License-Identifier: GPL-3.0-or-later
// A periodic lattice under tension of which one particle moves, and what linear equations say of it.
#pragma once

#include "../lattice_choice.hpp"
#include <spam/analysis/kicked_lattice.hpp>
#include <spam/analysis/wave_vectors.hpp>

namespace tensile_instability {

using namespace spam;

struct Parameters {
    double stress = 0.02;
    int cells = 24;
    double speed = 1e-10;
    int dimension = 2;
    CubicLattice lattice = CubicLattice::sc;
};

template <int Dim>
struct Sample : Variant<Dim, SmoothParticleModel<Dim>> {
    double stress = 0.0;
    std::unique_ptr<KickedLattice<Dim>> linear{};
};

template <int Dim>
Sample<Dim> make_sample(const Parameters& p, double stress, const Scheme& scheme) {
    Sample<Dim> sample;
    sample.stress = stress;
    sample.title = fmt::format("s = {:g}, {}", stress, velocity_title(scheme.transport, "plain v"));
    // at rest under tension
    const auto solid = ElasticSolid::triangular_lattice();
    SolidLattice<Dim> lattice, small;
    std::array<int, Dim> waves;  // along each axis
    waves.fill(p.cells);
    if constexpr (Dim == 2) {
        lattice = triangular_solid(p.cells, p.cells, solid, scheme, triangular_density, stress);
        small = smallest_triangular_solid(solid, scheme, triangular_density, stress);
    } else {
        lattice = cubic_solid(p.lattice, waves, solid, scheme, stress);
        small = smallest_cubic_solid(p.lattice, solid, scheme, stress);
        // One a particle: equivalent waves differ by 2 pi by the edge of a cell in any component (sc), in two of
        // them (bcc) or in all three (fcc), and by twice that in one.
        if (p.lattice != CubicLattice::sc) waves[0] *= 2;
        if (p.lattice == CubicLattice::fcc) waves[1] *= 2;
    }
    sample.model = std::move(lattice.model);
    sample.y0 = std::move(lattice.y0);
    auto& model = *sample.model;
    const Box<Dim>& box = model.box();
    const State<Dim> state(model.layout(), sample.y0);
    // what the linear equations say
    const Point<Dim> kick = p.speed * Point<Dim>::Unit(Dim - 1);
    sample.linear =
        std::make_unique<KickedLattice<Dim>>(LatticeModes<Dim>(*small.model, small.y0),
                                             allowed_wave_vectors<Dim>(box, waves), 1.0, kick);
    // the particle in the middle
    Point<Dim> middle;
    for (int a = 0; a < Dim; ++a) middle[a] = 0.5 * box.length(a);
    Eigen::Index nearest = 0;
    (state.position().colwise() - middle).colwise().norm().minCoeff(&nearest);
    state.velocity().col(nearest) = kick;
    model.layout().set_scale(Field::velocity, p.speed);
    model.layout().set_scale(Field::energy, p.speed * p.speed);
    return sample;
}

template <int Dim>
std::vector<Sample<Dim>> figure(const Parameters& p, const Scheme& scheme) {
    std::vector<Sample<Dim>> all;
    const auto add = [&](double stress, Transport transport) {
        Scheme other = scheme;
        other.transport = transport;
        all.push_back(make_sample<Dim>(p, stress, other));
        all.back().call(fmt::format("{}_{:g}", to_string(transport), stress));
    };
    add(0.01, Transport::plain);
    add(0.02, Transport::plain);
    all.back().prefix = "";
    add(0.02, Transport::monaghan);
    return all;
}

/// The shortest of equivalent wave vectors; in space in pi by the edge of a cell, and of those that symmetry makes
/// of it the one with k_x >= k_y >= k_z >= 0.
template <int Dim>
Point<Dim> shortest(const Parameters& p, const Point<Dim>& k) {
    if constexpr (Dim == 2) return first_zone(k);
    const CubicLattice reciprocal = p.lattice == CubicLattice::fcc   ? CubicLattice::bcc
                                    : p.lattice == CubicLattice::bcc ? CubicLattice::fcc
                                                                     : CubicLattice::sc;
    const double side = p.lattice == CubicLattice::sc ? 2.0 : 4.0;
    const auto sites = cubic_lattice(reciprocal, {1, 1, 1}, side / cubic_edge(reciprocal));
    Point<Dim> best = Point<Dim>::Constant(HUGE_VAL);
    for (Eigen::Index n = 0; n < sites.cols(); ++n) {
        Point<Dim> other =
            cubic_edge(p.lattice) / std::numbers::pi * k - sites.col(n).template head<Dim>();
        for (double& one : other) one = std::abs(std::remainder(one, side));
        std::sort(other.begin(), other.end(), std::greater<>());
        if (other.norm() < best.norm()) best = other;
    }
    return best;
}

}  // namespace tensile_instability
