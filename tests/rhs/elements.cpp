// SPDX-License-Identifier: GPL-3.0-or-later
// Finite elements at one time: exact for linear velocities and uniform stresses, no sum and no torque of their
// forces, the same in every frame and with any number of threads; the hourglass and what resists it.
#include "support/element_mesh.hpp"
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/core/parallel.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

const HourglassControl both{0.3, 0.2};

Eigen::Matrix2d stress_matrix(const Eigen::Vector3d& s) {
    return (Eigen::Matrix2d() << s[0], s[2], s[2], s[1]).finished();
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_linear_velocity_field_gives_the_exact_rate_of_stress) {
    const auto model = model_of({distorted_mesh(7, 5)}, elastic, both);
    Eigen::Matrix2d L;
    L << 0.3, -0.2, 0.7, 0.1;  // v = L x + b
    auto y =
        start_of(*model, [&](const Point<2>& x) { return Point<2>(L * x + Point<2>(0.4, -1.0)); });
    const Eigen::Vector3d sigma(0.05, -0.02, 0.03);
    State<2>(model->layout(), y).elements().stress().colwise() = sigma;
    const auto rates = rates_of(*model, y);
    const Eigen::Matrix2d D = 0.5 * (L + L.transpose()), W = 0.5 * (L - L.transpose()),
                          s = stress_matrix(sigma);
    const Eigen::Matrix2d exact =
        0.5 * D.trace() * Eigen::Matrix2d::Identity() + 2.0 * 0.4 * D + W * s - s * W;
    const ConstState<2> rate(model->layout(), rates), elements = rate.elements();
    for (Eigen::Index k = 0; k < elements.stress().cols(); ++k)
        BOOST_TEST((stress_matrix(elements.stress().col(k)) - exact).norm() < 1e-14);
    BOOST_TEST(elements.field(field_kind::hourglass_force).norm() < 1e-13);
}

BOOST_AUTO_TEST_CASE(a_uniform_stress_leaves_inner_nodes_alone) {
    const auto model = model_of({distorted_mesh(7, 5)}, elastic, both);
    auto y = start_of(*model, at_rest<2>());
    State<2>(model->layout(), y).elements().stress().colwise() = Eigen::Vector3d(0.5, -0.2, 0.3);
    const auto rates = rates_of(*model, y);
    const auto v_dot = ConstState<2>(model->layout(), rates).velocity();
    const auto& particles = model->particles();
    std::size_t inner = 0;
    for (Eigen::Index k = 0; k < v_dot.cols(); ++k) {
        const auto id = particles.id[static_cast<std::size_t>(k)];
        const auto column = id % 8, row = id / 8;
        const bool edge = column == 0 || column == 7 || row == 0 || row == 5;
        if (edge) continue;
        BOOST_TEST(v_dot.col(k).norm() < 1e-14);
        ++inner;
    }
    BOOST_TEST(inner == 24U);
    BOOST_TEST(v_dot.norm() > 0.1);  // edges are not free of stress
}

BOOST_AUTO_TEST_CASE(forces_have_no_sum_no_torque_and_their_power_is_the_elements_energy) {
    const auto model = model_of({distorted_mesh(9, 6)}, yielding(0.05), both);
    const auto y = random_elements(*model, 0.2);
    const auto rates = rates_of(*model, y);
    const ConstState<2> state(model->layout(), y), rate(model->layout(), rates);
    Point<2> sum = Point<2>::Zero();
    double torque = 0.0, power = 0.0, most = 0.0;
    for (Eigen::Index k = 0; k < rate.velocity().cols(); ++k) {
        const Point<2> force =
            model->particles().mass[static_cast<std::size_t>(k)] * rate.velocity().col(k);
        const Point<2> x = state.position().col(k), v = state.velocity().col(k);
        sum += force;
        torque += x.x() * force.y() - x.y() * force.x();
        power += force.dot(v);
        most += force.norm();
    }
    const auto& mass = model->term<Elements>()->mass();
    for (std::size_t k = 0; k < mass.size(); ++k)
        power += mass[k] * rate.elements().energy()(0, static_cast<Eigen::Index>(k));
    BOOST_TEST(sum.norm() < 1e-15 * most);
    BOOST_TEST(std::abs(torque) < 1e-14 * most);
    BOOST_TEST(std::abs(power) < 1e-15 * most);
    BOOST_TEST(rate.elements().energy().norm() > 1e-3);
}

