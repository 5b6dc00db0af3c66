// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/symmetric_eigen.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/von_mises.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spam {

/// A polynomial solid W that yields where von Mises' q of the Kirchhoff stress tau = P F^t exceeds Y, and tears
/// where the mean tension p = tr tau/D exceeds a limit p_c. q^2 = k s:s of the deviator s = eta dev(F F^t), k = 2 in
/// the plane, where q is the difference of the principal stresses, and 3/2 in space. The energy is what is
/// stored or spent at least, perfect plasticity with the flow normal to the surface,
///     psi(F) = min over G of W(F G) + Y d + p_c v,   P = dpsi/dF = dW/d(F G) G,
/// G = exp(-D_p) with the axes of F^t F, d^2 = D_p':D_p'/k of the deviator of D_p, v = tr D_p >= 0. Where q and p
/// are within their limits, G = 1. Stated by squared stretches, all of it is smooth where a particle is turned
/// inside out. Derived here; P against psi in tests/material/flowing_solid.cpp.
struct FlowingSolid {
    static constexpr double never = std::numeric_limits<double>::infinity();

    PolynomialSolid elastic;
    double yield_stress = never;   ///< Y
    double tension_limit = never;  ///< of the mean stress

    double stiffness() const { return elastic.stiffness(); }
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
    /// `work`: what is spent, Y d + p_c v.
    template <int Dim>
    struct Return {
        SymTensor<Dim> G;
        double work;
    };

    /// tr tau/D, by tr F F^t and J.
    template <int Dim>
    double mean_tension(double trace, double J) const {
        return elastic.eta * trace / Dim +
               ((elastic.lambda + elastic.eta) * (J - 1.0) - elastic.eta) * J;
    }
    template <int Dim>
    bool bears(const Stretch<Dim>& s, double by = 1.0) const {
        const double limit = by * yield_stress / elastic.eta;
        return !(s.spread2 > limit * limit) &&
               !(mean_tension<Dim>(s.trace, s.J) > by * tension_limit);
    }
    template <int Dim>
    [[gnu::noinline]] Mat<Dim> returned_stress(const Mat<Dim>& F, const Stretch<Dim>& trial) const {
        const SymTensor<Dim> G = returned(trial).G;
        return elastic.stress(F * G) * G;
    }

    /// W by tr F F^t and J.
    template <int Dim>
    double stored(double trace, double J) const {
        return 0.5 * elastic.eta * (trace - Dim) - elastic.eta * (J - 1.0) +
               0.5 * (elastic.lambda + elastic.eta) * (J - 1.0) * (J - 1.0);
    }
    /// The growth = det G, 0 < growth < 1, at which the tension is at its limit and least is stored and spent: a
    /// solid sheared by much can bear the same tension at another density. at(growth) returns tr F F^t and what
    /// flow spends besides.
    template <int Dim, class At>
    double growth_at_the_limit(double J, const At& at) const {
        constexpr int parts = 16;
        const auto excess = [&](double growth) {
            return mean_tension<Dim>(at(growth)[0], growth * J) - tension_limit;
        };
        double best = 1.0, least = never, high = 1.0, f_high = excess(1.0);
        for (int k = parts - 1; k >= 0; --k) {
            const double stretch = static_cast<double>(k) / parts;
            const double low = Dim == 2 ? stretch * stretch : stretch * stretch * stretch;
            const double f_low = k == 0 ? -tension_limit : excess(low);
            if (f_high > 0.0 && f_low <= 0.0) {
                const double growth = high - falling_root(high - low, [&](double less) {
                                          return less < high ? excess(high - less) : f_low;
                                      });
                const std::array<double, 2> there = at(growth);
                const double cost =
                    stored<Dim>(there[0], growth * J) + there[1] - tension_limit * std::log(growth);
                if (cost < least) {
                    least = cost;
                    best = growth;
                }
            }
            high = low;
            f_high = f_low;
        }
        return best;
    }

    /// In the plane C has the squared stretches (tr C +- spread)/2, and G = a + b C.
    [[gnu::noinline]] Return<2> returned(const Stretch<2>& s) const {
        const double eta = elastic.eta, spread = std::sqrt(s.spread2);
        const double longer = 0.5 * (s.trace + spread);
        const bool yields = eta * spread > yield_stress;
        const auto beyond = [&](double growth) {
            return yields && eta * growth * spread > yield_stress;
        };
        // On the surface: tr C, and the first stretch of G squared.
        const auto sum = [&](double growth) {
            const double J = growth * s.J;
            return std::sqrt(yield_stress * yield_stress / (eta * eta) + 4.0 * J * J);
        };
        const auto first2 = [&](double growth) {
            return 0.5 * (yield_stress / eta + sum(growth)) / longer;
        };
        const auto flow_work = [&](double growth) {
            return 0.5 * yield_stress * std::log(growth / first2(growth));
        };
        double growth = 1.0;
        if (mean_tension<2>(yields ? sum(1.0) : s.trace, s.J) > tension_limit) {
            if (yields) {
                growth = growth_at_the_limit<2>(s.J, [&](double g) {
                    return beyond(g) ? std::array{sum(g), flow_work(g)}
                                     : std::array{g * s.trace, 0.0};
                });
            } else {  // growth (A + B growth) = p_c
                const double A = 0.5 * eta * s.trace - (elastic.lambda + 2.0 * eta) * s.J;
                const double B = (elastic.lambda + eta) * s.J * s.J;
                const double root = std::sqrt(A * A + 4.0 * B * tension_limit);
                growth = A > 0.0 ? 2.0 * tension_limit / (A + root) : 0.5 * (root - A) / B;
            }
        }
        Return<2> r{{}, growth < 1.0 ? -tension_limit * std::log(growth) : 0.0};
        double first = std::sqrt(growth), slope = 0.0;
        if (beyond(growth)) {
            first = std::sqrt(first2(growth));
            slope = (first - growth / first) / spread;
            r.work += flow_work(growth);
        }
        r.G = slope * s.C;
        for (int a = 0; a < 2; ++a) r.G(a, a) += first - slope * longer;
        return r;
    }

    [[gnu::noinline]] Return<3> returned(const Stretch<3>& s) const {
        const double eta = elastic.eta, spread = std::sqrt(s.spread2);
        const SymmetricEigen<3> principal = symmetric_eigen(s.C);
        Deviator d(principal.value, yield_stress / eta);
        const auto scale2 = [](double growth) { return std::cbrt(growth * growth); };
        const auto beyond = [&](double growth) {
            return eta * scale2(growth) * spread > yield_stress;
        };
        const auto flow_work = [&] {
            return yield_stress * std::sqrt(2.0 / 3.0) * dot(d.n, d.strain);
        };
        const auto at = [&](double growth) {
            if (!beyond(growth)) return std::array{scale2(growth) * s.trace, 0.0};
            d.close(s.J, growth);
            return std::array{3.0 * d.mean, flow_work()};
        };
        double growth = 1.0;
        if (mean_tension<3>(at(1.0)[0], s.J) > tension_limit) {
            growth = growth_at_the_limit<3>(s.J, at);
            at(growth);
        }
        Return<3> r{{}, growth < 1.0 ? -tension_limit * std::log(growth) : 0.0};
        Vec<3> g;
        for (int a = 0; a < 3; ++a)
            g[a] = beyond(growth) ? std::exp(-d.strain[a]) : std::cbrt(growth);
        if (beyond(growth)) r.work += flow_work();
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
