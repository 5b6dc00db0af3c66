// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/physics/gauss_constraint.hpp>

#include <Eigen/QR>

namespace spam {

GaussMultipliersOf<Vec<3>> gauss_multipliers(const SymTensor<3>& I, const Vec<3>& L, double twice_K,
                                             const Vec<3>& L_dot) {
    GaussMultipliersOf<Vec<3>> m;
    if (!(I(0, 0) + I(1, 1) + I(2, 2) > 0.0) || !(twice_K > 0.0)) return m;
    Eigen::Matrix3d inertia;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) inertia(a, b) = I(a, b);
    // The least solution, where a straight body's inertia has no inverse.
    const Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> inverse(inertia);
    const Eigen::Vector3d l(L[0], L[1], L[2]), l_dot(L_dot[0], L_dot[1], L_dot[2]);
    const Eigen::Vector3d omega = inverse.solve(l), change = inverse.solve(l_dot);
    m.health = 1.0 - l.dot(omega) / twice_K;
    // (I - L L^t/2K)^-1 by Sherman and Morrison.
    const Eigen::Vector3d beta = -(change + omega * (omega.dot(l_dot) / (twice_K * m.health)));
    m.alpha = beta.dot(l) / twice_K;
    m.singular = !(m.health > 0.0) || !(std::abs(m.alpha) <= omega.norm());
    if (m.singular)
        m.alpha = 0.0;
    else
        m.beta = {{beta[0], beta[1], beta[2]}};
    return m;
}

}  // namespace spam
