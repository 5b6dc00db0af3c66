// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace spam {

/// Free vibrations of M q_ddot = -K q: K shape = omega^2 M shape, shape^T M shape = 1.
struct Vibrations {
    Eigen::VectorXd omega_squared;  ///< in no order; those of rigid motions are 0 up to rounding
    Eigen::MatrixXd shapes;         ///< columns
};

/// K and M are symmetric, n x n, M positive definite; std::domain_error if it is not. By GSL, whose
/// solver is compiled already: Eigen's takes as long as four problems.
Vibrations vibrations(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

}  // namespace spam
