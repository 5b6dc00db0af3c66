// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/density_potentials.hpp>

#include <Eigen/Core>

#include <vector>

/// What holds a plane lattice of particles of mass one together under potentials of the density,
/// [HH07] 8: directions that cost nothing, directions in which it falls apart, elastic moduli. Where
/// the density law is at rest on the lattice, rho0 = site_density(), density, gradient and curvature
/// potentials are sums of squares that vanish on the triangular and the square lattice: nothing can be
/// negative there, and what is zero is a matter of symmetry.
namespace spam {

/// Two vectors a_1, a_2 (columns) that make a lattice, n_1 a_1 + n_2 a_2.
using LatticeVectors = Eigen::Matrix2d;

/// What particles of mass one sum to at a site, itself included: sum_R w(|R|). It is the rho0 of a law
/// that is at rest on the lattice, a little off one particle per area. Throws InputError for no range.
double site_density(const LatticeVectors& lattice, Kernel kernel, double range);

/// Answers of a lattice to uniform deformation, from its energy per area.
struct ElasticModuli {
    double pressure;  ///< -dE/dA
    double bulk;      ///< A d^2E/dA^2
    double shear;     ///< x e^s, y e^-s: E'' = 4 G A. (C11 - C12)/2 where there is no pressure
    double diagonal_shear;  ///< the same along the diagonals: C44. Equal to `shear` where isotropic
};

/// By differences of the energy of one particle of the infinite lattice, extrapolated: to about 1e-9
/// of the energy per area. Throws InputError as hessian() does.
ElasticModuli elastic_moduli(const DensityPotentials& potentials, const LatticeVectors& lattice);

/// Second derivatives of Phi, 2N x 2N in the order x_1, y_1, x_2, ..., particles of mass one at
/// `position` (2 x N), anywhere. By differences of the forces, extrapolated: to 1e-12 of the largest.
/// Throws InputError where nothing acts, the law is not cold, the weight function is not smooth enough
/// for a potential, or a periodic length of the box is not above twice the range.
Eigen::MatrixXd hessian(const DensityPotentials& potentials, const Points<2>& position,
                        const Box<2>& box);

/// Eigenvalues of a Hessian, ascending, and what they say of its lattice.
struct LatticeSpectrum {
    /// Eigenvalues nearer to zero than this part of the largest are zero. Differences leave less than
    /// 1e-13 (2e-13 where a shell of neighbours lies at the range); the others are above 1e-7 wherever
    /// counts are claimed, but gradients alone can leave less: `smallest_other` tells.
    static constexpr double threshold = 1e-11;

    std::vector<double> eigenvalue;
    int zero = 0;      ///< directions that cost nothing; two are translations
    int negative = 0;  ///< directions in which the lattice falls apart
    double largest_zero =
        0.0;  ///< of those called zero, the largest, in parts of the largest of all
    double smallest_other = 0.0;  ///< of the others, the smallest: the gap is between these two

    explicit LatticeSpectrum(const Eigen::MatrixXd& hessian);
};

}  // namespace spam
