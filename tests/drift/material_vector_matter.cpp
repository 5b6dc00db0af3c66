// SPDX-License-Identifier: GPL-3.0-or-later
// Of which matter a solid with material vectors may be: other lattices, masses and spacings, two materials in one
// body, periodic boxes, a core besides. Each body turns a few times or rings; p, L, energy, shape and the
// closest pair say whether it holds.
#include "support/effort.hpp"
#include "support/random_state.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/shape.hpp>
#include <spam/material/flowing_solid.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace spam;
using spam::test::effort;

namespace {

constexpr PolynomialSolid elastic{0.43, 0.43};
constexpr double omega = 0.0125;

struct Kept {
    double p, L, energy, shape, closest;
};

/// Turned `turns` times by leapfrog from rest in the turning frame; changes are relative, p by mass and speed of
/// the outermost, the closest pair relative to the start's.
Kept turned(ParticleModel<2>& model, const char* what, double turns, double dt = 0.2) {
    const auto y0 = initial_state<2>(model, 1.0, 1.0, rigid_rotation(omega));
    Motion<2> motion(model, y0, {.method = "leapfrog", .dt = dt});
    const auto start = measure_invariants(model, motion.y());
    const double closest = closest_pair<2>(motion.state().position(), 1.0, model.box());
    Kept kept{0.0, 0.0, 0.0, 0.0, 1.0};
    const double end = turns * 2.0 * std::numbers::pi / omega;
    for (double t = 0.0; t < end;) {
        t = std::min(end, t + 12.0);
        motion.advance_to(t);
        const auto now = measure_invariants(model, motion.y());
        const Points<2> x = motion.state().position();
        kept.p = std::max(kept.p, (now.momentum - start.momentum).norm() / now.mass);
        kept.L =
            std::max(kept.L, std::abs(now.angular_momentum[0] / start.angular_momentum[0] - 1.0));
        kept.energy = std::max(kept.energy, std::abs(now.energy / start.energy - 1.0));
        kept.shape =
            std::max(kept.shape, shape_error<2>(model.particles().reference_position, x, 1.0));
        kept.closest = std::min(kept.closest, closest_pair<2>(x, 1.0, model.box()) / closest);
    }
    BOOST_TEST_MESSAGE(what << ": p " << kept.p << ", L " << kept.L << ", energy " << kept.energy
                            << ", shape " << kept.shape << ", closest pair " << kept.closest);
    return kept;
}

void check(const Kept& kept, double shape = 0.03) {
    BOOST_TEST(kept.p < 1e-14);
    BOOST_TEST(kept.L < 1e-12);
    BOOST_TEST(kept.energy < 1e-5);
    BOOST_TEST(kept.shape < shape);
    BOOST_TEST(kept.closest > 0.98);
}

MaterialVectorModel<2> of(Particles<2> particles, double density, double range = 3.0) {
    return {std::move(particles), elastic, {density, range}};
}

/// Two square lattices side by side, the right one with this spacing; masses as the spacing wants.
Particles<2> two_spacings(double spacing) {
    std::vector<Eigen::Vector2d> x;
    std::vector<double> mass;
    for (double a = -6.0; a < -0.1; a += 1.0)
        for (double b = -5.5; b < 6.0; b += 1.0) {
            x.emplace_back(a, b);
            mass.push_back(1.0);
        }
    const double begin = -0.5 + 0.5 * spacing;
    for (double a = begin; a < 5.5; a += spacing)
        for (double b = -6.0 + 0.5 * spacing; b < 6.0; b += spacing) {
            x.emplace_back(a, b);
            mass.push_back(spacing * spacing);
        }
    Points<2> points(2, static_cast<Eigen::Index>(x.size()));
    for (std::size_t k = 0; k < x.size(); ++k) points.col(static_cast<Eigen::Index>(k)) = x[k];
    auto particles = make_particles<2>(points, 1.0);
    particles.mass = mass;
    return particles;
}

/// The first half of the particles soft, the others stiff.
struct TwoMaterials {
    PolynomialSolid soft, stiff;
    std::size_t first_stiff;

