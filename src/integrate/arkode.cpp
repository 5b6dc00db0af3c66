// SPDX-License-Identifier: GPL-3.0-or-later
// Runs ARKODE's methods. From SUNDIALS 7 on one set of calls serves ERKStep and ARKStep.
#include "arkode.hpp"

#include "arkode_relaxation.hpp"
#include "arkode_tables.hpp"
#include <spam/core/error.hpp>
#include <spam/integrate/interrupt.hpp>

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <utility>

namespace spam {

// The calls in use, each named once: ours and ARKODE's.
#define SPAM_ARKODE_CALLS(X)                   \
    X(evolve, Evolve)                          \
    X(reset, Reset)                            \
    X(free, Free)                              \
    X(set_user_data, SetUserData)              \
    X(set_tolerances, SVtolerances)            \
    X(set_fixed_step, SetFixedStep)            \
    X(set_init_step, SetInitStep)              \
    X(set_stop_time, SetStopTime)              \
    X(set_min_step, SetMinStep)                \
    X(set_max_step, SetMaxStep)                \
    X(set_safety, SetSafetyFactor)             \
    X(set_most_rejections, SetMaxErrTestFails) \
    X(rejected, GetNumErrTestFails)            \
    X(last_step, GetLastStep)                  \
    X(current_step, GetCurrentStep)            \
    X(local_errors, GetEstLocalErrors)         \
    X(weights, GetErrWeights)

struct Arkode::Calls {
#if SUNDIALS_VERSION_MAJOR >= 7
#define SPAM_CALL(ours, theirs) decltype(&ARKode##theirs) ours = &ARKode##theirs;
    SPAM_ARKODE_CALLS(SPAM_CALL)
    decltype(&set_arkode_controller) set_controller = &set_arkode_controller;

    static const Calls& of(bool) {
        static constexpr Calls all;
        return all;
    }
#else
#define SPAM_CALL(ours, theirs) decltype(&ERKStep##theirs) ours = &ERKStep##theirs;
    SPAM_ARKODE_CALLS(SPAM_CALL)
    decltype(&set_erkstep_controller) set_controller = &set_erkstep_controller;
    decltype(&ERKStepSetErrHandlerFn) set_error_handler = &ERKStepSetErrHandlerFn;

