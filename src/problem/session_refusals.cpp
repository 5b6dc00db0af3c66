// SPDX-License-Identifier: GPL-3.0-or-later
// What a session refuses once models and plans are known, before anything is written.
#include <spam/core/error.hpp>
#include <spam/problem/session.hpp>

#include <fmt/format.h>

namespace spam {

/// What balances every body or all together: the same where there is one body, and always will be.
template <int Dim>
void Session::refuse_idle_balance(const std::vector<Case<Dim>>& cases) {
    for (const auto& one : cases)
        if (one.model->particles().bodies() > 1 || one.plan.may_change()) return;
    if (given("balance"))
        throw InputError("balance: both choices are the same for one body; leave it out");
    leave_out_of_case({"balance"});
}

/// Classical Runge-Kutta damps what decays at a rate below 2.785/dt, and makes what decays faster grow.
template <int Dim>
void Session::refuse_unstable(const Case<Dim>& one) const {
    constexpr double limit = 2.785;
    const double rate = one.model->fastest_damping(one.y0);
    const IntegratorOptions own = integrator_of(one.plan);
    if (own.method != "rk4" || *own.dt * rate < limit) return;
    const auto name = problem_.options_.first_given({"damping", "viscosity", "conductivity"});
    throw InputError(fmt::format(
        "dt: damping ({}) acts on fast motion at a rate of about {:.3g}, for which rk4 is stable "
        "with steps below {:.2g} only, not {:g}; choose a smaller --dt or less damping",
        name.empty() ? "of the model" : "--" + name, rate, limit / rate, *own.dt));
}

/// An adaptive method chooses its steps, but none in which things pass many particles. In such a step, then, the
/// run has an end.
template <int Dim>
void Session::refuse_endless(const Case<Dim>& one) const {
    if (!integrator_of(one.plan).adaptive()) return;  // settle_plan() has counted the steps
    const auto& layout = one.model->layout();
    double speed = 0.0;
    for (const auto& block : layout.blocks())
        if (block.field == Field::velocity) speed = block.scale;
    const double spacings = one.plan.t_end * speed / one.model->particles().spacing;
    if (!(spacings <= most_steps))
        throw InputError(fmt::format(
            "t-end: until t = {:g} particles would pass some {:.0e} others, in at least as many "
            "steps; give an earlier end",
            one.plan.t_end, spacings));
}

#define SPAM_INSTANTIATE(D)                                                  \
    template void Session::refuse_idle_balance(const std::vector<Case<D>>&); \
    template void Session::refuse_unstable(const Case<D>&) const;            \
    template void Session::refuse_endless(const Case<D>&) const;
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
