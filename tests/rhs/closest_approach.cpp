// SPDX-License-Identifier: GPL-3.0-or-later
// The restriction of the distance of closest approach: collisions of free particles (a solid without
// stiffness has no stress) against what mechanics says, gases, and the rotating hexagon.
#include "support/effort.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/shape.hpp>
#include <spam/external/friction.hpp>
#include <spam/integrate/driver.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/physics/closest_approach.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace spam;

namespace {

IntegratorOptions with(const std::string& method, std::optional<double> dt) {
    IntegratorOptions options;
    options.method = method;
    options.dt = dt;
    options.rtol = 1e-10;
    options.atol = 1e-12;
    return options;
}

/// Fixed and adaptive; Verner's table goes through ARKStep.
const std::vector<IntegratorOptions> methods{with("rk4", 0.1),
                                             with("rk4", 1.3),
                                             with("arkode:ZONNEVELD_5_3_4", 0.1),
                                             with("arkode:VERNER_8_5_6", 0.1),
                                             with("arkode:DORMAND_PRINCE_7_4_5", std::nullopt),
                                             with("arkode:VERNER_8_5_6", std::nullopt)};

const Scheme touching{.density = Density::summed, .closest_approach = 0.5, .range = 1.5};

/// A run of any model with its events; `jumps`: the largest change of invariants at an event.
struct Collisions {
    const SundialsContext context;
    Model<2>& model;
    std::size_t pairs = 0;
    Ode ode;
    Vector y;
    std::unique_ptr<Integrator> integrator;
    std::vector<double> times;
    Invariants<2> jump{};
    double closest = 1e300;  ///< after steps

    Collisions(Model<2>& m, const std::vector<double>& y0, const IntegratorOptions& options)
        : model(m),
          y(y0.size(), context) {
        std::copy(y0.begin(), y0.end(), y.span().begin());
        ode = as_ode(model, options, pairs);
        for (Event& event : ode.events) event = observed(std::move(event));
        integrator = make_integrator(options, ode, y, 0.0, context);
    }

    Event observed(Event event) {
        event.apply = [this, apply = event.apply](double t, std::span<double> z) {
            const auto before = measure_invariants(model, z);
            const std::size_t n = apply(t, z);
            const auto after = measure_invariants(model, z);
            times.insert(times.end(), n, t);
            const auto largest = [](double& most, double a, double b) {
                most = std::max(most, std::abs(a - b));
            };
            largest(jump.energy, before.energy, after.energy);
            for (int a = 0; a < 2; ++a)
                largest(jump.momentum[a], before.momentum[a], after.momentum[a]);
            largest(jump.angular_momentum[0], before.angular_momentum[0],
                    after.angular_momentum[0]);
            return n;
        };
        return event;
    }

    void run(double t_end, double spacing = 1.0) {
        Observers observers;
        observers.step = [&](double) {
            const Points<2> x = ConstState<2>(model.layout(), y.span()).position();
            closest = std::min(closest, closest_pair<2>(x, spacing, model.box()));
        };
        drive(*integrator, {t_end, t_end, t_end}, observers);
    }
    ConstState<2> state() const { return {model.layout(), y.span()}; }
    void check_jumps(double size) const {
        BOOST_TEST(jump.energy < size);
        BOOST_TEST(jump.momentum.norm() < size);
        BOOST_TEST(std::abs(jump.angular_momentum[0]) < size);
    }
};

Particles<2> free_particles(const Points<2>& x, const std::vector<double>& mass) {
    Particles<2> particles;
    particles.mass = mass;
    for (std::size_t k = 0; k < mass.size(); ++k) particles.id.push_back(static_cast<int>(k));
    particles.body.assign(mass.size(), 0);
    particles.reference_position = x;
    return particles;
}

std::vector<double> start(Model<2>& model, const Points<2>& v) {
    auto y0 = initial_state<2>(model, 1.0, 1.0, [](const Point<2>&) { return Point<2>(0, 0); });
    State<2>(model.layout(), y0).velocity() = v;
    return y0;
}

/// One collision of two particles at distance R, by hand. `r`, `v` of the first minus the second.
struct ByHand {
    double t;
    Point<2> r, impulse;

