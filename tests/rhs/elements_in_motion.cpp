// SPDX-License-Identifier: GPL-3.0-or-later
// Finite elements that move, yield and break: what they keep, and what settling after a step leaves alone.
#include "support/element_mesh.hpp"
#include "support/random_state.hpp"
#include <spam/core/parallel.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/problem/motion.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

const HourglassControl both{0.1, 0.1};

VelocityField<2> stirred(double speed) {
    return [speed](const Point<2>& x) {
        return Point<2>(speed * std::sin(0.5 * x.x()) - 0.02 * x.y(),
                        0.7 * speed * std::cos(0.7 * x.x()) * std::sin(0.6 * x.y()) + 0.02 * x.x());
    };
}

struct Drifts {
    double momentum, angular_momentum, energy, plastic_strain;
    std::size_t broken;
    std::vector<double> y;
};

Drifts drifts_of(ParticleModel<2>& model, double speed, double dt, double t_end,
                 const char* method = "rk4") {
    IntegratorOptions options;
    options.method = method;
    if (dt > 0.0) options.dt = dt;
    const auto y0 = start_of(model, stirred(speed));
    Motion<2> motion(model, y0, options);
    const auto before = measure_invariants<2>(model, y0);
    motion.advance_to(t_end);
    const auto after = measure_invariants<2>(model, motion.y());
    const ConstState<2> elements = motion.state().elements();
    return {(after.momentum - before.momentum).norm(),
            std::abs(after.angular_momentum[0] - before.angular_momentum[0]) /
                std::abs(before.angular_momentum[0]),
            std::abs(after.energy / before.energy - 1.0),
            elements.has(field_kind::plastic_strain)
                ? elements.field(field_kind::plastic_strain).maxCoeff()
                : 0.0,
            elements_broken(model, motion.y()),
            {motion.y().begin(), motion.y().end()}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(elastic_elements_keep_everything_to_the_order_of_the_integrator) {
    const auto model = model_of({distorted_mesh(10, 6)}, elastic, both);
    const Drifts coarse = drifts_of(*model, 0.05, 0.4, 20.0),
                 fine = drifts_of(*model, 0.05, 0.2, 20.0);
    BOOST_TEST(fine.momentum < 1e-13);
    BOOST_TEST(coarse.energy < 2e-4);
    BOOST_TEST(fine.energy < coarse.energy / 12.0);
    BOOST_TEST(fine.angular_momentum < coarse.angular_momentum / 12.0 + 1e-13);
}

BOOST_AUTO_TEST_CASE(plastic_flow_keeps_everything) {
    const auto model = model_of({distorted_mesh(10, 6)}, yielding(0.01), both);
    for (const char* method : {"rk4", "arkode:DORMAND_PRINCE_7_4_5", "gsl:rkf45"}) {
        const Drifts found =
            drifts_of(*model, 0.1, method == std::string("rk4") ? 0.1 : 0.0, 20.0, method);
        BOOST_TEST(found.plastic_strain > 0.05, method);
        BOOST_TEST(found.momentum < 1e-13, method);
        BOOST_TEST(found.angular_momentum < 1e-7, method);
        BOOST_TEST(found.energy < 1e-6, method);
    }
}

BOOST_AUTO_TEST_CASE(breaking_takes_nothing) {
    const auto model = model_of({distorted_mesh(10, 6)}, yielding(0.01, 0.06), both);
    const Drifts found = drifts_of(*model, 0.15, 0.1, 20.0);
    BOOST_TEST(found.broken > 3U);
    BOOST_TEST(found.broken < 60U);
    BOOST_TEST(found.momentum < 1e-13);
    BOOST_TEST(found.angular_momentum < 1e-7);
    BOOST_TEST(found.energy < 1e-6);
    // For good: no stress, no force, no rate.
    const auto rates = rates_of(*model, found.y);
    const ConstState<2> now = ConstState<2>(model->layout(), found.y).elements(),
                        rate = ConstState<2>(model->layout(), rates).elements();
    for (Eigen::Index k = 0; k < now.stress().cols(); ++k) {
        if (now.field(field_kind::broken)(0, k) == 0.0) continue;
        BOOST_TEST(now.stress().col(k).norm() == 0.0);
        BOOST_TEST(now.field(field_kind::hourglass_force).col(k).norm() == 0.0);
        BOOST_TEST(rate.stress().col(k).norm() == 0.0);
        BOOST_TEST(rate.energy()(0, k) == 0.0);
        BOOST_TEST(rate.field(field_kind::hourglass_force).col(k).norm() == 0.0);
    }
}

BOOST_AUTO_TEST_CASE(nodes_of_broken_elements_alone_fly_on) {
    const auto model = model_of({rectangle_mesh(1, 1)}, yielding(0.01, 0.05), both);
    const auto y0 = start_of(*model, [](const Point<2>& x) { return Point<2>(0.3 * x.x(), 0.0); });
    IntegratorOptions options;
    options.dt = 0.01;
    Motion<2> motion(*model, y0, options);
    motion.advance_to(5.0);
    BOOST_TEST(elements_broken(*model, motion.y()) == 1U);
    const auto rates = rates_of(*model, motion.y());
    BOOST_TEST(ConstState<2>(model->layout(), rates).velocity().norm() == 0.0);
    const auto now = measure_invariants<2>(*model, motion.y());
    BOOST_TEST(now.mass == lattice_density);
    BOOST_TEST(now.internal > 0.0);
    BOOST_TEST(std::abs(now.energy / measure_invariants<2>(*model, y0).energy - 1.0) < 1e-6);
}

BOOST_AUTO_TEST_CASE(settling_changes_no_rate) {
    const auto model = model_of({distorted_mesh(9, 6)}, yielding(0.03), both);
    auto y = random_elements(*model, 0.1);
    const auto before = rates_of(*model, y);
    BOOST_TEST(model->settles());
    BOOST_TEST(model->settle(0.0, y));
    BOOST_TEST(relative_difference(rates_of(*model, y), before) < 1e-13);
    BOOST_TEST(!model->settle(0.0, y) | (relative_difference(rates_of(*model, y), before) < 1e-13));
    const auto stress = ConstState<2>(model->layout(), y).elements().stress();
    const auto strain =
        ConstState<2>(model->layout(), y).elements().field(field_kind::plastic_strain);
    for (Eigen::Index k = 0; k < stress.cols(); ++k)
        BOOST_TEST(std::hypot(stress(0, k) - stress(1, k), 2.0 * stress(2, k)) <
                   (0.03 + 0.02 * strain(0, k)) * (1.0 + 1e-12));
}

BOOST_AUTO_TEST_CASE(what_is_remembered_half_way_leads_to_the_same_bits) {
    for (const char* method : {"rk4", "arkode:DORMAND_PRINCE_7_4_5"}) {
        IntegratorOptions options;
        options.method = method;
        if (options.method == "rk4") options.dt = 0.1;
        const auto made = [] {
            return model_of({distorted_mesh(10, 6)}, yielding(0.01, 0.06), both);
        };
        const auto model = made(), again = made();
        Motion<2> whole(*model, start_of(*model, stirred(0.15)), options);
        whole.advance_to(4.0);
        Archive written;
        whole.remember(written);
        const std::vector<double> y_half(whole.y().begin(), whole.y().end());
        {
            Archive reading(written.bytes());  // as a run does that writes a checkpoint
            whole.remember(reading);
        }
        whole.advance_to(9.0);
        start_of(*again, stirred(0.15));  // its scales
        Motion<2> restarted(*again, y_half, options, 4.0);
        Archive reading(written.bytes());
        restarted.remember(reading);
        restarted.advance_to(9.0);
        BOOST_TEST(std::equal(whole.y().begin(), whole.y().end(), restarted.y().begin()), method);
    }
}
