// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/exact_sum.hpp>
#include <spam/core/parts.hpp>
#include <spam/core/rigid_motion.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>

namespace spam {

template <int Dim>
Point<Dim> mean_by_mass(std::span<const double> mass, const Eigen::Ref<const Points<Dim>>& values) {
    const auto sums = exact_sums(mass.size(), [&](std::size_t i) {
        std::array<double, Dim + 1> terms;
        Eigen::Map<Point<Dim>>(terms.data()) = mass[i] * values.col(static_cast<Eigen::Index>(i));
        terms[Dim] = mass[i];
        return terms;
    });
    return Eigen::Map<const Point<Dim>>(sums.data()) / sums[Dim];
}

template <int Dim>
RigidMotion<Dim> best_translation(const Eigen::Ref<const Points<Dim>>& from,
                                  const Eigen::Ref<const Points<Dim>>& to) {
    const auto sums = exact_sums(static_cast<std::size_t>(from.cols()), [&](std::size_t i) {
        std::array<double, 2 * Dim> terms;
        Eigen::Map<Point<Dim>>(terms.data()) = from.col(static_cast<Eigen::Index>(i));
        Eigen::Map<Point<Dim>>(terms.data() + Dim) = to.col(static_cast<Eigen::Index>(i));
        return terms;
    });
    const auto n = static_cast<double>(Parts::here().total(static_cast<std::size_t>(from.cols())));
    RigidMotion<Dim> motion;
    motion.from = Eigen::Map<const Point<Dim>>(sums.data()) / n;
    motion.to = Eigen::Map<const Point<Dim>>(sums.data() + Dim) / n;
    return motion;
}

template <int Dim>
RigidMotion<Dim> best_rigid_motion(const Eigen::Ref<const Points<Dim>>& from,
                                   const Eigen::Ref<const Points<Dim>>& to) {
    using Matrix = Eigen::Matrix<double, Dim, Dim>;
    RigidMotion<Dim> motion = best_translation<Dim>(from, to);
    const auto sums = exact_sums(static_cast<std::size_t>(from.cols()), [&](std::size_t k) {
        const auto i = static_cast<Eigen::Index>(k);
        std::array<double, Dim * Dim> terms;
        Eigen::Map<Matrix>(terms.data()) =
            (to.col(i) - motion.to) * (from.col(i) - motion.from).transpose();
        return terms;
    });
    const Eigen::Map<const Matrix> correlation(sums.data());
    const Eigen::JacobiSVD<Matrix> svd(correlation, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Matrix u = svd.matrixU(), v = svd.matrixV();
    Matrix flip = Matrix::Identity();
    if ((u * v.transpose()).determinant() < 0.0) flip(Dim - 1, Dim - 1) = -1.0;
    motion.rotation = u * flip * v.transpose();
    return motion;
}

#define SPAM_INSTANTIATE(D)                                                                      \
    template Point<D> mean_by_mass(std::span<const double>, const Eigen::Ref<const Points<D>>&); \
    template RigidMotion<D> best_translation(const Eigen::Ref<const Points<D>>&,                 \
                                             const Eigen::Ref<const Points<D>>&);                \
    template RigidMotion<D> best_rigid_motion(const Eigen::Ref<const Points<D>>&,                \
                                              const Eigen::Ref<const Points<D>>&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
