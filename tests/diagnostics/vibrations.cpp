// SPDX-License-Identifier: GPL-3.0-or-later
// Free vibrations: a chain whose frequencies are known, what defines modes, and a mass that is none.

#include "sheared_square/vibrations.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

using namespace spam;

namespace {

/// Springs of a free chain of n masses.
Eigen::MatrixXd chain(Eigen::Index n) {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
        K(i, i) += 1.0;
        K(i + 1, i + 1) += 1.0;
        K(i, i + 1) = K(i + 1, i) = -1.0;
    }
    return K;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_chain_has_the_frequencies_of_standing_waves) {
    constexpr Eigen::Index n = 7;
    const auto found = vibrations(chain(n), 0.25 * Eigen::MatrixXd::Identity(n, n));
    std::vector<double> squared(found.omega_squared.begin(), found.omega_squared.end());
    std::sort(squared.begin(), squared.end());
    for (std::size_t k = 0; k < squared.size(); ++k) {  // 2 sqrt(K/m) sin(k pi / 2 n)
        const double omega = 4.0 * std::sin(0.5 * static_cast<double>(k) * std::numbers::pi /
                                            static_cast<double>(n));
        BOOST_TEST(std::abs(squared[k] - omega * omega) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(shapes_solve_the_equations_and_are_orthonormal_by_mass) {
    constexpr Eigen::Index n = 6;
    const Eigen::MatrixXd K = chain(n);
    Eigen::MatrixXd M = chain(n) + Eigen::MatrixXd::Identity(n, n);
    M(0, 0) += 3.0;  // no symmetry left
    const auto off = [&](const Vibrations& found, const Eigen::MatrixXd& mass) {
        const Eigen::MatrixXd norms = found.shapes.transpose() * mass * found.shapes;
        const Eigen::MatrixXd residual =
            K * found.shapes - mass * found.shapes * found.omega_squared.asDiagonal();
        return std::max((norms - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(),
                        residual.cwiseAbs().maxCoeff());
    };
    BOOST_TEST(off(vibrations(K, M), M) < 1e-12);
    // A law that breaks it: the mass of another body.
    BOOST_TEST(off(vibrations(K, Eigen::MatrixXd::Identity(n, n)), M) > 0.1);
}

BOOST_AUTO_TEST_CASE(a_mass_that_is_not_positive_is_refused) {
    BOOST_CHECK_THROW(vibrations(chain(3), -Eigen::MatrixXd::Identity(3, 3)), std::domain_error);
}
