// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/record.hpp>

namespace spam {
namespace column {

/// Stored: formed inside the pair, FMA would break F_ij = -F_ji.
template <int Dim, class T>
struct Pressure {
    T a{};  ///< P/rho^2
};
template <int Dim, class T>
struct Temperature {
    static constexpr auto quantity = Quantity::temperature;
    T temperature{};
};
template <int Dim, class T>
struct HeatFlux {
    static constexpr auto quantity = Quantity::heat_flux;
    Vec<Dim, T> q;  ///< Q/rho^2
};

template <int Dim, class T>
struct InverseDensity {
    T inverse_rho{};
};

/// Of friction and conduction by pairs (pair_friction.hpp): eta, ...
template <int Dim, class T>
struct ShearViscosity {
    T shear{};
};
/// ... 2 eta + lambda ...
template <int Dim, class T>
struct LongitudinalViscosity {
    T longitudinal{};
};
/// ... and 2 kappa.
template <int Dim, class T>
struct ConductionFactor {
    T conduction{};
};

}  // namespace column

/// What a pair body may know of a particle of a fluid without friction and conduction.
template <int Dim, class T = double>
using InviscidRecord = typename MotionRecord<Dim, T>::template And<column::Pressure>;

/// Of a fluid with either: the gradients of velocity and temperature are summed from density and
/// temperature, and tell A and q.
template <int Dim, class T = double>
using ConductingRecord =
    typename Record<Dim, T>::template And<column::Temperature, column::HeatFlux>;

/// Of a fluid with friction and conduction by pairs.
template <int Dim, class T = double>
using RubbingRecord =
    typename InviscidRecord<Dim, T>::template And<column::InverseDensity, column::Temperature>;

/// The same for particles that are shifted.
template <int Dim, class T = double>
using ShiftedRecord = typename RubbingRecord<Dim, T>::template And<column::Density>;

/// Of friction and conduction by pairs in a sweep of their own, where fluids may differ.
template <int Dim, class T = double>
using FrictionRecord = typename MotionRecord<Dim, T>::template And<
    column::InverseDensity, column::Temperature, column::ShearViscosity,
    column::LongitudinalViscosity, column::ConductionFactor>;

}  // namespace spam
