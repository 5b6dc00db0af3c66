// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/kernel.hpp>

#include <string>
#include <string_view>

namespace spam {

/// Where the density comes from: integrated, summed with the weight, or integrated with the velocity that moves the
/// particles.
enum class Density { continuity, summed, chain_rule };
/// What moves particles: v, its average, Monaghan's average, or v with shifting.
enum class Transport { plain, average, monaghan, shifting };
/// The density rho_ij of a pair.
enum class MeanDensityKind { arithmetic, geometric };
/// What keeps the angular momentum: nothing, Gauss' principle, or torques of particles or pairs that are scaled.
enum class AngularMomentum { free, gauss, torque_particle, torque_pair };
enum class Balance { body, global };      ///< what keeps an angular momentum of its own
enum class GaussSingular { skip, stop };  ///< where Gauss' principle has no solution
/// Which stress does the work that changes a particle's energy: the mean of both of a pair, or its own.
enum class Work { mean, own };

/// How well an invariant is kept by the equations themselves.
enum class Promise {
    exact,             ///< to round-off, whatever the step
    integrator_error,  ///< the ordinary differential equations keep it, the integrator to its
                       ///< accuracy
    not_kept           ///< the scheme changes it; its drift is physics of the scheme
};

/// How well a scheme keeps each invariant, less what externals have given.
struct Promises {
    /// sum m
    Promise mass = Promise::exact;
    /// sum m v
    Promise momentum = Promise::exact;
    /// sum m x v, about the origin.
    Promise angular_momentum = Promise::not_kept;
    /// Kinetic, internal and potential.
    Promise energy = Promise::integrator_error;
};

/// The paper's axes of choice, [HHM04] IX, as one value. `range` is the distance h at which the
/// weight function vanishes.
struct Scheme {
    /// --density
    Density density = Density::continuity;
    /// --transport
    Transport transport = Transport::plain;
    /// --mean-density
    MeanDensityKind mean_density = MeanDensityKind::arithmetic;
    /// --angular-momentum; on a line only `free`.
    AngularMomentum angular_momentum = AngularMomentum::free;
    /// --balance
    Balance balance = Balance::body;
    /// --gauss-singular
    GaussSingular gauss_singular = GaussSingular::skip;
    /// --work; `own` only for fluids with a temperature.
    Work work = Work::mean;
    double viscosity = 0.0;  ///< von Neumann's artificial viscosity: alpha; 0 without
    /// Of Transport::shifting: its coefficient by sound speed at rest times range (physics/shifting.hpp).
    double shifting = 1.0;
    double closest_approach = 0.0;  ///< distance at which approaching pairs are reflected; 0: none
    /// --kernel, the weight function.
    Kernel kernel = Kernel::lucy;
    /// --range: h, in units of length (spacings, usually).
    double range = 3.0;

    /// Throws InputError naming the combination, the reason and the fix if it makes no sense in
    /// `dim` dimensions.
    void validate(int dim) const;

    /// What validate() says of Transport::shifting.
    void validate_shifting() const;

    /// The same for particles of this spacing: pairs cannot be reflected there or beyond.
    void validate_distances(double spacing) const;

    /// What the scheme promises in free space of `dim` dimensions.
    Promises promises(int dim) const;

    /// Whether torques of pairs are scaled so that every group keeps its angular momentum.
    bool balances_torques() const {
        return angular_momentum == AngularMomentum::torque_pair ||
               angular_momentum == AngularMomentum::torque_particle;
    }

    /// One line: "density continuity, transport monaghan (arithmetic mean density), ..."
    std::string describe() const;

    friend bool operator==(const Scheme&, const Scheme&) = default;
};

std::string_view to_string(Density);
std::string_view to_string(Transport);
std::string_view to_string(MeanDensityKind);
std::string_view to_string(AngularMomentum);
std::string_view to_string(Balance);
std::string_view to_string(GaussSingular);
std::string_view to_string(Work);
std::string_view to_string(Promise);

}  // namespace spam
