// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/elastic_solid.hpp>
#include <spam/material/hyperelastic_law.hpp>

namespace spam {

/// An elastic solid whose energy is a polynomial of F, J = det F:
///     W = (eta/2)(tr F^t F - D) - eta (J - 1) + ((lambda + eta)/2) (J - 1)^2,
///     P = eta F + [(lambda + eta)(J - 1) - eta] cof F.
/// For small strains Hooke's law with lambda and eta, in any dimension. It stays smooth where a particle is
/// turned inside out, which a law with ln J does not.
struct PolynomialSolid {
    double lambda;  ///< first Lame constant
    double eta;     ///< second Lame constant (shear modulus)

    /// The law with the small-strain constants of `solid`.
    static PolynomialSolid like(const ElasticSolid& solid) { return {solid.lambda, solid.eta}; }

    double stiffness() const { return eta; }
    std::string describe() const {
        return fmt::format("polynomial solid, lambda = {:.6g}, eta = {:.6g}", lambda, eta);
    }

    template <int Dim>
    double energy(const Mat<Dim>& F) const {
        double square = -Dim;
        for (const double f : F.c) square += f * f;
        const double growth = determinant(F) - 1.0;
        return 0.5 * eta * square - eta * growth + 0.5 * (lambda + eta) * growth * growth;
    }

    template <int Dim>
    Mat<Dim> stress(const Mat<Dim>& F) const {
        return eta * F + ((lambda + eta) * (determinant(F) - 1.0) - eta) * cofactors(F);
    }

    /// d det F / dF
    template <int Dim>
    static Mat<Dim> cofactors(const Mat<Dim>& F) {
        Mat<Dim> c;
        if constexpr (Dim == 1) {
            c(0, 0) = 1.0;
        } else if constexpr (Dim == 2) {
            c(0, 0) = F(1, 1);
            c(0, 1) = -F(1, 0);
            c(1, 0) = -F(0, 1);
            c(1, 1) = F(0, 0);
        } else {
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b) {
                    const int i = (a + 1) % 3, j = (a + 2) % 3, k = (b + 1) % 3, l = (b + 2) % 3;
                    c(a, b) = F(i, k) * F(j, l) - F(i, l) * F(j, k);
                }
        }
        return c;
    }
};

static_assert(HyperelasticLaw<PolynomialSolid, 1> && HyperelasticLaw<PolynomialSolid, 2> &&
              HyperelasticLaw<PolynomialSolid, 3>);

}  // namespace spam
