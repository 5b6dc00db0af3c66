// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/exact_sum.hpp>
#include <spam/core/rigid_motion.hpp>
#include <spam/external/rigid_velocity.hpp>

#include <Eigen/Eigenvalues>

#include <array>

namespace spam {
template <int Dim>
RigidVelocity<Dim> rigid_velocity_of(const std::vector<double>& mass,
                                     const ConstState<Dim>& state) {
    const auto x = state.position(), v = state.velocity();
    RigidVelocity<Dim> motion{mean_by_mass<Dim>(mass, x), mean_by_mass<Dim>(mass, v)};
    if constexpr (Dim == 2) {
        const auto [L, I] = exact_sums(mass.size(), [&](std::size_t k) {
            const auto i = static_cast<Eigen::Index>(k);
            const Point<2> r = x.col(i) - motion.R, w = v.col(i) - motion.V;
            return std::array<double, 2>{mass[k] * (r.x() * w.y() - r.y() * w.x()),
                                         mass[k] * r.squaredNorm()};
        });
        if (I > 0.0) motion.omega[0] = L / I;
    }
    if constexpr (Dim == 3) {
        const auto sums = exact_sums(mass.size(), [&](std::size_t k) {
            const auto i = static_cast<Eigen::Index>(k);
            const Point<3> r = x.col(i) - motion.R, w = v.col(i) - motion.V;
            std::array<double, 12> terms;
            Eigen::Map<Point<3>>(terms.data()) = mass[k] * r.cross(w);
            Eigen::Map<Eigen::Matrix3d>(terms.data() + 3) = mass[k] * r * r.transpose();
            return terms;
        });
        const Eigen::Map<const Point<3>> L(sums.data());
        const Eigen::Map<const Eigen::Matrix3d> moments(sums.data() + 3);
        const Eigen::Matrix3d inertia = moments.trace() * Eigen::Matrix3d::Identity() - moments;
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(inertia);
        const Point<3> along = axes.eigenvectors().transpose() * L;
        const double least = 1e-12 * axes.eigenvalues().cwiseAbs().maxCoeff();
        for (int k = 0; k < 3; ++k)
            if (axes.eigenvalues()[k] > least)
                motion.omega += along[k] / axes.eigenvalues()[k] * axes.eigenvectors().col(k);
    }
    return motion;
}

template RigidVelocity<1> rigid_velocity_of(const std::vector<double>&, const ConstState<1>&);
template RigidVelocity<2> rigid_velocity_of(const std::vector<double>&, const ConstState<2>&);
template RigidVelocity<3> rigid_velocity_of(const std::vector<double>&, const ConstState<3>&);

}  // namespace spam
