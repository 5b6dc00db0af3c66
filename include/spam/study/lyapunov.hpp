// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/integrate/integrator.hpp>
#include <spam/rhs/model.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace spam {

/// A motion and M tangents to it, dv/dt = J v, which take the same steps of the same method: y and the tangents are
/// one ode, whose blocks are [y's block | that of tangent 1 | ...], so that a method which advances positions and
/// velocities in turn does so with tangents as well. Accounts have no tangents.
template <int Dim>
class TangentMotion {
  public:
    /// `tangents`: y's size without accounts x M. Throws InputError for an adaptive method, or one that goes on from
    /// earlier steps (the steps of tangents would not be those of the motion), and for models that are changed at
    /// single times or after steps, where tangents jump.
    TangentMotion(Model<Dim>& model, std::span<const double> y0, const Eigen::MatrixXd& tangents,
                  const IntegratorOptions& options, double t0 = 0.0);

    /// Throws GuardStop as an integrator does, and Interrupted after a signal.
    void advance_to(double t);
    double t() const { return integrator_->t(); }
    std::vector<double> y() const;
    Eigen::MatrixXd tangents() const;
    void set_tangents(const Eigen::MatrixXd& tangents);
    std::size_t rhs_evaluations() const { return evaluations_; }  ///< of the model

  private:
    template <class Visit>
    void each_block(const Visit& visit) const;
    void rates(double t, std::span<const double> from, std::span<double> to);

    Model<Dim>& model_;
    std::size_t count_;  ///< M
    SundialsContext context_;
    Ode ode_;
    std::vector<double> y_, y_dot_, tangent_, tangent_dot_;
    std::size_t evaluations_ = 0;
    std::unique_ptr<Vector> state_;
    std::unique_ptr<Integrator> integrator_;
};

/// How exponents are measured.
struct LyapunovOptions {
    double duration = 100.0;
    double interval = 0.1;      ///< between orthogonalisations
    double window = 0.0;        ///< of LyapunovSpectrum::windows; 0: a fortieth of the duration
    std::size_t exponents = 1;  ///< M; at most as many as there are numbers in y
    double discarded = 0.1;     ///< part of the duration that does not count
    std::uint32_t seed = 1;     ///< of the tangents at the start
    /// Called at the end of each window: y, and the first tangent by the scales of y.
    std::function<void(double t, std::span<const double> y, std::span<const double> leading)>
        at_window{};
};

/// |dx|^2 + |dv|^2 by particle of a tangent by the scales of y: which particles carry the instability. Of a unit
/// vector of positions and velocities alone they add up to 1.
template <int Dim>
std::vector<double> shares(const Model<Dim>& model, std::span<const double> tangent);

/// Rates of growth of M tangents, which are orthogonalised again and again (QR): Benettin et al., Meccanica 15, 9
/// (1980).
struct LyapunovSpectrum {
    std::vector<double> exponents;  ///< descending where the motion is long enough
    std::vector<double> errors;     ///< of the mean, from ten blocks
    /// Mean of the trace of J where M is all numbers of y, which the sum of all exponents is; else 0.
    double trace = 0.0;
    struct Window {
        double t;  ///< its end
        std::vector<double> exponents;
    };
    std::vector<Window> windows;
    std::vector<double> y;  ///< at the end
    std::size_t rhs_evaluations = 0;
};

/// Throws InputError where lyapunov_spectrum() would, before anything is computed: as TangentMotion does, and for a
/// number of exponents that is not between 1 and the size of y, or above 2000.
template <int Dim>
void require_spectrum(Model<Dim>& model, const IntegratorOptions& integrator,
                      std::size_t exponents);

/// Tangents are measured by the scales of the model's layout. Throws InputError as require_spectrum() does; GuardStop
/// where the motion ends.
template <int Dim>
LyapunovSpectrum lyapunov_spectrum(Model<Dim>& model, std::span<const double> y0,
                                   const IntegratorOptions& integrator,
                                   const LyapunovOptions& options);

}  // namespace spam
