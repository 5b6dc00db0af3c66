// SPDX-License-Identifier: GPL-3.0-or-later
#include "sundials_messages.hpp"
#include <spam/core/error.hpp>
#include <spam/core/nvector.hpp>
#include <spam/integrate/root.hpp>

#include <fmt/format.h>
#include <kinsol/kinsol.h>
#include <sunlinsol/sunlinsol_pcg.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <type_traits>

namespace spam {
namespace {

int kinsol_residual(N_Vector x, N_Vector F, void* of) {
    return (*static_cast<const Residual*>(of))(entries(x), entries(F)) ? 0 : 1;
}

}  // namespace

RootFound find_root(const Residual& residual, std::span<const double> start,
                    const RootOptions& options) {
    const SundialsContext context;
    SundialsMessages messages;
    const SundialsMessages::Scope scope(context, messages);
    Vector x(start.size(), context), one(start.size(), context);
    std::copy(start.begin(), start.end(), x.span().begin());
    std::fill(one.span().begin(), one.span().end(), 1.0);
    const auto freed = [](void* memory) { KINFree(&memory); };
    const std::unique_ptr<void, decltype(freed)> memory(KINCreate(context.get()), freed);
    const int products = 50 + static_cast<int>(5.0 * std::sqrt(static_cast<double>(start.size())));
    const std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, decltype(&SUNLinSolFree)> linear(
        SUNLinSol_PCG(x.get(), SUN_PREC_NONE, products, context.get()), &SUNLinSolFree);
    if (memory == nullptr || linear == nullptr) throw std::bad_alloc();
    void* const kinsol = memory.get();
    const auto check = [&](int flag, const char* what) {
        if (flag < 0)
            throw GuardStop(fmt::format(
                "equilibrium: no state at rest was found; let the load grow in smaller steps, or "
                "choose a smaller one (KINSOL's {}: {} {})",
                what, flag, messages.text()));
    };
#if SUNDIALS_VERSION_MAJOR < 7
    check(KINSetErrHandlerFn(kinsol, &SundialsMessages::handler, &messages), "SetErrHandlerFn");
#endif
    check(KINInit(kinsol, &kinsol_residual, x.get()), "Init");
    check(KINSetUserData(kinsol, const_cast<Residual*>(&residual)), "SetUserData");
    check(KINSetFuncNormTol(kinsol, options.tolerance), "SetFuncNormTol");
    check(KINSetScaledStepTol(kinsol, 1e-15), "SetScaledStepTol");
    check(KINSetNumMaxIters(kinsol, options.most_steps), "SetNumMaxIters");
    if (options.longest_step > 0.0)
        check(KINSetMaxNewtonStep(kinsol, options.longest_step), "SetMaxNewtonStep");
    check(KINSetEtaForm(kinsol, KIN_ETACHOICE1), "SetEtaForm");
    check(KINSetLinearSolver(kinsol, linear.get(), nullptr), "SetLinearSolver");
    const int flag = KINSol(kinsol, x.get(), KIN_LINESEARCH, one.get(), one.get());
    check(flag, "Sol");
    RootFound found;
    const auto at = std::as_const(x).span();
    found.x.assign(at.begin(), at.end());
    std::vector<double> F(found.x.size());
    residual(found.x, F);
    double left = 0.0;
    for (const double each : F)
        if (!(std::abs(each) <= left)) left = std::abs(each);
    if (flag == KIN_STEP_LT_STPTOL && !(left <= options.tolerance))
        throw GuardStop(fmt::format(
            "equilibrium: Newton's steps have become too short with forces of {:.1e} left, for {:.1e} that are "
            "allowed; allow larger ones, or let the load grow in smaller steps",
            left, options.tolerance));
    long steps = 0;
    KINGetNumNonlinSolvIters(kinsol, &steps);
    found.steps = static_cast<std::size_t>(steps);
    return found;
}

}  // namespace spam
