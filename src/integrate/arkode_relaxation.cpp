// SPDX-License-Identifier: GPL-3.0-or-later
// ARKODE solves E(y + gamma d) - E(y) - gamma sum_i b_i h gradE(z_i) . f(z_i) = 0 for gamma, z_i the stages
// of the step; the sum is a rounding error where the rates keep E. H. Ranocha et al., Relaxation Runge-Kutta
// methods: fully discrete explicit entropy-stable schemes ..., SIAM J. Sci. Comput. 42 (2020) A612.
#include "arkode_relaxation.hpp"

#include "arkode.hpp"
#include "arkode_tables.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#if 100 * SUNDIALS_VERSION_MAJOR + SUNDIALS_VERSION_MINOR >= 606
#define SPAM_RELAXATION
#endif
#if SUNDIALS_VERSION_MAJOR >= 7
#define SPAM_RELAX_CALL(name, ...) ARKode##name(__VA_ARGS__)
#else
#define SPAM_RELAX_CALL(name, ...) (erk_ ? ERKStep##name(__VA_ARGS__) : ARKStep##name(__VA_ARGS__))
#endif

namespace spam {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double rounding = 2.0 * epsilon;

// Of a step that must end at a certain time: so much is left for a step that is not rescaled, whose error
// in energy is smaller by spared^(order + 1). gamma may not be further from 1.
constexpr double spared = 0.01;

#ifdef SPAM_RELAXATION
// Newton's last change of gamma: what it leaves is its square.
constexpr double gamma_tolerance = 1e-9;

bool has_negative_weight(const std::string& method) {
    const Table table = load_table(method);
    return std::any_of(table->b, table->b + table->stages, [](double b) { return b < 0.0; });
}
#endif

}  // namespace

void require_relaxation(const IntegratorOptions& options) {
    const auto refuse = [](const std::string& reason) {
        throw InputError("relaxation: " + reason);
    };
#ifndef SPAM_RELAXATION
    static_cast<void>(options);
    refuse(
        fmt::format("needs SUNDIALS 6.6 or later, this is {}; leave it out", sundials_version()));
#else
    const IntegrationMethod& known = integration_method(options.method);
    const std::string& method = known.name;
    if (!method.starts_with("arkode:"))
        refuse(
            fmt::format("{} cannot rescale its steps, only arkode:<table> can; leave it out, or "
                        "use --integrator arkode:VERNER_8_5_6",
                        method));
    if (options.dt) refuse("fixed steps cannot be rescaled; leave --relaxation or --dt out");
    if (known.order < 2 || !known.adaptive)
        refuse(fmt::format("{} {}; use arkode:VERNER_8_5_6", method,
                           known.order < 2
                               ? "has order 1, ARKODE rescales from order 2 on"
                               : "cannot choose its steps, and fixed ones are not rescaled"));
    if (has_negative_weight(method))
        refuse(
            fmt::format("{} has a negative weight b_i, which ARKODE does not rescale; use e.g. "
                        "arkode:VERNER_8_5_6 or arkode:BOGACKI_SHAMPINE_4_2_3",
                        method));
#endif
}

void require_energy(const Ode& ode) {
    if (!ode.energy || !ode.energy_gradient)
        throw InputError(fmt::format(
            "relaxation: there is no energy to keep, {}; leave it out",
            ode.no_energy.empty() ? std::string("these equations name none") : ode.no_energy));
}

/// Short of the time t_stop, as seen from t.
double Arkode::short_of(double t_stop) const { return t_ + (1.0 - spared) * (t_stop - t_); }

/// The stop time for ARKODE's next step. Far away where the step does not come near t_stop: ARKODE would
/// shorten the steps after it as well and forget how long they could be.
double Arkode::stop_for_relaxed(double t_stop) const {
    const double ahead = step_ahead(), left = t_stop - t_;
    const bool far = ahead > 0.0 && (1.0 + spared) * ahead <= left;
    return far ? t_stop + left : short_of(t_stop);
}

