// SPDX-License-Identifier: GPL-3.0-or-later

#include "vibrations.hpp"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>

#include <cassert>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace spam {
namespace {

/// The memory of a symmetric matrix or of a vector, for GSL (which counts by rows).
gsl_matrix_view view(Eigen::MatrixXd& m) {
    return gsl_matrix_view_array(m.data(), static_cast<std::size_t>(m.cols()),
                                 static_cast<std::size_t>(m.rows()));
}
gsl_vector_view view(Eigen::VectorXd& v) {
    return gsl_vector_view_array(v.data(), static_cast<std::size_t>(v.size()));
}

}  // namespace

Vibrations vibrations(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
    const Eigen::Index n = stiffness.rows();
    assert(n > 0 && stiffness.cols() == n && mass.rows() == n && mass.cols() == n);
    Eigen::MatrixXd K = stiffness, M = mass, rows(n, n);  // K and M are overwritten
    Vibrations found{Eigen::VectorXd(n), {}};
    auto K_view = view(K), M_view = view(M), rows_view = view(rows);
    auto values_view = view(found.omega_squared);
    const std::unique_ptr<gsl_eigen_gensymmv_workspace, void (*)(gsl_eigen_gensymmv_workspace*)>
        workspace(gsl_eigen_gensymmv_alloc(static_cast<std::size_t>(n)), gsl_eigen_gensymmv_free);
    gsl_error_handler_t* const before = gsl_set_error_handler_off();  // it would abort
    const int status = gsl_eigen_gensymmv(&K_view.matrix, &M_view.matrix, &values_view.vector,
                                          &rows_view.matrix, workspace.get());
    gsl_set_error_handler(before);
    if (status != 0) throw std::domain_error("vibrations: the mass is not positive definite");
    found.shapes = rows.transpose();
    for (Eigen::Index k = 0; k < n; ++k)  // GSL's are of length 1
        found.shapes.col(k) /= std::sqrt(found.shapes.col(k).dot(mass * found.shapes.col(k)));
    return found;
}

}  // namespace spam
