// SPDX-License-Identifier: GPL-3.0-or-later
#include "bar.hpp"
#include "elements.hpp"
#include <spam/picture/draw.hpp>

#include <fmt/format.h>

namespace tension_test {
namespace {

tension_elements::Parameters twin_of(const Parameters& p) {
    tension_elements::Parameters twin;
    twin.columns = p.columns;
    twin.rows = p.rows.value_or(twin.rows);
    twin.taper = p.taper;
    twin.end_speed = p.end_speed;
    twin.yield_stress = p.matter.yield_stress.value_or(twin.yield_stress);
    twin.hardening = p.matter.hardening;
    twin.failure_strain = p.matter.failure_strain.value_or(twin.failure_strain);
    return twin;
}

/// Elements at their middles, by their plastic strain.
void draw_elements(Session& session, const Model<2>& model, const RunRecord& run) {
    const auto quadrilaterals = model.quadrilaterals();
    const auto x = ConstState<2>(model.layout(), run.y).position();
    const auto strains = tension_elements::plastic_strains(model, run.y);
    Points<2> middle = Points<2>::Zero(2, static_cast<Eigen::Index>(quadrilaterals.size()));
    for (std::size_t k = 0; k < quadrilaterals.size(); ++k)
        for (const auto corner : quadrilaterals[k])
            middle.col(static_cast<Eigen::Index>(k)) +=
                0.25 * x.col(static_cast<Eigen::Index>(corner));
    session.note_drawn(draw_configurations(session.plots_folder(), "configurations",
                                           "A bar of finite elements under tension",
                                           {{fmt::format("t = {:g}", run.statistics.t_end),
                                             middle,
                                             {strains.begin(), strains.end()},
                                             {}}},
                                           1, "plastic strain"));
}

}  // namespace

void compute_elements(Session& session, const Parameters& p) {
    const auto twin = twin_of(p);
    const auto bar = tension_elements::make_bar(twin);
    Plan<2> plan;
    plan.t_end = session.common().smoke ? 16.0 : 64.0;
    plan.output_every = plan.t_end / 128.0;
    plan.record(tension_elements::columns_of(twin));
    const auto run = session.run<2>(*bar.model, bar.y0, std::move(plan));
    const History& h = run.history;
    const bool known = run.complete && run.statistics.t_end >= 64.0 &&
                       session.when_default({"columns", "rows", "taper", "end-speed",
                                             "yield-stress", "hardening", "failure-strain"});
    constexpr struct {
        double t, largest;
    } known_strains[] = {{32.0, 0.048}, {48.0, 0.081}, {64.0, 0.113}};
    for (const auto& one : known_strains)
        if (known)
            session.check({fmt::format("largest_plastic_strain_at_{:g}", one.t),
                           h.at(one.t, "largest_plastic_strain"), one.largest, 0.004,
                           "[HH07] 13; recorded values"});
    for (const char* name :
         {"largest_plastic_strain", "mean_plastic_strain", "neck", "length", "elements_broken"})
        session.measure(name, h.last(name), "at the end");
    session.check_promises(run);
    if (session.plots()) draw_elements(session, *bar.model, run);
}

}  // namespace tension_test
