// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "arrays.hpp"
#include <spam/external/external.hpp>
#include <spam/material/material.hpp>

#include <pybind11/functional.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace spam::python {

/// The first exception of functions that are called where none may be thrown (in a right-hand side, in other
/// threads): kept, and raised again when the library has come back. Until then rates are NaN and none is called.
class Pending {
  public:
    bool failed() const { return failed_; }
    /// What is being handled. The interpreter is held.
    void keep();
    /// Throws what was kept, once. The interpreter is held.
    void raise();

  private:
    std::atomic<bool> failed_{false};
    std::mutex mutex_;
    std::exception_ptr first_;
};

using SharedPending = std::shared_ptr<Pending>;

/// A function of Python that many copies of a law share; given back where the interpreter is held.
using Function = std::shared_ptr<const py::function>;
Function function_of(py::function f);

/// A sound speed: one number, or a function of the density.
struct SoundSpeed {
    double number = 0.0;
    Function f{};
    /// Throws InputError for what is no positive number. Called where models are made.
    double at(double density) const;
};

/// sigma_dot of many particles at a time by f(grad_v (m, D, D), stress (m, D(D+1)/2)), as many as stresses.
/// `sounds`: whether it tells a sound speed.
template <int Dim, bool sounds>
struct FunctionLaw {
    Function f;
    SharedPending pending;
    SoundSpeed speed;

    std::string describe() const { return "a stress law of Python"; }
    double sound_speed(double density) const requires sounds { return speed.at(density); }
    void stress_rates(std::span<const Mat<Dim>> grad_v, std::span<const SymTensor<Dim>> stress,
                      std::span<SymTensor<Dim>> rate) const;
};

/// The same by a function of C, called from several threads at once.
using StressFunction = void (*)(std::int64_t n, const double* grad_v, const double* stress,
                                double* rate);

template <int Dim, bool sounds>
struct AddressLaw {
    StressFunction f;
    SoundSpeed speed;

    std::string describe() const { return "a compiled stress law"; }
    double sound_speed(double density) const requires sounds { return speed.at(density); }
    void stress_rates(std::span<const Mat<Dim>> grad_v, std::span<const SymTensor<Dim>> stress,
                      std::span<SymTensor<Dim>> rate) const {
        static_assert(sizeof(Mat<Dim>) == sizeof(double) * Dim * Dim);
        static_assert(sizeof(SymTensor<Dim>) == sizeof(double) * symmetric_size(Dim));
        f(static_cast<std::int64_t>(rate.size()), grad_v.data()->c.data(), stress.data()->c.data(),
          rate.data()->c.data());
    }
};

/// A force by mass, f(t, x (m, D), v (m, D)) -> (m, D), for blocks of particles.
template <int Dim>
class FunctionForce final : public External<Dim> {
  public:
    FunctionForce(Function f, SharedPending pending)
        : f_(std::move(f)),
          pending_(std::move(pending)) {}
    void add(const typename External<Dim>::Now& now, Eigen::Index first,
             Eigen::Index last) const override;
    std::string inseparable() const override { return "its force may depend on velocities"; }
    std::string describe() const override { return "a force of Python"; }

  private:
    Function f_;
    SharedPending pending_;
};

}  // namespace spam::python
