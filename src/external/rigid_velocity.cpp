// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/sums.hpp>
#include <spam/external/rigid_velocity.hpp>

#include <Eigen/Eigenvalues>

#include <array>

namespace spam {
namespace {

template <int Dim, class View>
Point<Dim> mean(const std::vector<double>& mass, const View& values) {
    CompensatedSum m;
    std::array<CompensatedSum, Dim> sum;
    for (Eigen::Index i = 0; i < values.cols(); ++i) {
        const double m_i = mass[static_cast<std::size_t>(i)];
        m += m_i;
        for (int a = 0; a < Dim; ++a) sum[static_cast<std::size_t>(a)] += m_i * values(a, i);
    }
    Point<Dim> result;
    for (int a = 0; a < Dim; ++a)
        result[a] = sum[static_cast<std::size_t>(a)] / static_cast<double>(m);
    return result;
}

}  // namespace

template <int Dim>
RigidVelocity<Dim> rigid_velocity_of(const std::vector<double>& mass,
                                     const ConstState<Dim>& state) {
    const auto x = state.position(), v = state.velocity();
    RigidVelocity<Dim> motion{mean<Dim>(mass, x), mean<Dim>(mass, v)};
    if constexpr (Dim == 2) {
        CompensatedSum L, I;
        for (Eigen::Index i = 0; i < x.cols(); ++i) {
            const double m = mass[static_cast<std::size_t>(i)];
            const Point<2> r = x.col(i) - motion.R, w = v.col(i) - motion.V;
            L += m * (r.x() * w.y() - r.y() * w.x());
            I += m * r.squaredNorm();
        }
        if (I > 0.0) motion.omega[0] = L / I;
    }
    if constexpr (Dim == 3) {
        std::array<CompensatedSum, 3> L;
        std::array<CompensatedSum, 9> rr;
        for (Eigen::Index i = 0; i < x.cols(); ++i) {
            const double m = mass[static_cast<std::size_t>(i)];
            const Point<3> r = x.col(i) - motion.R, w = v.col(i) - motion.V, l = r.cross(w);
            for (std::size_t a = 0; a < 3; ++a) {
                const auto row = static_cast<int>(a);
                L[a] += m * l[row];
                for (int b = 0; b < 3; ++b)
                    rr[3 * a + static_cast<std::size_t>(b)] += m * r[row] * r[b];
            }
        }
        Eigen::Matrix3d moments;
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) moments(a, b) = rr[static_cast<std::size_t>(3 * a + b)];
        const Eigen::Matrix3d inertia = moments.trace() * Eigen::Matrix3d::Identity() - moments;
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(inertia);
        const Point<3> along = axes.eigenvectors().transpose() * Point<3>(L[0], L[1], L[2]);
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
