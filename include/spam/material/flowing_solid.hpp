// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/error.hpp>
#include <spam/core/symmetric_eigen.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/von_mises.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace spam {

/// A polynomial solid W that yields where von Mises' q of the Kirchhoff stress tau = P F^t exceeds Y, and tears
/// where the mean tension p = tr tau/D exceeds a limit p_c. q^2 = k s:s of the deviator s = eta dev(F F^t), k = 2 in
/// the plane, where q is the difference of the principal stresses, and 3/2 in space. The energy is what is
/// stored or spent at least, perfect plasticity with the flow normal to the surface,
///     psi(F) = min over G of W(F G) + Y d + p_c v,   P = dpsi/dF = dW/d(F G) G,
/// G = exp(-D_p) with the axes of F^t F, d^2 = D_p':D_p'/k of the deviator of D_p, v = tr D_p >= 0. Where q and p
/// are within their limits, G = 1. What is crushed to less than half its volume becomes harder, Y times
/// 1 + ((1/2 - J)/J)^2, and does not flow when turned inside out, where flow would let F vanish; no tear
/// closes to less than 3/5 of the volume, above which p grows with J. Derived here; P against psi, and that psi is the
/// least: tests/material/flowing_solid.cpp.
struct FlowingSolid {
    static constexpr double never = std::numeric_limits<double>::infinity();

    PolynomialSolid elastic;
    double yield_stress = never;   ///< Y
    double tension_limit = never;  ///< p_c

    /// Throws InputError for limits that are not above 0.
    void validate() const {
        for (const auto& [name, limit] :
             {std::pair{"yield_stress", yield_stress}, {"tension_limit", tension_limit}})
            if (!(limit > 0.0))
                throw InputError(fmt::format(
                    "{}: {} must be above 0; leave it out where there is none", name, limit));
    }
    double stiffness() const { return elastic.stiffness(); }
    bool flows() const { return yield_stress < never || tension_limit < never; }
    double yield_strain() const { return yield_stress / (2.0 * elastic.eta); }
    std::string describe() const {
        std::string words = elastic.describe();
        if (yield_stress < never) words += fmt::format(", yields at {:.6g}", yield_stress);
        if (tension_limit < never) words += fmt::format(", tension at most {:.6g}", tension_limit);
        return words;
    }
    template <int Dim>
    double energy(const Mat<Dim>& F) const {
        const Stretch<Dim> trial(F);
        if (bears(trial)) return elastic.energy(F);
        const Return<Dim> back = returned(trial);
        return elastic.energy(F * back.G) + back.work;
    }
    template <int Dim>
    Mat<Dim> stress(const Mat<Dim>& F) const {
        const Stretch<Dim> trial(F);
        return bears(trial) ? elastic.stress(F) : returned_stress(F, trial);
    }

