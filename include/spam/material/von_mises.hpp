// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/elastic_solid.hpp>
#include <spam/material/plane_stress_multiplier.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <type_traits>

namespace spam {

/// A stress on or within the yield surface, and the plastic strain that brought it there.
template <int Dim>
struct ReturnedStress {
    SymTensor<Dim> stress;
    double zz = 0.0;      ///< across the plane, where the surface knows it
    double strain = 0.0;  ///< d eps_p
};

/// The x > 0 where f, which falls from f(0) > 0, is 0, to rounding error: by bisection and secants (the
/// Illinois method) between 0 and a bound that is found by doubling.
template <class F>
double falling_root(double bound, const F& f) {
    double low = 0.0, f_low = f(0.0), high = bound, f_high = f(high);
    for (int k = 0; f_high > 0.0 && k < 200; ++k) {
        low = high;
        f_low = f_high;
        high *= 2.0;
        f_high = f(high);
    }
    int last = 0;  // which end has moved: the value of one that stays is halved
    for (int k = 0; k < 100 && high - low > 2e-16 * high; ++k) {
        double x = high - f_high * (high - low) / (f_high - f_low);
        if (!(x > low && x < high)) x = 0.5 * (low + high);
        if (x == low || x == high) break;
        const double f_x = f(x);
        if (f_x > 0.0) {
            low = x;
            f_low = f_x;
            if (last > 0) f_high *= 0.5;
            last = 1;
        } else {
            high = x;
            f_high = f_x;
            if (last < 0) f_low *= 0.5;
            last = -1;
        }
    }
    return high;
}

/// Von Mises' surface, q = Y with q^2 = k s:s of the deviator s, from which stresses return along s: the
/// closest point in the norm of elastic energy, d eps_p = (q - Y)/(2 eta k), s *= 1 - 2 eta k d eps_p/q.
/// In the plane of two-dimensional bodies k = 2, q^2 = (sxx - syy)^2 + 4 sxy^2; with three directions k = 3/2,
/// q = Y in uniaxial tension. `Across`: in plane strain, where the stress sigma_zz counts.
template <int Directions, bool Across = false>
struct RadialVonMises {
    static constexpr int dim = Directions;
    static constexpr bool across = Across;
    static constexpr bool three = Across || Directions == 3;
    static constexpr double k = three ? 1.5 : 2.0;

    double lambda, eta;

    ElasticSolid elastic() const { return {lambda, eta}; }
    double modulus() const { return 2.0 * eta * k; }
    double bulk_modulus() const { return lambda + 2.0 * eta / (three ? 3.0 : 2.0); }
    static const char* name() {
        return Across ? "plane strain" : Directions == 3 ? "in space" : "in the plane";
    }

    struct Parts {
        double mean;
        SymTensor<dim> deviator;
        double zz;  ///< of the deviator
        double q;
    };
    static Parts parts(const SymTensor<dim>& stress, double zz) {
        Parts p{Across ? zz : 0.0, stress, 0.0, 0.0};
        for (int a = 0; a < dim; ++a) p.mean += stress(a, a);
        p.mean *= three ? 1.0 / 3.0 : 0.5;
        for (int a = 0; a < dim; ++a) p.deviator(a, a) -= p.mean;
        if (Across) p.zz = zz - p.mean;
        double square = p.zz * p.zz;
        for (int a = 0; a < dim; ++a)
            for (int b = a; b < dim; ++b)
                square += (a == b ? 1.0 : 2.0) * p.deviator(a, b) * p.deviator(a, b);
        p.q = std::sqrt(k * square);
        return p;
    }
    /// The deviator times `factor`.
    static ReturnedStress<dim> with_deviator(const Parts& p, double factor, double strain) {
        ReturnedStress<dim> r{factor * p.deviator, Across ? p.mean + factor * p.zz : 0.0, strain};
        for (int a = 0; a < dim; ++a) r.stress(a, a) += p.mean;
        return r;
    }
    /// Per volume, of a mean stress and a q.
    double elastic_energy(double mean, double q) const {
        return 0.5 * (mean * mean / bulk_modulus() + q * q / modulus());
    }

