// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/material_vectors.hpp>

#include <Eigen/Core>

#include <vector>

namespace spam {

/// The F = F^t under which a law has this Cauchy stress P F^t/det F; from F = 1 by Newton's method. Throws
/// InputError where the law bears no such stress.
template <int Dim>
Eigen::Matrix<double, Dim, Dim> deformation_under(
    const HyperelasticMaterial<Dim>& material,
    const Eigen::Matrix<double, Dim, Dim>& cauchy_stress);

/// What becomes of material vectors in a lattice that is analysed.
enum class BondMemory {
    kept,    ///< X stays what it is, as in MaterialVectors
    renewed  ///< X = F^-1 r at all times, F integrated: a corrected gradient without memory
};

/// Small disturbances of a Bravais lattice of material vectors (physics/material_vectors.hpp) at rest under
/// uniform strain. Everywhere r = F X, so that no bond has a misfit, and a wave r_j -> r_j + u exp(i k . r_j)
/// moves m omega^2 u = K(k) u. With a = exp(i k . r) - 1, b = N^-1 sum w a X, eps = a - b . X, q = P N^-1 X:
///     K = V b* . C . b + V sum (g s'/r) [a* eps r (x) q + a eps* q (x) r] + c sum w |eps|^2,
/// C = dP/dF. The second term is that of F itself, d^2 F = 2 sum dw e (x) X N^-1: under tension it is of
/// the sign of an instability, of the size of the stress, and the third, of kappa, is above it or not.
/// With memory K is Hermitian, whatever the stress. Derived here; against the rates of the model, and against
/// laws that are wrong, in tests/diagnostics/bonded_lattice.cpp.
template <int Dim>
class BondedLattice {
  public:
    using Tensor = Eigen::Matrix<double, Dim, Dim>;
    using ComplexTensor = Eigen::Matrix<std::complex<double>, Dim, Dim>;

    /// `basis`: columns that span the lattice as it was free of stress, one particle of mass 1 a cell. Throws
    /// InputError for a scheme or range without meaning.
    BondedLattice(const Tensor& basis, const HyperelasticMaterial<Dim>& material,
                  const MaterialVectorScheme& scheme, const Tensor& F,
                  BondMemory memory = BondMemory::kept);

    /// K(k)/m, of wave vectors of the strained lattice.
    ComplexTensor stiffness(const Point<Dim>& k) const;
    /// Largest real part of a rate: amplitudes grow like exp(rate t). 0 where nothing grows.
    double growth_rate(const Point<Dim>& k) const;
    /// Descending; zero where a branch grows instead.
    std::vector<double> frequencies(const Point<Dim>& k) const;
    /// Of the wave whose motion is along `direction` (or nearest to it).
    double frequency(const Point<Dim>& k, const Point<Dim>& direction) const;

    /// P F^t/det F
    Tensor stress() const { return P_ * F_.transpose() / F_.determinant(); }
    /// Neighbours that weigh something.
    std::size_t neighbours() const { return bonds_.size(); }

  private:
    using Vector = Point<Dim>;
    using Complex = std::complex<double>;
    struct Bond {
        Vector X, r, q;
        double w, fading;   ///< fading = g s'/r
        double forgetting;  ///< s g'/|X|
    };
    ComplexTensor with_memory(const Point<Dim>& k) const;
    ComplexTensor without_memory(const Point<Dim>& k) const;
    /// exp(i k . r) - 1 of every bond.
    std::vector<Complex> phases(const Point<Dim>& k) const;
    /// Of every bond the change of t where its end moves by a along the axis.
    std::vector<Vector> traction_changes(const std::vector<double>& a, int axis) const;

    BondMemory memory_;
    Tensor F_, P_, N_inverse_ = Tensor::Zero();
    /// dP by the numbers of F, column by column.
    Eigen::Matrix<double, Dim * Dim, Dim * Dim> C_;
    double mass_ = 1.0, volume_, c_;
    std::vector<Bond> bonds_;
};

extern template class BondedLattice<2>;
extern template class BondedLattice<3>;

/// Columns that span the triangular lattice whose rows lie along x.
Eigen::Matrix2d triangular_basis(double spacing = 1.0);

}  // namespace spam
