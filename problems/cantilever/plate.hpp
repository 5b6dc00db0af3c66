// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../solid_choice.hpp"
#include "beam.hpp"

namespace cantilever {

using namespace spam;

struct Parameters : SolidChoice {
    Parameters() { usual_viscosity = 0.5; }

    Beam beam{};
    int layers = 10;      // over the thickness
    double speed = 0.05;  // of the tip at the start, by sqrt(K/rho)
    double gravity = 0.0;
    std::optional<double> given_range;  // in spacings
    bool compare = false;

    /// In spacings. Shorter sums over present neighbours lose the order of the particles.
    double range() const { return given_range.value_or(remembers() ? 2.0 : 2.6); }
    double spacing(int n) const { return beam.thickness / n; }
};

/// One plate of so many layers.
struct Plate : Variant<2> {
    int layers;
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
