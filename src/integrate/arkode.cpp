// SPDX-License-Identifier: GPL-3.0-or-later
// Every ARKODE call of the library is in this file. For SUNDIALS 7 the calls of struct Calls become
// ARKodeEvolve, ARKodeSetFixedStep, ... and the error handler moves to the context.
#include "arkode.hpp"

#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/integrate/interrupt.hpp>

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_butcher_erk.h>
#include <arkode/arkode_erkstep.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <new>
#include <utility>

namespace spam {
namespace {

struct FreeTable {
    void operator()(ARKodeButcherTable table) const { ARKodeButcherTable_Free(table); }
};
using Table = std::unique_ptr<std::remove_pointer_t<ARKodeButcherTable>, FreeTable>;

Table load_table(const std::string& method) {
    std::string name = method.substr(std::string("arkode:").size());
    if (!name.starts_with("ARKODE_")) name.insert(0, "ARKODE_");
    const auto& known = arkode_tables();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
        const std::size_t prefix = std::string("ARKODE_").size();
        std::vector<std::string> words;
        for (const auto& table : known) words.push_back(table.substr(prefix));
        throw InputError(
            fmt::format("integrator: SUNDIALS has no explicit table '{}'{} The tables: {}",
                        method.substr(method.find(':') + 1),
                        suggestion(name.substr(prefix), words, "arkode:"), fmt::join(words, ", ")));
    }
    Table table(ARKodeButcherTable_LoadERKByName(name.c_str()));
    if (!table) throw InputError(fmt::format("integrator: SUNDIALS cannot load {}", name));
    return table;
}

/// ERKStep before SUNDIALS 6.7 takes every table with c_s = 1 for first-same-as-last and skips its
/// first stage: silently wrong unless the last row of A is b. Those tables run through ARKStep.
bool erkstep_is_right(const ARKodeButcherTableMem& table) {
    const int last = table.stages - 1;
    if (table.c[last] != 1.0) return true;
    for (int j = 0; j < table.stages; ++j)
        if (table.A[last][j] != table.b[j]) return false;
    return true;
}

}  // namespace

struct Arkode::Calls {
    decltype(&ERKStepEvolve) evolve;
    decltype(&ERKStepReset) reset;
    decltype(&ERKStepFree) free;
    decltype(&ERKStepSetUserData) set_user_data;
    decltype(&ERKStepSetErrHandlerFn) set_error_handler;
    decltype(&ERKStepSVtolerances) set_tolerances;
    decltype(&ERKStepSetFixedStep) set_fixed_step;
    decltype(&ERKStepSetInitStep) set_init_step;
    decltype(&ERKStepSetStopTime) set_stop_time;
    decltype(&ERKStepSetMinStep) set_min_step;
    decltype(&ERKStepSetAdaptivityMethod) set_adaptivity;
    decltype(&ERKStepGetNumErrTestFails) rejected;
    decltype(&ERKStepGetLastStep) last_step;
    decltype(&ERKStepGetCurrentStep) current_step;
};

namespace {
// Designated initialisers would name private members of Arkode; the order is that of struct Calls.
#define SPAM_ARKODE_CALLS(S)                                                                 \
    {                                                                                        \
        S##Evolve, S##Reset, S##Free, S##SetUserData, S##SetErrHandlerFn, S##SVtolerances,   \
            S##SetFixedStep, S##SetInitStep, S##SetStopTime, S##SetMinStep,                  \
            S##SetAdaptivityMethod, S##GetNumErrTestFails, S##GetLastStep, S##GetCurrentStep \
    }
}  // namespace

Arkode::Arkode(const IntegratorOptions& options, const Ode& ode, Vector& y, double t0,
               const SundialsContext& context)
    : Integrator(ode, y, t0),
      options_(options),
      context_(context),
      dt_(options.dt),
      grid_(t0, options.dt.value_or(1.0)),
      accepted_(y.clone()),
      watch_(ode) {
    create();
}

