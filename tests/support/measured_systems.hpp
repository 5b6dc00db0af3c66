// SPDX-License-Identifier: GPL-3.0-or-later
// On what speed is measured, in the plane and in space: h = 3 spacings in a hexagon of triangular lattice or a ball of
// face-centred cubic lattice.
#pragma once

#include <spam/material/elastic_solid.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>

namespace spam::test {

/// At least n in the plane, about n in space.
template <int Dim>
Points<Dim> round_body(std::int64_t n) {
    if constexpr (Dim == 2) {
        int r = 1;
        while (1 + 3L * r * (r + 1) < n) ++r;
        return triangular_hexagon(r);
    } else {
        const double radius = std::cbrt(3.0 * static_cast<double>(n) /
                                        (4.0 * std::numbers::pi * std::numbers::sqrt2));
        const int cells = 2 * static_cast<int>(radius / std::numbers::sqrt2) + 3;
        return ball_of(centred<3>(cubic_lattice(CubicLattice::fcc, {cells, cells, cells})), radius);
    }
}

/// Moves every value by up to a hundredth, so that no pair sits exactly at the range.
inline void jitter(std::span<double> values) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> u(-0.01, 0.01);
    for (double& value : values) value += u(random);
}

/// "one_sweep" and "two_sweeps" of the paper's elastic solid, "fluid": Lucy's gas with friction, "total_lagrangian".
template <int Dim>
struct MeasuredSystem {
    std::unique_ptr<ParticleModel<Dim>> model;
    const SmoothParticles<Dim>* law = nullptr;  ///< null of total_lagrangian
    std::vector<double> y, y_dot;

    MeasuredSystem(const std::string& name, std::int64_t n,
                   AngularMomentum angular_momentum = AngularMomentum::free) {
        auto body = make_particles<Dim>(round_body<Dim>(n), 1.0);
        const double density = Dim == 2 ? triangular_density : std::numbers::sqrt2;
        const auto solid = ElasticSolid::triangular_lattice();
        const auto keep = [this](auto made) {
            law = &made->law;
            model = std::move(made);
        };
        if (name == "total_lagrangian")
            model = std::make_unique<TotalLagrangianModel<Dim>>(
                std::move(body), StVenantKirchhoff::like(solid),
                TotalLagrangianScheme{density, 3.0, 0.1});
        else if (name == "fluid")
            keep(std::make_unique<FluidModel<Dim>>(std::move(body),
                                                   Fluid{LucyGas{}, NewtonViscosity{0.1, 0.3}},
                                                   Scheme{.angular_momentum = angular_momentum}));
        else
            keep(std::make_unique<SmoothParticleModel<Dim>>(
                std::move(body), solid,
                Scheme{.density = name == "two_sweeps" ? Density::summed : Density::continuity,
                       .transport = Transport::monaghan,
                       .angular_momentum = angular_momentum}));
        y = initial_state<Dim>(*model, density, 0.433, at_rest<Dim>());
        jitter(y);
        y_dot.resize(y.size());
    }
    void rates() { model->rates(0.0, y, y_dot); }
    Points<Dim> position() const { return ConstState<Dim>(model->layout(), y).position(); }
};

}  // namespace spam::test
