// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of bodies: forces and energy against every pair, which particles touch, what it keeps, threads, and
// what makes no sense.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/physics/density_potential.hpp>
#include <spam/rhs/contact.hpp>
#include <spam/rhs/particle_model.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

#include <numbers>
#include <numeric>

using namespace spam;
using namespace spam::test;

namespace {

const ContactScheme usual{.energy = 0.3, .range = 0.9};
const ContactScheme folding{.energy = 0.3, .range = 0.9, .folds_beyond = 2.5};

/// Three bodies through each other.
template <int Dim>
Particles<Dim> three_bodies(int cells, const Box<Dim>& box = {}, double jitter = 0.2) {
    auto all = joined<Dim>({jittered_particles<Dim>(cells, 11, jitter, box),
                            jittered_particles<Dim>(cells, 12, jitter, box),
                            jittered_particles<Dim>(cells, 13, jitter, box)});
    const std::size_t part = all.size() / 3;
    for (std::size_t i = 0; i < all.size(); ++i) {
        all.body[i] = static_cast<std::int32_t>(i / part);
        for (int a = 0; a < Dim; ++a)
            all.reference_position(a, static_cast<Eigen::Index>(i)) += 0.3 * all.body[i];
    }
    return all;
}

template <int Dim>
struct Touching {
    ParticleModel<Dim> model;
    const Contact<Dim>& contact;
    explicit Touching(Particles<Dim> particles, const ContactScheme& scheme = usual,
                      const Box<Dim>& box = {})
        : model(std::move(particles), box),
          contact(model.template add_term<Contact<Dim>>(scheme)) {}
};

/// The law as it is written, of every pair. `without_bodies`: a wrong one, which forgets the bodies of particles.
template <int Dim>
EnergyAndForces<Dim> oracle(const ParticleModel<Dim>& model, const ContactScheme& s,
                            std::span<const double> y, bool without_bodies = false) {
    const auto& p = model.particles();
    const Points<Dim> x = ConstState<Dim>(model.layout(), y).position();
    EnergyAndForces<Dim> sum{0.0, Points<Dim>::Zero(Dim, x.cols())};
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        for (Eigen::Index j = 0; j < x.cols(); ++j) {
            Point<Dim> r = x.col(i) - x.col(j),
                       R = p.reference_position.col(i) - p.reference_position.col(j);
            for (int a = 0; a < Dim; ++a) {
                const double shift = model.box().nearest_image(a, r[a]) - r[a];
                r[a] += shift;
                R[a] += shift;
            }
            const bool apart =
                without_bodies
                    ? i != j
                    : p.body[static_cast<std::size_t>(i)] != p.body[static_cast<std::size_t>(j)] ||
                          (s.folds_beyond > 0.0 && R.norm() > s.folds_beyond);
            const double q = 1.0 - r.squaredNorm() / (s.range * s.range);
            if (!apart || q <= 0.0) continue;
            sum.energy += 0.5 * s.energy * std::pow(q, 4);
            sum.force.col(i) += 8.0 * s.energy / (s.range * s.range) * std::pow(q, 3) * r;
        }
    return sum;
}

template <int Dim>
Points<Dim> forces(ParticleModel<Dim>& model, std::span<const double> y) {
    const auto rates = rates_of(model, y);
    Points<Dim> F = ConstState<Dim>(model.layout(), rates).velocity();
    for (Eigen::Index i = 0; i < F.cols(); ++i)
        F.col(i) *= model.particles().mass[static_cast<std::size_t>(i)];
    return F;
}

template <int Dim>
void every_pair(const ContactScheme& scheme, int cells, const Box<Dim>& box = {}) {
    Touching<Dim> touching(three_bodies<Dim>(cells, box), scheme, box);
    auto& model = touching.model;
    auto y = random_state(model, 21);
    const State<Dim> state(model.layout(), y);
    // Wherever the images are, and squeezed, so that bodies fold into themselves.
    for (double& x : state.position().reshaped())
        x = std::round(((box.periodic() ? 1.0 : 0.45) * x + 37.3) * 0x1p32) * 0x1p-32;
    const Points<Dim> F = forces(model, y);
    const auto exact = oracle<Dim>(model, scheme, y);
    BOOST_TEST(exact.energy > 1.0);
    BOOST_TEST((F - exact.force).cwiseAbs().maxCoeff() < 1e-13 * exact.force.cwiseAbs().maxCoeff());
    BOOST_TEST(std::abs(model.internal_energy(y) - exact.energy) < 1e-13 * exact.energy);
    BOOST_TEST((F - oracle<Dim>(model, scheme, y, true).force).norm() > 0.1 * F.norm());

    const double size = F.cwiseAbs().sum();
    BOOST_TEST(F.rowwise().sum().norm() < 1e-15 * size);
    const Points<Dim> x = state.position();
    const Eigen::Matrix<double, Dim, Dim> moment = x * F.transpose();
    if (!box.periodic()) BOOST_TEST((moment - moment.transpose()).norm() < 1e-13 * size);

    const Points<Dim> v = state.velocity();
    const auto energy_at = [&](double t) {
        auto moved = y;
        State<Dim>(model.layout(), moved).position() += t * v;
        return model.internal_energy(moved);
    };
    const double h = 1e-4, power = F.cwiseProduct(v).sum();
    const double change =
        (8.0 * (energy_at(h) - energy_at(-h)) - (energy_at(2 * h) - energy_at(-2 * h))) /
        (12.0 * h);
    BOOST_TEST(std::abs(change + power) < 1e-7 * size);
}

/// Two particles of unit mass, `reference` apart in the reference configuration.
Particles<2> two(double reference, bool of_one_body) {
    Particles<2> p;
    p.mass = {1.0, 1.0};
    p.id = {0, 1};
    p.body = {0, of_one_body ? 0 : 1};
    p.reference_position.resize(2, 2);
    p.reference_position << 0.0, reference, 0.0, 0.0;
    return p;
}
double push(const Particles<2>& particles, const ContactScheme& scheme, double distance) {
    Touching<2> touching(particles, scheme);
    std::vector<double> y(touching.model.layout().size());
    State<2>(touching.model.layout(), y).position()(0, 1) = distance;
    return forces(touching.model, y)(0, 1);
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_line) {
    every_pair<1>(usual, 30);
    every_pair<1>(folding, 30);
    every_pair<1>(folding, 30, periodic<1>(30.0));
}
BOOST_AUTO_TEST_CASE(in_the_plane) {
    every_pair<2>(usual, 9);
    every_pair<2>(folding, 9);
    every_pair<2>(usual, 12, Box<2>({12.0, 12.0 * std::sqrt(0.75)}));
    every_pair<2>(folding, 12, Box<2>({12.0, 0.0}));
}
BOOST_AUTO_TEST_CASE(in_space) {
    every_pair<3>(usual, 5);
    every_pair<3>(folding, 5, periodic<3>(5.0));
}

BOOST_AUTO_TEST_CASE(who_touches_whom) {
    const double pushed = 8.0 * 0.3 / 0.81 * std::pow(1.0 - 0.25 / 0.81, 3) * 0.5;
    const auto near = [](double a, double b) { return std::abs(a - b) < 1e-15; };
    BOOST_TEST(near(push(two(1.0, false), usual, 0.5), pushed));
    BOOST_TEST(push(two(1.0, false), usual, 0.9) == 0.0);
    BOOST_TEST(push(two(1.0, false), usual, 0.0) == 0.0);
    // Of one body: where it has folded.
    BOOST_TEST(push(two(1.0, true), folding, 0.5) == 0.0);
    BOOST_TEST(push(two(2.5, true), folding, 0.5) == 0.0);
    BOOST_TEST(near(push(two(2.6, true), folding, 0.5), pushed));
    BOOST_TEST(near(push(two(0.0, false), folding, 0.5), pushed));
}

// Bodies that are pressed together but do not touch feel nothing at all.
BOOST_AUTO_TEST_CASE(a_body_feels_nothing_of_itself) {
    auto particles = joined<2>({jittered_particles<2>(9, 31, 0.3), jittered_particles<2>(9, 32)});
    particles.reference_position.rightCols(81).row(0).array() += 30.0;
    particles.body.assign(162, 0);
    std::fill(particles.body.begin() + 81, particles.body.end(), 1);
    Touching<2> touching(particles);
    const auto y = random_state(touching.model, 33);
    BOOST_TEST(forces(touching.model, y).cwiseAbs().maxCoeff() == 0.0);
    BOOST_TEST(touching.model.internal_energy(y) == 0.0);
    BOOST_TEST(touching.contact.closest(y) == usual.range);
}

BOOST_AUTO_TEST_CASE(each_pair_to_the_last_bit) {
    // Pairs that meet no other particle, of unit mass.
    constexpr std::size_t n = 200;
    Particles<2> particles = two(0.0, false);
    std::vector<Particles<2>> pairs(n, particles);
    particles = joined<2>(pairs);
    std::mt19937_64 random(41);
    std::uniform_real_distribution<double> u(0.1, 0.6);
    Touching<2> touching(particles);
    std::vector<double> y(touching.model.layout().size());
    auto x = State<2>(touching.model.layout(), y).position();
    for (Eigen::Index k = 0; k < Eigen::Index{n}; ++k) {
        x.col(2 * k) = Point<2>(7.0 * static_cast<double>(k % 20) + u(random),
                                5.0 * static_cast<double>(k / 20) + u(random));
        x.col(2 * k + 1) = x.col(2 * k) + Point<2>(u(random), u(random) - 0.4);
    }
    const auto rates = rates_of(touching.model, y);
    const auto v_dot = ConstState<2>(touching.model.layout(), rates).velocity();
    int pushed = 0;
    for (Eigen::Index k = 0; k < Eigen::Index{n}; ++k) {
        BOOST_TEST((v_dot.col(2 * k) == -v_dot.col(2 * k + 1)));
        pushed += v_dot.col(2 * k).norm() > 0.0;
    }
    BOOST_TEST(pushed > 150);
}

BOOST_AUTO_TEST_CASE(the_closest_two_that_touch) {
    Touching<2> touching(three_bodies<2>(9), folding);
    const auto& p = touching.model.particles();
    auto y = random_state(touching.model, 51);
    State<2>(touching.model.layout(), y).position() *= 0.9;
    const auto x = ConstState<2>(touching.model.layout(), y).position();
    double least = folding.range;
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        for (Eigen::Index j = 0; j < i; ++j)
            if (p.body[static_cast<std::size_t>(i)] != p.body[static_cast<std::size_t>(j)] ||
                (p.reference_position.col(i) - p.reference_position.col(j)).norm() > 2.5)
                least = std::min(least, (x.col(i) - x.col(j)).norm());
    BOOST_TEST(std::abs(touching.contact.closest(y) - least) < 1e-14);
    BOOST_TEST(least < 0.5);
}

BOOST_AUTO_TEST_CASE(threads_leave_no_trace) {
    Touching<2> touching(three_bodies<2>(26), folding);
    BOOST_TEST(touching.model.particles().size() > parallel_threshold);
    const auto y = random_state(touching.model, 61);
    const auto one = rates_of(touching.model, y);
    for (const int threads : {1, 2, 3}) {
        set_threads(threads);
        Touching<2> again(three_bodies<2>(26), folding);
        BOOST_TEST((rates_of(again.model, y) == one));
    }
    set_threads(1);
}

// What a run finds to be connected has no say in which particles repel each other.
BOOST_AUTO_TEST_CASE(bodies_are_those_of_the_beginning) {
    Touching<2> touching(three_bodies<2>(9));
    const auto y = random_state(touching.model, 71);
    const auto before = rates_of(touching.model, y);
    const double closest = touching.contact.closest(y);
    touching.model.set_bodies(std::vector<std::int32_t>(touching.model.particles().size(), 0));
    BOOST_TEST((rates_of(touching.model, y) == before));
    BOOST_TEST(touching.contact.closest(y) == closest);
    // Nor in a part of the model that is made afterwards.
    std::vector<std::uint32_t> all(touching.model.particles().size());
    std::iota(all.begin(), all.end(), 0U);
    const auto part = touching.model.part(all);
    BOOST_TEST((rates_of(*part, y) == before));
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    const auto refused = [](const ContactScheme& scheme, const Particles<2>& particles) {
        return refusal([&] { Touching<2>(particles, scheme); });
    };
    const auto says = [](const std::string& text, const char* words) {
        return text.find(words) != std::string::npos;
    };
    const auto bodies = three_bodies<2>(4);
    for (const double bad : {0.0, -1.0, double(NAN), double(INFINITY)}) {
        BOOST_TEST(says(refused({.energy = bad}, bodies), "contact: energy"));
        BOOST_TEST(says(refused({.range = bad}, bodies), "contact-range: "));
    }
    BOOST_TEST(says(refused({.range = 1.01}, bodies), "contact-range: 1.01"));
    BOOST_TEST(says(refused({.range = 0.49}, bodies), "contact-range: 0.49"));
    BOOST_CHECK_NO_THROW(Touching<2>(bodies, {.energy = 0.3, .range = 0.5}));
    BOOST_TEST(says(refused({.range = 0.9, .folds_beyond = 0.8}, bodies), "0.8 apart"));
    BOOST_TEST(says(refused({.folds_beyond = -1.0}, bodies), "-1 apart"));
    const auto one = jittered_particles<2>(4, 81);
    BOOST_TEST(says(refused(usual, one), "nothing to touch"));
    BOOST_CHECK_NO_THROW(Touching<2>(one, folding));
    auto other = one;
    other.spacing = 2.0;
    BOOST_TEST(says(refusal([&] { joined<2>({one, other}); }), "spacing: 1 and 2"));
    other = one;
    other.material.assign(one.size(), 0);
    BOOST_TEST(says(refusal([&] { joined<2>({one, other}); }), "material: "));
}

// It is a potential of positions: particles must move with their own velocity, in every part that it acts
// in, whichever is added first.
BOOST_AUTO_TEST_CASE(averaged_velocities_are_refused) {
    const ElasticSolid solid = ElasticSolid::triangular_lattice();
    for (const auto transport : {Transport::average, Transport::monaghan, Transport::shifting})
        for (const bool contact_first : {false, true}) {
            const Scheme scheme{.transport = transport, .range = 2.6};
            const auto words = refusal([&] {
                ParticleModel<2> model(three_bodies<2>(5));
                if (contact_first) model.add_term<Contact<2>>(usual);
                model.add_term_among<SmoothParticles<2>>(25, 25, solid, scheme);
                model.add_term<Contact<2>>(usual);
            });
            BOOST_TEST(words.find("transport: ") == 0U, words);
        }
}