/// ARKODE's memory for going on from y at t, as if nothing had been before.
void Arkode::create() {
    static constexpr Calls erkstep = SPAM_ARKODE_CALLS(ERKStep);
    static constexpr Calls arkstep = SPAM_ARKODE_CALLS(ARKStep);
    if (memory_ != nullptr) calls_->free(&memory_);
    const Table table = load_table(options_.method);
    if (!dt_ && table->d == nullptr)
        throw InputError(fmt::format(
            "integrator: {} has no embedded error estimate and cannot choose its steps; add --dt",
            options_.method));
    const bool erk = erkstep_is_right(*table);
    calls_ = erk ? &erkstep : &arkstep;
    memory_ = erk ? ERKStepCreate(&Arkode::rates, t_, y_.get(), context_.get())
                  : ARKStepCreate(&Arkode::rates, nullptr, t_, y_.get(), context_.get());
    if (memory_ == nullptr) throw std::bad_alloc();
    check(calls_->set_error_handler(memory_, &Arkode::remember_message, this), "SetErrHandlerFn");
    check(calls_->set_user_data(memory_, this), "SetUserData");
    check(erk ? ERKStepSetTable(memory_, table.get())
              : ARKStepSetTables(memory_, table->q, table->p, nullptr, table.get()),
          "SetTable");
    if (dt_) {
        check(calls_->set_fixed_step(memory_, *dt_), "SetFixedStep");
    } else {
        Vector atol = y_.clone();
        std::copy(ode_.absolute_tolerance.begin(), ode_.absolute_tolerance.end(),
                  atol.span().begin());
        check(calls_->set_tolerances(memory_, options_.rtol, atol.get()), "SVtolerances");
        check(calls_->set_min_step(memory_, options_.min_step), "SetMinStep");
        check(calls_->set_adaptivity(memory_, ARK_ADAPT_PID, 1, 0, nullptr), "SetAdaptivityMethod");
    }
    retaking_ = false;
    N_VScale(1.0, y_.get(), accepted_.get());
}

Arkode::~Arkode() { calls_->free(&memory_); }

void Arkode::check(int flag, const char* call) const {
    if (flag != ARK_SUCCESS)
        throw InputError(
            fmt::format("integrator: ARKODE {} failed ({}): {}", call, flag, message_));
}

int Arkode::rates(double t, N_Vector y, N_Vector y_dot, void* self) {
    auto& me = *static_cast<Arkode*>(self);
    ++me.statistics_.rhs_evaluations;
    try {
        me.ode_.rates(t, entries(y), entries(y_dot));
        if (me.spoiled_.empty()) me.spoiled_ = me.spoiled_rate(entries(y_dot), t);
        // NaN rates make an adaptive step shrink; a positive return would be fatal. A fixed step
        // ends here, before later stages cover the first reason by their own.
        return me.dt_ && !me.ode_.failure().empty() ? -1 : 0;
    } catch (...) {
        me.error_ = std::current_exception();
        return -1;
    }
}

void Arkode::remember_message(int, const char*, const char*, char* message, void* self) {
    static_cast<Arkode*>(self)->message_ = message;
}

void Arkode::stop(int flag) const {
    if (error_) std::rethrow_exception(error_);
    const std::string reason = ode_.failure();
    std::string message = message_;
    std::replace(message.begin(), message.end(), '\n', ' ');
    if (!reason.empty())
        message = reason;
    else if (!spoiled_.empty())
        throw GuardStop(fmt::format("{} (ARKODE {})", spoiled_, flag));
    else if (flag == ARK_ERR_FAILURE || flag == ARK_CONV_FAILURE)
        message = fmt::format(
            "the error test failed again and again, the step fell to {:.3g}, "
            "near the least allowed {:.3g}",
            statistics_.last_step, options_.min_step);
    throw GuardStop(fmt::format("{} at t = {:.6g} (ARKODE {})", message, t_, flag));
}

/// One step of ARKODE from the last accepted state, into y. Returns the time it reached.
double Arkode::evolve(double t_stop) {
    double reached = t_;
    spoiled_.clear();
    const int flag = calls_->evolve(memory_, t_stop, y_.get(), &reached, ARK_ONE_STEP);
    try {
        if (flag < 0) stop(flag);
        if (!spoiled_.empty() && dt_) throw GuardStop(spoiled_);
        guard(y_.span(), reached);
    } catch (const GuardStop&) {
        N_VScale(1.0, accepted_.get(), y_.get());
        throw;
    }
    return reached;
}

