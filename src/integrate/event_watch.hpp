// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/integrate/integrator.hpp>

namespace spam {

/// Watches the events of an ode for an integrator, whatever its method. Where one has become due
/// within a step the step is taken again, shorter and shorter or longer, until it ends just before:
/// states there are solutions of the method's full order. Interpolation within the step, as SUNDIALS
/// does it for roots, costs thirty times the energy error of a step of rk4, and more evaluations.
class EventWatch {
  public:
    explicit EventWatch(const Ode& ode) : events_(ode.events) {}

    /// A step, or the rest of one, begins at (t, y).
    void begin(double t, std::span<const double> y);

    /// State after a step of another length from where begin() was told.
    using Retake = std::function<std::span<const double>(double length)>;
    struct Piece {
        double length;  ///< 0 to that of the whole step; nothing was retaken after it
        bool due;       ///< apply() must follow
    };
    /// How much of a step of length h counts, `z` being the state after the whole of it. Events that
    /// come and go within a step are found as far as their distance tells.
    Piece first_piece(double h, std::span<const double> z, const Retake& retake);

    /// Applies what is due at (t, y). Returns how many events that were.
    /// Throws GuardStop where events no longer let time go on: more than 10,000 times within a step,
    /// or 100 times in a row at the same t, or step after step more often than can be waited for:
    /// 3,200 times (for a large y twice its entries) within 64 steps.
    std::size_t apply(double t, std::span<double> y);

    void remember(Archive& archive);

  private:
    double distance(double t, std::span<const double> y) const;
    Piece locate(double h, double at_h, const Retake& retake);
    void count(double t, std::size_t entries, const std::string& name);

    const std::vector<Event>& events_;
    double t_ = 0.0;  ///< of begin()
    std::span<const double> y_;
    double whole_ = 0.0;         ///< length of the step measured last
    double window_end_ = 0.0;    ///< one step after the first of those counted
    std::size_t in_window_ = 0;  ///< applied since
    double long_window_end_ = 0.0;
    std::size_t in_long_window_ = 0;
    double last_t_ = 0.0;
    std::size_t at_last_t_ = 0;
};

}  // namespace spam