BOOST_AUTO_TEST_CASE(what_is_turned_has_turned_rates) {
    const auto model = model_of({distorted_mesh(6, 4)}, yielding(0.05), both);
    const auto y = random_elements(*model, 0.2);
    auto turned = y;
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(0.7).toRotationMatrix();
    const auto turn = [&](std::vector<double>& all) {
        const State<2> s(model->layout(), all), e = s.elements();
        s.position() = (R * s.position()).eval();
        s.velocity() = (R * s.velocity()).eval();
        auto Q = e.field(field_kind::hourglass_force);
        Q = (R * Q).eval();
        for (Eigen::Index k = 0; k < e.stress().cols(); ++k) {
            const Eigen::Matrix2d sigma = R * stress_matrix(e.stress().col(k)) * R.transpose();
            e.stress().col(k) << sigma(0, 0), sigma(1, 1), sigma(0, 1);
        }
    };
    turn(turned);
    auto expected = rates_of(*model, y);
    turn(expected);
    BOOST_TEST(relative_difference(rates_of(*model, turned), expected) < 1e-13);
}

BOOST_AUTO_TEST_CASE(an_hourglass_meets_what_resists_it_and_nothing_else) {
    for (const auto& control :
         {HourglassControl{}, HourglassControl{0.2, 0.0}, HourglassControl{0.0, 0.4}}) {
        const auto model = model_of({rectangle_mesh(4, 4)}, elastic, control);
        auto y = start_of(*model, [](const Point<2>& x) {
            return Point<2>(std::lround(x.x() + x.y() + 8.0) % 2 == 0 ? 1.0 : -1.0, 0.0);
        });
        const auto rates = rates_of(*model, y);
        const ConstState<2> state(model->layout(), y), rate(model->layout(), rates);
        BOOST_TEST(rate.elements().stress().norm() == 0.0);
        const double c = elastic.sound_speed(lattice_density);
        // Every node: 16 C/M of an element, C = viscosity rho sqrt(A) c/4.
        const Points<2> braked = -4.0 * control.viscosity * c * state.velocity();
        BOOST_TEST((rate.velocity() - braked).norm() < 1e-13);
        if (control.stiffness > 0.0)
            for (Eigen::Index k = 0; k < 16; ++k)
                BOOST_TEST(
                    std::abs(std::abs(rate.elements().field(field_kind::hourglass_force)(0, k)) -
                             0.4 * lattice_density * c * c) < 1e-14);
        BOOST_TEST(std::abs(model->fastest_damping(y) - 4.0 * control.viscosity * c) < 1e-13);
        // Also asked for without a state, of bodies at rest.
        BOOST_TEST(std::abs(model->fastest_damping({}) - 4.0 * control.viscosity * c) < 1e-13);
    }
}

BOOST_AUTO_TEST_CASE(each_element_has_the_law_of_its_material) {
    MeshedBodies bodies = make_nodes({distorted_mesh(6, 4)}, lattice_density);
    std::vector<std::int32_t> material(bodies.element.size());
    for (std::size_t k = 0; k < material.size(); ++k) material[k] = k % 3 == 0 ? 1 : 0;
    ParticleModel<2> model(bodies.nodes);
    model.add_term<Elements>(bodies.element,
                             std::vector<Elements::Material>{{elastic, lattice_density, {}},
                                                             {yielding(0.05), lattice_density, {}}},
                             material);
    const auto y = random_elements(model, 0.2);
    const auto soft = model_of({distorted_mesh(6, 4)}, yielding(0.05)),
               hard = model_of({distorted_mesh(6, 4)}, elastic);
    const auto of = [&](ParticleModel<2>& alone) {
        std::vector<double> z(alone.layout().size(), 0.0);
        const State<2> to(alone.layout(), z);
        const ConstState<2> from(model.layout(), y);
        to.position() = from.position();
        to.velocity() = from.velocity();
        to.elements().stress() = from.elements().stress();
        if (to.elements().has(field_kind::plastic_strain))
            to.elements().field(field_kind::plastic_strain) =
                from.elements().field(field_kind::plastic_strain);
        return rates_of(alone, z);
    };
    const auto rates = rates_of(model, y), yields = of(*soft), stretches = of(*hard);
    const auto stress = ConstState<2>(model.layout(), rates).elements().stress();
    double apart = 0.0;
    for (std::size_t k = 0; k < material.size(); ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        const Eigen::Vector3d
            soft_rate = ConstState<2>(soft->layout(), yields).elements().stress().col(column),
            hard_rate = ConstState<2>(hard->layout(), stretches).elements().stress().col(column);
        BOOST_TEST((stress.col(column) - (material[k] == 1 ? soft_rate : hard_rate)).norm() == 0.0);
        apart = std::max(apart, (soft_rate - hard_rate).norm());
    }
    BOOST_TEST(apart > 1e-3);
}

