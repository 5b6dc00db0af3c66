// SPDX-License-Identifier: GPL-3.0-or-later
// A viscous fluid whose particles are stirred, in a box that it fills: what taylor_green and cavity share.
#pragma once

#include "../common.hpp"

namespace stirred {

using namespace spam;

struct Parameters {
    const Sides* sides = nullptr;
    int cells = 50;           // particles along each side, at spacing 1
    double speed = 0.1;       // of the lid, or the largest at the start; sound: 1
    double reynolds = 100.0;  // speed cells/nu
    bool compare = false;
    FrictionBy friction = FrictionBy::pairs;
    Scheme scheme{.density = Density::continuity,
                  .transport = Transport::shifting,
                  .kernel = Kernel::w4,
                  .range = 4.0};

    double viscosity(int cells_now) const { return speed * cells_now / reynolds; }
    bool shifted() const { return scheme.transport == Transport::shifting; }
};

/// P = rho^3 - rho^2: density and sound speed 1, no pressure at rest. Newton's viscosity, no bulk viscosity.
Fluid fluid_of(const Parameters& p, double nu);

/// cells x cells particles of mass 1 at spacing 1, moved by up to `disorder` spacings, between 0 and `cells`.
std::unique_ptr<FluidModel<2>> make_model(const Parameters& p, int cells, const Box<2>& box,
                                          double disorder = 0.0, int seed = 1);

/// Where the density is part of y: that of this pressure, with the energy that belongs to it.
void set_pressure(const Model<2>& model, std::vector<double>& y,
                  const std::function<double(const Point<2>&)>& pressure);

/// Step of rk4: friction and sound are resolved, and shifting, which all scale with the particles; and what happens
/// at free edges, which draw together at once.
double step_of(const Parameters& p, double nu, const Box<2>& box);

/// --cells, --speed, --reynolds, --transport, --shifting, --density, --friction, --kernel, --range, --compare.
void add_options(Options& options, Parameters& p, const std::string& speed_of_what);

/// Of --help: step_of() in words, and what sides need.
constexpr const char* step_words =
    "0.1 h, or shorter where friction or shifting are strong or a side moves fast, 0.025 h beside open or rigid sides";
constexpr const char* sides_remark = "open and rigid sides need --transport plain";

/// Where these are the defaults, something is known.
const std::vector<std::string>& decisive_options();

}  // namespace stirred
