// SPDX-License-Identifier: GPL-3.0-or-later
// A column of an embedded-atom fluid under gravity, of particles or of finite elements: how it is made, and what it is
// compared with.
#pragma once

#include "../common.hpp"
#include <spam/rhs/density_potentials.hpp>
#include <spam/rhs/elements.hpp>

namespace water_column {

using namespace spam;

constexpr int figure_width = 16;        // 640 particles
constexpr double figure_gravity = 0.4;  // g times height by c^2 = B0/rho0 = 1

/// What the column is made of.
enum class ColumnOf { particles, elements, both };
inline std::string_view to_string(ColumnOf kind) {
    constexpr std::string_view names[] = {"particles", "elements", "both"};
    return names[static_cast<std::size_t>(kind)];
}

struct Parameters {
    const Sides* sides = nullptr;
    ColumnOf model = ColumnOf::particles;
    std::string mesh{};  ///< "80x64": elements across and up; empty: as on the slide, dy = 2 dx = 1
    HourglassControl hourglass{0.1, 0.0};
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
    std::array<int, 2> mesh{};             ///< elements across and up; none of particles
    int sample = 0;        ///< beyond 0: one that rests a little shorter or longer than the first
    std::string prefix{};  ///< of results where there are several columns

    int particles() const { return width * rows; }
    bool of_elements() const { return mesh[0] > 0; }
    /// "640 particles"
    std::string words() const {
        return of_elements() ? fmt::format("{} x {} elements", mesh[0], mesh[1])
                             : fmt::format("{} particles", particles());
    }
};

/// `refinement`: 1, or 2 and 4 for columns twice and four times as wide, with everything else scaled so that
/// the flow is the same at t/width. `sample`: 0, or one that rests a little shorter (1, 3, ...) or longer than
/// the first. `only_described`: without a state.
FluidColumn make_column(const Parameters& p, int refinement, int sample, bool only_described);

/// What a column of any kind has: all but models and states.
FluidColumn scaled_column(const Parameters& p, int refinement);
/// One of elements, which floor and walls guide: their nodes slide there. Sets p.mesh where it is empty; throws
/// InputError where it is none.
FluidColumn make_mesh_column(Parameters& p, bool only_described);
/// A step of rk4 in which sound passes a tenth of an element.
double step_of(const FluidColumn& column);

/// Of the fluid: pressure and energy by the density.
AnyEquationOfState law_of(const Parameters& p);
/// Of every particle, or of every element.
std::vector<double> pressures_of(const Parameters& p, const Model<2>& model,
                                 std::span<const double> y);

// ---- the column at rest ----

/// Density at `depth` below the surface: grad P = rho g with P(rho) of the embedded atom, B0 = rho0 = 1.
double hydrostatic_density(double g, double depth);
/// Depth of a fluid that has a mass `mass` per width: so far above the floor is its surface.
double hydrostatic_depth(double g, double mass);

/// Particles of a horizontal slab, or a row of elements.
struct Slab {
    double y;        ///< mean height
    double density;  ///< mean of the (summed) densities
};
/// Rows of elements, from the floor upwards.
std::vector<Slab> rows_of(const FluidColumn& column, std::span<const double> y);
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
/// `centre_height`: of the centre of mass. `tension`: share of particles, or elements, under tension.
std::vector<Column<2>> compared_columns(const Parameters& p);
/// Of elements, by their nodes: `front`, `leading_percent` (of the mass), `height` (at the wall), compared_columns(),
/// `hourglass_work`.
std::vector<Column<2>> mesh_columns(const Parameters& p);

/// Times at which both are compared and drawn, by the unit of time: 30 and 40 of a column 40 wide.
constexpr double compared_times[] = {0.75, 1.0};

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

/// Of elements, in a run of their own or beside particles.
void report_elements(Session& session, const Parameters& p, const Computed& elements);
/// Particles against elements; `samples`: of particles, the first one to be compared where there is no other.
void report_both(Session& session, const Parameters& p, std::span<const Computed> samples,
                 const Computed& elements);
/// Whether a run has come to t.
bool reached(const RunRecord& run, double t);
/// Of all samples of a size that have come to time t: mean and standard deviation of a column of the history.
struct Sampled {
    int number = 0;
    double mean = 0.0, deviation = 0.0;
};
Sampled sampled(std::span<const Computed> samples, double t, const char* name);
void report(Session& session, const Parameters& p, const std::vector<Computed>& columns);
/// Columns that are no further samples.
void draw(Session& session, const Parameters& p, const std::vector<Computed>& columns);

}  // namespace water_column
