// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of solids that yield and break, by themselves: stresses along prescribed ways of deformation against
// exact answers.
#include "support/refusal.hpp"
#include <spam/analysis/material_point.hpp>
#include <spam/material/johnson_cook.hpp>
#include <spam/material/perzyna.hpp>
#include <spam/material/smooth_yield.hpp>
#include <spam/material/yielding_solid.hpp>

#include <boost/test/unit_test.hpp>

#include <numbers>

using namespace spam;
using spam::test::refusal;
namespace {

constexpr double lambda = 0.7, eta = 0.4, Y = 0.02;
constexpr double pi = std::numbers::pi;

const PlaneVonMises plane{lambda, eta};
const PlaneStressVonMises stress{lambda, eta};
const SpaceVonMises space{lambda, eta};

IntegratorOptions rk4(double dt) {
    IntegratorOptions options;
    options.dt = dt;
    return options;
}

template <int Dim>
Mat<Dim> gradient(std::initializer_list<double> rows) {
    Mat<Dim> g;
    std::copy(rows.begin(), rows.end(), g.c.begin());
    return g;
}

}  // namespace

/// A bar in plane stress or in space that is drawn at a fixed rate, sideways as it likes.
BOOST_AUTO_TEST_CASE(uniaxial_tension_follows_young_and_then_the_hardening) {
    const double E = eta * (3.0 * lambda + 2.0 * eta) / (lambda + eta);
    const double nu = lambda / (2.0 * (lambda + eta)), H = 0.1, rate = 1e-3;
    const double first = Y / E / rate;
    const YieldingSolid<PlaneStressVonMises> solid(stress, LinearHardening{Y, H});
    const auto drawn = [&](double t) {
        const double part = t < first ? nu : (nu * H + 0.5 * E) / (E + H);  // of the yielding bar
        return gradient<2>({rate, 0.0, 0.0, -part * rate});
    };
    const double dt =
        first / 4096.0;  // at the change of rate one stage of a step has the wrong one
    MaterialPoint<2> point(solid, drawn, rk4(dt));
    point.advance_to(first);
    BOOST_TEST(std::abs(point.stress()(0, 0) - Y) < 2e-7);
    BOOST_TEST(std::abs(point.stress()(1, 1)) < 2e-7);
    point.advance_to(10.0 * first);
    // E H/(E + H) is the slope beyond first yield; of the strain E/(E + H) is plastic.
    const double more = 9.0 * first * rate;
    BOOST_TEST(std::abs(point.stress()(0, 0) - Y - more * E * H / (E + H)) < 2e-9);
    BOOST_TEST(std::abs(point.stress()(1, 1)) < 2e-9);
    BOOST_TEST(std::abs(point.value(field_kind::plastic_strain) - more * E / (E + H)) < 1e-8);
}

/// In simple shear at rate 1, v_x = y, the deviator Y/2 (sin phi, cos phi) of (d, xy) on the surface turns by
/// d phi/dt = 1 - (2 eta/Y) sin phi: from pure shear to where sin phi = Y/(2 eta).
BOOST_AUTO_TEST_CASE(simple_shear_turns_the_deviator_to_its_place) {
    const YieldingSolid<PlaneVonMises> solid(plane, LinearHardening{Y});
    const auto shear = [](double) { return gradient<2>({0.0, 0.0, 1.0, 0.0}); };
    MaterialPoint<2> point(solid, shear, rk4(1e-3));
    point.advance_to(1.0);
    const SymTensor<2> s = point.stress();
    const double phi = std::asin(Y / (2.0 * eta));
    BOOST_TEST(std::abs(0.5 * (s(0, 0) - s(1, 1)) - 0.5 * Y * std::sin(phi)) < 1e-7);
    BOOST_TEST(std::abs(s(0, 1) - 0.5 * Y * std::cos(phi)) < 1e-7);
    BOOST_TEST(std::abs(s(0, 0) + s(1, 1)) < 1e-15);
    // All work is stress times strain: what is not elastic is Y eps_p.
    const double stored = Y * Y / (8.0 * eta);
    BOOST_TEST(std::abs(point.energy() - stored - Y * point.value(field_kind::plastic_strain)) <
               1e-4 * point.energy());
}

