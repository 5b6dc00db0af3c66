// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex_modes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace spam {

ComplexModes complex_modes(const Eigen::MatrixXcd& matrix) {
    const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(matrix);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXcd ComplexModes::shares(const Eigen::VectorXcd& v) const {
    return vectors.partialPivLu().solve(v);
}

Eigen::VectorXd solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
    return matrix.partialPivLu().solve(right);
}

}  // namespace spam
