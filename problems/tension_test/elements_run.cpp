// SPDX-License-Identifier: GPL-3.0-or-later
#include "bar.hpp"
#include "elements.hpp"

namespace tension_test {
namespace {

tension_elements::Parameters twin_of(const Parameters& p) {
    tension_elements::Parameters twin;
    twin.columns = p.columns;
    twin.rows = p.rows.value_or(twin.rows);
    twin.taper = p.taper;
    twin.end_speed = p.end_speed.value_or(twin.end_speed);
    twin.yield_stress = p.matter.yield_stress.value_or(twin.yield_stress);
    twin.hardening = p.matter.hardening;
    twin.failure_strain = p.matter.failure_strain.value_or(twin.failure_strain);
    return twin;
}

}  // namespace

void compute_elements(Session& session, const Parameters& p) {
    const bool known = session.when_default(
        {"columns", "rows", "taper", "end-speed", "yield-stress", "hardening", "failure-strain"});
    tension_elements::compute(session, twin_of(p), session.common().smoke ? 16.0 : 64.0, known);
}

}  // namespace tension_test