/// Elements of the two colours of a chequerboard that turn against each other: s (x, -y), not s (-y, x), which
/// draws them out along x and along y in turn.
BOOST_AUTO_TEST_CASE(a_chequerboard_turns_without_resistance) {
    const auto model = model_of({rectangle_mesh(4, 4)}, elastic);
    const auto largest_rate = [&](const auto& field) {
        const auto y = start_of(*model, [&](const Point<2>& x) {
            const double s = std::lround(x.x() + x.y() + 8.0) % 2 == 0 ? 1.0 : -1.0;
            return Point<2>(s * field(x));
        });
        const auto rates = rates_of(*model, y);
        return ConstState<2>(model->layout(), rates).elements().stress().cwiseAbs().maxCoeff();
    };
    BOOST_TEST(largest_rate([](const Point<2>& x) { return Point<2>(x.x(), -x.y()); }) < 1e-15);
    BOOST_TEST(largest_rate([](const Point<2>& x) { return Point<2>(-x.y(), x.x()); }) > 0.1);
}

BOOST_AUTO_TEST_CASE(no_bit_depends_on_the_number_of_threads) {
    const auto model = model_of({distorted_mesh(60, 40)}, yielding(0.05), both);
    const auto y = random_elements(*model, 0.2);
    set_threads(1);
    const auto one = rates_of(*model, y);
    for (const int threads : {2, 3}) {
        set_threads(threads);
        BOOST_TEST((rates_of(*model, y) == one));
    }
    set_threads(1);
}

BOOST_AUTO_TEST_CASE(y_holds_fields_of_elements_beside_those_of_particles) {
    // A block of smooth particles beside a block of elements, both with stresses.
    MeshedBodies bodies = make_nodes({rectangle_mesh(3, 2)}, lattice_density);
    const std::size_t nodes = bodies.nodes.size();
    Particles<2> all = bodies.nodes;
    const auto block = make_particles<2>(triangular_block(6, 5), 1.0);
    all.reference_position.conservativeResize(2, static_cast<Eigen::Index>(nodes + block.size()));
    all.reference_position.rightCols(static_cast<Eigen::Index>(block.size())) =
        block.reference_position.colwise() + Point<2>(30.0, 0.0);
    for (std::size_t k = 0; k < block.size(); ++k) {
        all.mass.push_back(1.0);
        all.id.push_back(static_cast<std::int64_t>(nodes) + block.id[k]);
        all.body.push_back(1);
    }
    ParticleModel<2> model(all);
    model.add_term_among<Elements>(
        0, nodes, bodies.element,
        std::vector<Elements::Material>{{elastic, lattice_density, {0.1, 0.0}}});
    model.add_term_among<SmoothParticles<2>>(nodes, block.size(), elastic, Scheme{});
    const auto& layout = model.layout();
    BOOST_TEST(layout.elements() == 6U);
    BOOST_TEST(layout.find(Field::stress)->size == 3 * (nodes + block.size()));
    BOOST_TEST(layout.find(Field::stress, Holder::element)->size == 18U);
    BOOST_TEST(layout.find(Field::stress, Holder::element)->name() == "element_stress");

    auto y = start_of(model, [](const Point<2>& x) { return Point<2>(0.1 * x.x(), 0.0); });
    const auto rates = rates_of(model, y);
    const ConstState<2> rate(layout, rates);
    const auto of_particles = rate.stress().rightCols(static_cast<Eigen::Index>(block.size()));
    BOOST_TEST(of_particles.row(0).minCoeff() > 0.03);
    BOOST_TEST((rate.elements().stress().row(0).array() - 0.13).abs().maxCoeff() < 1e-14);
    BOOST_TEST(rate.stress().leftCols(static_cast<Eigen::Index>(nodes)).norm() == 0.0);

    std::size_t pairs = 0;
    const Ode ode = as_ode<2>(model, {}, pairs);
    const auto& stress = *layout.find(Field::stress, Holder::element);
    BOOST_TEST(ode.entry_name(stress.offset + 3 * 4 + 2) == "stress_xy of element 4");
    BOOST_TEST(ode.entry_name(layout.find(Field::stress)->offset + 3 * nodes) ==
               "stress_xx of particle " + std::to_string(all.id[nodes]));
}