/// A square in the plane of strains (d, xy), back to its beginning: on each side the angle theta between
/// deviator and strain rate falls by tan(theta/2) -> tan(theta/2) exp(-(4 eta/Y) strain), strain = |(d, xy)|.
BOOST_AUTO_TEST_CASE(a_closed_path_of_strain_ends_where_it_should) {
    const double side = 0.05;
    const auto path = [&](double t) {
        const int k = std::min(static_cast<int>(t), 3);
        const double d[] = {side, 0.0, -side, 0.0}, xy[] = {0.0, side, 0.0, -side};
        return gradient<2>({d[k], xy[k], xy[k], -d[k]});
    };
    // From 0 along d until it yields, then from corner to corner.
    double angle = 0.0;  // of the deviator, in the plane (d, xy)
    for (int k = 1; k < 4; ++k) {
        const double along = 0.5 * pi * k;
        double theta = std::remainder(angle - along, 2.0 * pi);
        theta = 2.0 * std::atan(std::tan(0.5 * theta) * std::exp(-4.0 * eta / Y * side));
        angle = along + theta;
    }
    const auto error = [&](const Material<2>& solid, double dt) {
        MaterialPoint<2> point(solid, path, rk4(dt));
        point.advance_to(4.0);
        const SymTensor<2> s = point.stress();
        return std::hypot(0.5 * (s(0, 0) - s(1, 1)) - 0.5 * Y * std::cos(angle),
                          s(0, 1) - 0.5 * Y * std::sin(angle)) /
               Y;
    };
    const YieldingSolid<PlaneVonMises> solid(plane, LinearHardening{Y});
    const double coarse = error(solid, 1.0 / 256.0), fine = error(solid, 1.0 / 512.0);
    BOOST_TEST(fine < 2e-2);
    BOOST_TEST(std::abs(std::log2(coarse / fine) - 1.0) < 0.15);
    BOOST_TEST(error(solid, 1.0 / 65536.0) < 2e-4);
    BOOST_TEST(error(SmoothYield<PlaneVonMises>(plane, LinearHardening{Y}, 1e-3), 1.0 / 65536.0) <
               2e-3);
}

/// An excess at fixed strain decays with the time tau.
BOOST_AUTO_TEST_CASE(perzynas_excess_decays) {
    const double tau = 0.5;
    const YieldingSolid<PlaneVonMises, Perzyna> solid(plane, {{Y}, tau});
    const auto sheared = [](double t) {
        return t < 1.0 ? gradient<2>({0.0, 0.05, 0.05, 0.0}) : Mat<2>{};
    };
    MaterialPoint<2> point(solid, sheared, rk4(1.0 / 1024.0));
    const auto excess = [&] { return 2.0 * point.stress()(0, 1) - Y; };
    point.advance_to(1.0);
    const double first = excess();
    // Steady flow at rate q_dot/(4 eta) = 2 D_xy/2: q - Y = 4 eta tau 0.05.
    const double steady = 4.0 * eta * tau * 0.05;
    BOOST_TEST(std::abs(first - steady * (1.0 - std::exp(-(1.0 - Y / (0.2 * eta)) / tau))) <
               1e-3 * steady);
    point.advance_to(1.0 + tau);
    BOOST_TEST(std::abs(excess() / first - std::exp(-1.0)) < 1e-3);
}

BOOST_AUTO_TEST_CASE(johnson_cook_is_harder_when_fast_and_softer_when_hot) {
    JohnsonCook law{Y, 0.02, 0.3, 0.05, 1e-3, 1.0, 0.0, 1.0, 0.05, 1.0};
    const auto drawn = [&](double rate, double heat_capacity) {
        law.heat_capacity = heat_capacity;
        const YieldingSolid<SpaceVonMises, JohnsonCook> solid(space, law);
        MaterialPoint<3> point(
            solid,
            [rate](double) {
                Mat<3> g;
                g(0, 0) = rate;
                g(1, 1) = g(2, 2) = -0.5 * rate;
                return g;
            },
            rk4(0.5e-3 / rate));
        point.advance_to(0.5 / rate);
        const double flowed = point.value(field_kind::plastic_strain);
        const double q = SpaceVonMises::parts(point.stress(), 0.0).q;
        const double T = (point.energy() - space.elastic_energy(0.0, q)) / heat_capacity;
        // At constant rate of deformation the rate of plastic strain is that of the way, nearly.
        BOOST_TEST(std::abs(q - law.yield_stress({flowed, rate, T})) < 2e-3 * q);
        BOOST_TEST(std::abs(flowed - 0.5) < 0.05);
        return q;
    };
    const double slow = drawn(1e-4, 1e9), fast = drawn(1.0, 1e9), hot = drawn(1e-4, 0.1);
    BOOST_TEST(std::abs(fast / slow - (1.0 + 0.05 * std::log(1e3))) < 5e-3);
    BOOST_TEST(hot < 0.9 * slow);
}

/// In plane strain an incompressible solid is drawn at 2 Y/sqrt(3).
BOOST_AUTO_TEST_CASE(plane_strain_knows_the_stress_across) {
    const PlaneStrainVonMises stiff{1e3, eta};
    const YieldingSolid<PlaneStrainVonMises> solid(stiff, LinearHardening{Y});
    MaterialPoint<2> point(
        solid,
        [](double) {
            return gradient<2>({0.1, 0.0, 0.0, -0.1});
        },
        rk4(1e-2));
    point.advance_to(2.0);
    const SymTensor<2> s = point.stress();
    BOOST_TEST(std::abs(s(0, 0) - s(1, 1) - 2.0 * Y / std::sqrt(3.0)) < 1e-10);
    BOOST_TEST(std::abs(point.value(field_kind::stress_zz) - 0.5 * (s(0, 0) + s(1, 1))) < 1e-10);
}

