// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/kernel.hpp>

#include <string>
#include <string_view>

namespace spam {

enum class Density { continuity, summed, chain_rule };
enum class Transport { plain, average, monaghan, shifting };
enum class MeanDensityKind { arithmetic, geometric };
enum class AngularMomentum { free, gauss, torque_particle, torque_pair };
enum class Balance { body, global };      ///< what keeps an angular momentum of its own
enum class GaussSingular { skip, stop };  ///< where Gauss' principle has no solution

/// How well an invariant is kept by the equations themselves.
enum class Promise {
    exact,             ///< to round-off, whatever the step
    integrator_error,  ///< the ordinary differential equations keep it, the integrator to its
                       ///< accuracy
    not_kept           ///< the scheme changes it; its drift is physics of the scheme
};

struct Promises {
    Promise mass = Promise::exact;
    Promise momentum = Promise::exact;
    Promise angular_momentum = Promise::not_kept;
    Promise energy = Promise::integrator_error;
};

/// The paper's axes of choice, [HHM04] IX, as one value. `range` is the distance h at which the
/// weight function vanishes.
struct Scheme {
    Density density = Density::continuity;
    Transport transport = Transport::plain;
    MeanDensityKind mean_density = MeanDensityKind::arithmetic;
    AngularMomentum angular_momentum = AngularMomentum::free;
    Balance balance = Balance::body;
    GaussSingular gauss_singular = GaussSingular::skip;
    double viscosity = 0.0;  ///< von Neumann's artificial viscosity: alpha; 0 without
    /// Of Transport::shifting: its coefficient by sound speed at rest times range (physics/shifting.hpp).
    double shifting = 1.0;
    double closest_approach = 0.0;  ///< distance at which approaching pairs are reflected; 0: none
    Kernel kernel = Kernel::lucy;
    double range = 3.0;

    /// Throws InputError naming the combination, the reason and the fix if it makes no sense in
    /// `dim` dimensions.
    void validate(int dim) const;

    /// What validate() says of Transport::shifting.
    void validate_shifting() const;

    /// The same for particles of this spacing: pairs cannot be reflected there or beyond.
    void validate_distances(double spacing) const;

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
std::string_view to_string(Promise);

}  // namespace spam
