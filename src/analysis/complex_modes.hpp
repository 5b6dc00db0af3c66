// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace spam {

/// Eigenvalues and right eigenvectors (columns of length one) of a square complex matrix. In a file of
/// its own because Eigen's solver takes long to compile.
struct ComplexModes {
    Eigen::VectorXcd values;
    Eigen::MatrixXcd vectors;

    /// The shares of the vectors in v.
    Eigen::VectorXcd shares(const Eigen::VectorXcd& v) const;
};
ComplexModes complex_modes(const Eigen::MatrixXcd& matrix);

/// Of matrix x = right: here for the same reason.
Eigen::VectorXd solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

}  // namespace spam
