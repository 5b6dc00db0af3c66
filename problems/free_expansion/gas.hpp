// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of free_expansion share.
#pragma once

#include "../common.hpp"
#include "../ranges.hpp"
#include <spam/diagnostics/field_grid.hpp>
#include <spam/material/fluid.hpp>

namespace free_expansion {

using namespace spam;

enum class Walls { periodic, mirror };
inline std::string_view to_string(Walls w) { return w == Walls::periodic ? "periodic" : "mirror"; }

struct Parameters {
    const Sides* sides = nullptr;
    int dimension = 2;
    int cells = 64;                // along an edge of the gas, at spacing 1
    std::optional<int> particles;  // in place of cells
    Walls walls = Walls::periodic;
    Kernel kernel = Kernel::lucy;
    double range = 6.0;
    Ranges ranges = Ranges::fixed;
    int seed = 4;
    bool compare = false, cost = false, movie = false;
    bool only_described = false;  // a dry run: no state is computed
};

/// The gas in the middle of its box of twice the side, and what is gathered on the way.
template <int Dim>
struct Gas : Variant<Dim, Model<Dim>> {
    int cells;
    AnyWeight<Dim> weight;  ///< of averages; of the motion as well where ranges are fixed
    std::vector<double> field_times{};  ///< of the files of gridded fields
    int frames = 0;                     ///< of a film

    double side() const { return 2.0 * cells; }
    /// z of the layer of sites that is next to the middle: of pictures of what is in space.
    double cut() const { return cells % 2 == 1 ? cells : cells + 0.5; }
    std::size_t particles() const { return this->model->particles().size(); }
};

/// n^Dim particles of mass and spacing 1, at rest, each off its site by 0.1 (u - 1/2), u even between 0
/// and 1; in the plane P = rho^2/2 (gamma = 2, [HH01] eq 20), on the line P = rho^3/3 (gamma = 3,
/// exercise 1), in space P = 0.6 rho^(5/3): isentropes of the ideal gas with c = 1 at the start.
/// Ranges by density: h = range/rho^(1/Dim), for as many neighbours in the thin gas as in the dense.
template <int Dim>
Gas<Dim> make_gas(int cells, const Parameters& p);

AnyEquationOfState law_of(int dim);

/// A step with which RK4 keeps the energy to 1e-6: 0.25 with Lucy's weight of range 6 in the plane; half
/// of it, a quarter, ... with weights that feel shorter waves, in proportion to these. On the line, where
/// every particle meets every other, 12,000 steps of 0.25 change the energy by 2e-6: half of it. In space
/// 0.2 with Lucy's weight of range 4.
template <int Dim>
double step_for(const Parameters& p);

/// entropy_sum, entropy_grid, entropy_full_v2: changes since the start as a part of N k ln (box/gas).
template <int Dim>
std::vector<Column<Dim>> entropy_columns(const Gas<Dim>& gas);

/// Fields of one state on a regular grid over the box; in space of its cut alone where asked.
template <int Dim>
struct Fields {
    FieldGrid<Dim> grid;
    std::vector<double> density;
    std::vector<double> kinetic;  ///< per volume: sum_j m_j v_j^2 w/2, seen motion and hidden
    Eigen::MatrixXd velocity;     ///< <v>, Dim x nodes, 0 where no gas is
    std::vector<double> hidden;   ///< (<v^2> - <v>^2)/2 per mass
};
template <int Dim>
Fields<Dim> fields_of(const Gas<Dim>& gas, const Points<Dim>& position, const Points<Dim>& velocity,
                      bool of_cut = false);

/// fields_0000.vti, ... beside the snapshots, and fields.pvd, the list of them with their times.
template <int Dim>
void write_fields(const RunFolder& folder, Gas<Dim>& gas, double t, std::span<const double> y);

// ---- checks.cpp ----

template <int Dim>
void check(Session& session, const Parameters& p, const Gas<Dim>& gas, const RunRecord& run);

// ---- pictures.cpp ----

/// Times, in those the sound takes along the gas, at which configurations are drawn.
inline const std::vector<double> drawn_at{0.25, 0.5, 0.75, 1.25};

template <int Dim>
void draw_entropy(Session& session, const std::vector<Gas<Dim>>& gases,
                  const std::vector<RunRecord>& runs);
template <int Dim>
void draw(Session& session, const Gas<Dim>& gas);

/// A frame of a film in <folder>/frames; false where it could not be drawn.
template <int Dim>
bool draw_frame(const RunFolder& folder, const Gas<Dim>& gas, int number, double t,
                std::span<const double> y);
/// Puts them together, or says why not.
void make_movie(Session& session, const RunFolder& folder);

// ---- cost.cpp ----

/// Seconds a unit of time against the number of particles, [HH01] exercise 4.
template <int Dim>
void measure_cost(Session& session, const Parameters& p);

}  // namespace free_expansion
