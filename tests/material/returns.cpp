// SPDX-License-Identifier: GPL-3.0-or-later
// Returns to von Mises' surfaces against the closest point, found by Newton's method in all six components
// without knowing what they simplify to.
#include <spam/material/plane_stress_return.hpp>
#include <spam/material/von_mises.hpp>

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include <random>
#include <vector>

using namespace spam;
namespace {

constexpr double lambda = 0.7, eta = 0.4, Y = 0.02;

/// Stress as xx, yy, zz, xy, yz, xz, of which `free` may differ from 0; C^-1 and the form q^2 = s^t M s of
/// isotropic elasticity and von Mises, in `directions` dimensions.
struct Projection {
    std::vector<int> free;
    int directions;
    double H = 0.0;
    using Voigt = Eigen::Matrix<double, 6, 1>;
    using Form = Eigen::Matrix<double, 6, 6>;

    Form compliance() const {
        Form C = Form::Zero();
        for (int a = 0; a < 6; ++a) C(a, a) = a < 3 ? 2.0 * eta : eta;
        for (int a = 0; a < directions; ++a)
            for (int b = 0; b < directions; ++b) C(a, b) += lambda;
        return C.inverse();
    }
    Form square() const {
        Form M = Form::Zero();
        if (directions == 2) {  // (sxx - syy)^2 + 4 sxy^2
            M(0, 0) = M(1, 1) = 1.0;
            M(0, 1) = M(1, 0) = -1.0;
            M(3, 3) = 4.0;
            return M;
        }
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) M(a, b) = a == b ? 1.0 : -0.5;
        for (int a = 3; a < 6; ++a) M(a, a) = 3.0;
        return M;
    }
    double q(const Voigt& s) const { return std::sqrt(s.dot(square() * s)); }

    /// Newton's method for C^-1 (s - trial) + g dq/ds = 0, q = Y + H g, in the free components.
    std::pair<Voigt, double> closest(const Voigt& trial) const {
        const auto n = static_cast<Eigen::Index>(free.size());
        const Form C = compliance(), M = square();
        Voigt s = trial * (Y / q(trial));
        double g = 0.0;
        for (int k = 0; k < 200; ++k) {
            const Voigt slope = M * s / q(s);
            const Voigt left = C * (s - trial) + g * slope;
            const Form bend = C + g * (M - slope * slope.transpose()) / q(s);
            Eigen::MatrixXd J(n + 1, n + 1);
            Eigen::VectorXd r(n + 1);
            for (Eigen::Index a = 0; a < n; ++a) {
                const int i = free[static_cast<std::size_t>(a)];
                r[a] = left[i];
                for (Eigen::Index b = 0; b < n; ++b)
                    J(a, b) = bend(i, free[static_cast<std::size_t>(b)]);
                J(a, n) = J(n, a) = slope[i];
            }
            J(n, n) = -H;
            r[n] = q(s) - Y - H * g;
            const Eigen::VectorXd step = J.fullPivLu().solve(r);
            for (Eigen::Index a = 0; a < n; ++a) s[free[static_cast<std::size_t>(a)]] -= step[a];
            g -= step[n];
        }
        return {s, g};
    }
};

template <int Dim>
Projection::Voigt voigt(const SymTensor<Dim>& s, double zz) {
    Projection::Voigt v = Projection::Voigt::Zero();
    for (int a = 0; a < Dim; ++a) v[a] = s(a, a);
    v[3] = s(0, 1);
    if constexpr (Dim == 3) {
        v[4] = s(1, 2);
        v[5] = s(0, 2);
    } else {
        v[2] = zz;
    }
    return v;
}

