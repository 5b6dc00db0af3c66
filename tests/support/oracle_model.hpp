// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/elastic_solid.hpp>
#include <spam/rhs/model.hpp>

#include <memory>

namespace spam::test {

/// Laws that are wrong on purpose: each must make a property fail.
enum class Mutation {
    none,
    full_work,            ///< energy without the factor 1/2
    work_before_scaling,  ///< energy from the force before torques were balanced
    without_X,            ///< torque balance that forgets sum m u x v
    printed_average,      ///< <v> divided by rho_i, as printed, with integrated density
    printed_gradient,     ///< (v_i - v_j) in grad v, as printed
    anisotropic,          ///< shear modulus that knows the axes
    reversed_spin,        ///< rotation of the stress with the wrong sign
    half_list,            ///< pairs of i with later j only
    viscous_recession,    ///< viscosity that also holds back what separates
    printed_multipliers,  ///< Gauss' beta without its minus sign, as printed
    absolute_position,    ///< a force that knows where the origin is
    lucys_weight          ///< that weight function, whatever the scheme says
};

/// The equations of smooth particles from the papers as loops over all pairs, with Eigen, sharing no sum, list or
/// weight function with the library. Slow, simple, and the judge of the pipeline. Free space.
template <int Dim>
std::unique_ptr<Model<Dim>> oracle_model(Particles<Dim> particles, const ElasticSolid& law,
                                         const Scheme& scheme, Mutation mutation = Mutation::none);

}  // namespace spam::test