BOOST_AUTO_TEST_CASE(order_of_the_forms_where_the_strain_rate_turns) {
    const auto turning = [](double t) {
        const double d = 0.05 * std::cos(2.0 * t), xy = 0.05 * std::sin(2.0 * t);
        return gradient<2>({d, xy - 0.1, xy + 0.1, -d});
    };
    const auto order = [&](const Material<2>& solid) {
        const auto at = [&](double dt) {
            MaterialPoint<2> point(solid, turning, rk4(dt));
            point.advance_to(4.0);
            return point.stress();
        };
        const auto fine = at(1.0 / 16384.0), one = at(1.0 / 128.0), other = at(1.0 / 256.0);
        const auto error = [&](const SymTensor<2>& s) {
            return std::hypot(s.c[0] - fine.c[0], s.c[1] - fine.c[1], s.c[2] - fine.c[2]);
        };
        return std::log2(error(one) / error(other));
    };
    BOOST_TEST(std::abs(order(YieldingSolid<PlaneVonMises>(plane, LinearHardening{Y})) - 1.0) <
               0.1);
    const double smooth = order(SmoothYield<PlaneVonMises>(plane, LinearHardening{Y}, 0.5));
    BOOST_TEST(std::abs(smooth - 4.0) < 0.7);
}

/// Broken for good: no deviator, no tension, and the energy is not touched.
BOOST_AUTO_TEST_CASE(solids_break_where_they_are_told_to) {
    const auto pulled = [](double t) {
        return gradient<2>({t < 1.0 ? 0.1 : -0.2, 0.0, 0.0, t < 1.0 ? 0.02 : -0.2});
    };
    const auto broken_at = [&](const Failure& failure) {
        const YieldingSolid<PlaneVonMises> solid(plane, LinearHardening{Y}, failure);
        MaterialPoint<2> point(solid, pulled, rk4(1.0 / 256.0));
        double when = 0.0;
        while (point.t() < 1.0) {
            point.advance_to(point.t() + 1.0 / 256.0);
            if (when == 0.0 && failure.possible() && point.value(field_kind::broken) > 0.0) {
                when = point.t();
                for (const double component : point.stress().c) BOOST_TEST(component == 0.0);
            }
        }
        if (when == 0.0) return when;
        const double energy = point.energy();
        BOOST_TEST(energy > 0.0);
        for (const double component : point.stress().c) BOOST_TEST(component == 0.0);
        point.advance_to(3.0);
        BOOST_TEST(point.value(field_kind::broken) == 1.0);
        const SymTensor<2> s = point.stress();
        BOOST_TEST(s(0, 0) < 0.0);  // it can still be pressed
        BOOST_TEST((s(0, 0) == s(1, 1) && s(0, 1) == 0.0));
        return when;
    };
    BOOST_TEST(broken_at({}) == 0.0);
    const double by_strain = broken_at({.plastic_strain = 0.01});
    // q = 4 eta 0.04 t up to Y, then eps_p = 0.04 (t - t_Y).
    BOOST_TEST(std::abs(by_strain - Y / (0.16 * eta) - 0.25) < 2.0 / 256.0);
    const double by_tension = broken_at({.tension = 0.04});  // (lambda + eta) 0.12 t
    BOOST_TEST(std::abs(by_tension - 0.04 / (0.12 * (lambda + eta))) < 2.0 / 256.0);
    const double by_stress = broken_at({.largest_stress = 0.05});  // the mean and Y/2
    BOOST_TEST(std::abs(by_stress - 0.04 / (0.12 * (lambda + eta))) < 2.0 / 256.0);
}

BOOST_AUTO_TEST_CASE(constants_that_make_no_sense_are_refused) {
    using Solid = YieldingSolid<PlaneVonMises>;
    const auto says = [](const std::string& told, const std::string& words) {
        BOOST_TEST(told.find(words) != std::string::npos, told);
    };
    says(refusal([] { Solid(plane, LinearHardening{-1.0}); }), "yield-stress: -1");
    says(refusal([] { Solid(plane, LinearHardening{Y, -0.1}); }), "hardening: -0.1");
    says(refusal([] { Solid(plane, LinearHardening{Y}, Failure{.plastic_strain = -1.0}); }),
         "failure-strain: -1");
    says(refusal([] { SmoothYield<PlaneVonMises>(plane, LinearHardening{Y}, 0.0); }),
         "yield-width: 0");
    says(refusal([] {
             YieldingSolid<PlaneVonMises, Perzyna>(plane, {{Y}, 0.0});
         }),
         "relaxation-time: 0");
    IntegratorOptions adams;
    adams.method = "cvode:adams";
    const auto still = [](double) { return Mat<2>{}; };
    says(refusal([&] { MaterialPoint<2>(Solid(plane, LinearHardening{Y}), still, adams); }),
         "cvode:adams");
}