    /// Of ERKStep, or of ARKStep, which runs what ERKStep cannot.
    static const Calls& of(bool erkstep) {
        static constexpr Calls erk;
        static constexpr Calls ark = [] {
            Calls calls;
#define SPAM_ARKSTEP(ours, theirs) calls.ours = &ARKStep##theirs;
            SPAM_ARKODE_CALLS(SPAM_ARKSTEP)
            calls.set_controller = &set_arkstep_controller;
            calls.set_error_handler = &ARKStepSetErrHandlerFn;
            return calls;
        }();
        return erkstep ? erk : ark;
    }
#endif
};

Arkode::Arkode(const IntegratorOptions& options, const Ode& ode, Vector& y, double t0,
               const SundialsContext& context)
    : Integrator(ode, y, t0),
      options_(options),
      context_(context),
      dt_(options.dt),
      grid_(t0, options.dt.value_or(1.0)),
      accepted_(y.clone()),
      local_error_(y.clone()),
      weight_(y.clone()),
      shares_(ode.blocks, ErrorShares::Norm::rms),
      watch_(ode) {
    create();
}

/// ARKODE's memory for going on from y at t, as if nothing had been before.
void Arkode::create() {
    if (memory_ != nullptr) calls_->free(&memory_);
    const SundialsMessages::Scope scope(context_, messages_);
    const Table table = load_table(options_.method);
    erk_ = erkstep_is_right(*table);
    calls_ = &Calls::of(erk_);
    memory_ = erk_ ? ERKStepCreate(&Arkode::rates, t_, y_.get(), context_.get())
                   : ARKStepCreate(&Arkode::rates, nullptr, t_, y_.get(), context_.get());
    if (memory_ == nullptr) throw std::bad_alloc();
#if SUNDIALS_VERSION_MAJOR < 7
    check(calls_->set_error_handler(memory_, &SundialsMessages::handler, &messages_),
          "SetErrHandlerFn");
#endif
    check(calls_->set_user_data(memory_, this), "SetUserData");
    check(erk_ ? ERKStepSetTable(memory_, table.get())
               : ARKStepSetTables(memory_, table->q, table->p, nullptr, table.get()),
          "SetTable");
    if (dt_)
        check(calls_->set_fixed_step(memory_, *dt_), "SetFixedStep");
    else
        set_step_control();
    if (options_.relaxation) set_relaxation();
    retaking_ = false;
    first_step_ = 0.0;
    N_VScale(1.0, y_.get(), accepted_.get());
}

void Arkode::set_step_control() {
    Vector atol = y_.clone();
    std::copy(ode_.absolute_tolerance.begin(), ode_.absolute_tolerance.end(), atol.span().begin());
    check(calls_->set_tolerances(memory_, options_.rtol, atol.get()), "SVtolerances");
    check(calls_->set_controller(memory_, options_.controller, context_.get(), controller_),
          "SetController");
    check(calls_->set_most_rejections(memory_, most_rejections), "SetMaxErrTestFails");
    check(calls_->set_min_step(memory_, *options_.min_step), "SetMinStep");
    if (options_.max_step) check(calls_->set_max_step(memory_, *options_.max_step), "SetMaxStep");
    if (options_.initial_step)
        check(calls_->set_init_step(memory_, *options_.initial_step), "SetInitStep");
    if (options_.safety) check(calls_->set_safety(memory_, *options_.safety), "SetSafetyFactor");
}

Arkode::~Arkode() { calls_->free(&memory_); }

void Arkode::check(int flag, const char* call) const {
    if (flag != ARK_SUCCESS)
        throw InputError(
            fmt::format("integrator: ARKODE {} failed ({}): {}", call, flag, messages_.text()));
}

int Arkode::rates(double t, N_Vector y, N_Vector y_dot, void* self) {
    auto& me = *static_cast<Arkode*>(self);
    ++me.statistics_.rhs_evaluations;
    try {
        me.ode_.rates(t, entries(y), entries(y_dot));
        if (me.checks_rates_ && me.non_finite_.empty())
            me.non_finite_ = me.non_finite_rate(entries(y_dot), t);
        // NaN rates make an adaptive step shrink; a positive return would be fatal. A fixed step
        // ends here; stages after a NaN complain of it, which is not the reason of an adaptive one.
        std::string failure = me.ode_.failure();
        if (failure.empty()) return 0;
        if (me.failure_.empty() || me.non_finite_entry(entries(y), t).empty())
            me.failure_ = std::move(failure);
        return me.dt_ ? -1 : 0;
    } catch (...) {
        me.error_ = std::current_exception();
        return -1;
    }
}

/// Why a call of evolve came back with this flag. What the rates have thrown goes on from here.
std::string Arkode::reason_of(int flag) {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    if (failure_.empty() && !non_finite_.empty())
        return fmt::format("{} (ARKODE {})", non_finite_, flag);
    std::string message = failure_.empty() ? messages_.text() : failure_;
    std::replace(message.begin(), message.end(), '\n', ' ');
    if (flag == ARK_ERR_FAILURE && failure_.empty()) {
        estimate_errors();
        double h = 0.0;
        calls_->current_step(memory_, &h);
        message = rejected_too_often(h, *options_.min_step, shares_.in_words());
    }
    if (failure_.empty() && is_failed_relaxation(flag))
        message = "no step was found whose rescaling keeps the energy; leave --relaxation out";
    return fmt::format("{} at t = {:.6g} (ARKODE {})", message, t_, flag);
}

void Arkode::estimate_errors() {
    if (ode_.blocks.empty()) return;
    check(calls_->local_errors(memory_, local_error_.get()), "GetEstLocalErrors");
    check(calls_->weights(memory_, weight_.get()), "GetErrWeights");
    shares_.measure(
        [e = local_error_.span(), w = weight_.span()](std::size_t k) { return e[k] * w[k]; });
}

/// One step of ARKODE from the last accepted state, into y.
Arkode::Attempt Arkode::attempt(double t_stop) {
    failure_.clear();
    non_finite_.clear();
    first_step_ = 0.0;
    Attempt step{t_, {}};
    const int flag = calls_->evolve(memory_, t_stop, y_.get(), &step.reached, ARK_ONE_STEP);
    if (flag < 0)
        step.why_not = reason_of(flag);
    else if (dt_ && !non_finite_.empty())
        step.why_not = non_finite_;
    else
        step.why_not = non_finite_entry(y_.span(), step.reached);
    return step;
}

/// The same for callers that cannot go on without: returns the time it reached, or throws GuardStop with y
/// as it was. The reason names the rate that was the first not to be finite, where one was.
double Arkode::evolve(double t_stop) {
    const SundialsMessages::Scope scope(context_, messages_);
    double h = dt_.value_or(0.0);
    if (!dt_) calls_->current_step(memory_, &h);
    if (h == 0.0) checks_rates_ = true;  // ARKODE chooses the first step itself
    const Attempt step = attempt(t_stop);
    if (!step.why_not.empty()) {
        N_VScale(1.0, accepted_.get(), y_.get());
        const bool known = checks_rates_ || !failure_.empty();
        const std::string rate = known ? std::string{} : find_non_finite_rate(h);
        throw GuardStop(rate.empty() ? step.why_not : rate);
    }
    checks_rates_ = false;
    return step.reached;
}

/// Takes the step that failed once more, of length h, and checks every rate: to do so in every step would
/// cost a tenth of them. Empty where all are finite.
std::string Arkode::find_non_finite_rate(double h) {
    checks_rates_ = retaking_ = true;
    if (options_.relaxation) relax(false);
    double reached = t_;
    if (calls_->reset(memory_, t_, accepted_.get()) == ARK_SUCCESS &&
        calls_->set_fixed_step(memory_, h) == ARK_SUCCESS)
        calls_->evolve(memory_, t_ + 2.0 * h, y_.get(), &reached, ARK_ONE_STEP);
    N_VScale(1.0, accepted_.get(), y_.get());
    checks_rates_ = false;
    return non_finite_;
}

/// One step of length h from (from, y), into y_. Returns the time it reached.
double Arkode::take_fixed(double from, const Vector& y, double h) {
    retaking_ = true;
    check(calls_->reset(memory_, from, y.get()), "Reset");
    check(calls_->set_fixed_step(memory_, h), "SetFixedStep");
    return evolve(from + 2.0 * h);
}

/// Another step from the last accepted state, of length h.
std::span<const double> Arkode::retake(double h) {
    if (options_.relaxation) return retake_relaxed(h);
    take_fixed(t_, accepted_, h);
    return y_.span();
}

/// From y at t, where an event ended the step before: in fixed steps, or beginning with one of h.
void Arkode::restart(double h) {
    check(calls_->reset(memory_, t_, y_.get()), "Reset");
    check(calls_->set_fixed_step(memory_, dt_.value_or(0.0)), "SetFixedStep");
    if (!dt_) check(calls_->set_init_step(memory_, h), "SetInitStep");
    first_step_ = h;
    relax(true);
    retaking_ = false;
}

/// The adaptive step that ARKODE would try next; 0 where it has not chosen one.
double Arkode::step_ahead() const {
    if (first_step_ > 0.0) return first_step_;
    double ahead = 0.0;
    check(calls_->current_step(memory_, &ahead), "GetCurrentStep");
    return ahead;
}

/// One step from t, of length h to t_next where it is fixed, or the part of it before an event.
void Arkode::take_piece(double h, double t_next) {
    if (dt_ && h != *dt_) check(calls_->set_fixed_step(memory_, h), "SetFixedStep");
    watch_.begin(t_, std::as_const(accepted_).span());
    const double ahead = step_ahead();
    double reached = evolve(t_next + dt_.value_or(0.0));
    bool closed = false;
    if (!dt_) {
        calls_->last_step(memory_, &statistics_.last_step);
        if (errors_due()) {
            estimate_errors();
            shares_.count(statistics_);
        }
        closed = options_.relaxation && almost_at(t_next, reached);
        if (closed) {
            land(reached, t_next);
            reached = t_next;
        }
        h = reached - t_;
    }
    const auto [length, due] =
        watch_.first_piece(h, y_.span(), [this](double shorter) { return retake(shorter); });
    if (length == 0.0) N_VScale(1.0, accepted_.get(), y_.get());
    // ARKODE adds up fixed steps; the grid is computed.
    if (length == h)
        t_ = dt_ ? t_next : reached;
    else
        t_ = std::min(t_ + length, t_next);
    if (due) statistics_.events += watch_.apply(t_, y_.span());
    N_VScale(1.0, y_.get(), accepted_.get());
    if (length < h)
        restart(h);
    else if (closed)
        restart(ahead > 0.0 ? ahead : h);
    else if (dt_ && h != *dt_)
        check(calls_->set_fixed_step(memory_, *dt_), "SetFixedStep");
}

double Arkode::take_step(double t_stop) {
    if (dt_) {
        const FixedGrid::Step next = grid_.next(t_, t_stop);
        whole_step_ = false;
        for (double h = next.length; t_ < next.to; h = next.to - t_) {
            take_piece(h, next.to);
            if (t_ < next.to && InterruptWatch::told() != 0) return t_;
        }
        grid_.arrive(next);
        whole_step_ = next.whole;
        statistics_.last_step = next.length;
    } else {
        check(
            calls_->set_stop_time(memory_, options_.relaxation ? stop_for_relaxed(t_stop) : t_stop),
            "SetStopTime");
        take_piece(0.0, t_stop);
    }
    ++statistics_.steps;
    long rejected = 0;
    calls_->rejected(memory_, &rejected);
    statistics_.rejected_steps =
        rejected_before_ + static_cast<std::size_t>(rejected + relaxations_failed());
    return t_;
}

void Arkode::reset(double t) {
    t_ = t;
    grid_.reset(t);
    check(calls_->reset(memory_, t, y_.get()), "Reset");
    // A step that failed while it was taken again has left its length behind.
    if (dt_ || retaking_) check(calls_->set_fixed_step(memory_, dt_.value_or(0.0)), "SetFixedStep");
    if (options_.relaxation) set_relaxation();
    retaking_ = false;
    N_VScale(1.0, y_.get(), accepted_.get());
}

void Arkode::remember(Archive& archive) {
    Integrator::remember(archive);
    double ahead = archive.reading() ? 0.0 : step_ahead();
    archive(grid_, watch_, ahead);
    if (!archive.reading()) return;
    rejected_before_ = statistics_.rejected_steps;
    create();
    if (dt_) return;
    check(calls_->set_init_step(memory_, ahead), "SetInitStep");
    first_step_ = ahead;
}

}  // namespace spam
