// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>

#include <fmt/format.h>

#include <concepts>
#include <string>

namespace spam {

/// A law whose stress follows the velocity gradient (grad v)_ab = d v_b / d x_a at once; it comes on
/// top of the pressure of an equation of state.
template <class Law, int Dim>
concept ViscousLaw = requires(const Law law, Mat<Dim> grad_v) {
    { law.viscous_stress(grad_v) } -> std::same_as<SymTensor<Dim>>;
    { law.describe() } -> std::convertible_to<std::string>;
};

/// Newton's viscosity, [HH07] 1 (where the slide has abs(div v)):
///     sigma = lambda (div v) I + eta (grad v + grad v^t),   P = (p - lambda div v) I - eta (...)
/// Tension-positive. The bulk viscosity lambda + 2 eta/D must not be negative, nor eta: then
/// sigma : grad v, the heat made, is not either. lambda = -eta in the plane is without bulk viscosity.
struct NewtonViscosity {
    double lambda;  ///< second coefficient
    double eta;     ///< shear viscosity

    /// The law of given shear and bulk viscosity in D dimensions.
    static NewtonViscosity shear_and_bulk(double shear, double bulk, int dimensions) {
        return {bulk - 2.0 * shear / dimensions, shear};
    }
    /// eta_v: lambda + eta in the plane, lambda + 2 eta/3 in space.
    double bulk_viscosity(int dimensions) const { return lambda + 2.0 * eta / dimensions; }

    template <int Dim, class T>
    SymTensor<Dim, T> viscous_stress(const Mat<Dim, T>& grad_v) const {
        const T dilation = T(lambda) * grad_v.trace();
        SymTensor<Dim, T> stress;
        for (int a = 0; a < Dim; ++a) {
            stress(a, a) = dilation + T(2.0 * eta) * grad_v(a, a);
            for (int b = a + 1; b < Dim; ++b) stress(a, b) = T(eta) * (grad_v(a, b) + grad_v(b, a));
        }
        return stress;
    }
    std::string describe() const {
        return fmt::format("Newton viscosity, lambda = {:.6g}, eta = {:.6g}", lambda, eta);
    }
};

static_assert(ViscousLaw<NewtonViscosity, 1> && ViscousLaw<NewtonViscosity, 2> &&
              ViscousLaw<NewtonViscosity, 3>);

}  // namespace spam
