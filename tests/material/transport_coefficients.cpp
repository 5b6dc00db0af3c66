// SPDX-License-Identifier: GPL-3.0-or-later
// Viscosity and conduction do what a second law allows: no stress in rigid rotation, heat made and
// never used up, the bulk viscosity that the text gives in each dimension.
#include <spam/material/fourier_conduction.hpp>
#include <spam/material/newton_viscosity.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace spam;

namespace {

template <int Dim>
Mat<Dim> random_gradient(std::mt19937_64& random) {
    std::normal_distribution<double> g;
    Mat<Dim> grad_v;
    for (double& x : grad_v.c) x = g(random);
    return grad_v;
}

template <int Dim>
double heating(const NewtonViscosity& law, const Mat<Dim>& grad_v) {
    const auto stress = law.viscous_stress(grad_v);
    double heat = 0.0;
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) heat += stress(a, b) * grad_v(a, b);
    return heat;
}

/// The least heat over many random flows: without a bulk viscosity it comes near zero, and below it
/// if that is negative.
template <int Dim>
double least_heating(const NewtonViscosity& law) {
    std::mt19937_64 random(7);
    double least = HUGE_VAL;
    for (int k = 0; k < 300; ++k) {
        Mat<Dim> grad_v = random_gradient<Dim>(random);
        if (k % 2 == 0)  // every other one a pure expansion
            for (int a = 0; a < Dim; ++a)
                for (int b = 0; b < Dim; ++b) grad_v(a, b) = a == b ? 1.0 : 0.0;
        least = std::min(least, heating(law, grad_v));
    }
    return least;
}

template <int Dim>
void check() {
    const NewtonViscosity law{0.3, 0.8};
    std::mt19937_64 random(5);
    for (int k = 0; k < 20; ++k) {
        Mat<Dim> grad_v = random_gradient<Dim>(random), spin;
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b) spin(a, b) = grad_v(a, b) - grad_v(b, a);
        const auto stress = law.viscous_stress(grad_v);
        double trace = 0.0;
        for (int a = 0; a < Dim; ++a) trace += stress(a, a);
        BOOST_TEST(std::abs(trace - Dim * law.bulk_viscosity(Dim) * grad_v.trace()) < 1e-13);
        for (const double s : law.viscous_stress(spin).c) BOOST_TEST(s == 0.0);
    }
    BOOST_TEST(least_heating<Dim>(law) > 0.0);
    BOOST_TEST(least_heating<Dim>(NewtonViscosity::shear_and_bulk(0.8, 0.0, Dim)) > -1e-13);
    BOOST_TEST(least_heating<Dim>(NewtonViscosity::shear_and_bulk(0.8, -0.01, Dim)) < -1e-3);
}

}  // namespace

BOOST_AUTO_TEST_CASE(newton_viscosity) {
    check<1>();
    check<2>();
    check<3>();
}

BOOST_AUTO_TEST_CASE(bulk_viscosity_as_printed) {
    const NewtonViscosity law{0.3, 0.6};
    BOOST_TEST(std::abs(law.bulk_viscosity(2) - 0.9) < 1e-15);
    BOOST_TEST(std::abs(law.bulk_viscosity(3) - 0.7) < 1e-15);
    BOOST_TEST(NewtonViscosity::shear_and_bulk(0.6, 0.0, 2).lambda == -0.6);
}

BOOST_AUTO_TEST_CASE(shear_flow) {
    Mat<2> grad_v;
    grad_v(1, 0) = 0.5;  // d v_x / d y
    const auto stress = NewtonViscosity{0.3, 0.8}.viscous_stress(grad_v);
    BOOST_TEST(std::abs(stress(0, 1) - 0.4) < 1e-15);
    BOOST_TEST(stress(0, 0) == 0.0);
}

BOOST_AUTO_TEST_CASE(heat_goes_from_warm_to_cold) {
    const Vec<3> grad_T{{1.0, -2.0, 0.5}};
    const auto Q = FourierConduction{0.7}.heat_flux(grad_T);
    BOOST_TEST(dot(Q, grad_T) < 0.0);
    BOOST_TEST(Q[1] == 1.4);
    BOOST_TEST(dot(FourierConduction{-0.7}.heat_flux(grad_T), grad_T) > 0.0);
}
