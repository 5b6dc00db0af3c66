// SPDX-License-Identifier: GPL-3.0-or-later
// The gas of blast: a quarter of the plane with a hot disc at its corner, and where the front is.
#pragma once

#include "../common.hpp"
#include "sedov.hpp"

namespace blast {

using namespace spam;

struct Parameters {
    const Sides* sides = nullptr;
    int cells = 48;
    bool single = false;
    double gamma = 1.4;
    double ratio = 1e5;   ///< of the pressures, hot by cold
    int finer = 4;        ///< how many hot particles there are in place of one in each direction
    double radius = 0.1;  ///< of the hot disc, by the edge of the quarter
    Scheme scheme{.density = Density::continuity,
                  .work = Work::own,
                  .viscosity = 1.0,
                  .kernel = Kernel::w4,
                  .range = 4.0};

    double step(int cells_along) const;
    /// Energy of a unit of mass of the hot gas: pi radius^2 of it hold the energy 1.
    double hot() const;
};

/// Edge 1, density 1, and energy 1 of the hot disc where all four quarters are counted.
struct Gas : Variant<2, FluidModel<2>> {
    int cells;
    Sedov exact;

    double time(double R) const { return exact.time(R, 1.0, 1.0); }
    double radius(double t) const { return exact.radius(t, 1.0, 1.0); }
};
Gas make_gas(const Parameters& p, int cells, bool only_described);

/// Means over particles in rings of about the width of the spacing around the corner.
struct Rings {
    std::vector<double> r, density, velocity, pressure;
};
Rings rings_of(const FluidModel<2>& model, std::span<const double> y);

/// Where the density, beyond its peak, has fallen half of the way back to 1; NaN where there is no peak.
double front(const FluidModel<2>& model, std::span<const double> y);

}  // namespace blast
