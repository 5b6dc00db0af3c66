// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever an external gives to momentum, angular momentum and energy is booked, for every law of
// particles, so that what is left is kept as without it; what is not booked is found.
#include "rhs/combinations.hpp"
#include <spam/integrate/integrator.hpp>

#include <fmt/format.h>

using namespace spam;
using namespace spam::test;

namespace {

template <int Dim>
Group end_of(const Sample<Dim>& s) {
    return select<Dim>(s.model.particles(), [](const Point<Dim>& x) { return x.x() < 1.2; });
}
/// Along a parabola, or along a curve: y = 0.01 t^2 or 0.02 (1 - cos t).
template <int Dim>
std::unique_ptr<Clamp<Dim>> driven_end(const Sample<Dim>& s, bool curved = false) {
    return std::make_unique<Clamp<Dim>>(
        end_of(s),
        [=](double t) {
            return point<Dim>(0.01 * t, 0.02 * (curved ? std::sin(t) : t), -0.01 * t);
        },
        [=](double t) { return point<Dim>(0.01, 0.02 * (curved ? std::cos(t) : 1.0), -0.01); });
}

/// What acts on a part of the particles; the rest: combined_laws.hpp.
template <int Dim>
const std::map<std::string, Add<Dim>> on_a_part{
    {"load",
     [](Sample<Dim>& s) {
         add_external<Load<Dim>>(
             s,
             [](double t) {
                 return point<Dim>(0.01 * std::sin(t), 0.02 * std::cos(2.0 * t), 0.01);
             },
             select<Dim>(s.model.particles(), [](const Point<Dim>& x) { return x.x() > 2.0; }));
     }},
    {"clamped end under its own weight",
     [](Sample<Dim>& s) {
         add_external<Gravity<Dim>>(s, point<Dim>(0.0, -0.01, 0.005));
         add_external<Clamp<Dim>>(s, end_of(s));
     }},
    {"end driven along an axis",
     [](Sample<Dim>& s) {
         auto clamp = driven_end(s);
         clamp->only_along(0);
         s.model.add(std::move(clamp));
     }},
    {"driven end", [](Sample<Dim>& s) { s.model.add(driven_end(s)); }}};

template <int Dim>
void accounts_close() {
    Laws<Dim> laws = all_laws<Dim>();
    laws["solid, averaged velocity and balanced torques"] = [](Sample<Dim>& s, const Scheme&) {
        with_scheme<Dim>().at("SmoothParticles, solid")(
            s, {.transport = Transport::average, .angular_momentum = AngularMomentum::torque_pair});
    };
    for (const auto& [law, build] : laws)
        for (const auto& [external, add] : on_a_part<Dim>)
            BOOST_TEST_CONTEXT(law << ", " << external) {
                const Row row = combine<Dim>(build, further<Dim>().at(""), {}, add);
                BOOST_TEST(row.refused == "");
                BOOST_TEST(row.momentum < 1e-11);
                BOOST_TEST(row.energy < 1e-9);
                if (row.turns) BOOST_TEST(row.angular_momentum < 1e-10);
            }
}

/// A body of springs on its way to t.
template <int Dim>
struct Springy {
    Sample<Dim> sample;
    std::unique_ptr<Motion<Dim>> motion;
    Invariants<Dim> before, after;

    Springy(const Add<Dim>& external, const IntegratorOptions& options, double t) {
        add_springs(sample);
        external(sample);
        motion = std::make_unique<Motion<Dim>>(sample.model, sample.start(), options);
        before = measure_invariants<Dim>(sample.model, motion->y());
        motion->advance_to(t);
        after = measure_invariants<Dim>(sample.model, motion->y());
    }
};

/// Does nothing, gives nothing, and is booked; or kicks without its potential being told.
template <int Dim>
class Secret final : public External<Dim> {
  public:
    explicit Secret(double kick) : kick_(kick) {}
    void add(const typename External<Dim>::Now& now, Eigen::Index first,
             Eigen::Index last) const override {
        now.rate.velocity().row(1).segment(first, last - first).array() -= kick_;
    }
    bool potential() const override { return true; }  // but no energy
    std::string describe() const override { return "secret"; }

