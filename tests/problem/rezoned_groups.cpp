// SPDX-License-Identifier: GPL-3.0-or-later
// Groups of particles merged into two, and particles split: what is kept group by group, and which may be merged.
#include "problem/rezoned_gas.hpp"
#include "support/refusal.hpp"
#include <spam/material/gamma_gas.hpp>
#include <spam/problem/remake.hpp>
#include <spam/problem/repopulation.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace spam;
using spam::test::gas_of;
using spam::test::refusal;

namespace {

/// Groups of 3 to 6 at random in boxes of their own, each in two; every seventh particle beside them in 2^Dim.
template <int Dim>
struct Crowd {
    std::shared_ptr<Model<Dim>> model;
    std::vector<double> y;
    std::vector<std::vector<std::size_t>> groups;
    std::vector<std::size_t> split;

    Crowd(std::size_t count, std::mt19937& random) {
        std::uniform_real_distribution<double> unit(-1.0, 1.0);
        Particles<Dim> p;
        std::vector<Point<Dim>> x, v;
        std::vector<double> e;
        for (std::size_t g = 0; g < count; ++g) {
            const std::size_t n = g % 7 == 6 ? 1 : 3 + random() % 4;
            Point<Dim> place = Point<Dim>::Zero();
            place[0] = 8.0 * static_cast<double>(g % 32);
            place[1] = 8.0 * static_cast<double>(g / 32);
            const double spin = unit(random);
            groups.emplace_back();
            for (std::size_t k = 0; k < n; ++k) {
                (n == 1 ? split : groups.back()).push_back(p.mass.size());
                Point<Dim> r, u;
                for (int a = 0; a < Dim; ++a) r[a] = unit(random), u[a] = 0.3 * unit(random);
                u[0] -= spin * r[1];
                u[1] += spin * r[0];
                p.id.push_back(static_cast<std::int64_t>(p.mass.size()));
                p.mass.push_back(1.5 + unit(random));
                p.body.push_back(0);
                e.push_back(1.0 + 0.9 * unit(random));
                x.push_back(place + r);
                v.push_back(u);
            }
            if (groups.back().empty()) groups.pop_back();
        }
        const auto n = static_cast<Eigen::Index>(x.size());
        p.reference_position.resize(Dim, n);
        for (Eigen::Index i = 0; i < n; ++i)
            p.reference_position.col(i) = x[static_cast<std::size_t>(i)];
        model = gas_of<Dim>(p);
        y.resize(model->layout().size());
        const State<Dim> state(model->layout(), y);
        state.position() = p.reference_position;
        for (Eigen::Index i = 0; i < n; ++i) {
            state.velocity().col(i) = v[static_cast<std::size_t>(i)];
            state.energy()(0, i) = e[static_cast<std::size_t>(i)];
        }
    }
};

/// Mass, momentum, angular momentum and energy, with the sizes of what they are sums of.
template <int Dim>
struct Sums {
    double m = 0.0, E = 0.0, e = 0.0, p_size = 0.0, L_size = 0.0;
    Point<Dim> p = Point<Dim>::Zero();
    Eigen::Matrix<double, Dim, Dim> L = Eigen::Matrix<double, Dim, Dim>::Zero();
    void add(double mass, const Point<Dim>& x, const Point<Dim>& v, double energy) {
        m += mass;
        p += mass * v;
        L += mass * (x * v.transpose() - v * x.transpose());
        E += mass * (energy + 0.5 * v.squaredNorm());
        e += mass * energy;
        p_size += mass * v.norm();
        L_size += mass * v.norm() * x.norm();
    }
};

template <int Dim>
void check_groups(int rounds, std::size_t count) {
    std::mt19937 random(11);
    double m = 0.0, p = 0.0, L = 0.0, E = 0.0, least = 1.0;
    std::size_t merged = 0, splits = 0;
    for (int round = 0; round < rounds; ++round) {
        Crowd<Dim> crowd(count, random);
        Repopulation<Dim> change(crowd.model->particles());
        for (const auto& group : crowd.groups)
            change.merge(group, twin_offset<Dim>(*crowd.model, crowd.y, group));
        for (const std::size_t i : crowd.split) {
            Points<Dim> corners(Dim, 1 << Dim);
            for (int k = 0; k < 1 << Dim; ++k)
                for (int a = 0; a < Dim; ++a) corners(a, k) = (k >> a) & 1 ? 0.21 : -0.21;
            change.split(i, corners);
        }
        const auto population = change.finish();
        const auto next = gas_of<Dim>(population.particles);
        const auto remade = remake<Dim>(*crowd.model, crowd.y, population, *next);
        const ConstState<Dim> from(crowd.model->layout(), crowd.y), to(next->layout(), remade.y);
        std::vector<Sums<Dim>> now(crowd.y.size()), was(crowd.y.size());  // by the first part
        for (std::size_t k = 0; k < population.parts.size(); ++k) {
            const auto& parts = population.parts[k];
            const auto c = static_cast<Eigen::Index>(k);
            const bool again = now[parts.front().particle].m > 0.0;
            now[parts.front().particle].add(next->particles().mass[k], to.position().col(c),
                                            to.velocity().col(c), to.energy()(0, c));
            if (!again)
                for (const auto& part : parts) {
                    const auto a = static_cast<Eigen::Index>(part.particle);
                    was[parts.front().particle].add(crowd.model->particles().mass[part.particle],
                                                    from.position().col(a), from.velocity().col(a),
                                                    from.energy()(0, a));
                }
        }
        merged += crowd.groups.size();
        splits += crowd.split.size();
        for (std::size_t k = 0; k < now.size(); ++k) {
            if (!(now[k].m > 0.0)) continue;
            const auto &a = was[k], &b = now[k];
            m = std::max(m, std::abs(b.m - a.m) / a.m);
            p = std::max(p, (b.p - a.p).norm() / a.p_size);
            L = std::max(L, (b.L - a.L).norm() / (a.L_size + a.p_size));
            E = std::max(E, std::abs(b.E - a.E) / a.E);
            least = std::min(least, (b.e - a.e) / a.E);
        }
    }
    BOOST_TEST_MESSAGE(Dim << " dimensions, " << merged << " merges, " << splits << " splits: m "
                           << m << ", p " << p << ", L " << L << ", E " << E << ", least heat "
                           << least);
    BOOST_TEST(merged + splits >= static_cast<std::size_t>(rounds) * count);
    BOOST_TEST(m < 1e-14);
    BOOST_TEST(p < 1e-14);
    BOOST_TEST(L < 1e-14);
    BOOST_TEST(E < 1e-14);
    BOOST_TEST(least > -1e-15);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_hundred_thousand_groups_keep_what_they_have) {
    check_groups<2>(100, 1000);
    check_groups<3>(100, 1000);
}

/// A mutated law, without the turn: the angular momentum of the parts would be lost. With d shorter than it should be
/// it is kept, but takes more energy than there is for it.
BOOST_AUTO_TEST_CASE(without_the_turn_angular_momentum_is_lost) {
    std::mt19937 random(3);
    Crowd<2> crowd(7, random);
    const auto& group = crowd.groups.front();
    Repopulation<2> into_one(crowd.model->particles());
    into_one.merge(group);
    const auto population = into_one.finish();
    const auto next = gas_of<2>(population.particles);
    const auto remade = remake<2>(*crowd.model, crowd.y, population, *next);
    BOOST_TEST((remade.after.angular_momentum - remade.before.angular_momentum).norm() > 1e-3);
    const auto heat_of = [&](double part) {
        Repopulation<2> into_two(crowd.model->particles());
        into_two.merge(group, part * twin_offset<2>(*crowd.model, crowd.y, group));
        const auto twins = into_two.finish();
        const auto two = gas_of<2>(twins.particles);
        const auto made = remake<2>(*crowd.model, crowd.y, twins, *two);
        BOOST_TEST((made.after.angular_momentum - made.before.angular_momentum).norm() < 1e-12);
        return made.after.internal - made.before.internal;
    };
    BOOST_TEST(heat_of(1.0) > 0.0);
    BOOST_TEST(heat_of(0.2) < 0.0);
}

BOOST_AUTO_TEST_CASE(who_may_not_be_one_is_not) {
    std::mt19937 random(5);
    const Crowd<2> crowd(7, random);
    const auto group = crowd.groups.front();
    auto particles = crowd.model->particles();
    particles.body[group[1]] = 1;
    BOOST_TEST(refusal([&] { Repopulation<2>(particles).merge(group); }) ==
               "population: particles 0 and 1 are of different bodies and cannot be one");
    // Broken and whole.
    FieldLayout<2> layout(2, {Field::position});
    constexpr FieldKind broken{"broken", Rank::scalar,     Role::history, "1",
                               100,      Quantity::scalar, Share::equal};
    const std::int64_t ids[] = {4, 9};
    Change<2> change{{{{0, 0.5, Point<2>::Zero()}, {1, 0.5, Point<2>::Zero()}}}, {}, ids};
    const double old[] = {0.0, 1.0};
    double made = 0.0;
    BOOST_TEST(refusal([&] { change.carry(broken, old, &made, 1); }) ==
               "population: particles 4 and 9 differ in 'broken' and cannot be one");
}
