// SPDX-License-Identifier: GPL-3.0-or-later
// A bar that is pulled apart: how it is made, what is watched, and what is known of it.
#pragma once

#include "../breaking/matter.hpp"

namespace tension_test {

using namespace breaking;

struct Parameters {
    Matter matter;
    int columns = 60;
    std::optional<int> rows;  ///< 14, or 12 elements
    double taper = 0.1;
    std::optional<double> load_rate, damping;
    std::optional<double> end_speed;  ///< in place of a load
};

struct PulledBar : Variant<2> {
    MatterKind kind;
    double load_rate;  ///< the load at the ends is load_rate t; 0 where there is none
    double step;       ///< of classical Runge-Kutta
    double t_end;      ///< at which a run ends at the latest
};

/// `matter`: that of p, of one kind.
PulledBar make_bar(const Session& session, const Parameters& p, const Matter& matter);

/// `pieces`: of a twentieth of the particles or more; `largest_piece`, `second_piece`: their particles;
/// `length`, `closest_pair`.
std::vector<Column<2>> columns_of(const PulledBar& bar);

/// Time of the first of the last rows that all have more than one piece; none where the last has one.
std::optional<double> parted_at(const History& h);

void report(Session& session, const Parameters& p, const PulledBar& bar, const RunRecord& run);
/// The states kept of one bar, or of several how they were before and have ended.
void draw(Session& session, const std::vector<PulledBar>& bars, const std::vector<RunRecord>& runs);

/// The run of the finite-element twin, and what it came to.
void compute_elements(Session& session, const Parameters& p);

}  // namespace tension_test
