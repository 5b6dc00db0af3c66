// SPDX-License-Identifier: GPL-3.0-or-later
#include "section.hpp"

#include <spam/kernel/any_weight.hpp>

#include <Eigen/Dense>

#include <cmath>

namespace torsion {

double rigidity_of_columns(int n, spam::Kernel kernel, double range) {
    const auto weight = spam::weight_function<3>(to_string(kernel), range);
    const int reach = static_cast<int>(std::ceil(range));
    const Eigen::Index sites = static_cast<Eigen::Index>(n) * n;
    const auto at = [n](int i, int j) { return static_cast<Eigen::Index>(j) * n + i; };
    // Strains of all sites as linear functions of w: rows x then y; and without w.
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(2 * sites, sites);
    Eigen::VectorXd strain(2 * sites);
    double inertia = 0.0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const double x = i - 0.5 * (n - 1), y = j - 0.5 * (n - 1);
            inertia += x * x + y * y;
            Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
            Eigen::Vector2d mean = Eigen::Vector2d::Zero();
            std::vector<std::pair<Eigen::Index, Eigen::Vector3d>> gradients;
            for (int c = -reach; c <= reach; ++c)
                for (int b = std::max(-reach, -j); b <= std::min(reach, n - 1 - j); ++b)
                    for (int a = std::max(-reach, -i); a <= std::min(reach, n - 1 - i); ++a) {
                        const Eigen::Vector3d r(a, b, c);
                        if (r.isZero(0.0) || r.norm() >= range) continue;
                        const double slope = weight.minus_slope_over_r(r.norm());
                        A += slope * r * r.transpose();
                        mean += slope * c * c * Eigen::Vector2d(a, b);
                        gradients.emplace_back(at(i + a, j + b), slope * r);
                    }
            const Eigen::Matrix3d K = A.inverse();
            mean *= K(2, 2);  // the section is a plane of symmetry: K has no other part along z
            const Eigen::Index k = at(i, j);
            for (const auto& [site, gradient] : gradients) {
                const Eigen::Vector3d g = K * gradient;
                for (Eigen::Index d = 0; d < 2; ++d) {
                    D(d * sites + k, site) += g[d];
                    D(d * sites + k, k) -= g[d];
                }
            }
            strain[k] = -(y + mean[1]);
            strain[sites + k] = x + mean[0];
        }
    const Eigen::VectorXd w = D.completeOrthogonalDecomposition().solve(-strain);
    return (D * w + strain).squaredNorm() / inertia / (6.0 * rigidity_of_square);
}

}  // namespace torsion