BOOST_AUTO_TEST_CASE(a_mesh_that_makes_no_sense_is_refused) {
    const auto made = [](const Mesh& mesh, const Elements::Material& material, int times = 1) {
        MeshedBodies bodies = make_nodes({mesh}, 1.0);
        ParticleModel<2> model(bodies.nodes);
        for (int k = 0; k < times; ++k)
            model.add_term<Elements>(bodies.element, std::vector<Elements::Material>{material});
    };
    const Mesh good = rectangle_mesh(2, 2);
    const Elements::Material material{elastic, 1.0, {}};
    made(good, material);
    Mesh clockwise = good;
    std::swap(clockwise.element[2][0], clockwise.element[2][2]);
    std::swap(clockwise.element[2][0], clockwise.element[2][1]);
    std::swap(clockwise.element[2][2], clockwise.element[2][3]);
    for (auto& one : clockwise.element) one = {one[3], one[2], one[1], one[0]};
    BOOST_CHECK_THROW(made(clockwise, material), InputError);
    BOOST_CHECK_THROW(made(good, {elastic, 0.0, {}}), InputError);
    BOOST_CHECK_THROW(made(good, {elastic, 1.0, {-0.1, 0.0}}), InputError);
    BOOST_CHECK_THROW(made(good, {elastic, 1.0, {0.0, -0.1}}), InputError);
    BOOST_CHECK_THROW(made(good, material, 2), InputError);  // one term has all elements
    BOOST_CHECK_THROW(rectangle_mesh(0, 3), InputError);
    BOOST_CHECK_THROW(disk_mesh(4, 0.0), InputError);
}

BOOST_AUTO_TEST_CASE(an_element_turned_inside_out_is_named) {
    const auto model = model_of({rectangle_mesh(3, 3)}, elastic);
    auto y = start_of(*model, at_rest<2>());
    const auto corner = model->quadrilaterals()[4][0];
    State<2>(model->layout(), y).position().col(corner) += Point<2>(3.0, 3.0);
    const auto rates = rates_of(*model, y);
    BOOST_TEST(std::isnan(rates.front()));
    BOOST_TEST(model->failure() == "element 4 is turned inside out");
}

BOOST_AUTO_TEST_CASE(meshes_have_the_areas_of_what_they_fill) {
    const MeshedBodies disk = make_nodes({disk_mesh(14, 8.0), rectangle_mesh(80, 8)}, 2.0);
    BOOST_TEST(disk.element.size() == 836U);
    double ball = 0.0, plate = 0.0;
    for (std::size_t k = 0; k < disk.nodes.size(); ++k)
        (disk.nodes.body[k] == 0 ? ball : plate) += disk.nodes.mass[k];
    BOOST_TEST(std::abs(plate - 2.0 * 640.0) < 1e-9);
    BOOST_TEST(std::abs(ball / (2.0 * 64.0 * std::numbers::pi) - 1.0) < 0.02);
    BOOST_TEST(std::abs(disk_mesh(14, 8.0).node.colwise().norm().maxCoeff() - 8.0) < 1e-14);
}
