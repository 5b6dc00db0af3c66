// SPDX-License-Identifier: GPL-3.0-or-later
// A column of an embedded-atom fluid under gravity: how it is made, and what it is compared with.
#pragma once

#include "../common.hpp"
#include <spam/rhs/density_potentials.hpp>

namespace water_column {

using namespace spam;

constexpr int figure_width = 16;        // 640 particles
constexpr double figure_gravity = 0.4;  // g times height by c^2 = B0/rho0 = 1

struct Parameters {
    const Sides* sides = nullptr;
    int width = figure_width;
    double aspect = 2.5;
    double gravity = figure_gravity;
    bool compare = false;
    std::optional<int> samples;
    std::optional<double> cavitation;
    double surface_tension = 0.1;
    double core = 1.0;
    double core_range = 0.7;
    std::optional<double> damping, relaxation_time;
    Kernel kernel = Kernel::lucy;
    double range = 3.0;
};

/// One column: at rest between walls, and let go.
struct FluidColumn {
    int width, rows;
    double g;                ///< gravity
    double damping;          ///< of the relaxation
    double relaxation_time;  ///< its length
    double unit;             ///< of time, of the collapse: the width at figure_gravity
    std::shared_ptr<ParticleModel<2>> between_walls, released;
    std::vector<double> y0{};              ///< square lattice at rest
    std::vector<NearestState<2>> drawn{};  ///< of the collapse
    int sample = 0;        ///< beyond 0: one that rests a little shorter or longer than the first
    std::string prefix{};  ///< of results where there are several columns

    int particles() const { return width * rows; }
};

/// `refinement`: 1, or 2 and 4 for columns twice and four times as wide, with everything else scaled so that
/// the flow is the same at t/width. `sample`: 0, or one that rests a little shorter (1, 3, ...) or longer than
/// the first. `only_described`: without a state.
FluidColumn make_column(const Parameters& p, int refinement, int sample, bool only_described);

/// Of the fluid: pressure and energy by the density.
AnyEquationOfState law_of(const Parameters& p);

// ---- the column at rest ----

/// Density at `depth` below the surface: grad P = rho g with P(rho) of the embedded atom, B0 = rho0 = 1.
double hydrostatic_density(double g, double depth);
/// Depth of a fluid that has a mass `mass` per width: so far above the floor is its surface.
double hydrostatic_depth(double g, double mass);

/// Particles of a horizontal slab.
struct Slab {
    double y;        ///< mean height
    double density;  ///< mean of the summed densities
};
/// From the floor upwards.
std::vector<Slab> slabs_of(const FluidColumn& column, std::span<const double> y);
/// Largest relative difference of slabs from the hydrostatic density, where the weight function does not
/// reach the surface.
double profile_error(const FluidColumn& column, std::span<const double> y, double range);
/// Of the number of particles below the last place where profile_error() looks: relative difference from
/// the hydrostatic mass there.
double mass_error(const FluidColumn& column, std::span<const double> y, double range);

// ---- the column on its way ----

/// `front`: largest x. `leading_percent`: x beyond which the leading 1 % of the particles are. `height`:
/// largest y of the particles within the range of the wall. `closest_pair`.
std::vector<Column<2>> motion_columns(double range);

struct Measured {
    double T, Z;
};
/// Martin and Moyce 1952, water columns twice as high as wide: T = t sqrt(2 g/a), Z = front/a, a the width.
const std::vector<Measured>& martin_and_moyce();
/// t/width at T.
double scaled_time(const FluidColumn& column, double T);
/// Whether they had this column.
bool is_martin_and_moyce(const FluidColumn& column);

// ---- what was found ----

/// What became of a column, so far as it has come.
struct Computed {
    const FluidColumn* column;
    const RunRecord* rest;
    const RunRecord* collapse;  ///< null where it has not been released
};

void report(Session& session, const Parameters& p, const std::vector<Computed>& columns);
/// Columns that are no further samples.
void draw(Session& session, const Parameters& p, const std::vector<Computed>& columns);

}  // namespace water_column