template <class Surface>
void check_returns(const Surface& surface, const Projection& projection) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0.0, 0.05);
    int outside = 0;
    for (int k = 0; k < 200; ++k) {
        SymTensor<Surface::dim> trial;
        for (double& component : trial.c) component = normal(random);
        const double zz = Surface::across ? normal(random) : 0.0;
        const auto v = voigt(trial, zz);
        const auto found = surface.returned(trial, zz, projection.H,
                                            [&](double d, double) { return Y + projection.H * d; });
        if (projection.q(v) <= Y) {
            BOOST_TEST((found.stress.c == trial.c && found.strain == 0.0));
            continue;
        }
        ++outside;
        const auto closest = projection.closest(v);
        BOOST_TEST((voigt(found.stress, found.zz) - closest.first).norm() < 1e-12);
        BOOST_TEST(std::abs(found.strain - closest.second) < 1e-11);
        // ... and no other point of the surface nearby is closer.
        const auto distance = [&](const Projection::Voigt& s) {
            return (s - v).dot(projection.compliance() * (s - v));
        };
        if (projection.H > 0.0) continue;
        for (int m = 0; m < 20; ++m) {
            auto other = closest.first;
            for (const int i : projection.free) other[i] += 0.02 * normal(random);
            if (projection.q(other) > Y) other *= Y / projection.q(other);
            BOOST_TEST(distance(other) >= distance(voigt(found.stress, found.zz)) * (1.0 - 1e-12));
        }
    }
    BOOST_TEST(outside > 100);
}

const PlaneVonMises plane{lambda, eta};
const PlaneStrainVonMises plane_strain{lambda, eta};
const PlaneStressVonMises stress{lambda, eta};
const SpaceVonMises space{lambda, eta};

}  // namespace

BOOST_AUTO_TEST_CASE(returns_are_closest_points) {
    for (const double H : {0.0, 0.3}) {
        check_returns(plane, {{0, 1, 3}, 2, H});
        check_returns(plane_strain, {{0, 1, 2, 3}, 3, H});
        check_returns(stress, {{0, 1, 3}, 3, H});
        check_returns(space, {{0, 1, 2, 3, 4, 5}, 3, H});
    }
}

/// What roots are found for, where the yield stress is not linear: a linear one gives the same.
BOOST_AUTO_TEST_CASE(a_yield_stress_that_is_not_linear_is_met) {
    SymTensor<3> trial;
    trial.c = {0.09, -0.02, 0.01, 0.03, -0.01, 0.02};
    const double nan = std::nan("");
    const auto linear = [](double d, double) { return Y + 0.3 * d; };
    const auto exact = space.returned(trial, 0.0, 0.3, linear);
    const auto searched = space.returned(trial, 0.0, nan, linear);
    BOOST_TEST(std::abs(exact.strain - searched.strain) < 1e-15);
    const auto curved = [](double d, double energy) { return Y * (1.0 + std::sqrt(d)) - energy; };
    const auto found = space.returned(trial, 0.0, nan, curved);
    const auto p = SpaceVonMises::parts(found.stress, 0.0);
    BOOST_TEST(found.strain > 0.0);
    BOOST_TEST(std::abs(p.q - curved(found.strain, space.elastic_energy(p.mean, p.q))) < 1e-15);
}

/// Many at once, with a rest that fills no register; those that do not yield keep every bit.
BOOST_AUTO_TEST_CASE(blocks_return_as_particles_do) {
    constexpr std::size_t count = 77;
    for (const double H : {0.0, 0.3}) {
        const LinearHardening flow{Y, H};
        std::mt19937 random(11);
        std::normal_distribution<double> normal(0.0, 0.02);
        std::vector<double> strain(count), trial(3 * count), returned(3 * count);
        for (double& x : strain) x = std::abs(normal(random));
        for (double& x : trial) x = normal(random);
        return_plane_stress(stress, flow, count, strain.data(), trial.data(), returned.data());
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const SymTensor<2> one{{trial[3 * i], trial[3 * i + 1], trial[3 * i + 2]}};
            const auto alone = stress.returned(
                one, 0.0, H, [&](double d, double) { return flow.yield_stress({strain[i] + d}); });
            kept += alone.strain == 0.0 ? 1 : 0;
            for (std::size_t c = 0; c < 3; ++c)
                if (alone.strain == 0.0)
                    BOOST_TEST(returned[3 * i + c] == trial[3 * i + c]);
                else
                    BOOST_TEST(std::abs(returned[3 * i + c] - alone.stress.c[c]) < 1e-16);
        }
        BOOST_TEST(kept > 5U);
        BOOST_TEST(kept < count - 20U);
    }
}
