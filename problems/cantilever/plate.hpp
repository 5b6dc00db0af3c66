// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../formulation.hpp"
#include "beam.hpp"
#include <spam/problem/nearest_state.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/spam.hpp>

namespace cantilever {

using namespace spam;

struct Parameters {
    Beam beam{};
    int layers = 10;      // over the thickness
    double speed = 0.05;  // of the tip at the start, by sqrt(K/rho)
    double gravity = 0.0;
    Formulation formulation = Formulation::total_lagrangian;
    std::optional<double> given_range;  // in spacings
    std::optional<double> penalty;
    double viscosity = 0.5;
    bool compare = false;

    bool lagrangian() const { return formulation == Formulation::total_lagrangian; }
    bool vectors() const { return formulation == Formulation::material_vectors; }
    bool remembers() const { return lagrangian() || vectors(); }
    /// In spacings. Shorter sums over present neighbours lose the order of the particles.
    double range() const { return given_range.value_or(remembers() ? 2.0 : 2.6); }
    double kappa() const {
        return penalty.value_or(lagrangian() ? 0.1 : MaterialVectorScheme::default_penalty);
    }
    double spacing(int n) const { return beam.thickness / n; }
};

/// One plate of so many layers.
struct Plate {
    int layers;
    std::string prefix;
    std::shared_ptr<ParticleModel<2>> model;
    std::vector<double> y0;
    std::vector<NearestState<2>> drawn{};
};

/// Square lattice from 5 cm (a quarter of the length) before x = 0, where it is held, to x = L.
Plate make_plate(const Parameters& p, int layers);

/// Deflection of the tip's column of particles, in the mean: column `tip`.
Column<2> tip_column(const Model<2>& model);

/// Of the tip about its rest, with gravity about the mean of its extremes; 0 where it turns too seldom.
double period_of(const Parameters& p, const History& h);

void draw(Session& session, const Parameters& p, const std::vector<Plate>& plates,
          const std::vector<RunRecord>& runs);

}  // namespace cantilever