    /// Y(d, energy) is the yield stress after a plastic strain of d more, `energy` the elastic one left then;
    /// `slope` its derivative by d where it is linear, else unset (NaN).
    template <class YieldStress>
    ReturnedStress<dim> returned(const SymTensor<dim>& trial, double zz, double slope,
                                 const YieldStress& Y) const {
        const Parts p = parts(trial, zz);
        const double excess = p.q - Y(0.0, elastic_energy(p.mean, p.q));
        if (!(excess > 0.0)) return {trial, zz, 0.0};
        double d = excess / (modulus() + slope);
        if (std::isnan(slope))
            d = falling_root(p.q / modulus(), [&](double x) {
                const double left = p.q - modulus() * x;
                return left - Y(x, elastic_energy(p.mean, left));
            });
        return with_deviator(p, 1.0 - modulus() * d / p.q, d);
    }
};

using PlaneVonMises = RadialVonMises<2>;  ///< of bodies that have two dimensions alone
using PlaneStrainVonMises = RadialVonMises<2, true>;
using SpaceVonMises = RadialVonMises<3>;

/// Von Mises' surface in plane stress, sigma_zz = 0: q^2 = sxx^2 - sxx syy + syy^2 + 3 sxy^2. The closest
/// point in the norm of elastic energy is, with p, d = (sxx +- syy)/2,
///     p' = p/(1 + E g/(3 (1 - nu))), d' = d/(1 + 2 eta g), sxy' = sxy/(1 + 2 eta g),
/// g > 0 from q' = Y(eps_p + 2 g q'/3) (Simo and Hughes 1998, 3.4). Lambda and eta are those of space.
struct PlaneStressVonMises {
    static constexpr int dim = 2;
    static constexpr bool across = false;
    static constexpr bool three = true;

    double lambda, eta;

    /// With lambda* = 2 lambda eta/(lambda + 2 eta): no stress across the plane.
    ElasticSolid elastic() const { return {2.0 * lambda * eta / (lambda + 2.0 * eta), eta}; }
    double modulus() const { return 3.0 * eta; }
    static const char* name() { return "plane stress"; }
    /// How fast g makes p and the two others fall: E/(3 (1 - nu)), with E = eta (3 lambda + 2 eta)/(lambda + eta)
    /// and nu = lambda/(2 (lambda + eta)), and 2 eta.
    std::array<double, 2> falls() const {
        return {2.0 * eta * (3.0 * lambda + 2.0 * eta) / (3.0 * (lambda + 2.0 * eta)), 2.0 * eta};
    }

    template <class YieldStress>
    ReturnedStress<dim> returned(const SymTensor<dim>& trial, double, double slope,
                                 const YieldStress& Y) const {
        const double p = 0.5 * (trial(0, 0) + trial(1, 1)), d = 0.5 * (trial(0, 0) - trial(1, 1));
        const double xy = trial(0, 1), p2 = p * p, s2 = 3.0 * (d * d + xy * xy);
        const auto elastic_energy = [&](double f, double h) {
            return 0.5 * (f * f * p2 / (elastic().lambda + eta) + h * h * s2 / (3.0 * eta));
        };
        const double first = Y(0.0, elastic_energy(1.0, 1.0));
        if (!(p2 + s2 > first * first)) return {trial, 0.0, 0.0};
        const double a = falls()[0], b = falls()[1];
        double g = 0.0, f = 1.0, h = 1.0, q = 0.0;
        const auto go_to = [&](double to) {
            g = to;
            f = 1.0 / (1.0 + a * g);
            h = 1.0 / (1.0 + b * g);
            q = std::sqrt(f * f * p2 + h * h * s2);
        };
        if (std::isnan(slope)) {
            go_to(falling_root(1.0 / eta, [&](double x) {
                go_to(x);
                return q - Y(2.0 / 3.0 * x * q, elastic_energy(f, h));
            }));
        } else {
            PlaneStressMultiplier<double> root{p2, s2, first, a, b, 2.0 / 3.0 * slope};
            while (root.advance()) {
            }
            go_to(root.g);
        }
        ReturnedStress<dim> r;
        r.stress(0, 0) = f * p + h * d;
        r.stress(1, 1) = f * p - h * d;
        r.stress(0, 1) = h * xy;
        r.strain = 2.0 / 3.0 * g * q;
        return r;
    }
};

}  // namespace spam
