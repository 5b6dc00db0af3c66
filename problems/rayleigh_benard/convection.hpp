// SPDX-License-Identifier: GPL-3.0-or-later
// The layer as smooth particles: what the parts of the problem share.
#pragma once

#include "../common.hpp"
#include "grid.hpp"

namespace rayleigh_benard {

using namespace spam;

struct Parameters {
    const Sides* sides = nullptr;
    int height = 20;
    double rayleigh = 1e4;
    double roll = 0.05;
    FrictionBy friction = FrictionBy::pairs;
    Density density = Density::summed;
    Work work = Work::mean;
    Kernel kernel = Kernel::w4;
    double range = 3.5;
    bool scan = false;
};

struct Convection : Variant<2, FluidModel<2>> {
    Layer layer;
};

/// 2 L x L particles of mass 1 at spacing 1. `only_described`: without y0. Throws InputError where the plates
/// are no walls with temperatures, the lower one is not the hotter one, or a side is open.
Convection make_convection(const Parameters& p, double rayleigh, bool only_described);

/// |4 <v_y sin(pi y/L) exp(i pi x/L)>|: the velocity of rolls as wide as they are high.
Column<2> roll_amplitude_column(const Layer& layer);

/// Heat through a plate between two rows, by what the layer at rest conducts; of the lower plate what it gives,
/// of the upper one what it takes.
double nusselt(const Layer& layer, const std::vector<double>& t, const std::vector<double>& heat,
               std::size_t from, std::size_t to, bool upper);
/// The same at all rows but the first.
std::vector<double> nusselt(const Layer& layer, const std::vector<double>& t,
                            const std::vector<double>& heat, bool upper);
/// The row at the middle of a run.
std::size_t middle(const std::vector<double>& t);

/// How fast ln(amplitude) grows in the second half.
double growth_rate(const std::vector<double>& t, const std::vector<double>& amplitude);

/// Velocity, density and temperature, the grid on the left and particles on the right, [HH07] 12; heat, rolls
/// and kinetic energy against time.
void draw(Session& session, const Convection& gas, const RunRecord& run, const Grid& grid,
          const GridRun& twin);
/// --scan: velocities of rolls at the end, and on the grid how fast weak ones grow.
struct Scan {
    std::vector<double> rayleigh{}, of_particles{}, of_grid{}, growth{};
    /// Of a layer whose density and temperature vary little, between such plates; empty where unknown.
    std::optional<double> linear_onset{};
};
void draw_scan(Session& session, const Scan& scan);

}  // namespace rayleigh_benard
