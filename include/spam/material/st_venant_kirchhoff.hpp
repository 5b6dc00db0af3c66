// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/elastic_solid.hpp>
#include <spam/material/hyperelastic_law.hpp>

namespace spam {

/// Hooke's law between the strain and the stress of the reference configuration:
///     E = (F^t F - 1)/2,   energy = lambda tr(E)^2/2 + eta E:E,   P = F (lambda tr(E) 1 + 2 eta E).
/// For small strains the elastic solid of [HHM04] II. Softens under strong compression: no
/// stiffness is left where a bar is squeezed to 1/sqrt(3) of its length.
struct StVenantKirchhoff {
    double lambda;  ///< first Lame constant
    double eta;     ///< second Lame constant (shear modulus)

    /// The law with the small-strain constants of `solid`.
    static StVenantKirchhoff like(const ElasticSolid& solid) { return {solid.lambda, solid.eta}; }

    double stiffness() const { return penalty_modulus(lambda, eta); }
    std::string describe() const {
        return fmt::format("St Venant-Kirchhoff, lambda = {:.6g}, eta = {:.6g}", lambda, eta);
    }

    /// E_ab = (F_ca F_cb - delta_ab)/2
    template <int Dim, class T>
    static SymTensor<Dim, T> strain(const Mat<Dim, T>& F) {
        SymTensor<Dim, T> E;
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b) {
                T sum = a == b ? T(-1.0) : T(0.0);
                for (int c = 0; c < Dim; ++c) sum += F(c, a) * F(c, b);
                E(a, b) = T(0.5) * sum;
            }
        return E;
    }

    template <int Dim, class T>
    Mat<Dim, T> stress(const Mat<Dim, T>& F) const {
        const SymTensor<Dim, T> E = strain(F);
        SymTensor<Dim, T> S = T(2.0 * eta) * E;
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b) S(a, a) += T(lambda) * E(b, b);
        return F * S;
    }

    template <int Dim, class T>
    T energy(const Mat<Dim, T>& F) const {
        const SymTensor<Dim, T> E = strain(F);
        T trace{}, square{};
        for (int a = 0; a < Dim; ++a) {
            trace += E(a, a);
            for (int b = 0; b < Dim; ++b) square += E(a, b) * E(a, b);
        }
        return T(0.5 * lambda) * trace * trace + T(eta) * square;
    }
};

static_assert(HyperelasticLaw<StVenantKirchhoff, 1> && HyperelasticLaw<StVenantKirchhoff, 2> &&
              HyperelasticLaw<StVenantKirchhoff, 3>);

}  // namespace spam