/// Whether what is left after a rescaled step is no step of its own.
bool Arkode::almost_at(double t_stop, double reached) const {
    return t_stop - reached <= 2.0 * spared * (reached - t_) + rounding * std::abs(t_stop);
}

/// From y, which is at `reached`, to `to`, not rescaled.
void Arkode::close_gap(double reached, double to) {
    if (to - reached <= rounding * std::abs(to)) return;
    relax(false);
    take_fixed(reached, y_, to - reached);
}

/// Another step from the last accepted state, of length h.
std::span<const double> Arkode::retake_relaxed(double h) {
    relax(h > spared * statistics_.last_step);
    close_gap(take_fixed(t_, accepted_, short_of(t_ + h) - t_), t_ + h);
    return y_.span();
}

/// At t_stop. ARKODE's step is longer than the one it told where it began to choose anew: back then.
void Arkode::land(double reached, double t_stop) {
    if (reached > t_stop)
        retake_relaxed(t_stop - t_);
    else
        close_gap(reached, t_stop);
}

#ifdef SPAM_RELAXATION
bool is_failed_relaxation(int flag) { return flag == ARK_RELAX_FAIL; }

/// From y on. The energy counts as kept where it differs by the rounding errors of its terms, which are
/// about as large as those of y: epsilon sum_k |dE/dy_k y_k|.
void Arkode::set_relaxation() {
    relax(true);
    double scale = std::abs(ode_.energy(y_.span()));
    const Vector gradient = y_.clone();
    check(energy_gradient(y_.get(), gradient.get(), this), "relaxation");
    scale = std::max(scale, exact_sum(y_.size(), [&](std::size_t k) {
                         return std::abs(gradient.span()[k] * y_.span()[k]);
                     }));
    if (!std::isfinite(scale)) scale = 0.0;  // ARKODE's own choice; the first step says why
    check(SPAM_RELAX_CALL(SetRelaxResTol, memory_, 4.0 * epsilon * scale), "SetRelaxResTol");
    check(SPAM_RELAX_CALL(SetRelaxTol, memory_, gamma_tolerance, gamma_tolerance), "SetRelaxTol");
    check(SPAM_RELAX_CALL(SetRelaxLowerBound, memory_, 1.0 - spared), "SetRelaxLowerBound");
    check(SPAM_RELAX_CALL(SetRelaxUpperBound, memory_, 1.0 + spared), "SetRelaxUpperBound");
    check(SPAM_RELAX_CALL(SetRelaxMaxFails, memory_, most_rejections), "SetRelaxMaxFails");
}

void Arkode::relax(bool on) {
    if (!options_.relaxation) return;
    check(SPAM_RELAX_CALL(SetRelaxFn, memory_, on ? &Arkode::energy : nullptr,
                          on ? &Arkode::energy_gradient : nullptr),
          "SetRelaxFn");
}

long Arkode::relaxations_failed() const {
    long failed = 0;
    if (options_.relaxation) SPAM_RELAX_CALL(GetNumRelaxFails, memory_, &failed);
    return failed;
}
#else
bool is_failed_relaxation(int) { return false; }
void Arkode::set_relaxation() {}
void Arkode::relax(bool) {}
long Arkode::relaxations_failed() const { return 0; }
#endif

/// A positive return makes the step shrink.
int Arkode::energy(N_Vector y, double* energy, void* self) {
    auto& me = *static_cast<Arkode*>(self);
    try {
        *energy = me.ode_.energy(entries(y));
        return std::isfinite(*energy) ? 0 : 1;
    } catch (...) {
        me.error_ = std::current_exception();
        return -1;
    }
}

/// ARKODE does not tell the time of a stage: rates that keep an energy do not depend on it.
int Arkode::energy_gradient(N_Vector y, N_Vector gradient, void* self) {
    auto& me = *static_cast<Arkode*>(self);
    try {
        me.statistics_.rhs_evaluations +=
            me.ode_.energy_gradient(me.t_, entries(y), entries(gradient));
        return 0;
    } catch (...) {
        me.error_ = std::current_exception();
        return -1;
    }
}

}  // namespace spam
