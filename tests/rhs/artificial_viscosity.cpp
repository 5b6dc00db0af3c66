// SPDX-License-Identifier: GPL-3.0-or-later
// Artificial viscosity beside any law: the force that smooth particles have by their scheme, heat that closes the
// energy of solids that keep their reference, and mirrors.
#include "support/random_state.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/artificial_viscosity.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace spam;
using namespace spam::test;

namespace {

template <int Dim>
Points<Dim> block() {
    std::array<int, Dim> cells{};
    cells.fill(Dim == 1 ? 40 : Dim == 2 ? 12 : 7);
    return square_lattice<Dim>(cells);
}

/// In the mean, of particles of mass 1 where they start: what the scheme takes its sound speed at.
template <int Dim>
double summed_density(const Model<Dim>& model, Kernel kernel) {
    const GeneralWeight<Dim> weight(kernel, 2.6);
    const Points<Dim>& x = model.particles().reference_position;
    double sum = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        for (Eigen::Index j = 0; j < x.cols(); ++j)
            sum += weight.value(model.box().nearest(x.col(i) - x.col(j)).norm());
    return sum / static_cast<double>(x.cols());
}

/// Rates of v and of what is heated in a block that is free of stress.
template <int Dim, class Add>
std::pair<std::vector<double>, std::vector<double>> rates_with(const Box<Dim>& box, Kernel kernel,
                                                               const Add& add) {
    ParticleModel<Dim> model(make_particles<Dim>(block<Dim>(), 1.0, 1.0, box), box);
    const Field heat = add(model, kernel);
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    std::vector<Point<Dim>> velocity(model.particles().size());
    for (auto& v : velocity)
        for (double& c : v) c = 0.3 * normal(random);
    std::vector<double> y = initial_state<Dim>(
        model, 1.0, 0.43, [](const Point<Dim>&) { return Point<Dim>::Zero().eval(); });
    const State<Dim> state(model.layout(), y);
    for (std::size_t i = 0; i < velocity.size(); ++i)
        state.velocity().col(static_cast<Eigen::Index>(i)) =
            velocity[static_cast<std::size_t>(model.particles().id[i])];
    const std::vector<double> rates = rates_of(model, y);
    const ConstState<Dim> rate(model.layout(), rates);
    const auto v_dot = rate.velocity();
    const auto e_dot = rate.field(heat);
    return {{v_dot.data(), v_dot.data() + v_dot.size()},
            {e_dot.data(), e_dot.data() + e_dot.size()}};
}

template <int Dim>
void is_the_force_of_the_scheme(const Box<Dim>& box) {
    for (const Kernel kernel : {Kernel::lucy, Kernel::w4}) {
        const auto scheme = rates_with<Dim>(box, kernel, [](auto& model, Kernel chosen) -> Field {
            model.template add_term<SmoothParticles<Dim>>(
                ElasticSolid{0.43, 0.43}, Scheme{.viscosity = 0.7, .kernel = chosen, .range = 2.6});
            return Field::energy;
        });
        const auto beside = rates_with<Dim>(box, kernel, [](auto& model, Kernel chosen) -> Field {
            model.template add_term<ArtificialViscosity<Dim>>(
                typename ArtificialViscosity<Dim>::Constants{
                    .alpha = 0.7,
                    .range = 2.6,
                    .density = 1.0,
                    .sound_speed = std::sqrt(3.0 * 0.43 / summed_density<Dim>(model, chosen)),
                    .kernel = chosen});
            return field_kind::viscous_heat;
        });
        double most = 0.0, heated = 0.0;
        for (std::size_t k = 0; k < scheme.first.size(); ++k) {
            most = std::max(most, std::abs(scheme.first[k]));
            BOOST_TEST(std::abs(scheme.first[k] - beside.first[k]) < 1e-12);
        }
        for (std::size_t i = 0; i < scheme.second.size(); ++i) {
            heated += beside.second[i];
            BOOST_TEST(std::abs(scheme.second[i] - beside.second[i]) < 1e-12);
        }
        BOOST_TEST(most > 0.05);
        BOOST_TEST(heated > 0.1);
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(it_is_the_force_of_the_scheme) {
    is_the_force_of_the_scheme<1>({});
    is_the_force_of_the_scheme<2>({});
    is_the_force_of_the_scheme<3>({});
    is_the_force_of_the_scheme<1>(Box<1>({40.0}));
    is_the_force_of_the_scheme<2>(Box<2>({12.0, 0.0}));
    is_the_force_of_the_scheme<3>(Box<3>({7.0, 7.0, 0.0}));
}

// A bar of a solid that keeps its reference is hit: the wave loses its oscillations to heat.
BOOST_AUTO_TEST_CASE(heat_closes_the_energy_of_a_solid_that_keeps_its_reference) {
    const auto hit = [](double alpha) {
        ParticleModel<2> model(make_particles<2>(square_lattice<2>({40, 6}), 1.0, 1.0));
        model.add_term<TotalLagrangian<2>>(StVenantKirchhoff{0.43, 0.43},
                                           TotalLagrangianScheme{1.0, 3.0});
        if (alpha > 0.0)
            model.add_term<ArtificialViscosity<2>>(ArtificialViscosity<2>::Constants{
                .alpha = alpha, .range = 3.0, .density = 1.0, .sound_speed = std::sqrt(1.29)});
        const auto y0 = initial_state<2>(model, 1.0, 0.43, [](const Point<2>& x) {
            return Point<2>(x[0] < 8.0 ? 0.1 : 0.0, 0.002 * x[1]);
        });
        IntegratorOptions rk4;
        rk4.dt = 0.1;
        Motion<2> motion(model, y0, rk4);
        const auto before = measure_invariants<2>(model, motion.y());
        motion.advance_to(15.0);
        const auto after = measure_invariants<2>(model, motion.y());
        BOOST_TEST((after.momentum - before.momentum).norm() < 1e-13);
        BOOST_TEST(std::abs(after.angular_momentum[0] - before.angular_momentum[0]) < 1e-12);
        BOOST_TEST(std::abs(after.energy - before.energy) < 1e-6 * before.energy);
        double heat = 0.0;
        if (alpha > 0.0)
            for (std::size_t i = 0; i < model.particles().size(); ++i) {
                const double h = motion.state().find(field_kind::viscous_heat)[i];
                BOOST_TEST(h >= 0.0);
                heat += model.particles().mass[i] * h;
            }
        return heat / before.energy;
    };
    BOOST_TEST(hit(0.0) == 0.0);
    const double one = hit(1.0), half = hit(0.5);
    BOOST_TEST(one > half);
    BOOST_TEST(half > 0.02);
}

BOOST_AUTO_TEST_CASE(constants_without_meaning_are_refused) {
    ParticleModel<2> model(make_particles<2>(square_lattice<2>({4, 4}), 1.0, 1.0));
    using Constants = ArtificialViscosity<2>::Constants;
    const Constants usual{.range = 3.0, .density = 1.0, .sound_speed = 1.0};
    for (double Constants::*const number :
         {&Constants::alpha, &Constants::range, &Constants::density, &Constants::sound_speed})
        for (const double value : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
            Constants wrong = usual;
            wrong.*number = value;
            BOOST_CHECK_THROW(model.add_term<ArtificialViscosity<2>>(wrong), InputError);
        }
}

// A wall that takes energy cannot take this heat.
BOOST_AUTO_TEST_CASE(behind_a_mirror_but_not_behind_a_wall_that_heats) {
    for (const WallKind kind : {WallKind::mirror, WallKind::no_slip}) {
        Box<2> box;
        box.set_wall(0, false, {.kind = kind, .at = -0.5});
        ParticleModel<2> model(make_particles<2>(square_lattice<2>({6, 6}), 1.0, 1.0, box), box);
        const auto add = [&] {
            model.add_term<ArtificialViscosity<2>>(ArtificialViscosity<2>::Constants{
                .range = 3.0, .density = 1.0, .sound_speed = 1.0});
        };
        if (kind == WallKind::mirror)
            BOOST_CHECK_NO_THROW(add());
        else
            BOOST_CHECK_THROW(add(), InputError);
    }
}
