// SPDX-License-Identifier: GPL-3.0-or-later
// Potentials of the density: every force is minus the derivative of its energy, in any dimension, free
// and periodic, with unequal masses; momentum and angular momentum are balanced; a potential with one
// term wrong is found out; weights that are not smooth enough are refused.
#include "support/effort.hpp"
#include "support/random_state.hpp"
#include <spam/kernel/lucy.hpp>
#include <spam/kernel/monaghan_cubic.hpp>
#include <spam/kernel/wn.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/physics/cohesive_potential.hpp>
#include <spam/physics/core_potential.hpp>
#include <spam/physics/curvature_strength.hpp>
#include <spam/physics/embedded_energy.hpp>
#include <spam/physics/surface_tension.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;

namespace {

constexpr double range = 2.3;

/// Unequal particles, jittered about a lattice: about 30.
template <int Dim>
struct Sample {
    Box<Dim> box;
    Particles<Dim> particles;

    Sample(unsigned seed, bool periodic) {
        const int cells = Dim == 1 ? 12 : Dim == 2 ? 6 : 5;
        if (periodic) {
            std::array<double, Dim> lengths;
            lengths.fill(cells);
            if constexpr (Dim == 2) lengths[1] *= std::sqrt(0.75);
            box = Box<Dim>(lengths);
        }
        particles = test::jittered_particles<Dim>(cells, seed, 0.2, box);
    }

    /// What `evaluate` makes of these particles with x in place of their positions.
    template <class Evaluate>
    EnergyAndForces<Dim> at(const Points<Dim>& x, const Evaluate& evaluate) const {
        const PairList<Dim> pairs(x, range, box);
        return evaluate(ListedParticles<Dim>{x, particles.mass, pairs, box});
    }
};

/// Whether some neighbour of i is so near the range, or the joint of a spline at half of it, that a
/// difference quotient would see a derivative of the force jump there.
template <int Dim>
bool near_a_joint(const Sample<Dim>& sample, const Points<Dim>& x, Eigen::Index i, double h) {
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
        double r2 = 0.0;
        for (int a = 0; a < Dim; ++a)
            r2 += std::pow(sample.box.nearest_image(a, x(a, i) - x(a, j)), 2);
        for (const double joint : {0.5 * range, range})
            if (std::abs(std::sqrt(r2) - joint) < 2.0 * h) return true;
    }
    return false;
}

/// The largest |F + d Phi/d r|, relative to the largest force, over a few particles.
template <int Dim, class Evaluate>
double force_error(const Sample<Dim>& sample, const Evaluate& evaluate) {
    Points<Dim> x = sample.particles.reference_position;
    const Points<Dim> force = sample.at(x, evaluate).force;
    double worst = 0.0;
    const double h = 2e-4;
    int looked_at = 0;
    const int stride = Dim == 1 ? 3 : test::effort(3, 12);  // on a line there are few
    for (Eigen::Index i = 0; i < x.cols(); i += stride) {
        if (near_a_joint(sample, x, i, 1.01 * h)) continue;
        ++looked_at;
        for (int a = 0; a < Dim; ++a) {
            const double from = x(a, i);
            const auto energy = [&](double shift) {
                x(a, i) = from + shift;
                return sample.at(x, evaluate).energy;
            };
            const double slope =
                (8.0 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12.0 * h);
            x(a, i) = from;
            worst = std::max(worst, std::abs(force(a, i) + slope));
        }
    }
    BOOST_REQUIRE(looked_at > 2);
    return worst / force.cwiseAbs().maxCoeff();
}

/// The largest component of sum F, and of sum r F - F r, relative to the largest force.
template <int Dim>
std::pair<double, double> imbalance(const Points<Dim>& x, const Points<Dim>& F) {
    const Eigen::Matrix<double, Dim, Dim> moment = x * F.transpose();
    const double size = F.cwiseAbs().maxCoeff();
    return {F.rowwise().sum().cwiseAbs().maxCoeff() / size,
            (moment - moment.transpose()).cwiseAbs().maxCoeff() / size};
}