    const PolynomialSolid& of(std::size_t i) const { return i < first_stiff ? soft : stiff; }
    Mat<2> stress(std::size_t i, const Mat<2>& F) const { return of(i).stress(F); }
    double energy(std::size_t i, const Mat<2>& F) const { return of(i).energy(F); }
    TwoMaterials in_state(const ConstState<2>&) const { return *this; }
    bool settle(std::size_t, const Mat<2>&, const State<2>&) const { return false; }
    std::vector<Field> history() const { return {}; }
    double stiffness() const { return soft.stiffness(); }
    std::string describe() const { return "two materials"; }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_square_lattice) {
    auto model = of(make_particles<2>(square_lattice<2>({12, 12}), 1.0), 1.0);
    check(turned(model, "square lattice", effort(5.0, 2.0, 1.0)));
}

BOOST_AUTO_TEST_CASE(masses_that_differ) {
    for (const double spread : {0.2, 0.8}) {
        auto particles = make_particles<2>(triangular_hexagon(7), 1.0);
        std::mt19937_64 random(3);
        std::uniform_real_distribution<double> u(-spread, spread);
        for (double& m : particles.mass) m += u(random);
        auto model = of(particles, std::sqrt(4.0 / 3.0));
        check(turned(model, "masses", effort(5.0, 2.0, 1.0)));
    }
}

BOOST_AUTO_TEST_CASE(spacings_that_differ) {
    for (const double spacing : {0.8, 0.5, 0.34}) {
        auto model = of(two_spacings(spacing), 1.0);
        check(turned(model, "spacings",
                     spacing < 0.5 ? effort(1.0, 0.5, 0.2) : effort(5.0, 2.0, 0.2), 0.2 * spacing));
    }
}

BOOST_AUTO_TEST_CASE(two_materials_in_one_body) {
    for (const double ratio : {3.0, 10.0}) {
        auto particles = make_particles<2>(triangular_block(14, 14), 1.0);
        TwoMaterials law{elastic, {ratio * 0.43, ratio * 0.43}, particles.size() / 2};
        MaterialVectorModel<2> model(particles, law, {std::sqrt(4.0 / 3.0)});
        check(turned(model, "two materials", effort(5.0, 2.0, 1.0), 0.1));
    }
}

BOOST_AUTO_TEST_CASE(a_periodic_box) {
    const Box<2> box({12.0, 12.0 * std::sqrt(0.75)});
    MaterialVectorModel<2> model(make_particles<2>(triangular_block(12, 12), 1.0, 1.0, box),
                                 elastic, {std::sqrt(4.0 / 3.0)}, box);
    std::mt19937_64 random(5);
    std::normal_distribution<double> g;
    const auto y0 = initial_state<2>(model, 1.0, 1.0, [&](const Point<2>& x) {
        return Point<2>(0.3 + 0.05 * std::sin(2.0 * std::numbers::pi * x.y() / box.length(1)) +
                            0.02 * g(random),
                        0.2 + 0.02 * g(random));
    });
    Motion<2> motion(model, y0, {.method = "leapfrog", .dt = 0.05});
    const auto start = measure_invariants(model, motion.y());
    double p = 0.0, energy = 0.0;
    for (double t = 2.0; t <= effort(400.0, 150.0, 60.0); t += 2.0) {
        motion.advance_to(t);
        const auto now = measure_invariants(model, motion.y());
        p = std::max(p, (now.momentum - start.momentum).norm() / now.mass);
        energy = std::max(energy, std::abs(now.energy / start.energy - 1.0));
    }
    BOOST_TEST_MESSAGE("periodic: p " << p << ", energy " << energy << ", lists "
                                      << model.list_builds());
    BOOST_TEST(p < 1e-14);
    BOOST_TEST(energy < 1e-5);
}

/// What yields and is pressed together, with a core: p, L and energy are kept, and none pass through each other.
BOOST_AUTO_TEST_CASE(a_core_besides) {
    const auto closest_with = [](double e_c) {
        MaterialVectorModel<2> model(make_particles<2>(triangular_block(16, 10), 1.0),
                                     FlowingSolid{elastic, 0.03}, {std::sqrt(4.0 / 3.0)});
        if (e_c > 0.0) model.add_term<Core<2>>(CorePotential{e_c, 0.8});
        const auto y0 = initial_state<2>(model, 1.0, 1.0, [](const Point<2>& x) {
            return Point<2>(-0.08 * x.x() + 0.02 * x.y(), 0.03 * x.x());
        });
        Motion<2> motion(model, y0, {.method = "rk4", .dt = 0.05});
        const auto start = measure_invariants(model, motion.y());
        double closest = 1.0;
        for (double t = 1.0; t <= 40.0; t += 1.0) {
            motion.advance_to(t);
            closest = std::min(closest, closest_pair<2>(motion.state().position(), 1.0, {}));
        }
        const auto end = measure_invariants(model, motion.y());
        const double L = std::abs(end.angular_momentum[0] / start.angular_momentum[0] - 1.0),
                     energy = std::abs(end.energy / start.energy - 1.0);
        BOOST_TEST_MESSAGE("core " << e_c << ": closest " << closest << ", L " << L << ", energy "
                                   << energy << ", heat " << model.law.heat() / start.energy);
        BOOST_TEST((end.momentum - start.momentum).norm() < 1e-12);
        BOOST_TEST(L < 1e-8);
        BOOST_TEST(energy < 1e-4);
        return closest;
    };
    const double without = closest_with(0.0), with = closest_with(1.0);
    BOOST_TEST(with > without);
    BOOST_TEST(with > 0.5);
}
