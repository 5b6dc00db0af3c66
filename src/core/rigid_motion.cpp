// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/rigid_motion.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>

namespace spam {

template <int Dim>
RigidMotion<Dim> best_translation(const Eigen::Ref<const Points<Dim>>& from,
                                  const Eigen::Ref<const Points<Dim>>& to) {
    RigidMotion<Dim> motion;
    motion.from = from.rowwise().mean();
    motion.to = to.rowwise().mean();
    return motion;
}

template <int Dim>
RigidMotion<Dim> best_rigid_motion(const Eigen::Ref<const Points<Dim>>& from,
                                   const Eigen::Ref<const Points<Dim>>& to) {
    using Matrix = Eigen::Matrix<double, Dim, Dim>;
    RigidMotion<Dim> motion = best_translation<Dim>(from, to);
    Matrix correlation = Matrix::Zero();
    for (Eigen::Index i = 0; i < from.cols(); ++i)
        correlation += (to.col(i) - motion.to) * (from.col(i) - motion.from).transpose();
    const Eigen::JacobiSVD<Matrix> svd(correlation, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Matrix u = svd.matrixU(), v = svd.matrixV();
    Matrix flip = Matrix::Identity();
    if ((u * v.transpose()).determinant() < 0.0) flip(Dim - 1, Dim - 1) = -1.0;
    motion.rotation = u * flip * v.transpose();
    return motion;
}

template RigidMotion<1> best_translation(const Eigen::Ref<const Points<1>>&,
                                         const Eigen::Ref<const Points<1>>&);
template RigidMotion<2> best_translation(const Eigen::Ref<const Points<2>>&,
                                         const Eigen::Ref<const Points<2>>&);
template RigidMotion<3> best_translation(const Eigen::Ref<const Points<3>>&,
                                         const Eigen::Ref<const Points<3>>&);
template RigidMotion<1> best_rigid_motion(const Eigen::Ref<const Points<1>>&,
                                          const Eigen::Ref<const Points<1>>&);
template RigidMotion<2> best_rigid_motion(const Eigen::Ref<const Points<2>>&,
                                          const Eigen::Ref<const Points<2>>&);
template RigidMotion<3> best_rigid_motion(const Eigen::Ref<const Points<3>>&,
                                          const Eigen::Ref<const Points<3>>&);

}  // namespace spam
