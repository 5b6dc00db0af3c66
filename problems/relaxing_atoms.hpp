// SPDX-License-Identifier: GPL-3.0-or-later
// What drop and string_phase have in common: embedded atoms that friction brings to rest.
#pragma once

#include "common.hpp"
#include <spam/external/friction.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/rhs/density_potentials.hpp>

namespace spam {

/// As options give it.
struct RelaxingAtoms {
    double core_range = 0.7;
    double damping = 0.1;
    Kernel kernel = Kernel::lucy;
    double range = 3.0;

    /// --damping, --kernel and --range.
    void add_options(Options& options) {
        options.number("damping", damping, "rate of the friction, gamma", between(1e-6, 100.0));
        options.choice<Kernel>("kernel", kernel, all_kernels(), "weight function");
        options.number("range", range, "distance at which the weight function vanishes",
                       positive());
    }

    /// Of atoms whose rest density is rho_0, with a core of this energy, if any.
    DensityPotentials potentials(double rho_0, double core) const {
        DensityPotentials all;
        all.state = EmbeddedAtom{1.0, rho_0};
        if (core > 0.0) all.core = {core, core_range};
        all.kernel = kernel;
        all.range = range;
        return all;
    }

    /// One body, whatever its particles' places, at rest.
    Variant<2> at_rest_at(const Points<2>& x, const DensityPotentials& potentials,
                          const std::string& title, const Box<2>& box = {}) const {
        Variant<2> one{.title = title};
        one.model = std::make_shared<DensityPotentialModel<2>>(
            one_body(make_particles<2>(x, 1.0, 1.0, box)), potentials, box);
        if (damping > 0.0)
            one.model->add(std::make_unique<Friction<2>>(damping, FrictionOf::all_motion));
        one.y0 = initial_state<2>(*one.model, 1.0, 1.0, at_rest<2>());
        one.model->layout().set_scale(Field::velocity, 0.1);
        return one;
    }
};

/// The one that an option names or, where it is not given, two: without what
/// the option is about, and with as much of it as in the figure.
template <class Make>
std::vector<Variant<2>> one_or_both(const std::optional<double>& given, double of_figure,
                                    const std::string& name, const Make& make) {
    if (given) return {make(*given)};
    std::vector<Variant<2>> both{make(0.0), make(of_figure)};
    both[0].label = "no_" + name;
    both[1].call(name);
    return both;
}

/// Runs them; `usual` is when they are at rest.
inline std::vector<RunRecord> relax(Session& session, std::vector<Variant<2>>& all, double usual,
                                    const Column<2>& column) {
    return run_all(session, all, [&](const Variant<2>&) {
        Plan<2> plan;
        plan.t_end = session.common().smoke ? 20.0 : usual;
        plan.record({column, closest_pair_column<2>()});
        return plan;
    });
}

/// The largest rise of the energy from one row to the next, which friction can only take away.
inline double largest_rise(const std::vector<double>& energy) {
    double rise = 0.0;
    for (std::size_t k = 1; k < energy.size(); ++k)
        rise = std::max(rise, energy[k] - energy[k - 1]);
    return rise;
}

/// The momentum by particle: round-off, relative to the largest rms speed where that is above that of sound, 1.
inline void check_momentum(const Findings& findings, const RunRecord& run, const char* source) {
    const History& h = run.history;
    const double speed = std::sqrt(2.0 * h.largest("kinetic") / h.first("mass"));
    findings.check("momentum_per_particle",
                   std::hypot(h.largest_change("momentum_x"), h.largest_change("momentum_y")) /
                       static_cast<double>(run.statistics.particles),
                   0.0, 1e-12 * std::max(1.0, speed), source);
}

}  // namespace spam
