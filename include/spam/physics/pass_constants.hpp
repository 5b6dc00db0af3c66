// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/scheme.hpp>

#include <array>

namespace spam {

/// Constants of the artificial viscosity (viscosity.hpp).
struct ViscosityConstants {
    double alpha = 0.0;
    double sound_speed = 0.0;
    double length = 0.0;  ///< half the range: what other codes call h
};

/// What passes that hold constants are made from, by their with().
struct PassConstants {
    MeanDensityKind mean_density = MeanDensityKind::arithmetic;
    ViscosityConstants viscosity{};
    double shifting = 0.0;         ///< D of shifting.hpp; 0 without
    double inverse_density = 1.0;  ///< of a total-Lagrangian solid: 1/rho_0
    double penalty = 0.0;          ///< its penalty times its stiffness, kappa lambda
    /// Of friction and conduction by pairs: eta, lambda and kappa.
    double shear = 0.0, second_viscosity = 0.0, conductivity = 0.0;
    double core_energy = 0.0;     ///< of CorePotential (a core's, a contact's) or CohesivePotential
    double core_range = 1.0;      ///< likewise: their length
    double apart = 0.0;           ///< how far apart particles that touch are by ContactRecord
    std::array<double, 8> own{};  ///< of a law outside the library
};

}  // namespace spam
