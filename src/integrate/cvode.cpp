// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvode.hpp"

#include "arkode_control.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parts.hpp>

#include <cvode/cvode.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

namespace spam {

Cvode::Cvode(const IntegratorOptions& options, const Ode& ode, Vector& y, double t0,
             const SundialsContext& context)
    : Integrator(ode, y, t0),
      options_(options),
      context_(context),
      accepted_(y.clone()),
      local_error_(y.clone()),
      weight_(y.clone()),
      shares_(ode.blocks, ErrorShares::Norm::rms) {
    create();
}

Cvode::~Cvode() { destroy(); }

void Cvode::destroy() {
    CVodeFree(&memory_);
    corrector_.reset();
}

/// CVODE's memory for going on from y at t, as if nothing had been before.
void Cvode::create() {
    destroy();
    const SundialsMessages::Scope scope(context_, messages_);
    const bool bdf = options_.method == "cvode:bdf";
    memory_ = CVodeCreate(bdf ? CV_BDF : CV_ADAMS, context_.get());
    if (memory_ == nullptr) throw std::bad_alloc();
#if SUNDIALS_VERSION_MAJOR < 7
    check(CVodeSetErrHandlerFn(memory_, &SundialsMessages::handler, &messages_), "SetErrHandlerFn");
#endif
    check(CVodeInit(memory_, &Cvode::rates, t_, y_.get()), "Init");
    check(CVodeSetUserData(memory_, this), "SetUserData");
    Vector atol = y_.clone();
    std::copy(ode_.absolute_tolerance.begin(), ode_.absolute_tolerance.end(), atol.span().begin());
    // SPGMR divides by weights: those of accounts are then not 0, but of no weight in any sum.
    for (double& tolerance : atol.span())
        if (bdf) tolerance = std::min(tolerance, 1e100);
    check(CVodeSVtolerances(memory_, options_.rtol, atol.get()), "SVtolerances");
    corrector_ = std::make_unique<CvodeCorrector>(bdf, y_, context_);
    check(CVodeSetNonlinearSolver(memory_, corrector_->get()), "SetNonlinearSolver");
    if (bdf) {
        check(CVodeSetLinearSolver(memory_, corrector_->krylov(), nullptr), "SetLinearSolver");
        // CVODE knows the length of a part alone, by which each would stop its linear solver elsewhere.
        Parts& parts = Parts::here();
        const std::size_t copies = parts.alone() ? 0 : parts.copies;
        const auto n = static_cast<double>(parts.total(y_.size() - copies) + copies);
        check(CVodeSetLSNormFactor(memory_, std::sqrt(n)), "SetLSNormFactor");
        // Orders 3 to 5 let what turns slowly grow where steps are long.
        check(CVodeSetStabLimDet(memory_, 1), "SetStabLimDet");
    }
    check(CVodeSetMaxErrTestFails(memory_, most_rejections), "SetMaxErrTestFails");
    check(CVodeSetMaxConvFails(memory_, most_rejections), "SetMaxConvFails");
    check(CVodeSetMinStep(memory_, *options_.min_step), "SetMinStep");
    if (options_.max_step) check(CVodeSetMaxStep(memory_, *options_.max_step), "SetMaxStep");
    if (options_.initial_step)
        check(CVodeSetInitStep(memory_, *options_.initial_step), "SetInitStep");
    N_VScale(1.0, y_.get(), accepted_.get());
}

void Cvode::check(int flag, const char* call) const {
    if (flag != CV_SUCCESS)
        throw InputError(
            fmt::format("integrator: CVODE {} failed ({}): {}", call, flag, messages_.text()));
}

int Cvode::rates(double t, N_Vector y, N_Vector y_dot, void* self) {
    auto& me = *static_cast<Cvode*>(self);
    ++me.statistics_.rhs_evaluations;
    try {
        me.ode_.rates(t, entries(y), entries(y_dot));
        return me.ode_.failure().empty() ? 0 : 1;  // 1: a shorter step may do
    } catch (...) {
        me.error_ = std::current_exception();
        return -1;
    }
}

void Cvode::estimate_errors() {
    if (ode_.blocks.empty()) return;
    check(CVodeGetEstLocalErrors(memory_, local_error_.get()), "GetEstLocalErrors");
    check(CVodeGetErrWeights(memory_, weight_.get()), "GetErrWeights");
    shares_.measure(
        [e = local_error_.span(), w = weight_.span()](std::size_t k) { return e[k] * w[k]; });
}

void Cvode::stop(int flag) {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    std::string message = ode_.failure();
    double h = 0.0;
    CVodeGetCurrentStep(memory_, &h);
    if (message.empty() && flag == CV_ERR_FAILURE) {
        estimate_errors();
        message = rejected_too_often(h, *options_.min_step, shares_.in_words());
    } else if (message.empty() && flag == CV_CONV_FAILURE) {
        message = fmt::format(
            "the corrector did not converge, the step fell to {:.3g} (least allowed {:.3g})", h,
            *options_.min_step);
    } else if (message.empty()) {
        message = messages_.text();
    }
    std::replace(message.begin(), message.end(), '\n', ' ');
    throw GuardStop(fmt::format("{} at t = {:.6g} (CVODE {})", message, t_, flag));
}

double Cvode::take_step(double t_stop) {
    check(CVodeSetStopTime(memory_, t_stop), "SetStopTime");
    const SundialsMessages::Scope scope(context_, messages_);
    double reached = t_;
    const int flag = CVode(memory_, t_stop, y_.get(), &reached, CV_ONE_STEP);
    try {
        if (flag < 0) stop(flag);
        guard(y_.span(), reached);
    } catch (const GuardStop&) {
        N_VScale(1.0, accepted_.get(), y_.get());
        throw;
    }
    t_ = reached;
    N_VScale(1.0, y_.get(), accepted_.get());
    count();
    return t_;
}

void Cvode::count() {
    if (errors_due()) {
        estimate_errors();
        shares_.count(statistics_);
    }
    ++statistics_.steps;
    CVodeGetLastStep(memory_, &statistics_.last_step);
    long errors = 0, corrections = 0;
    CVodeGetNumErrTestFails(memory_, &errors);
    CVodeGetNumStepSolveFails(memory_, &corrections);
    statistics_.rejected_steps = rejected_before_ + static_cast<std::size_t>(errors + corrections);
}

void Cvode::reset(double t) {
    t_ = t;
    rejected_before_ = statistics_.rejected_steps;  // CVodeReInit begins to count anew
    check(CVodeReInit(memory_, t, y_.get()), "ReInit");
    N_VScale(1.0, y_.get(), accepted_.get());
}

/// The next step is not remembered: order 1 needs a much shorter one, which CVODE finds.
void Cvode::remember(Archive& archive) {
    Integrator::remember(archive);
    if (!archive.reading()) return;
    rejected_before_ = statistics_.rejected_steps;
    create();
}

}  // namespace spam
