// SPDX-License-Identifier: GPL-3.0-or-later
#include "gas.hpp"

#include <spam/material/gamma_gas.hpp>

namespace blast {

double Parameters::hot() const { return 1.0 / (std::numbers::pi * radius * radius); }

double Parameters::step(int cells_along) const {
    return 0.05 / cells_along / std::sqrt(gamma * (gamma - 1.0) * hot());
}

namespace {

/// The lattice, `finer` times as many in each direction where it is hot: what is left of the hot gas fills most of
/// the blast in the end, and its particles must not lose each other.
struct Places {
    Points<2> x;
    std::vector<double> mass;
    std::vector<bool> hot;
};
Places places_of(const Parameters& p, int cells) {
    const double spacing = 1.0 / cells;
    std::vector<Point<2>> at;
    Places all;
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column) {
            const Point<2> corner(column * spacing, row * spacing);
            const bool hot = (corner.array() + 0.5 * spacing).matrix().norm() < p.radius;
            const int parts = hot ? p.finer : 1;
            for (int k = 0; k < parts * parts; ++k) {
                const Point<2> inside(k % parts + 0.5, k / parts + 0.5);
                at.push_back(corner + spacing / parts * inside);
                all.mass.push_back(spacing * spacing / (parts * parts));
                all.hot.push_back(hot);
            }
        }
    all.x.resize(2, static_cast<Eigen::Index>(at.size()));
    for (std::size_t i = 0; i < at.size(); ++i) all.x.col(static_cast<Eigen::Index>(i)) = at[i];
    return all;
}

}  // namespace

Gas make_gas(const Parameters& p, int cells, bool only_described) {
    const double spacing = 1.0 / cells;
    const auto box = p.sides->box<2>(Point<2>::Zero(), Point<2>(1.0, 1.0));
    const Places places = places_of(p, cells);
    auto particles = make_particles<2>(places.x, spacing * spacing, spacing, box);
    double hot_mass = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const auto given = static_cast<std::size_t>(particles.id[i]);
        particles.mass[i] = places.mass[given];
        if (places.hot[given]) hot_mass += places.mass[given];
    }
    if (!(hot_mass > 0.0))
        refuse(
            "radius: {:g} leaves no particle in the hot disc, spacings being {:g}; give more --cells or a "
            "larger disc",
            p.radius, spacing);
    Scheme scheme = p.scheme;
    scheme.range *= spacing;
    Gas gas{{}, cells, Sedov(p.gamma, 2)};
    gas.model = std::make_shared<FluidModel<2>>(std::move(particles), Fluid{GammaGas{p.gamma}},
                                                scheme, box);
    if (only_described) return gas;
    const auto& model = *gas.model;
    const Points<2>& at = model.particles().reference_position;
    gas.y0 = gas.model->state(at, Points<2>::Zero(2, at.cols()), 1.0);
    const State<2> state(model.layout(), gas.y0);
    // So much that the energy of all four quarters is 1: the disc has steps.
    const double e = 0.25 / hot_mass;
    for (Eigen::Index i = 0; i < at.cols(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        state.energy()(0, i) =
            places.hot[static_cast<std::size_t>(model.particles().id[k])] ? e : e / p.ratio;
        if (state.has(Field::density)) state.density()(0, i) = 1.0;
    }
    gas.model->layout().set_scale(Field::velocity, std::sqrt(e));
    gas.model->layout().set_scale(Field::energy, e);
    return gas;
}

Rings rings_of(const FluidModel<2>& model, std::span<const double> y) {
    const ConstState<2> state(model.layout(), y);
    const auto rho = model.density(y), P = model.pressure(y);
    const double width = model.particles().spacing;
    const auto count = static_cast<std::size_t>(std::ceil(std::numbers::sqrt2 / width)) + 1;
    std::vector<double> particles(count, 0.0);
    Rings all{particles, particles, particles, particles};
    for (std::size_t i = 0; i < rho.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        const Point<2> x = state.position().col(k);
        const auto ring = static_cast<std::size_t>(x.norm() / width);
        if (ring >= count) continue;
        particles[ring] += 1.0;
        all.r[ring] += x.norm();
        all.density[ring] += rho[i];
        all.velocity[ring] += state.velocity().col(k).dot(x) / x.norm();
        all.pressure[ring] += P[i];
    }
    Rings rings;
    for (std::size_t ring = 0; ring < count; ++ring) {
        if (particles[ring] == 0.0) continue;
        rings.r.push_back(all.r[ring] / particles[ring]);
        rings.density.push_back(all.density[ring] / particles[ring]);
        rings.velocity.push_back(all.velocity[ring] / particles[ring]);
        rings.pressure.push_back(all.pressure[ring] / particles[ring]);
    }
    return rings;
}

double front(const FluidModel<2>& model, std::span<const double> y) {
    const Rings rings = rings_of(model, y);
    const auto peak = std::max_element(rings.density.begin(), rings.density.end());
    const double half = 0.5 * (1.0 + *peak);
    auto k = static_cast<std::size_t>(peak - rings.density.begin());
    while (k + 1 < rings.r.size() && rings.density[k + 1] > half) ++k;
    if (*peak < 1.1 || k + 1 >= rings.r.size()) return std::numeric_limits<double>::quiet_NaN();
    const double part = (rings.density[k] - half) / (rings.density[k] - rings.density[k + 1]);
    return rings.r[k] + part * (rings.r[k + 1] - rings.r[k]);
}

}  // namespace blast
