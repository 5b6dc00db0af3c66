// SPDX-License-Identifier: GPL-3.0-or-later
// A bar that is pulled apart: how it is made, what is watched, and what is known of it.
#pragma once

#include "../breaking/matter.hpp"

namespace tension_test {

using namespace breaking;

struct Parameters {
    Matter matter;
    int dimension = 2;
    int columns = 60;         ///< in space 30 layers
    std::optional<int> rows;  ///< 14, or 12 elements; in space 8 layers either way
    double taper = 0.1;
    std::optional<double> load_rate, damping;
    std::optional<double> end_speed;  ///< in place of a load
};

template <int Dim>
struct PulledBar : Variant<Dim> {
    MatterKind kind;
    double load_rate;  ///< the load at the ends is load_rate t; 0 where there is none
    double step;       ///< of classical Runge-Kutta
    double t_end;      ///< at which a run ends at the latest
};

/// `matter`: that of p, of one kind.
template <int Dim>
PulledBar<Dim> make_bar(const Session& session, const Parameters& p, const Matter& matter);

/// `pieces`: of a twentieth of the particles or more; `largest_piece`, `second_piece`: their particles;
/// `length`, `closest_pair`.
template <int Dim>
std::vector<Column<Dim>> columns_of(const PulledBar<Dim>& bar);

/// Time of the first of the last rows that all have more than one piece; none where the last has one.
std::optional<double> parted_at(const History& h);

template <int Dim>
void report(Session& session, const Parameters& p, const PulledBar<Dim>& bar, const RunRecord& run);
/// The states kept of one bar, or of several how they were before and have ended; in space the layer of sites that is
/// next to the middle.
template <int Dim>
void draw(Session& session, const Parameters& p, const std::vector<PulledBar<Dim>>& bars,
          const std::vector<RunRecord>& runs);

/// The run of the finite-element twin, and what it came to.
void compute_elements(Session& session, const Parameters& p);

}  // namespace tension_test
