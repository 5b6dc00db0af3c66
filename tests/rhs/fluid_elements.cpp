// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of a fluid: density of the corners, forces that are the gradient of their energy, friction and work against
// the hourglass; what they keep, mixed with solids and alone; what is refused.
#include "support/element_mesh.hpp"
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/diagnostics/invariants.hpp>
#include <spam/external/clamp.hpp>
#include <spam/external/gravity.hpp>
#include <spam/material/cavitation.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/density_potentials.hpp>
#include <spam/rhs/own_ranges.hpp>

#include <boost/test/unit_test.hpp>

#include <array>

using namespace spam;
using namespace spam::test;

namespace {

const EmbeddedAtom water{1.0, 1.0};
const HourglassControl both{0.1, 0.05};

std::unique_ptr<ParticleModel<2>> fluid_of(const Mesh& mesh, const Fluid& fluid,
                                           const HourglassControl& control = {},
                                           double density = 1.0, double temperature = 0.0) {
    MeshedBodies bodies = make_nodes({mesh}, density);
    auto model = std::make_unique<ParticleModel<2>>(std::move(bodies.nodes));
    model->add_term<Elements>(
        std::move(bodies.element),
        std::vector<Elements::Material>{{fluid, density, control, temperature}});
    return model;
}

std::vector<double> stirred(ParticleModel<2>& model, double speed) {
    auto y = initial_state<2>(model, 1.0, 1.0, [speed](const Point<2>& x) {
        return Point<2>(speed * std::sin(0.5 * x.x()) - 0.01 * x.y(),
                        speed * std::cos(0.7 * x.x()) * std::sin(0.6 * x.y()) + 0.01 * x.x());
    });
    model.term<Elements>()->warm(y);
    return y;
}

/// The largest difference of m v_dot and -dE/dx, by central differences of the internal energy.
double force_error(ParticleModel<2>& model, std::vector<double> y) {
    const auto rates = rates_of(model, y);
    const auto v_dot = ConstState<2>(model.layout(), rates).velocity();
    double largest = 0.0;
    constexpr double h = 1e-5;
    for (Eigen::Index i = 0; i < v_dot.cols(); ++i)
        for (Eigen::Index a = 0; a < 2; ++a) {
            double& x = State<2>(model.layout(), y).position()(a, i);
            const double place = x;
            const auto energy = [&](double at) {
                x = at;
                return model.internal_energy(y);
            };
            const double slope = (energy(place + h) - energy(place - h)) / (2.0 * h);
            x = place;
            const double mass = model.particles().mass[static_cast<std::size_t>(i)];
            largest = std::max(largest, std::abs(mass * v_dot(a, i) + slope));
        }
    return largest;
}

struct Drifts {
    double momentum, angular_momentum, energy;
};

Drifts drifts_of(ParticleModel<2>& model, double dt, const char* method = "rk4") {
    const auto y0 = stirred(model, 0.1);
    Motion<2> motion(model, y0, {.method = method, .dt = dt});
    motion.advance_to(20.0);
    const auto before = measure_invariants<2>(model, y0),
               after = measure_invariants<2>(model, motion.y());
    return {(after.momentum - before.momentum).norm(),
            std::abs(after.angular_momentum[0] - before.angular_momentum[0]),
            std::abs(after.energy - before.energy)};
}

/// A column between guides under gravity, of side `scale`, its time and that of g in proportion.
std::vector<double> fallen(double scale) {
    Mesh mesh = rectangle_mesh(6, 8, scale);
    mesh.node.row(0).array() += 3.0 * scale;
    mesh.node.row(1).array() += 4.0 * scale;
    MeshedBodies bodies = make_nodes({mesh}, 1.0, scale);
    ParticleModel<2> model(std::move(bodies.nodes));
    model.add_term<Elements>(std::move(bodies.element),
                             std::vector<Elements::Material>{
                                 {Fluid{CavitatingEmbeddedAtom(water, 0.02)}, 1.0, {0.1, 0.0}}});
    model.add(std::make_unique<Gravity<2>>(Point<2>(0.0, -0.05 / scale)));
    for (const int axis : {0, 1}) {
        auto guide = std::make_unique<Clamp<2>>(
            select<2>(model.particles(), [axis](const Point<2>& x) { return x[axis] < 1e-9; }));
        guide->only_along(axis);
        model.add(std::move(guide));
    }
    const auto y0 = initial_state<2>(model, 1.0, 1.0, at_rest<2>());
    Motion<2> motion(model, y0, {.dt = 0.0523 * scale});
    motion.advance_to(20.0 * scale);
    const Points<2> x = motion.state().position() / scale;
    return {x.data(), x.data() + x.size()};
}

std::string refused(const Elements::Material& material, const Box<2>& box = {}) {
    return refusal([&] {
        MeshedBodies bodies = make_nodes({rectangle_mesh(2, 2)}, 1.0);
        ParticleModel<2> model(bodies.nodes, box);
        model.add_term<Elements>(bodies.element, std::vector<Elements::Material>{material});
    });
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(forces_of_a_cold_fluid_are_the_gradient_of_its_energy) {
    // From nearly torn to compressed, on both sides of where the tension is at its limit.
    for (const Fluid& fluid : {Fluid{water}, Fluid{CavitatingEmbeddedAtom(water, 0.02)}})
        for (const double stretch : {0.85, 1.0, 1.02, 1.3}) {
            const auto model = fluid_of(distorted_mesh(5, 4, 0.25), fluid);
            BOOST_TEST(model->layout().blocks().size() == 2U);  // y = (x, v)
            auto y = initial_state<2>(*model, 1.0, 1.0, at_rest<2>());
            State<2>(model->layout(), y).position() *= stretch;
            BOOST_TEST(force_error(*model, y) < 1e-7);
        }
}

BOOST_AUTO_TEST_CASE(a_uniform_fluid_has_its_pressure_and_inner_nodes_rest) {
    const auto model = fluid_of(distorted_mesh(7, 5), Fluid{water}, both, 1.2);
    const auto y = initial_state<2>(*model, 1.2, 1.0, at_rest<2>());
    const Elements::Fields all = fluid_elements(*model, y);
    for (std::size_t k = 0; k < 35; ++k) {
        BOOST_TEST(std::abs(all.density[k] - 1.2) < 1e-14);
        BOOST_TEST(std::abs(all.stress[k](0, 0) + water.pressure(1.2)) < 1e-14);
        BOOST_TEST(std::abs(all.energy[k] - water.cold_energy(1.2)) < 1e-14);
    }
    const auto rates = rates_of(*model, y);
    const auto v_dot = ConstState<2>(model->layout(), rates).velocity();
    for (Eigen::Index k = 0; k < v_dot.cols(); ++k) {
        const auto id = model->particles().id[static_cast<std::size_t>(k)];
        const bool edge = id % 8 == 0 || id % 8 == 7 || id / 8 == 0 || id / 8 == 5;
        BOOST_TEST((edge || v_dot.col(k).norm() < 1e-14));
    }
}

BOOST_AUTO_TEST_CASE(friction_is_that_of_the_gradient_and_heats) {
    // v = (y, 0) shears: sigma_xy = eta. Of a cold fluid and of a gas, whose energy grows by eta/rho.
    const NewtonViscosity friction{-0.3, 0.3};
    for (const bool cold : {true, false}) {
        const Fluid fluid{cold ? AnyEquationOfState(water) : AnyEquationOfState(GammaGas{1.4}),
                          friction};
        const auto model = fluid_of(distorted_mesh(4, 4), fluid, {}, 1.0, 0.5);
        auto y = initial_state<2>(*model, 1.0, 1.0,
                                  [](const Point<2>& x) { return Point<2>(x.y(), 0.0); });
        model->term<Elements>()->warm(y);
        const Elements::Fields all = fluid_elements(*model, y);
        BOOST_TEST(std::abs(all.stress[5](0, 1) - 0.3) < 1e-14);
        BOOST_TEST(std::abs(all.stress[5](0, 0) + (cold ? 0.0 : 0.5)) < 1e-14);
        const auto rates = rates_of(*model, y);
        const double* const heat =
            ConstState<2>(model->layout(), rates)
                .elements()
                .find(cold ? Field(field_kind::friction_work) : Field::energy);
        for (std::size_t k = 0; k < 16; ++k) BOOST_TEST(std::abs(heat[k] - 0.3) < 1e-14);
    }
    // Alone it brakes with that rate at most, and elements of squares that do (x, -y) in turn with it.
    const auto model = fluid_of(rectangle_mesh(4, 4), Fluid{water, friction});
    const auto y = initial_state<2>(*model, 1.0, 1.0, [](const Point<2>& x) {
        return Point<2>(std::lround(x.x() + 2.0) % 2 == 0 ? 1.0 : -1.0, 0.0);
    });
    const auto rates = rates_of(*model, y);
    const ConstState<2> state(model->layout(), y), rate(model->layout(), rates);
    double fastest = 0.0;
    for (Eigen::Index k = 0; k < 25; ++k)
        fastest = std::max(fastest, -rate.velocity()(0, k) / state.velocity()(0, k));
    BOOST_TEST(fastest <= model->fastest_damping(y));
    BOOST_TEST(fastest > 0.4 * model->fastest_damping(y));
}

BOOST_AUTO_TEST_CASE(a_fluid_in_free_space_keeps_everything) {
    const Mesh mesh = distorted_mesh(10, 6);
    const NewtonViscosity friction{0.0, 0.05};
    const struct {
        Fluid fluid;
        HourglassControl control;
        double T;
    } cases[] = {{{water}, {}, 0.0},
                 {{water}, both, 0.0},
                 {{CavitatingEmbeddedAtom(water, 0.1), friction}, both, 0.0},
                 {{GammaGas{1.4}, friction}, both, 0.1}};
    for (const auto& [fluid, control, T] : cases) {
        const auto model = fluid_of(mesh, fluid, control, 1.0, T);
        const Drifts coarse = drifts_of(*model, 0.2), fine = drifts_of(*model, 0.1);
        const std::string words = model->describe();
        BOOST_TEST(fine.momentum < 1e-12, words);
        BOOST_TEST(coarse.energy < 1e-3, words);
        BOOST_TEST(fine.energy < coarse.energy / 8.0 + 1e-12,
                   words << coarse.energy << " " << fine.energy);
        BOOST_TEST(fine.angular_momentum < coarse.angular_momentum / 8.0 + 1e-12, words);
    }
    // Steps whose changes of velocity are forces keep L to the last bits: there is no torque.
    const auto model = fluid_of(mesh, Fluid{water});
    const Drifts exact = drifts_of(*model, 0.1, "leapfrog");
    BOOST_TEST(exact.momentum < 1e-12);
    BOOST_TEST(exact.angular_momentum < 1e-11);
}

BOOST_AUTO_TEST_CASE(a_solid_and_a_fluid_share_a_mesh) {
    MeshedBodies bodies = make_nodes({distorted_mesh(10, 6)}, 1.0);
    std::vector<std::int32_t> material(bodies.element.size());
    for (std::size_t k = 0; k < material.size(); ++k) material[k] = k % 10 < 5 ? 0 : 1;
    const auto made = [&] {
        auto model = std::make_unique<ParticleModel<2>>(bodies.nodes);
        model->add_term<Elements>(
            bodies.element,
            std::vector<Elements::Material>{{yielding(0.02), 1.0, both}, {Fluid{water}, 1.0, both}},
            material);
        return model;
    };
    const auto model = made(), again = made();
    const Drifts coarse = drifts_of(*model, 0.1), fine = drifts_of(*model, 0.05);
    BOOST_TEST(fine.momentum < 1e-12);
    BOOST_TEST(coarse.energy < 1e-4);
    BOOST_TEST(fine.energy < coarse.energy / 2.0);
    const IntegratorOptions options{.dt = 0.1};
    Motion<2> whole(*model, stirred(*model, 0.1), options);
    whole.advance_to(4.0);
    const std::vector<double> y_half(whole.y().begin(), whole.y().end());
    const ConstState<2> elements = ConstState<2>(model->layout(), y_half).elements();
    BOOST_TEST(elements.stress().rightCols(5).norm() == 0.0);  // of a fluid: none in y
    BOOST_TEST(elements.stress().leftCols(5).norm() > 0.0);
    const Elements::Fields all = fluid_elements(*model, y_half);
    BOOST_TEST(all.stress[0](0, 0) == elements.stress()(0, 0));
    BOOST_TEST(all.stress[9](0, 0) == -water.pressure(all.density[9]));
    // What y holds is all there is: another model goes on from it with the same bits.
    Archive written;
    whole.remember(written);
    whole.advance_to(9.0);
    stirred(*again, 0.1);
    Motion<2> restarted(*again, y_half, options, 4.0);
    Archive reading(written.bytes());
    restarted.remember(reading);
    restarted.advance_to(9.0);
    BOOST_TEST(std::equal(whole.y().begin(), whole.y().end(), restarted.y().begin()));
}

BOOST_AUTO_TEST_CASE(half_the_size_takes_half_the_time) {
    const auto whole = fallen(1.0), half = fallen(0.5), other = fallen(0.3);
    double moved = 0.0;
    for (std::size_t k = 0; k < whole.size(); ++k) {
        BOOST_TEST(std::abs(half[k] - whole[k]) < 1e-10);
        BOOST_TEST(std::abs(other[k] - whole[k]) < 1e-10);
        moved = std::max(moved, std::abs(whole[k]));
    }
    BOOST_TEST(moved > 7.0);
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense_for_elements_of_a_fluid_is_refused) {
    BOOST_TEST(refused({Fluid{water}, 1.0, both}) == "accepted");
    BOOST_TEST(
        has(refused({Fluid{GammaGas{1.4}, {}, FourierConduction{1.0}}, 1.0}), "conductivity"));
    BOOST_TEST(
        has(refused({Fluid{water, NewtonViscosity{0.0, 1.0}, {}, true}, 1.0}), "by gradients"));
    BOOST_TEST(has(refused({Fluid{water, NewtonViscosity{0.0, -1.0}}, 1.0}), "shear viscosity"));
    BOOST_TEST(has(refused({Fluid{GammaGas{1.4}}, 1.0, both}), "its temperature"));
    BOOST_TEST(refused({Fluid{GammaGas{1.4}}, 1.0, both, 0.2}) == "accepted");
    BOOST_TEST(has(refused({Fluid{GammaGas{1.4}}, 1.0, {}, -0.2}), "temperature -0.2"));
    Box<2> walled;
    walled.set_wall(1, false, {WallKind::mirror, -1.0});
    BOOST_TEST(has(refused({Fluid{water}, 1.0}, walled), "guide the nodes"));
    // Outside the law a run stops with its reason.
    const auto model = fluid_of(rectangle_mesh(2, 2), Fluid{GammaGas{1.4}}, {}, 1.0, 0.2);
    auto y = stirred(*model, 0.0);
    State<2>(model->layout(), y).elements().energy()(0, 3) = std::nan("");
    BOOST_TEST(std::isnan(rates_of(*model, y).front()));
    BOOST_TEST(has(model->failure(), "of element 3 is outside the law"));
}

/// Corners of elements have no densities that could be summed, in whatever order the laws come; where none is a
/// fluid's, or among other particles, the same laws are taken.
BOOST_AUTO_TEST_CASE(laws_that_sum_densities_are_refused_beside_elements_of_a_fluid) {
    MeshedBodies bodies = make_nodes({rectangle_mesh(4, 4)}, 1.0);
    const DensityPotentials surface{.surface_tension = 0.1, .range = 3.0},
        core{.core = {1.0, 0.7}, .range = 3.0};
    const auto composed = [&](bool fluid, bool first, const auto& law) {
        return refusal([&] {
            ParticleModel<2> model(bodies.nodes);
            if (first) law(model);
            model.add_term<Elements>(
                bodies.element,
                std::vector<Elements::Material>{
                    fluid ? Elements::Material{Fluid{water}, 1.0}
                          : Elements::Material{ElasticSolid::triangular_lattice(), 1.0}});
            if (!first) law(model);
        });
    };
    const auto potentials = [](const DensityPotentials& p) {
        return [p](ParticleModel<2>& model) { model.add_term<DensityPotentialTerm<2>>(p); };
    };
    const auto ranges = [](ParticleModel<2>& model) {
        model.add_term<OwnRanges<2>>(Fluid{GammaGas{2.0}}, VariableRangeScheme{3.0, Kernel::w4});
    };
    for (const bool first : {false, true}) {
        BOOST_TEST(has(composed(true, first, potentials(surface)), "leave it out"));
        BOOST_TEST(has(composed(true, first, potentials(core)), "leave it out"));
        BOOST_TEST(has(composed(true, first, ranges), "leave it out"));
        BOOST_TEST(composed(false, first, potentials(surface)) == "accepted");
    }
}