    template <int Dim>
    std::optional<Mat<Dim>> flow(const Mat<Dim>& F) const {
        const Stretch<Dim> trial(F);
        // What has just returned is not looked at again because of its last digits.
        if (bears(trial, 1.0 + 1e-10)) return {};
        const SymTensor<Dim> G = returned(trial).G;
        Mat<Dim> flow;
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b) flow(a, b) = G(a, b);
        return flow;
    }

  private:
    static constexpr double crushed = 0.5, closed = 0.6;

    /// F^t F and what follows from it without its axes.
    template <int Dim>
    struct Stretch {
        SymTensor<Dim> C;
        double J, trace = 0.0;
        double spread2 = 0.0;  ///< q^2/eta^2

        explicit Stretch(const Mat<Dim>& F) : J(determinant(F)) {
            for (int a = 0; a < Dim; ++a)
                for (int b = a; b < Dim; ++b)
                    for (int c = 0; c < Dim; ++c) C(a, b) += F(c, a) * F(c, b);
            for (int a = 0; a < Dim; ++a) trace += C(a, a);
            for (int a = 0; a < Dim; ++a) {
                spread2 += factor * (C(a, a) - trace / Dim) * (C(a, a) - trace / Dim);
                for (int b = a + 1; b < Dim; ++b) spread2 += 2.0 * factor * C(a, b) * C(a, b);
            }
        }
        static constexpr double factor = Dim == 3 ? 1.5 : 2.0;  // k
    };
    /// `work`: what is spent. `slope`: what its dependence on J adds to P, times cof F.
    template <int Dim>
    struct Return {
        SymTensor<Dim> G;
        double work = 0.0, slope = 0.0;
    };

    /// tr tau/D, by tr F F^t and J.
    template <int Dim>
    double mean_tension(double trace, double J) const {
        return elastic.eta * trace / Dim +
               ((elastic.lambda + elastic.eta) * (J - 1.0) - elastic.eta) * J;
    }
    double yield_stress_at(double J) const {
        if (J < crushed && J > 0.0) {
            const double less = (crushed - J) / J;
            return yield_stress * (1.0 + less * less);
        }
        return J > 0.0 ? yield_stress : never;
    }
    /// Its derivative by J.
    double hardening(double J) const {
        return J < crushed ? -2.0 * yield_stress * crushed * (crushed - J) / (J * J * J) : 0.0;
    }
    template <int Dim>
    bool bears(const Stretch<Dim>& s, double by = 1.0) const {
        const double limit = by * yield_stress_at(s.J) / elastic.eta;
        return !(s.spread2 > limit * limit) &&
               !(s.J > closed && mean_tension<Dim>(s.trace, s.J) > by * tension_limit);
    }
    template <int Dim>
    [[gnu::noinline]] Mat<Dim> returned_stress(const Mat<Dim>& F, const Stretch<Dim>& trial) const {
        const Return<Dim> back = returned(trial);
        Mat<Dim> P = elastic.stress(F * back.G) * back.G;
        if (back.slope != 0.0) P += back.slope * PolynomialSolid::cofactors(F);
        return P;
    }

    /// det G at which the tension is at its limit, or the least there may be. trace(growth): tr F F^t there, on the
    /// yield surface where that is reached. Sets the slope of what is spent.
    template <int Dim, class Trace>
    double growth_at_the_limit(double J, const Trace& trace, double& slope) const {
        const auto excess = [&](double less) {
            return mean_tension<Dim>(trace(1.0 - less), (1.0 - less) * J) - tension_limit;
        };
        const double most = 1.0 - closed / J, left = excess(most);
        if (!(left > 0.0)) return 1.0 - falling_root(most, excess);
        slope = -left / J;  // beyond that tension is what is spent, not what is stored
        return closed / J;
    }

    /// In the plane C has the squared stretches (tr C +- spread)/2, and G = a + b C.
    [[gnu::noinline]] Return<2> returned(const Stretch<2>& s) const {
        const double spread = std::sqrt(s.spread2), longer = 0.5 * (s.trace + spread);
        const double Y = yield_stress_at(s.J), gap = Y / elastic.eta;
        const auto yields = [&](double growth) { return growth * spread > gap; };
        const auto trace = [&](double growth) {
            const double J = growth * s.J;
            return yields(growth) ? std::sqrt(gap * gap + 4.0 * J * J) : growth * s.trace;
        };
        Return<2> r;
        double growth = 1.0;
        if (s.J > closed && mean_tension<2>(trace(1.0), s.J) > tension_limit) {
            growth = growth_at_the_limit<2>(s.J, trace, r.slope);
            r.work = -tension_limit * std::log(growth);
        }
        double first = std::sqrt(growth), difference = 0.0;
        if (yields(growth)) {
            first = std::sqrt(0.5 * (gap + trace(growth)) / longer);
            difference = (first - growth / first) / spread;
            const double strain = 0.5 * std::log(growth / (first * first));
            r.work += Y * strain;
            r.slope += hardening(s.J) * strain;
        }
        r.G = difference * s.C;
        for (int a = 0; a < 2; ++a) r.G(a, a) += first - difference * longer;
        return r;
    }

    [[gnu::noinline]] Return<3> returned(const Stretch<3>& s) const {
        const double spread = std::sqrt(s.spread2);
        const double Y = yield_stress_at(s.J), gap = Y / elastic.eta;
        const SymmetricEigen<3> principal = symmetric_eigen(s.C);
        Deviator surface(principal.value, gap);
        const auto scale2 = [](double growth) { return std::cbrt(growth * growth); };
        const auto yields = [&](double growth) { return scale2(growth) * spread > gap; };
        const auto trace = [&](double growth) {
            if (!yields(growth)) return scale2(growth) * s.trace;
            surface.close(s.J, growth);
            return 3.0 * surface.mean;
        };
        Return<3> r;
        double growth = 1.0;
        if (s.J > closed && mean_tension<3>(trace(1.0), s.J) > tension_limit) {
            growth = growth_at_the_limit<3>(s.J, trace, r.slope);
            r.work = -tension_limit * std::log(growth);
        }
        Vec<3> g;
        for (double& x : g.c) x = std::cbrt(growth);
        if (yields(growth)) {
            surface.close(s.J, growth);
            for (int a = 0; a < 3; ++a) g[a] = std::exp(-surface.strain[a]);
            const double strain = std::sqrt(2.0 / 3.0) * dot(surface.n, surface.strain);
            r.work += Y * strain;
            r.slope += hardening(s.J) * strain;
        }
        r.G = from_eigen(g, principal.vectors);
        return r;
    }

    /// The squared stretches on the surface, l = mean + radius n, |n| = 1, for which D_p = ln(trial/l)/2 is
    /// normal to it: no part along t, which is normal to n among deviators. By Newton's method for the angle,
    /// from the radial return. The least stretch, which may be 0, is known by its product with the others.
    struct Deviator {
        Vec<3> trial, n, strain;  ///< strain: D_p
        double radius, mean = 0.0;
        int least = 0;

        Deviator(const Vec<3>& stretches, double spread)
            : trial(stretches),
              radius(spread / std::sqrt(1.5)) {
            double middle = 0.0;
            for (int a = 0; a < 3; ++a) {
                middle += trial[a] / 3.0;
                if (trial[a] < trial[least]) least = a;
            }
            for (int a = 0; a < 3; ++a) n[a] = trial[a] - middle;
            n = (1.0 / std::sqrt(dot(n, n))) * n;
        }
        /// With det F = growth J.
        void close(double J, double growth) {
            const double J2 = growth * growth * J * J, shrinkage = -std::log(growth);
            double turn = 1.0;
            for (int k = 0; k < 40; ++k) {
                find_mean(J2);
                Vec<3> x, t;  // t = n x (1, 1, 1)/sqrt(3)
                for (int a = 0; a < 3; ++a) {
                    x[a] = mean + radius * n[a];
                    t[a] = (n[(a + 1) % 3] - n[(a + 2) % 3]) / std::sqrt(3.0);
                }
                strain[least] = shrinkage;
                for (int a = 0; a < 3; ++a)
                    if (a != least) {
                        strain[a] = 0.5 * std::log(trial[a] / x[a]);
                        strain[least] -= strain[a];
                    }
                // |turn| converges quadratically.
                if (std::abs(turn) < 1e-9) break;
                double slope = -dot(n, strain), pairs = 0.0, sum = 0.0;
                for (int a = 0; a < 3; ++a) {
                    const int b = (a + 1) % 3, c = (a + 2) % 3;
                    pairs += x[a] * x[b];
                    sum += x[c] * (t[a] - t[b]) * (t[a] - t[b]);
                }
                slope -= 0.5 * radius * sum / pairs;
                turn = std::clamp(-dot(t, strain) / slope, -0.5, 0.5);
                n = std::cos(turn) * n + std::sin(turn) * t;
            }
        }
        /// From above, where the product is convex.
        void find_mean(double J2) {
            mean = std::cbrt(J2) - radius * std::min({n[0], n[1], n[2]});
            for (int k = 0; k < 60; ++k) {
                double f = 1.0, slope = 0.0;
                for (const double x : n.c) {
                    const double factor = mean + radius * x;
                    slope = slope * factor + f;
                    f *= factor;
                }
                const double step = (f - J2) / slope;
                mean -= step;
                if (!(std::abs(step) > 4e-16 * mean)) break;
            }
        }
    };
};

static_assert(FlowingLaw<FlowingSolid, 2> && FlowingLaw<FlowingSolid, 3>);

}  // namespace spam