template <int Dim, class Evaluate>
void check(const char* name, const Evaluate& evaluate) {
    for (const bool periodic : {false, true})
        for (unsigned seed = 1; seed <= test::effort(2U, 1U); ++seed)
            BOOST_TEST_CONTEXT(name << ", " << Dim << "d, " << (periodic ? "periodic" : "free")) {
                const Sample<Dim> sample(seed, periodic);
                const Points<Dim>& x = sample.particles.reference_position;
                BOOST_TEST(force_error(sample, evaluate) < 1e-8);
                const auto [momentum, angular] = imbalance<Dim>(x, sample.at(x, evaluate).force);
                BOOST_TEST(momentum < 1e-13);
                if (!periodic) BOOST_TEST(angular < 1e-13 * static_cast<double>(x.cols()));
            }
}

/// A term as a function of the neighbourhood.
template <int Dim, class Weight, class Term>
auto of(const Term& term, const Weight& weight) {
    return [=](const ListedParticles<Dim>& near) {
        return energy_and_forces<Dim>(term, weight, near);
    };
}
template <int Dim>
auto of(const DistancePotential auto& potential) {
    return
        [=](const ListedParticles<Dim>& near) { return energy_and_forces<Dim>(potential, near); };
}

template <int Dim>
void check_all() {
    check<Dim>("density", of<Dim>(EmbeddedEnergy<EmbeddedAtom>{{1.3, 0.9}}, Lucy<Dim>(range)));
    check<Dim>("density", of<Dim>(EmbeddedEnergy<LucyGas>{}, MonaghanCubic<Dim>(range)));
    check<Dim>("gradient", of<Dim>(SurfaceTension{0.3}, Lucy<Dim>(range)));
    check<Dim>("gradient", of<Dim>(SurfaceTension{0.3}, MonaghanCubic<Dim>(range)));
    check<Dim>("core", of<Dim>(CorePotential{0.7, 1.3}));
    check<Dim>("cohesion", of<Dim>(CohesivePotential{0.1, 0.9}));
    if constexpr (Dim > 1) {
        check<Dim>("curvature", of<Dim>(CurvatureStrength{0.2}, Wn<Dim, 4>(range)));
        check<Dim>("curvature", of<Dim>(CurvatureStrength{0.2}, Wn<Dim, 5>(range)));
    }
}

// ---- with one thing wrong ----

