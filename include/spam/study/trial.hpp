// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/integrate/integrator.hpp>
#include <spam/study/example_systems.hpp>

#include <functional>
#include <string>

namespace spam {

/// A system to integrate again and again, by many methods.
template <int Dim>
struct Trial {
    std::string name;   ///< one word, for tables
    std::string title;  ///< for pictures
    std::function<Start<Dim>()>
        start;  ///< the same every time; several threads may call it at once
    double t_end = 0.0;
    /// Empty where dy/dt has all the derivatives that methods count on: orders are claimed then. Else
    /// why not, in words.
    std::string rough{};
};

/// One integration from t = 0 to the end, without observers.
struct TrialRun {
    std::vector<double> y;  ///< the last accepted state
    Integrator::Statistics statistics;
    double seconds = 0.0;      ///< of this thread's processor time, without making the integrator
    std::string stopped{};     ///< why it did not reach the end; empty if it did
    bool interrupted = false;  ///< by a signal
};

/// Integrates to `t_end`. `most_calls`: a run that would need more right-hand sides (as can be told
/// when a quarter of them are used up) is given up; 0: no limit. Throws InputError as make_integrator().
template <int Dim>
TrialRun integrate_trial(const Start<Dim>& start, const IntegratorOptions& options, double t_end,
                         std::size_t most_calls = 0);

/// The same run again and again, in all for up to `seconds` and at most five times: the least of its
/// times, which what else the machine does can only lengthen.
template <int Dim>
double least_seconds(const Start<Dim>& start, const IntegratorOptions& options, double t_end,
                     const TrialRun& first, double seconds);

/// Right-hand sides of one step of fixed length that nothing cuts short.
template <int Dim>
double calls_per_step(const Start<Dim>& start, const std::string& method, double dt);

/// Sizes against which changes are judged, from states of a run: sums that bound |p| and |L| by
/// Cauchy and Schwarz, sqrt(2 M K) and sqrt(2 I K) with I = sum m r^2 and K the larger kinetic energy;
/// and the larger of |E| and K.
struct ConservedScales {
    double momentum, angular_momentum, energy;
};
template <int Dim>
ConservedScales conserved_scales(const Model<Dim>& model, std::span<const double> y0,
                                 double largest_kinetic);

}  // namespace spam
