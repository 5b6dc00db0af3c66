// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "systems.hpp"
#include <spam/integrate/integrator.hpp>

#include <algorithm>
#include <memory>

namespace spam::bench {

/// A system under way, its right-hand sides timed.
template <class System>
class Stepping {
  public:
    Stepping(System& system, const IntegratorOptions& options)
        : system_(system),
          y_(system.y.size(), context_) {
        std::copy(system.y.begin(), system.y.end(), y_.span().begin());
        ode_.rates = [this](double t, std::span<const double> z, std::span<double> z_dot) {
            const Stopwatch watch;
            system_.model.rates(t, z, z_dot);
            in_rates_ += watch.seconds();
            ++calls_;
        };
        ode_.failure = [] { return std::string{}; };
        ode_.entry_name = [](std::size_t) { return std::string{}; };
        ode_.absolute_tolerance.assign(system.y.size(), 1e-10);
        for (const auto& block : system.model.layout().blocks())
            ode_.blocks.push_back({std::string(block.field.name()), block.offset, block.size});
        integrator_ = make_integrator(options, ode_, y_, 0.0, context_);
    }
    void step() { integrator_->step(1e9); }
    void forget() { in_rates_ = 0.0, calls_ = 0, builds_ = system_.model.list_builds(); }

    double seconds_in_rates() const { return in_rates_; }
    std::size_t calls() const { return calls_; }
    std::size_t builds() const { return system_.model.list_builds() - builds_; }
    std::span<const double> y() const { return y_.span(); }

  private:
    System& system_;
    SundialsContext context_;
    Vector y_;
    Ode ode_;
    double in_rates_ = 0.0;
    std::size_t calls_ = 0, builds_ = 0;
    std::unique_ptr<Integrator> integrator_;
};

inline IntegratorOptions rk4(double dt) {
    IntegratorOptions options;
    options.dt = dt;
    return options;
}

}  // namespace spam::bench