/// Forgets that a gradient changes sign with the direction.
struct EvenGradient : SurfaceTension {
    static constexpr double parity = 1.0;
};
/// Forgets the term along the line of centres, in which w''' is.
struct NoThirdDerivative : CurvatureStrength {
    template <int Dim>
    static Vec<Dim> pull(const SymTensor<Dim>& G, const WeightAt<Dim>& at) {
        return (2.0 * at.second_over_r) * (G * at.n);
    }
};
/// The invariant as misread: xy counted once.
struct NotInvariant : CurvatureStrength {
    template <int Dim>
    double energy(double, const SymTensor<Dim>& D) const {
        return s_c * (4.0 * D(0, 0) * D(0, 0) + D(0, 1) * D(0, 1));
    }
    template <int Dim>
    SymTensor<Dim> slope(double, const SymTensor<Dim>& D) const {
        SymTensor<Dim> G;  // per component of D as the sums know it
        G(0, 0) = 4.0 * s_c * D(0, 0);
        G(1, 1) = -G(0, 0);
        G(0, 1) = s_c * D(0, 1);
        return G;
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(forces_are_minus_the_slope_of_the_energy_1d) { check_all<1>(); }
BOOST_AUTO_TEST_CASE(forces_are_minus_the_slope_of_the_energy_2d) { check_all<2>(); }
BOOST_AUTO_TEST_CASE(forces_are_minus_the_slope_of_the_energy_3d) { check_all<3>(); }

BOOST_AUTO_TEST_CASE(what_is_wrong_is_noticed) {
    const Sample<2> sample(1, false);
    const Points<2>& x = sample.particles.reference_position;
    const Wn<2, 5> w(range);
    EvenGradient even;
    even.s_g = 0.3;
    BOOST_TEST(force_error(sample, of<2>(even, w)) > 1e-3);
    NoThirdDerivative incomplete;
    incomplete.s_c = 0.2;
    BOOST_TEST(force_error(sample, of<2>(incomplete, w)) > 1e-3);
    // This one has an energy of its own, but one that knows which way the axes point.
    NotInvariant skew;
    skew.s_c = 0.2;
    BOOST_TEST(force_error(sample, of<2>(skew, w)) < 1e-8);
    BOOST_TEST(imbalance<2>(x, sample.at(x, of<2>(skew, w)).force).second > 1e-3);
}

BOOST_AUTO_TEST_CASE(the_curvature_potential_of_the_plane_as_printed) {
    const Sample<2> sample(3, false);
    const Points<2>& x = sample.particles.reference_position;
    const Wn<2, 5> w(range);
    double phi = 0.0;  // (rho_xx - rho_yy)^2 + 4 rho_xy^2, with q = (w'' - w'/r)/r^2
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        double A = 0.0, B = 0.0;
        for (Eigen::Index j = 0; j < x.cols(); ++j) {
            const Point<2> d = x.col(i) - x.col(j);
            if (i == j || d.norm() >= range) continue;
            const double q =
                (w.second_derivative(d.norm()) + w.minus_slope_over_r(d.norm())) / d.squaredNorm();
            const double m = sample.particles.mass[static_cast<std::size_t>(j)];
            A += m * q * (d.x() * d.x() - d.y() * d.y());
            B += m * q * d.x() * d.y();
        }
        phi += 0.2 * (A * A + 4.0 * B * B);
    }
    BOOST_TEST(std::abs(sample.at(x, of<2>(CurvatureStrength{0.2}, w)).energy - phi) < 1e-13 * phi);
}

BOOST_AUTO_TEST_CASE(particles_at_one_place_exert_no_infinite_force) {
    Sample<2> sample(1, false);
    Points<2> x = sample.particles.reference_position;
    x.col(5) = x.col(4);
    const Wn<2, 5> w(range);
    BOOST_TEST(sample.at(x, of<2>(CurvatureStrength{0.2}, w)).force.allFinite());
    BOOST_TEST(sample.at(x, of<2>(SurfaceTension{0.2}, w)).force.allFinite());
    BOOST_TEST(sample.at(x, of<2>(CorePotential{0.2, 0.7})).force.allFinite());
}

BOOST_AUTO_TEST_CASE(weights_that_are_not_smooth_enough_are_refused_with_the_reason) {
    const auto says = [](const std::string& words) {
        return [=](const InputError& e) {
            return std::string(e.what()).find(words) != std::string::npos;
        };
    };
    const CurvatureStrength strength{0.2};
    BOOST_CHECK_EXCEPTION(check_smooth_enough<2>(strength, Wn<2, 2>(3.0)), InputError,
                          says("a curvature potential needs a weight function with 3 continuous "
                               "derivatives, this one has 1"));
    BOOST_CHECK_EXCEPTION(check_smooth_enough<2>(strength, Lucy<2>(3.0)), InputError,
                          says("forces would jump where a neighbour passes the range; use w4"));
    BOOST_CHECK_THROW(check_smooth_enough<2>(strength, MonaghanCubic<2>(3.0)), InputError);
    BOOST_CHECK_THROW(check_smooth_enough<2>(SurfaceTension{0.1}, Wn<2, 2>(3.0)), InputError);
    BOOST_CHECK_NO_THROW(check_smooth_enough<2>(strength, Wn<2, 4>(3.0)));
    BOOST_CHECK_NO_THROW(check_smooth_enough<2>(SurfaceTension{0.1}, Lucy<2>(3.0)));
    BOOST_CHECK_NO_THROW(check_smooth_enough<2>(EmbeddedEnergy<LucyGas>{}, Wn<2, 2>(3.0)));
}
