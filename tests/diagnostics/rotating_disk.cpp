// SPDX-License-Identifier: GPL-3.0-or-later
// The rotating disk of [HHM04] VI: its displacement has its stresses, these are in balance with the
// rotation, and the rim is free. The displacement printed there fails.
#include "rotating_disk/rotating_disk.hpp"

#include <spam/material/elastic_solid.hpp>

#include <boost/test/unit_test.hpp>

#include <functional>

using namespace spam;

namespace {

const RotatingDisk disk{1.3, 0.7, 0.02, 9.0};
using Displacement = std::function<double(double)>;

double slope(const Displacement& u, double r) { return (u(r + 1e-4) - u(r - 1e-4)) / 2e-4; }

/// sigma_rr and sigma_tt of an axially symmetric displacement, by the material's own law.
std::pair<double, double> stresses(const Displacement& u, double r) {
    Mat<2> grad;
    grad(0, 0) = slope(u, r);
    grad(1, 1) = u(r) / r;
    const auto sigma =
        ElasticSolid{disk.eta, disk.eta}.stress_rate(grad, SymTensor<2>{});  // lambda = eta
    return {sigma(0, 0), sigma(1, 1)};
}

/// Largest difference from the analytic stresses, over the stress at the centre.
double mismatch(const Displacement& u) {
    double worst = 0.0;
    for (double r = 0.5; r <= disk.R; r += 0.5) {
        const auto [radial, hoop] = stresses(u, r);
        worst = std::max({worst, std::abs(radial - disk.radial_stress(r)),
                          std::abs(hoop - disk.hoop_stress(r))});
    }
    return worst / disk.centre_stress();
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_displacement_has_the_stresses) {
    BOOST_TEST(mismatch([](double r) { return disk.displacement(r); }) < 1e-7);
}

BOOST_AUTO_TEST_CASE(the_printed_displacement_has_others) {
    const Displacement printed = [](double r) {
        return disk.load() * r / 6.0 * (disk.R * disk.R - 2.0 * r * r / 3.0);
    };
    BOOST_TEST(mismatch(printed) > 0.1);
    BOOST_TEST(mismatch([&](double r) { return printed(r) / disk.eta; }) > 0.1);
    const auto [radial, hoop] = stresses([&](double r) { return printed(r) / disk.eta; }, disk.R);
    BOOST_TEST(radial < -0.5 * disk.centre_stress());  // pressed at its rim, by nothing
}

BOOST_AUTO_TEST_CASE(stress_holds_the_centrifugal_force) {
    const auto radial = [](double r) { return disk.radial_stress(r); };
    for (double r = 0.5; r <= disk.R; r += 0.5) {
        const double divergence =
            slope(radial, r) + (disk.radial_stress(r) - disk.hoop_stress(r)) / r;
        BOOST_TEST(divergence == -disk.load() * r, boost::test_tools::tolerance(1e-7));
    }
    BOOST_TEST(disk.radial_stress(disk.R) == 0.0);
}

BOOST_AUTO_TEST_CASE(density_follows_the_displacement) {
    const auto u = [](double r) { return disk.displacement(r); };
    for (const double r : {0.5, 4.0, 9.0})
        BOOST_TEST(disk.density(r) == disk.rho * (1.0 - slope(u, r) - u(r) / r),
                   boost::test_tools::tolerance(1e-9));
}
