// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/symmetric_eigen.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/von_mises.hpp>

#include <limits>

namespace spam {

/// A polynomial solid that yields where von Mises' q of the Kirchhoff stress tau = P F^t exceeds Y, and tears
/// where the mean tension tr tau/D exceeds a limit. q^2 = k s:s of the deviator s = eta dev(F F^t), k = 2 in the
/// plane, where q is the difference of the principal stresses, and 3/2 in space. The return keeps principal
/// directions: squared stretches l = beta + (Y/q)(l - mean l), with the beta that keeps J; too much
/// tension scales all stretches. Derived here; tests/rhs/material_vectors_flow.cpp.
struct FlowingSolid {
    static constexpr double never = std::numeric_limits<double>::infinity();

    PolynomialSolid elastic;
    double yield_stress = never;   ///< Y
    double tension_limit = never;  ///< of the mean stress

    double stiffness() const { return elastic.stiffness(); }
    std::string describe() const {
        std::string words = elastic.describe();
        if (yield_stress < never) words += fmt::format(", yields at {:.6g}", yield_stress);
        if (tension_limit < never) words += fmt::format(", tension at most {:.6g}", tension_limit);
        return words;
    }
    template <int Dim>
    double energy(const Mat<Dim>& F) const {
        return elastic.energy(F);
    }
    template <int Dim>
    Mat<Dim> stress(const Mat<Dim>& F) const {
        return elastic.stress(F);
    }

    template <int Dim>
    std::optional<Mat<Dim>> flow(const Mat<Dim>& F) const {
        const double J = determinant(F);
        if (!(J > 0.0)) return {};
        SymTensor<Dim> C;  // F^t F
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b)
                for (int c = 0; c < Dim; ++c) C(a, b) += F(c, a) * F(c, b);
        double trace = 0.0, square = 0.0;
        for (int a = 0; a < Dim; ++a) trace += C(a, a);
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b)
                square += std::pow(C(a, b) - (a == b ? trace / Dim : 0.0), 2);
        const double q = elastic.eta * std::sqrt((Dim == 3 ? 1.5 : 2.0) * square);
        // What has just returned is not looked at again because of its last digits.
        constexpr double beyond = 1.0 + 1e-10;
        const bool yields = q > beyond * yield_stress;
        if (!yields && mean_tension<Dim>(trace, J) <= beyond * tension_limit) return {};

        const SymmetricEigen<Dim> principal = symmetric_eigen(C);
        Vec<Dim> l = principal.value;
        if (yields) return_deviator<Dim>(l, trace / Dim, yield_stress / q, J * J);
        trace = 0.0;
        for (const double x : l.c) trace += x;
        if (mean_tension<Dim>(trace, J) > tension_limit) {
            const double less = falling_root(1.0, [&](double x) {
                return mean_tension<Dim>((1.0 - x) * (1.0 - x) * trace,
                                         std::pow(1.0 - x, Dim) * J) -
                       tension_limit;
            });
            for (double& x : l.c) x *= (1.0 - less) * (1.0 - less);
        }
        Mat<Dim> G;
        for (int n = 0; n < Dim; ++n) {
            const double stretch = std::sqrt(l[n] / principal.value[n]);
            for (int a = 0; a < Dim; ++a)
                for (int b = 0; b < Dim; ++b)
                    G(a, b) += stretch * principal.vectors(a, n) * principal.vectors(b, n);
        }
        return G;
    }

  private:
    /// tr tau/D, by tr F F^t and J.
    template <int Dim>
    double mean_tension(double trace, double J) const {
        return elastic.eta * trace / Dim +
               ((elastic.lambda + elastic.eta) * (J - 1.0) - elastic.eta) * J;
    }

    /// l = beta + part (l - mean): by Newton's method from the mean, above the root of a convex function.
    template <int Dim>
    static void return_deviator(Vec<Dim>& l, double mean, double part, double product) {
        double beta = mean;
        for (int k = 0; k < 60; ++k) {
            double f = 1.0, slope = 0.0;
            for (const double x : l.c) {
                const double factor = beta + part * (x - mean);
                slope = slope * factor + f;
                f *= factor;
            }
            const double step = (f - product) / slope;
            beta -= step;
            if (std::abs(step) <= 4e-16 * beta) break;
        }
        for (double& x : l.c) x = beta + part * (x - mean);
    }
};

static_assert(FlowingLaw<FlowingSolid, 2> && FlowingLaw<FlowingSolid, 3>);

}  // namespace spam
