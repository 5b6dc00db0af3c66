// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/analysis/lattice_modes.hpp>

namespace spam {

/// What the linear analysis says of [HHM04] Fig. 1: of a periodic lattice at rest, one particle
/// starts with a small velocity v0. All wave vectors of the sample get the same share, and
///     K(t) = m/(2N) sum_k |cosh(sqrt(M(k)) t) v0|^2,    v_ddot = M(k) v,
/// until the disturbance is no longer small. In the end the fastest growing waves are left, but that
/// takes long: many wave vectors of a large sample grow almost as fast.
template <int Dim>
class KickedLattice {
  public:
    /// `k`: the sample's wave vectors, Dim x N (allowed_wave_vectors()).
    KickedLattice(const LatticeModes<Dim>& modes, const Points<Dim>& k, double mass,
                  const Point<Dim>& v0);

    double kinetic(double t) const;
    /// d ln K / dt: tends to twice the fastest growth rate.
    double kinetic_rate(double t) const;

    double fastest_rate() const { return fastest_rate_; }  ///< of amplitudes
    const Point<Dim>& fastest() const { return fastest_; }

  private:
    struct Wave {
        Eigen::MatrixXcd shape;   ///< eigenvectors of M, times the share of v0 in each
        Eigen::VectorXcd lambda;  ///< square roots of its eigenvalues
    };
    double mass_;
    std::vector<Wave> waves_;
    double fastest_rate_ = 0.0;
    Point<Dim> fastest_ = Point<Dim>::Zero();
};

SPAM_COMPILED(extern template class KickedLattice);

}  // namespace spam