/// Another step from the last accepted state, of length h.
std::span<const double> Arkode::retake(double h) {
    retaking_ = true;
    check(calls_->reset(memory_, t_, accepted_.get()), "Reset");
    check(calls_->set_fixed_step(memory_, h), "SetFixedStep");
    evolve(t_ + 2.0 * h);
    return y_.span();
}

/// From y at t, where an event ended the step before: in fixed steps, or beginning with one of h.
void Arkode::restart(double h) {
    check(calls_->reset(memory_, t_, y_.get()), "Reset");
    check(calls_->set_fixed_step(memory_, dt_.value_or(0.0)), "SetFixedStep");
    if (!dt_) check(calls_->set_init_step(memory_, h), "SetInitStep");
    retaking_ = false;
}

/// One step from t, of length h to t_next where it is fixed, or the part of it before an event.
void Arkode::take_piece(double h, double t_next) {
    if (dt_ && h != *dt_) check(calls_->set_fixed_step(memory_, h), "SetFixedStep");
    watch_.begin(t_, std::as_const(accepted_).span());
    const double reached = evolve(t_next + dt_.value_or(0.0));
    calls_->last_step(memory_, &statistics_.last_step);
    if (!dt_) h = reached - t_;
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
    else if (dt_ && h != *dt_)
        check(calls_->set_fixed_step(memory_, *dt_), "SetFixedStep");
}

double Arkode::step(double t_stop) {
    if (dt_) {
        const FixedGrid::Step next = grid_.next(t_, t_stop);
        for (double h = next.length; t_ < next.to; h = next.to - t_) {
            take_piece(h, next.to);
            if (t_ < next.to && InterruptWatch::received() != 0) return t_;
        }
        grid_.arrive(next);
        statistics_.last_step = next.length;
    } else {
        check(calls_->set_stop_time(memory_, t_stop), "SetStopTime");
        take_piece(0.0, t_stop);
    }
    ++statistics_.steps;
    long rejected = 0;
    calls_->rejected(memory_, &rejected);
    statistics_.rejected_steps = rejected_before_ + static_cast<std::size_t>(rejected);
    return t_;
}

void Arkode::reset(double t) {
    t_ = t;
    grid_.reset(t);
    check(calls_->reset(memory_, t, y_.get()), "Reset");
    // A step that failed while it was taken again has left its length behind.
    if (dt_ || retaking_) check(calls_->set_fixed_step(memory_, dt_.value_or(0.0)), "SetFixedStep");
    retaking_ = false;
    N_VScale(1.0, y_.get(), accepted_.get());
}

void Arkode::remember(Archive& archive) {
    Integrator::remember(archive);
    double ahead = 0.0;  // the step that ARKODE would try next
    if (!archive.reading()) check(calls_->current_step(memory_, &ahead), "GetCurrentStep");
    archive(grid_, watch_, ahead);
    if (!archive.reading()) return;
    rejected_before_ = statistics_.rejected_steps;
    create();
    if (!dt_) check(calls_->set_init_step(memory_, ahead), "SetInitStep");
}

const std::vector<std::string>& arkode_tables() {
    static const std::vector<std::string> names{
        "ARKODE_HEUN_EULER_2_1_2",     "ARKODE_BOGACKI_SHAMPINE_4_2_3",
        "ARKODE_ARK324L2SA_ERK_4_2_3", "ARKODE_ZONNEVELD_5_3_4",
        "ARKODE_ARK436L2SA_ERK_6_3_4", "ARKODE_SAYFY_ABURUB_6_3_4",
        "ARKODE_CASH_KARP_6_4_5",      "ARKODE_FEHLBERG_6_4_5",
        "ARKODE_DORMAND_PRINCE_7_4_5", "ARKODE_ARK548L2SA_ERK_8_4_5",
        "ARKODE_VERNER_8_5_6",         "ARKODE_FEHLBERG_13_7_8",
        "ARKODE_KNOTH_WOLKE_3_3",      "ARKODE_ARK437L2SA_ERK_7_3_4",
        "ARKODE_ARK548L2SAb_ERK_8_4_5"};
    return names;
}

}  // namespace spam