    ByHand(Point<2> r_0, const Point<2>& v, double R, double m_1, double m_2) {
        const double b = r_0.dot(v), a = v.squaredNorm(), c = r_0.squaredNorm() - R * R;
        t = c / (-b + std::sqrt(b * b - a * c));
        r = r_0 + t * v;
        impulse = -2.0 * (m_1 * m_2 / (m_1 + m_2)) * (v.dot(r) / (R * R)) * r;
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(two_particles_collide_as_mechanics_says) {
    struct Setting {
        const char* what;
        Point<2> x_2, v_1, v_2;
        double m_1, m_2;
    };
    const std::vector<Setting> settings{
        {"head on", {1.2, 0.0}, {0.3, 0.0}, {-0.4, 0.0}, 1.0, 1.0},
        {"oblique", {1.1, 0.7}, {0.5, 0.2}, {-0.3, -0.15}, 1.0, 1.0},
        {"unequal masses", {1.1, 0.7}, {0.5, 0.2}, {-0.3, -0.15}, 0.3, 2.5},
        {"one at rest", {0.9, -0.8}, {0.6, -0.45}, {0.0, 0.0}, 1.0, 4.0},
        {"grazing, within a step", {1.5, 0.49}, {1.9, 0.0}, {-1.9, 0.0}, 1.0, 2.0},
        {"image", {9.2, 0.3}, {-0.5, 0.1}, {0.4, 0.05}, 1.0, 2.0},
        {"image, far from home", {9.2 + 50.0, 0.3 - 80.0}, {-0.5, 0.1}, {0.4, 0.05}, 1.0, 2.0}};
    for (const Setting& s : settings) {
        Points<2> x(2, 2), v(2, 2);
        x << 0.0, s.x_2[0], 0.0, s.x_2[1];
        v << s.v_1[0], s.v_2[0], s.v_1[1], s.v_2[1];
        Point<2> r = -s.x_2;  // nearest image in a box of length 10
        for (int a = 0; a < 2; ++a) r[a] -= 10.0 * std::nearbyint(r[a] / 10.0);
        const ByHand hand(r, s.v_1 - s.v_2, 0.5, s.m_1, s.m_2);
        const double t_end = hand.t + 0.777;
        // Found some 1e-12 R too far out: the more oblique, the more that turns the impulse.
        const double tolerance =
            5e-12 * 0.5 * (s.v_1 - s.v_2).norm() / std::abs((s.v_1 - s.v_2).dot(hand.r));
        for (const auto& options : methods) {
            BOOST_TEST_CONTEXT(s.what << ", " << options.describe()) {
                SmoothParticleModel<2> model(free_particles(x, {s.m_1, s.m_2}),
                                             ElasticSolid{0.0, 0.0}, touching,
                                             Box<2>({10.0, 10.0}));
                Collisions run(model, start(model, v), options);
                run.run(t_end);
                BOOST_TEST(run.times.size() == 1U);
                BOOST_TEST(std::abs(run.times.at(0) - hand.t) < tolerance);
                BOOST_TEST(run.integrator->statistics().events == 1U);
                const Point<2> v_1 = s.v_1 + hand.impulse / s.m_1,
                               v_2 = s.v_2 - hand.impulse / s.m_2;
                BOOST_TEST((run.state().velocity().col(0) - v_1).norm() < tolerance);
                BOOST_TEST((run.state().velocity().col(1) - v_2).norm() < tolerance);
                const Point<2> x_1 = hand.t * s.v_1 + 0.777 * v_1,
                               x_2 = s.x_2 + hand.t * s.v_2 + 0.777 * v_2;
                BOOST_TEST((run.state().position().col(0) - x_1).norm() < tolerance);
                BOOST_TEST((run.state().position().col(1) - x_2).norm() < tolerance);
                if (s.what[0] != 'i') run.check_jumps(1e-13);  // L has no meaning across images
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(pairs_that_are_nearer_from_the_start_are_left_alone) {
    Points<2> x(2, 2), v(2, 2);
    x << 0.0, 0.4, 0.0, 0.0;
    v << 0.1, -0.1, 0.0, 0.03;
    for (const auto& options : methods) {
        SmoothParticleModel<2> model(free_particles(x, {1.0, 1.0}), ElasticSolid{0.0, 0.0},
                                     touching);
        Collisions run(model, start(model, v), options);
        run.run(10.0);
        BOOST_TEST(run.times.empty());
        BOOST_TEST((run.state().velocity() - v).norm() == 0.0);
    }
}

BOOST_AUTO_TEST_CASE(three_at_once) {
    // The one in the middle is hit from both sides; then three that meet at 120 degrees.
    for (const auto& options : methods) {
        BOOST_TEST_CONTEXT(options.describe()) {
            Points<2> x(2, 3), v(2, 3);
            x << -1.0, 0.0, 1.0, 0.0, 0.0, 0.0;
            v << 0.25, 0.0, -0.25, 0.0, 0.0, 0.0;
            SmoothParticleModel<2> line(free_particles(x, {1.0, 1.0, 1.0}), ElasticSolid{0.0, 0.0},
                                        touching);
            Collisions run(line, start(line, v), options);
            run.run(5.0);
            BOOST_TEST((run.state().velocity() + v).norm() < 1e-13);
            BOOST_TEST(std::abs(run.times.at(0) - 2.0) < 1e-11);
            run.check_jumps(1e-13);

            const double s = std::sqrt(0.75);
            x << 1.0, -0.5, -0.5, 0.0, s, -s;
            SmoothParticleModel<2> star(free_particles(x, {1.0, 1.0, 1.0}), ElasticSolid{0.0, 0.0},
                                        touching);
            Collisions meeting(star, start(star, -0.3 * x), options);
            meeting.run(6.0);
            BOOST_TEST(meeting.times.size() >= 3U);
            BOOST_TEST(meeting.closest > 0.5 - 1e-12);
            meeting.check_jumps(1e-13);
        }
    }
}

namespace {

/// 49 free particles of unequal mass in a periodic box, density 1.
struct Gas {
    Box<2> box{std::array<double, 2>{7.0, 7.0}};
    std::unique_ptr<SmoothParticleModel<2>> model;
    Points<2> v;
    std::vector<double> y0;

    explicit Gas(Scheme scheme = touching) {
        std::mt19937_64 random(7);
        std::normal_distribution<double> g;
        const Points<2> x = square_lattice<2>({7, 7});
        v.resize(2, x.cols());
        for (double& c : v.reshaped()) c = g(random);
        std::vector<double> mass;
        for (Eigen::Index i = 0; i < x.cols(); ++i)
            mass.push_back(1.0 + 0.3 * std::tanh(g(random)));
        model = std::make_unique<SmoothParticleModel<2>>(free_particles(x, mass),
                                                         ElasticSolid{0.0, 0.0}, scheme, box);
        y0 = start(*model, v);
    }
    void add(std::unique_ptr<External<2>> external) {
        model->add(std::move(external));
        y0 = start(*model, v);
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_gas_keeps_energy_and_momentum_through_hundreds_of_events) {
    for (const auto& options : methods) {
        BOOST_TEST_CONTEXT(options.describe()) {
            Gas gas;
            Collisions run(*gas.model, gas.y0, options);
            const auto before = measure_invariants(*gas.model, gas.y0);
            run.run(test::effort(10.0, 3.0));
            const auto after = measure_invariants(*gas.model, run.y.span());
            BOOST_TEST_MESSAGE(options.describe() << ": " << run.times.size() << " events, "
                                                  << run.integrator->statistics().rhs_evaluations
                                                  << " right-hand sides");
            BOOST_TEST(run.times.size() > test::effort(300U, 80U));
            BOOST_TEST(run.times.size() == run.integrator->statistics().events);
            BOOST_TEST(std::abs(after.energy - before.energy) < 1e-12 * before.energy);
            BOOST_TEST((after.momentum - before.momentum).norm() < 1e-12);
            BOOST_TEST(run.closest > 0.5 - 1e-12);  // no pair slips through
        }
    }
}

BOOST_AUTO_TEST_CASE(a_gas_is_reflected_under_friction_too) {
    for (const auto& options : methods) {
        BOOST_TEST_CONTEXT(options.describe()) {
            Gas gas;
            gas.add(std::make_unique<Friction<2>>(0.05, FrictionOf::all_motion));
            Collisions run(*gas.model, gas.y0, options);
            run.run(5.0);
            BOOST_TEST(run.times.size() > 100U);
            BOOST_TEST(run.times.size() == run.integrator->statistics().events);
            BOOST_TEST(run.closest > 0.5 - 1e-12);
            BOOST_TEST(run.jump.energy < 1e-12);
            BOOST_TEST(run.jump.momentum.norm() < 1e-12);  // L has no meaning across images
        }
    }
    Gas gas;
    gas.add(std::make_unique<Friction<2>>(0.05));
    BOOST_CHECK_THROW(Collisions(*gas.model, gas.y0, with("cvode:adams", std::nullopt)),
                      InputError);
}

BOOST_AUTO_TEST_CASE(integrators_agree_on_the_events_of_a_gas) {
    // Until chaos has made rounding visible: it grows by about ten in a unit of time.
    Gas reference_gas;
    Collisions reference(*reference_gas.model, reference_gas.y0, methods.front());
    reference.run(3.0);
    BOOST_TEST(reference.times.size() > 80U);
    for (const auto& options : methods) {
        BOOST_TEST_CONTEXT(options.describe()) {
            Gas gas;
            Collisions run(*gas.model, gas.y0, options);
            run.run(3.0);
            BOOST_TEST(run.times.size() == reference.times.size());
            double largest = 0.0;
            for (std::size_t k = 0; k < std::min(run.times.size(), reference.times.size()); ++k)
                largest = std::max(largest, std::abs(run.times[k] - reference.times[k]));
            BOOST_TEST_MESSAGE(options.describe() << ": event times differ by " << largest);
            BOOST_TEST(largest < 1e-6);
            BOOST_TEST((run.state().position() - reference.state().position()).norm() < 1e-6);
        }
    }
}
