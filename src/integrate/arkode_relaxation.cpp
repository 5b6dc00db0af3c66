// SPDX-License-Identifier: GPL-3.0-or-later
// ARKODE solves E(y + gamma d) - E(y) - gamma sum_i b_i h gradE(z_i) . f(z_i) = 0 for gamma, z_i the stages
// of the step; the sum is a rounding error where the rates keep E.
#include "arkode_relaxation.hpp"

#include "arkode.hpp"
#include "arkode_tables.hpp"
#include <spam/core/error.hpp>

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

constexpr double close_by = 0.01;  // of a step: a gap before a stop that is closed at once

#ifdef SPAM_RELAXATION
// Newton's last change of gamma: what it leaves is its square.
constexpr double gamma_tolerance = 1e-9;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

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
    const std::string& method = integration_method(options.method).name;
    if (!method.starts_with("arkode:"))
        refuse(
            fmt::format("{} cannot rescale its steps, only arkode:<table> can; leave it out, or "
                        "use --integrator arkode:VERNER_8_5_6",
                        method));
#ifndef SPAM_RELAXATION
    refuse(
        fmt::format("needs SUNDIALS 6.6 or later, this is {}; leave it out", sundials_version()));
#else
    if (options.dt)
        refuse(
            "a rescaled step ends beside the grid of fixed ones; leave --relaxation or --dt out");
    if (integration_method(method).order < 2)
        refuse(fmt::format(
            "{} has order 1, ARKODE rescales from order 2 on; use arkode:VERNER_8_5_6", method));
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

/// Whether a step that was to end at t_stop, or close by, is rescaled to end elsewhere.
bool Arkode::misses(double reached, double t_stop) const {
    const double gap = t_stop - reached;
    return gap < 0.0 || (gap > 0.0 && gap <= close_by * (reached - t_));
}

/// From y, which is at `reached`, to `to`.
void Arkode::close_gap(double reached, double to) {
    const double gap = to - reached;
    if (std::abs(gap) <= 2.0 * std::numeric_limits<double>::epsilon() * std::abs(to)) return;
    relax(false);
    take_fixed(reached, y_, gap);
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
    double terms = 0.0;
    for (std::size_t k = 0; k < y_.size(); ++k)
        terms += std::abs(gradient.span()[k] * y_.span()[k]);
    scale = std::max(scale, terms);
    if (!std::isfinite(scale)) scale = 0.0;  // ARKODE's own choice; the first step says why
    check(SPAM_RELAX_CALL(SetRelaxResTol, memory_, 4.0 * epsilon * scale), "SetRelaxResTol");
    check(SPAM_RELAX_CALL(SetRelaxTol, memory_, gamma_tolerance, gamma_tolerance), "SetRelaxTol");
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
