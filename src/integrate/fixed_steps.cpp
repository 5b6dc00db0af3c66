// SPDX-License-Identifier: GPL-3.0-or-later
#include "fixed_steps.hpp"

#include <spam/core/error.hpp>
#include <spam/core/parts.hpp>
#include <spam/integrate/interrupt.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace spam {

FixedSteps::FixedSteps(const Ode& ode, Vector& y, double t0, double dt)
    : Integrator(ode, y, t0),
      z_(y.clone()),
      grid_(t0, dt),
      watch_(ode) {}

void FixedSteps::rates(double t, const Vector& at, Vector& y_dot) {
    ++statistics_.rhs_evaluations;
    ode_.rates(t, at.span(), y_dot.span());
    if (const std::string reason = ode_.failure(); !reason.empty()) stop(reason, t);
}

void FixedSteps::stop(const std::string& reason, double t) {
    const std::string message = fmt::format("{} at t = {:.6g}", reason, t);
    Parts::here().give_up(message, statistics_.rhs_evaluations);
    throw GuardStop(message);
}

std::span<const double> FixedSteps::guarded(double h) {
    advance(h);
    try {
        guard(z_.span(), t_ + h);
    } catch (const GuardStop&) {
        if (const std::string reason = non_finite_stage(h); !reason.empty())
            throw GuardStop(reason);
        throw;
    }
    return z_.span();
}

/// A step of length h to t_next, in pieces where events are due.
void FixedSteps::take_pieces(double h, double t_next) {
    while (t_ < t_next) {
        watch_.begin(t_, std::as_const(y_).span());
        begin();
        const auto z = guarded(h);
        const auto [length, due] =
            watch_.first_piece(h, z, [this](double other) { return guarded(other); });
        if (length > 0.0) {
            N_VScale(1.0, z_.get(), y_.get());
            accept();
        }
        t_ = length == h ? t_next : std::min(t_ + length, t_next);
        if (due) {
            statistics_.events += watch_.apply(t_, y_.span());
            forget();
        }
        h = t_next - t_;
        if (due && InterruptWatch::told() != 0) return;
    }
}

double FixedSteps::take_step(double t_stop) {
    const FixedGrid::Step next = grid_.next(t_, t_stop);
    whole_step_ = false;
    try {
        // Where the rates of a stage have no meaning in one part, the others hear of it in the exchange of images of
        // the next stage, or in that of the guard: to ask all at each stage would be as many exchanges again.
        const Parts::AgreesLater later(Parts::here());
        take_pieces(next.length, next.to);
    } catch (const PartGaveUp& other) {
        if (other.turn == 0) throw;  // for another reason than a stage of ours
        statistics_.rhs_evaluations = other.turn;
        throw GuardStop(other.what());
    }
    if (t_ < next.to) return t_;  // interrupted
    whole_step_ = next.whole;
    grid_.arrive(next);
    ++statistics_.steps;
    statistics_.last_step = next.length;
    return t_;
}

void FixedSteps::reset(double t) {
    t_ = t;
    grid_.reset(t);
    forget();
}

void FixedSteps::remember(Archive& archive) {
    Integrator::remember(archive);
    archive(grid_, watch_);
    if (archive.reading()) forget();
}

}  // namespace spam
