// SPDX-License-Identifier: GPL-3.0-or-later
// What md_fields computes, and what it finds.
#pragma once

#include "../common.hpp"
#include <spam/diagnostics/field_grid.hpp>
#include <spam/diagnostics/molecular_fields.hpp>

namespace md_fields {

using namespace spam;

enum class System { fluid, impact };
inline std::string_view to_string(System system) {
    return system == System::fluid ? "fluid" : "impact";
}

struct Parameters {
    System system = System::fluid;
    int cells = 32;
    double temperature = 1.5;
    double radius = 16.0, speed = 6.0, offset = 12.0;
    double range = 3.0;
    Kernel kernel = Kernel::lucy;
    int seed = 1;
    AnyWeight<2> weight() const { return weight_function<2>(spam::to_string(kernel), range); }
};

struct Molecules : Variant<2> {
    System system;
    int draws = 0;          ///< of velocities, after the first ones
    double drawn_at = 0.0;  ///< when the latest was due
};

/// The true temperature, and at several ranges what fields say and what they should say.
std::vector<Column<2>> columns_of(const Molecules& one, const Parameters& p);
/// Draws all velocities anew after each interval, with the kinetic energy that there is.
Observer<2> draw_velocities(Molecules& one, int seed, double interval);
/// `known`: where another program has found something.
void report_temperature(const Findings& findings, const RunRecord& run, bool known);

/// Momentum at the end, at random places. `known`: likewise.
void report_balance(const Findings& findings, const Molecules& one, const Parameters& p,
                    const RunRecord& run, bool known);
void draw_balance(Session& session, const Molecules& one, const Parameters& p,
                  const RunRecord& run);

}  // namespace md_fields
