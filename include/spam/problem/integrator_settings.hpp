// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/field.hpp>
#include <spam/integrate/integrator.hpp>
#include <spam/io/options.hpp>

#include <array>

namespace spam {

/// The options that say how a problem is integrated. An option without effect on the method chosen is
/// refused.
class IntegratorSettings {
  public:
    /// `default_dt`: the step of rk4 when none is given; `words`: the same for --help, where it depends on other
    /// options.
    IntegratorSettings(double default_dt, std::string words)
        : default_dt_(default_dt),
          default_words_(std::move(words)) {}

    void add_to(Options& options);
    /// What the options, once parsed, mean; throws InputError where they mean nothing.
    IntegratorOptions resolve(Options& options);
    /// To be called before resolve(): multiplies the default step of rk4 by `part`.
    void shorten_default(double part) { default_dt_ *= part; }
    /// Another step of rk4 for the case at hand, where none is given. Returns whether it is taken.
    bool prefer_step(double dt, const Options& options);
    /// Leapfrog as the default method, where --integrator is not given, with step dt, where --dt is not given either;
    /// call resolve() afterwards.
    bool prefer_leapfrog(double dt, const Options& options);

    /// Names of all of them.
    static const std::vector<std::string>& names();

  private:
    void refuse_idle(const Options& options, const std::string& method) const;
    void fill(IntegratorOptions& integrator);

    double default_dt_;
    std::string default_words_;
    std::string method_ = "rk4", controller_;
    std::optional<double> dt_, rtol_, atol_, safety_, min_step_, max_step_, initial_step_;
    std::optional<int> max_steps_;
    bool relaxation_ = false;
    std::array<std::optional<double>, integrated_fields.size()> field_atol_;
};

/// More than any run can take.
constexpr double most_steps = 1e9;

/// Throws InputError where fixed steps, or the longest allowed, would take more of them than that to `t_end`.
void refuse_endless(const IntegratorOptions& integrator, double t_end);

}  // namespace spam
