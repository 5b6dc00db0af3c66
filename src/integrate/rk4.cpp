// SPDX-License-Identifier: GPL-3.0-or-later
#include "rk4.hpp"

#include <spam/core/error.hpp>
#include <spam/integrate/interrupt.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace spam {

Rk4::Rk4(const Ode& ode, Vector& y, double t0, double dt)
    : Integrator(ode, y, t0),
      grid_(t0, dt),
      k_{y.clone(), y.clone(), y.clone(), y.clone()},
      z_(y.clone()),
      watch_(ode) {}

void Rk4::stage(double t, const Vector& at, std::size_t k) {
    ++statistics_.rhs_evaluations;
    ode_.rates(t, at.span(), k_[k].span());
    const std::string reason = ode_.failure();
    if (!reason.empty()) throw GuardStop(fmt::format("{} at t = {:.6g}", reason, t));
}

/// The state after h, from y and the first stage there.
std::span<const double> Rk4::advance(double h) {
    N_VLinearSum(1.0, y_.get(), 0.5 * h, k_[0].get(), z_.get());
    stage(t_ + 0.5 * h, z_, 1);
    N_VLinearSum(1.0, y_.get(), 0.5 * h, k_[1].get(), z_.get());
    stage(t_ + 0.5 * h, z_, 2);
    N_VLinearSum(1.0, y_.get(), h, k_[2].get(), z_.get());
    stage(t_ + h, z_, 3);

    std::array<double, 5> c{1.0, h / 6.0, h / 3.0, h / 3.0, h / 6.0};
    std::array<N_Vector, 5> v{y_.get(), k_[0].get(), k_[1].get(), k_[2].get(), k_[3].get()};
    N_VLinearCombination(5, c.data(), v.data(), z_.get());
    try {
        guard(z_.span(), t_ + h);
    } catch (const GuardStop&) {
        const std::array<double, 4> times{t_, t_ + 0.5 * h, t_ + 0.5 * h, t_ + h};
        for (std::size_t k = 0; k < k_.size(); ++k)
            if (const auto reason = spoiled_rate(k_[k].span(), times[k]); !reason.empty())
                throw GuardStop(reason);
        throw;
    }
    return z_.span();
}

/// A step of length h to t_next, in pieces where events are due.
void Rk4::take_pieces(double h, double t_next) {
    while (t_ < t_next) {
        watch_.begin(t_, std::as_const(y_).span());
        stage(t_, y_, 0);
        const auto z = advance(h);
        const auto [length, due] =
            watch_.first_piece(h, z, [this](double shorter) { return advance(shorter); });
        if (length > 0.0) N_VScale(1.0, z_.get(), y_.get());
        t_ = length == h ? t_next : std::min(t_ + length, t_next);
        if (due) statistics_.events += watch_.apply(t_, y_.span());
        h = t_next - t_;
        if (due && InterruptWatch::received() != 0) return;
    }
}

double Rk4::step(double t_stop) {
    const FixedGrid::Step next = grid_.next(t_, t_stop);
    take_pieces(next.length, next.to);
    if (t_ < next.to) return t_;  // interrupted
    grid_.arrive(next);
    ++statistics_.steps;
    statistics_.last_step = next.length;
    return t_;
}

void Rk4::reset(double t) {
    t_ = t;
    grid_.reset(t);
}

void Rk4::remember(Archive& archive) {
    Integrator::remember(archive);
    archive(grid_, watch_);
}

}  // namespace spam
