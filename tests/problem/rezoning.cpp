// SPDX-License-Identifier: GPL-3.0-or-later
// Particles split and merged on the way of a run: what is kept group by group, who may be merged, what criteria do, and
// what is refused.
#include "support/refusal.hpp"
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/material/harmonic_spring.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/problem/remake.hpp>
#include <spam/problem/run_in_memory.hpp>
#include <spam/rhs/density_potentials.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace spam;
using spam::test::refusal;

namespace {

const Scheme summed{.density = Density::summed, .kernel = Kernel::w4, .range = 3.0};

template <int Dim>
std::shared_ptr<Model<Dim>> gas_of(Particles<Dim> particles) {
    return std::make_shared<FluidModel<Dim>>(std::move(particles), Fluid{GammaGas{2.0}}, summed);
}

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

/// A square of gas in motion, with a Rezoning.
template <int Dim>
Case<Dim> expanding(double rate, const Rezoning<Dim>& how) {
    std::array<int, Dim> cells;
    cells.fill(Dim == 3 ? 6 : 12);
    auto particles = make_particles<Dim>(centred<Dim>(square_lattice<Dim>(cells)), 1.0);
    const Points<Dim> x = particles.reference_position;
    auto model =
        std::make_shared<FluidModel<Dim>>(std::move(particles), Fluid{GammaGas{2.0}}, summed);
    Case<Dim> one{model, model->state(x, rate * x, 0.05), {}};
    one.plan.t_end = 2.0;
    one.plan.output_every = one.plan.snapshot_every = 0.25;
    one.plan.rezone(how);
    one.plan.rezoning->every = 0.5;
    one.plan.rezoning->make = gas_of<Dim>;
    return one;
}

template <int Dim>
RunRecord ran(double rate, const Rezoning<Dim>& how) {
    auto record = run_in_memory(expanding<Dim>(rate, how), {.method = "rk4", .dt = 0.05});
    BOOST_TEST(record.complete, record.statistics.stopped);
    for (const Drift& drift : record.drifts)
        BOOST_TEST(drift.change < (drift.name == "energy" ? 1e-6 : 1e-12), drift.name);
    return record;
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

/// Each criterion alone, splits in two and in 2^Dim, and nothing twice: what was split is not merged at once.
BOOST_AUTO_TEST_CASE(criteria_split_and_merge) {
    const double inf = std::numeric_limits<double>::infinity();
    const auto last = [](const RunRecord& record, const char* name) {
        return record.history.last(name);
    };
    const auto four = ran<2>(0.4, {.volume = RezoningLimits{1.5, 0.3}});
    BOOST_TEST(last(four, "splits") >= 100.0);
    BOOST_TEST(last(four, "merges") == 0.0);
    BOOST_TEST(last(four, "particles") == 144.0 + 3.0 * last(four, "splits"));
    const auto two = ran<2>(0.4, {.volume = RezoningLimits{1.5, 0.3}, .in_two = true});
    BOOST_TEST(last(two, "particles") == 144.0 + last(two, "splits"));
    const auto few = ran<2>(0.4, {.neighbours = RezoningLimits{16.0, 70.0}});
    BOOST_TEST(last(few, "splits") > 20.0);
    const auto many = ran<2>(-0.3, {.neighbours = RezoningLimits{0.0, 36.0}});
    BOOST_TEST(last(many, "merges") > 10.0);
    BOOST_TEST(last(many, "particles") < 120.0);
    BOOST_TEST(last(many, "rezoning_heat") > 0.0);
    const auto steep = ran<2>(0.1, {.gradient = RezoningLimits{1.5, 0.01}});
    BOOST_TEST(last(steep, "splits") > 10.0);
    BOOST_TEST(last(ran<2>(0.1, {.gradient = RezoningLimits{inf, 0.01}}), "splits") == 0.0);
    BOOST_TEST(last(ran<3>(0.3, {.volume = RezoningLimits{1.5, 0.1}}), "splits") > 50.0);
}

/// Densities and ranges that belong to each other, of children too.
BOOST_AUTO_TEST_CASE(ranges_by_density_are_found_anew) {
    const auto make = [](Particles<2> particles) {
        return std::make_shared<VariableRangeModel<2>>(std::move(particles), Fluid{GammaGas{2.0}},
                                                       VariableRangeScheme{3.0, Kernel::w4});
    };
    const auto first =
        make(make_particles<2>(centred<2>(square_lattice<2>(std::array{10, 10})), 1.0));
    const Points<2> x = first->particles().reference_position;
    const auto y = first->state(x, 0.1 * x, 0.5);
    Repopulation<2> change(first->particles());
    Points<2> corners(2, 2);
    corners << 0.25, -0.25, 0.25, -0.25;
    for (const std::size_t i : {44u, 45u, 54u}) change.split(i, corners);
    const auto population = change.finish();
    const auto next = make(population.particles);
    const auto remade = remake<2>(*first, y, population, *next);
    const ConstState<2> to(next->layout(), remade.y);
    const auto rho = next->solve_densities(to.position());
    double worst = 0.0, jump = 0.0;
    for (std::size_t k = 0; k < rho.size(); ++k) {
        const auto c = static_cast<Eigen::Index>(k);
        worst = std::max(worst, std::abs(to.density()(0, c) / rho[k] - 1.0));
        const auto old = static_cast<Eigen::Index>(population.parts[k].front().particle);
        jump = std::max(jump,
                        std::abs(ConstState<2>(first->layout(), y).density()(0, old) / rho[k] - 1));
    }
    BOOST_TEST(worst == 0.0);
    BOOST_TEST(jump > 0.01);  // what children would have of their parents is none of theirs
    BOOST_TEST(std::abs(remade.after.energy / remade.before.energy - 1.0) < 1e-14);
}

/// Potentials: paid where particles have an energy, else refused; cold laws have nothing to pay with.
BOOST_AUTO_TEST_CASE(what_nothing_can_pay_for_is_refused) {
    const DensityPotentials surface{.surface_tension = 0.2, .range = 3.0};
    const auto lattice = make_particles<2>(centred<2>(square_lattice<2>(std::array{8, 8})), 1.0);
    Points<2> corners(2, 2);
    corners << 0.25, -0.25, 0.25, -0.25;
    Repopulation<2> change(lattice);
    change.split(27, corners);
    const auto population = change.finish();
    const auto alone = [&](Particles<2> p) {
        auto model = std::make_shared<ParticleModel<2>>(std::move(p));
        model->add_term<DensityPotentialTerm<2>>(surface);
        return model;
    };
    const auto with_gas = [&](Particles<2> p) {
        auto model = std::make_shared<ParticleModel<2>>(std::move(p));
        model->add_term<SmoothParticles<2>>(Fluid{GammaGas{2.0}}, summed);
        model->add_term<DensityPotentialTerm<2>>(surface);
        return model;
    };
    const auto cold = [&](Particles<2> p) {
        return std::make_shared<FluidModel<2>>(std::move(p), Fluid{EmbeddedAtom{}}, summed);
    };
    const auto remade = [&](const auto& make, double e) {
        const auto first = make(lattice), second = make(population.particles);
        std::vector<double> y(first->layout().size(), 0.0);
        const State<2> state(first->layout(), y);
        state.position() = lattice.reference_position;
        if (state.has(Field::energy)) state.energy().setConstant(e);
        return remake<2>(*first, y, population, *second);
    };
    BOOST_TEST(refusal([&] { remade(alone, 0.0); }).find("no energy of their own to pay for it") !=
               std::string::npos);
    const auto paid = remade(with_gas, 5.0);
    BOOST_TEST(std::abs(paid.after.energy / paid.before.energy - 1.0) < 1e-14);
    BOOST_TEST(refusal([&] { remade(cold, 0.0); }).find("and nothing can pay") !=
               std::string::npos);
}

BOOST_AUTO_TEST_CASE(models_that_cannot_be_rezoned_say_so) {
    const auto lattice = make_particles<2>(triangular_hexagon(4), 1.0);
    const auto why = [&](const auto& model,
                         Rezoning<2> how = {.volume = RezoningLimits{2.0, 0.5}}) {
        how.every = 1.0;
        how.make = gas_of<2>;
        return refusal([&] { how.check(model); });
    };
    const auto gas = gas_of<2>(lattice);
    BOOST_TEST(why(*gas) == "accepted");
    BOOST_TEST(why(SmoothParticleModel<2>(lattice, ElasticSolid::triangular_lattice(), Scheme{})) ==
               "accepted");
    const auto says = [](const std::string& line, const char* words) {
        BOOST_TEST(line.starts_with("rezoning: "), line);
        BOOST_TEST(line.find(words) != std::string::npos, line);
        BOOST_TEST(line.find('\n') == std::string::npos, line);
    };
    says(why(BondedModel<2>(lattice, HarmonicSpring{})), "use smooth particles");
    says(why(MaterialVectorModel<2>(lattice, PolynomialSolid{0.43, 0.43}, {1.2, 2.4, 1.0})),
         "use an updated solid");
    says(why(FluidModel<2>(lattice, Fluid{EmbeddedAtom{}}, summed)), "use a law with an energy");
    says(why(*gas, {.volume = RezoningLimits{2.0, 0.6}}), "merged again");
    says(why(*gas, {.neighbours = RezoningLimits{12.0, 30.0}}), "merged again");
    says(why(*gas, {.volume = RezoningLimits{-1.0, -1.0}}), "give limits");
    says(why(*gas, {}), "give a criterion");
    says(why(ParticleModel<2>(lattice)), "no law");
}
