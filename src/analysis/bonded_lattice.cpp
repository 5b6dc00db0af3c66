// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex_modes.hpp"
#include <spam/analysis/bonded_lattice.hpp>
#include <spam/core/error.hpp>
#include <spam/physics/material_vectors.hpp>

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace spam {
namespace {

template <int Dim>
using Tensor = Eigen::Matrix<double, Dim, Dim>;

/// P of laws without a memory, which look at no state.
template <int Dim>
Tensor<Dim> first_stress(const HyperelasticMaterial<Dim>& material, const Tensor<Dim>& F) {
    using Rows = Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>;
    const Rows from = F;
    Rows P;
    const std::uint32_t number = 0;
    static const FieldLayout<Dim> layout(1, {Field::position, Field::velocity});
    static const std::array<double, 2 * Dim> y{};
    if (!material.stresses({&number, 1}, Dim * Dim, from.data(), P.data(),
                           ConstState<Dim>(layout, y)))
        throw InputError("material: its stress is not finite under this deformation");
    return P;
}

/// dP/dF: of polynomials up to the fourth degree but for rounding (Richardson).
template <int Dim>
Eigen::Matrix<double, Dim * Dim, Dim * Dim> tangent(const HyperelasticMaterial<Dim>& material,
                                                    const Tensor<Dim>& F) {
    Eigen::Matrix<double, Dim * Dim, Dim * Dim> C;
    for (Eigen::Index n = 0; n < Dim * Dim; ++n) {
        const auto centred = [&](double step) -> Tensor<Dim> {
            Tensor<Dim> up = F, down = F;
            up(n) += step;
            down(n) -= step;
            return (first_stress<Dim>(material, up) - first_stress<Dim>(material, down)) /
                   (2.0 * step);
        };
        const Tensor<Dim> column = (4.0 * centred(0.005) - centred(0.01)) / 3.0;
        C.col(n) = Eigen::Map<const Eigen::Matrix<double, Dim * Dim, 1>>(column.data());
    }
    return 0.5 * (C + C.transpose());
}

template <int Dim>
Tensor<Dim> cauchy_stress(const HyperelasticMaterial<Dim>& material, const Tensor<Dim>& F) {
    return first_stress<Dim>(material, F) * F.transpose() / F.determinant();
}

}  // namespace

template <int Dim>
Tensor<Dim> deformation_under(const HyperelasticMaterial<Dim>& material,
                              const Tensor<Dim>& cauchy) {
    constexpr int numbers = Dim * (Dim + 1) / 2;
    using Numbers = Eigen::Matrix<double, numbers, 1>;
    const auto symmetric = [](const Numbers& n) {
        Tensor<Dim> t;
        for (int a = 0, c = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b, ++c) t(a, b) = t(b, a) = n[c];
        return t;
    };
    const auto numbers_of = [](const Tensor<Dim>& t) {
        Numbers n;
        for (int a = 0, c = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b, ++c) n[c] = t(a, b);
        return n;
    };
    const auto missing = [&](const Numbers& n) -> Numbers {
        return numbers_of(cauchy_stress<Dim>(material, symmetric(n)) - cauchy);
    };
    Numbers F = numbers_of(Tensor<Dim>::Identity());
    const double scale = std::max(material.stiffness(), cauchy.norm());
    for (int iteration = 0; iteration < 50; ++iteration) {
        const Numbers off = missing(F);
        if (off.norm() < 1e-14 * scale) return symmetric(F);
        Eigen::Matrix<double, numbers, numbers> slope;
        for (int n = 0; n < numbers; ++n) {
            constexpr double step = 1e-6;
            Numbers up = F, down = F;
            up[n] += step;
            down[n] -= step;
            slope.col(n) = (missing(up) - missing(down)) / (2.0 * step);
        }
        Numbers change = solution(slope, off);
        if (change.norm() > 0.2) change *= 0.2 / change.norm();
        F -= change;
        if (!F.allFinite() || !(symmetric(F).determinant() > 0.0)) break;
        if (change.norm() < 1e-15) return symmetric(F);
    }
    throw InputError(
        fmt::format("stress: '{}' bears no such stress in any state of strain; give less",
                    material.describe()));
}

template <int Dim>
BondedLattice<Dim>::BondedLattice(const Tensor& basis, const HyperelasticMaterial<Dim>& material,
                                  const MaterialVectorScheme& scheme, const Tensor& F,
                                  BondMemory memory)
    : memory_(memory),
      F_(F),
      P_(first_stress<Dim>(material, F)),
      C_(tangent<Dim>(material, F)),
      volume_(mass_ / scheme.density) {
    const double h = scheme.range;
    if (!(h > 0.0) || !(h <= 30.0 * basis.colwise().norm().maxCoeff()))
        throw InputError(fmt::format("range: {:g} must be positive and not above 30 spacings", h));
    if (!(scheme.density > 0.0))
        throw InputError(fmt::format("density: {:g} must be positive", scheme.density));
    if (!(scheme.penalty >= 0.0))
        throw InputError(fmt::format("penalty: {:g} must not be below 0", scheme.penalty));
    Tensor N = Tensor::Zero(), N_free = Tensor::Zero();
    // Sites that may be nearer than h in one of the two lattices.
    const Tensor back = basis.inverse(), strained_back = (F * basis).inverse();
    std::array<int, Dim> most, n;
    for (int a = 0; a < Dim; ++a)
        most[static_cast<std::size_t>(a)] =
            static_cast<int>(h * std::max(back.row(a).norm(), strained_back.row(a).norm())) + 1;
    for (std::size_t a = 0; a < Dim; ++a) n[a] = -most[a];
    for (bool more = true; more;) {
        Vector cell;
        for (int a = 0; a < Dim; ++a) cell[a] = n[static_cast<std::size_t>(a)];
        const Vector X = basis * cell, r = F * X;
        if (cell.squaredNorm() > 0.0) {
            const double g = scheme.weight(X.norm(), h);
            const BondFade<double> fade(r.squaredNorm(), 1.0 / h);
            const double w = g * fade.s;
            N_free += g * BondFade<double>(X.squaredNorm(), 1.0 / h).s * X * X.transpose();
            N += w * X * X.transpose();
            const double step = 1e-5 * h;
            const double slope =
                (scheme.weight(X.norm() + step, h) - scheme.weight(X.norm() - step, h)) /
                (2.0 * step * X.norm());
            if (w > 0.0)
                bonds_.push_back({X, r, Vector::Zero(), w, g * fade.slope, fade.s * slope});
        }
        std::size_t a = 0;
        while (a < Dim && ++n[a] > most[a]) {
            n[a] = -most[a];
            ++a;
        }
        more = a < Dim;
    }
    if (!(N.determinant() > 0.0))
        throw InputError("range: a particle has no neighbours in every direction; widen --range");
    N_inverse_ = N.inverse();
    c_ = scheme.penalty * material.stiffness() * volume_ / (N_free.trace() / Dim);
    for (Bond& bond : bonds_) bond.q = P_ * (N_inverse_ * bond.X);
}

/// Complex numbers as two real ones, of vectors and matrices part by part: products of complex matrices of a fixed
/// size with real ones take Eigen longer to compile than all the rest of this file.
template <int Dim>
auto BondedLattice<Dim>::phases(const Point<Dim>& k) const -> std::vector<Complex> {
    std::vector<Complex> a;
    for (const Bond& bond : bonds_) a.push_back(std::polar(1.0, k.dot(bond.r)) - 1.0);
    return a;
}

template <int Dim>
auto BondedLattice<Dim>::with_memory(const Point<Dim>& k) const -> ComplexTensor {
    const std::vector<Complex> a = phases(k);
    Vector b_re = Vector::Zero(), b_im = Vector::Zero();
    for (std::size_t m = 0; m < bonds_.size(); ++m) {
        const Vector along = bonds_[m].w * (N_inverse_ * bonds_[m].X);
        b_re += a[m].real() * along;
        b_im += a[m].imag() * along;
    }
    ComplexTensor K = ComplexTensor::Zero();
    for (int c = 0; c < Dim; ++c)
        for (int d = 0; d < Dim; ++d)
            for (int e = 0; e < Dim; ++e)
                for (int f = 0; f < Dim; ++f)
                    K(c, d) += volume_ * C_(c + Dim * e, d + Dim * f) * Complex(b_re[e], -b_im[e]) *
                               Complex(b_re[f], b_im[f]);
    double misfit = 0.0;
    for (std::size_t m = 0; m < bonds_.size(); ++m) {
        const Bond& bond = bonds_[m];
        const Complex eps = a[m] - Complex(b_re.dot(bond.X), b_im.dot(bond.X));
        const Complex mixed = volume_ * bond.fading * std::conj(a[m]) * eps;
        for (int c = 0; c < Dim; ++c)
            for (int d = 0; d < Dim; ++d)
                K(c, d) +=
                    mixed * (bond.r[c] * bond.q[d]) + std::conj(mixed) * (bond.q[c] * bond.r[d]);
        misfit += bond.w * std::norm(eps);
    }
    for (int c = 0; c < Dim; ++c) K(c, c) += c_ * misfit;
    return K;
}

/// t = w T r, T = V tau M^-1 with M = sum w r (x) r and the Kirchhoff stress tau of the F that is integrated,
/// F_dot = L F, and w = g(|F^-1 r|) s(r). The force is sum t_kj - t_jk. Under stress K has no symmetry.
/// Changes of t are linear in a with real factors: found for its real and its imaginary part.
template <int Dim>
auto BondedLattice<Dim>::without_memory(const Point<Dim>& k) const -> ComplexTensor {
    const std::vector<Complex> a = phases(k);
    ComplexTensor K = ComplexTensor::Zero();
    std::vector<double> part(a.size());
    for (const bool imaginary : {false, true}) {
        for (std::size_t m = 0; m < a.size(); ++m) part[m] = imaginary ? a[m].imag() : a[m].real();
        for (int axis = 0; axis < Dim; ++axis) {
            const std::vector<Vector> changes = traction_changes(part, axis);
            for (std::size_t m = 0; m < a.size(); ++m) {
                const Complex back =
                    std::conj(a[m]) * (imaginary ? Complex(0.0, 1.0) : Complex(1.0));
                for (int c = 0; c < Dim; ++c) K(c, axis) += back * changes[m][c];
            }
        }
    }
    return K;
}

template <int Dim>
auto BondedLattice<Dim>::traction_changes(const std::vector<double>& a, int axis) const
    -> std::vector<Vector> {
    const Tensor tau = P_ * F_.transpose(), F_back = F_.inverse();
    const Tensor M_back = F_back.transpose() * N_inverse_ * F_back, T = volume_ * tau * M_back;
    const Vector u = Vector::Unit(axis), u_back = F_back * u;
    Vector beta = Vector::Zero();  // L = u (x) beta
    for (std::size_t m = 0; m < a.size(); ++m)
        beta += (bonds_[m].w * a[m]) * (M_back * bonds_[m].r);
    const Tensor dF = u * (F_.transpose() * beta).transpose();
    Tensor dP = Tensor::Zero();
    for (int n = 0; n < Dim * Dim; ++n)
        for (int o = 0; o < Dim * Dim; ++o) dP(n) += C_(n, o) * dF(o);
    const Tensor dtau = dP * F_.transpose() + P_ * dF.transpose();
    std::vector<double> dw;
    Tensor dM = Tensor::Zero();
    for (std::size_t m = 0; m < a.size(); ++m) {
        const Bond& bond = bonds_[m];
        dw.push_back(bond.fading * a[m] * bond.r[axis] +
                     bond.forgetting * (a[m] - beta.dot(bond.r)) * bond.X.dot(u_back));
        dM += dw[m] * bond.r * bond.r.transpose() +
              bond.w * a[m] * (u * bond.r.transpose() + bond.r * u.transpose());
    }
    const Tensor dT = (volume_ * dtau - T * dM) * M_back;
    std::vector<Vector> changes;
    for (std::size_t m = 0; m < a.size(); ++m)
        changes.push_back(dw[m] * (T * bonds_[m].r) + bonds_[m].w * (dT * bonds_[m].r) +
                          bonds_[m].w * a[m] * (T * u));
    return changes;
}

template <int Dim>
auto BondedLattice<Dim>::stiffness(const Point<Dim>& k) const -> ComplexTensor {
    return (memory_ == BondMemory::kept ? with_memory(k) : without_memory(k)) / mass_;
}

template <int Dim>
double BondedLattice<Dim>::growth_rate(const Point<Dim>& k) const {
    double largest = 0.0;
    for (const std::complex<double>& square : complex_modes(stiffness(k)).values) {
        // Hermitian: real, but for rounding
        const std::complex<double> rate =
            std::sqrt(memory_ == BondMemory::kept ? std::complex<double>(-square.real()) : -square);
        largest = std::max(largest, std::abs(rate.real()));
    }
    return largest;
}

template <int Dim>
std::vector<double> BondedLattice<Dim>::frequencies(const Point<Dim>& k) const {
    std::vector<double> all;
    for (const std::complex<double>& square : complex_modes(stiffness(k)).values)
        all.push_back(std::sqrt(std::complex<double>(square)).real());
    std::sort(all.begin(), all.end(), std::greater<>());
    return all;
}

template <int Dim>
double BondedLattice<Dim>::frequency(const Point<Dim>& k, const Point<Dim>& direction) const {
    const ComplexModes found = complex_modes(stiffness(k));
    double best = -1.0, omega = 0.0;
    for (Eigen::Index n = 0; n < found.values.size(); ++n) {
        const double along =
            std::abs(found.vectors.col(n).dot(direction.template cast<std::complex<double>>()));
        if (along <= best + 1e-9) continue;
        best = along;
        omega = std::sqrt(std::complex<double>(found.values[n])).real();
    }
    return omega;
}

Eigen::Matrix2d triangular_basis(double spacing) {
    Eigen::Matrix2d basis;
    basis << spacing, 0.5 * spacing, 0.0, std::sqrt(0.75) * spacing;
    return basis;
}

#define SPAM_INSTANTIATE(D)                                                                    \
    template Tensor<D> deformation_under<D>(const HyperelasticMaterial<D>&, const Tensor<D>&); \
    template class BondedLattice<D>;
SPAM_INSTANTIATE(2)
SPAM_INSTANTIATE(3)

}  // namespace spam