  private:
    double kick_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(accounts_close_for_every_law_and_every_external) {
    accounts_close<2>();
    accounts_close<3>();
}

/// The mutated law: as if gravity had a potential of its own and forgot it.
BOOST_AUTO_TEST_CASE_TEMPLATE(what_is_not_booked_is_missed, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    const Row row =
        combine<Dim>(with_scheme<Dim>().at("SmoothParticles, solid"), further<Dim>().at(""), {},
                     [](Sample<Dim>& s) { add_external<Secret<Dim>>(s, 0.01); });
    BOOST_TEST(row.momentum < 1e-11);
    BOOST_TEST(row.energy > 1e-4);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(driven_particles_follow_their_motion, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    const Springy<Dim> body([](Sample<Dim>& s) { s.model.add(driven_end(s, true)); },
                            {.method = "arkode:DORMAND_PRINCE_7_4_5", .dt = {}, .rtol = 1e-10},
                            2.0);
    const Group end = end_of(body.sample);
    const Points<Dim> moved =
        body.motion->state().position() - body.sample.model.particles().reference_position;
    const auto expected = point<Dim>(0.02, 0.02 * (1.0 - std::cos(2.0)), -0.02);
    int driven = 0;
    for (Eigen::Index i = 0; i < moved.cols(); ++i) {
        if (!is_in(end, i)) continue;
        ++driven;
        BOOST_TEST((moved.col(i) - expected).norm() < 1e-9);
    }
    BOOST_TEST(driven > 4);
    BOOST_TEST(std::abs(body.after.work) > 1e-5);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_thermostat_reaches_its_temperature_and_its_heat_is_booked, In,
                              PlaneAndSpace) {
    constexpr int Dim = In::value;
    const Springy<Dim> body([](Sample<Dim>& s) { add_external<Thermostat<Dim>>(s, 0.01, 1.0); },
                            {.method = "rk4", .dt = 0.05}, 40.0);
    const auto n = static_cast<double>(body.sample.model.particles().size());
    const double mean = 0.5 * body.after.momentum.squaredNorm() / n;  // of masses 1
    BOOST_TEST(std::abs((body.after.kinetic - mean) / (0.5 * Dim * (n - 1.0)) / 0.01 - 1.0) < 0.3);
    BOOST_TEST(body.after.heat > 0.3 * body.after.kinetic);
    BOOST_TEST(body.after.work == 0.0);
}

/// Leapfrog and its relatives keep p and L with a force from outside, too.
BOOST_AUTO_TEST_CASE_TEMPLATE(accounts_take_the_kicks_of_velocities, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    const Springy<Dim> body(externals<Dim>().at("Gravity"), {.method = "leapfrog", .dt = 0.1},
                            50.0);
    const auto &before = body.before, &after = body.after;
    BOOST_TEST(after.momentum.norm() > 1.0);
    BOOST_TEST((after.momentum_balance() - before.momentum_balance()).norm() < 1e-12);
    BOOST_TEST((after.angular_momentum_balance() - before.angular_momentum_balance()).norm() <
               1e-10);
    BOOST_TEST(std::abs(after.energy_balance() - before.energy_balance()) < 1e-3 * after.kinetic);
}

/// Adaptive steps do not depend on accounts.
BOOST_AUTO_TEST_CASE_TEMPLATE(accounts_have_no_say_in_steps, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    const auto steps = [](const Add<Dim>& add) {
        const Springy<Dim> body(add, {.method = "arkode:DORMAND_PRINCE_7_4_5", .dt = {}}, 5.0);
        return static_cast<double>(body.motion->statistics().steps);
    };
    const auto booked = [](Sample<Dim>& s) { add_external<Secret<Dim>>(s, 0.0); };
    BOOST_TEST(std::abs(steps(booked) - steps(externals<Dim>().at(""))) <= 2.0);  // N is larger
}

/// A group or a load of too few particles would be read beyond its end.
BOOST_AUTO_TEST_CASE_TEMPLATE(externals_of_another_number_of_particles_are_refused, In,
                              PlaneAndSpace) {
    constexpr int Dim = In::value;
    const Springy<Dim> body([](Sample<Dim>&) {}, {.method = "rk4", .dt = 0.1}, 0.1);
    ParticleModel<Dim> model(body.sample.model.particles(), {});
    const std::size_t n = model.particles().size();
    const auto constant = [](double) { return Point<Dim>(Point<Dim>::Zero()); };
    const auto with = [&](std::size_t size) {
        const auto columns = static_cast<Eigen::Index>(size);
        return std::vector<std::shared_ptr<External<Dim>>>{
            std::make_shared<Clamp<Dim>>(Group(size)),
            std::make_shared<Load<Dim>>(constant, Group(size)),
            std::make_shared<DistributedLoad<Dim>>([](double) { return 0.0; },
                                                   Points<Dim>(Points<Dim>::Zero(Dim, columns)))};
    };
    for (const std::size_t size : {n - 1, n + 1}) {
        const auto said = fmt::format("made for {} particles, and the model has {}", size, n);
        for (const auto& external : with(size))
            BOOST_CHECK_EXCEPTION(model.add(external), InputError, [&](const InputError& e) {
                return std::string(e.what()).find(said) != std::string::npos;
            });
    }
    for (const auto& external : with(n)) model.add(external);
    BOOST_TEST(model.externals().size() == 3u);
}
