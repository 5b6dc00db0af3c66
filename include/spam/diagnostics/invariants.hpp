// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>

#include <vector>

namespace spam {

/// What an isolated system keeps, at one time, and what externals have given to one that is not. Sums are
/// exact (ExactSum): drifts contain no error of theirs.
template <int Dim>
struct Invariants {
    /// Number of rotation planes: 0, 1, 3.
    static constexpr int planes = Dim * (Dim - 1) / 2;
    using AngularMomentum = Eigen::Matrix<double, planes, 1>;

    double mass = 0.0;
    Point<Dim> momentum = Point<Dim>::Zero();
    AngularMomentum angular_momentum = AngularMomentum::Zero();  ///< about the origin; z, or x y z
    double kinetic = 0.0;
    double internal = 0.0;
    double energy = 0.0;  ///< kinetic + internal

    /// What externals have given since t = 0 (external/external.hpp), and changes of particles (Model::gains); zero
    /// without any.
    double work = 0.0, heat = 0.0;
    Point<Dim> impulse = Point<Dim>::Zero();
    AngularMomentum angular_impulse = AngularMomentum::Zero();

    /// What the particles keep among themselves.
    double energy_balance() const { return energy - work - heat; }
    Point<Dim> momentum_balance() const { return momentum - impulse; }
    AngularMomentum angular_momentum_balance() const { return angular_momentum - angular_impulse; }
};

template <int Dim>
Invariants<Dim> measure_invariants(const Model<Dim>& model, std::span<const double> y);

/// Angular momentum of each body about the origin: by body, then z in the plane, or x, y, z. On a line there is none.
template <int Dim>
std::vector<double> angular_momentum_of_bodies(const Model<Dim>& model, std::span<const double> y);

/// Sizes against which changes are judged: sum m |v| and sum m |x||v|, which do not vanish when the
/// conserved vector does, and what neighbours do to each other before it cancels (of which rounding
/// leaves a part): sum |f|, its torque and its power, each with the mean |x| and |v| of the particles.
struct InvariantScales {
    double momentum = 0.0, angular_momentum = 0.0;
    double force = 0.0, torque = 0.0, power = 0.0;
};
template <int Dim>
InvariantScales measure_scales(const Model<Dim>& model, std::span<const double> y);

}  // namespace spam
