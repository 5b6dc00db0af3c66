// SPDX-License-Identifier: GPL-3.0-or-later
// Periodic boxes by images: a box narrower than twice the range is the same as its repetition in a wide one,
// whatever the formulation reads of neighbours; momentum across a border is kept to round-off.
#include "support/every_potential.hpp"
#include "support/plane_and_space.hpp"
#include "support/random_state.hpp"
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/total_lagrangian.hpp>

#include <boost/test/unit_test.hpp>

#include <functional>

using namespace spam;
using namespace spam::test;

namespace {

constexpr int cells = 5, copies = 3;
constexpr double length = cells;

template <int Dim>
constexpr Eigen::Index all_copies = copies* all_copies<Dim - 1>;
template <>
constexpr Eigen::Index all_copies<0> = 1;

template <int Dim>
Particles<Dim> patch(unsigned seed) {
    std::array<int, Dim> n;
    n.fill(cells);
    Points<Dim> x = square_lattice<Dim>(n);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(-0.1, 0.1);
    for (auto& c : x.reshaped()) c = std::round((c + u(random)) * 0x1p32) * 0x1p-32;
    auto particles = make_particles<Dim>(x, 1.0, 1.0, periodic<Dim>(length));
    for (double& m : particles.mass) m += u(random);
    return particles;
}

/// The patch as often as it has room in a box three times as long.
template <int Dim>
Particles<Dim> repeated(const Particles<Dim>& one) {
    Particles<Dim> all = one;
    const Eigen::Index n = one.reference_position.cols();
    all.reference_position.resize(Dim, n * all_copies<Dim>);
    all.mass.clear(), all.id.clear();
    for (Eigen::Index copy = 0; copy < all_copies<Dim>; ++copy) {
        Point<Dim> shift = Point<Dim>::Zero();
        for (Eigen::Index a = 0, rest = copy; a < Dim; ++a, rest /= copies)
            shift[a] = length * static_cast<double>(rest % copies);
        all.reference_position.middleCols(copy * n, n) = one.reference_position.colwise() + shift;
        all.mass.insert(all.mass.end(), one.mass.begin(), one.mass.end());
        for (const auto id : one.id) all.id.push_back(id + static_cast<std::int64_t>(copy * n));
    }
    all.body.assign(all.mass.size(), 0);
    return all;
}

template <int Dim>
using Build = std::function<std::unique_ptr<Model<Dim>>(Particles<Dim>, const Box<Dim>&)>;

/// Largest difference of any rate, relative to the largest of its field.
template <int Dim>
double narrow_against_wide(const Build<Dim>& build, double deform = 0.05) {
    set_threads(1);  // of few particles two wait for each other
    const auto one = patch<Dim>(7);
    auto narrow = build(one, periodic<Dim>(length));
    auto wide = build(repeated<Dim>(one), periodic<Dim>(copies * length));
    auto y = random_state(*narrow, 8);
    std::vector<double> Y(wide->layout().size(), 0.0);
    const State<Dim> small(narrow->layout(), y), large(wide->layout(), Y);
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> u(-deform, deform);
    // On a grid that both boxes leave as it is.
    for (auto& x : small.position().reshaped()) x = std::round((x + u(random)) * 0x1p32) * 0x1p-32;
    if (small.has(Field::energy))  // gases need a temperature
        for (auto& e : small.energy().reshaped()) e = std::abs(e) + 0.5;
    const Eigen::Index n = one.reference_position.cols();
    const Points<Dim>& X = wide->particles().reference_position;
    for (const auto& block : narrow->layout().blocks())
        for (Eigen::Index copy = 0; copy < all_copies<Dim>; ++copy)
            large.field(block.field).middleCols(copy * n, n) = small.field(block.field);
    for (Eigen::Index k = 0; k < X.cols(); ++k)
        large.position().col(k) += X.col(k) - one.reference_position.col(k % n);
    const auto rates = rates_of(*narrow, y), expected = rates_of(*wide, Y);
    const ConstState<Dim> found(narrow->layout(), rates), right(wide->layout(), expected);
    double worst = 0.0;
    for (const auto& block : narrow->layout().blocks())
        for (Eigen::Index copy = 0; copy < all_copies<Dim>; ++copy) {
            const auto of_copy = right.field(block.field).middleCols(copy * n, n);
            const double size = of_copy.cwiseAbs().maxCoeff();
            const double apart = (found.field(block.field) - of_copy).cwiseAbs().maxCoeff();
            BOOST_TEST(size > 0.0);
            worst = std::max(worst, std::isnan(apart) ? HUGE_VAL : apart / size);
        }
    BOOST_TEST(found.velocity().cwiseAbs().maxCoeff() > 1e-3);
    // Momentum, to round-off of the sum alone.
    for (int a = 0; a < Dim; ++a) {
        ExactSum total, size;
        for (Eigen::Index i = 0; i < n; ++i) {
            const double f = one.mass[static_cast<std::size_t>(i)] * found.velocity()(a, i);
            total += f, size += std::abs(f);
        }
        BOOST_TEST(std::abs(double(total)) < 1e-14 * double(size));
    }
    return worst;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(solids, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    for (Scheme scheme : all_schemes<Dim>()) {
        if (scheme.angular_momentum == AngularMomentum::gauss) continue;  // not in periodic boxes
        const Build<Dim> build = [&](Particles<Dim> particles, const Box<Dim>& box) {
            return std::make_unique<SmoothParticleModel<Dim>>(std::move(particles),
                                                              ElasticSolid{0.7, 0.4}, scheme, box);
        };
        BOOST_TEST(narrow_against_wide<Dim>(build) < 2e-14, scheme.describe());
    }
}

BOOST_AUTO_TEST_CASE(fluids) {
    const Fluid gas{IdealGas{}},
        water{IdealGas{}, NewtonViscosity{0.3, 0.1}, FourierConduction{0.4}};
    Fluid rubbing = water;
    rubbing.by_pairs = true;
    rubbing.viscosity = NewtonViscosity{0.1, 0.3};
    for (const Fluid& fluid : {gas, water, rubbing})
        for (const auto transport : {Transport::plain, Transport::average, Transport::monaghan})
            for (const auto kernel : {Kernel::lucy, Kernel::monaghan})
                for (const double viscosity : {0.0, 0.3}) {
                    const Scheme scheme{.density = Density::continuity,
                                        .transport = transport,
                                        .viscosity = viscosity,
                                        .kernel = kernel,
                                        .range = 2.7};
                    const Build<2> plane = [&](Particles<2> particles, const Box<2>& box) {
                        return std::make_unique<FluidModel<2>>(std::move(particles), fluid, scheme,
                                                               box);
                    };
                    BOOST_TEST(narrow_against_wide<2>(plane) < 2e-14, scheme.describe());
                }
    for (const bool by_pairs : {false, true}) {
        Fluid cold{EmbeddedAtom{}, NewtonViscosity{0.1, 0.3}};
        cold.by_pairs = by_pairs;
        const Scheme scheme{.transport = Transport::shifting, .range = 2.7};
        const Build<2> shifted = [&](Particles<2> particles, const Box<2>& box) {
            return std::make_unique<FluidModel<2>>(std::move(particles), cold, scheme, box);
        };
        BOOST_TEST(narrow_against_wide<2>(shifted) < 2e-14, scheme.describe());
    }
    const Scheme summed{.density = Density::summed, .range = 2.7};
    const Build<1> line = [&](Particles<1> particles, const Box<1>& box) {
        return std::make_unique<FluidModel<1>>(std::move(particles), water, summed, box);
    };
    BOOST_TEST(narrow_against_wide<1>(line) < 2e-14);
}

BOOST_AUTO_TEST_CASE(potentials) {
    const DensityPotentials everything = every_potential();
    const Build<2> of_density = [&](Particles<2> particles, const Box<2>& box) {
        return std::make_unique<DensityPotentialModel<2>>(std::move(particles), everything, box);
    };
    BOOST_TEST(narrow_against_wide<2>(of_density) < 2e-14);
    const Build<2> lucy = [](Particles<2> particles, const Box<2>& box) {
        return std::make_unique<PairPotentialModel<2>>(std::move(particles), 2.9, box);
    };
    BOOST_TEST(narrow_against_wide<2>(lucy) < 2e-14);
}

BOOST_AUTO_TEST_CASE(total_lagrangian_solids) {
    const Build<2> build = [](Particles<2> particles, const Box<2>& box) {
        return std::make_unique<TotalLagrangianModel<2>>(std::move(particles),
                                                         StVenantKirchhoff{0.7, 0.4},
                                                         TotalLagrangianScheme{1.0, 2.7, 0.1}, box);
    };
    BOOST_TEST(narrow_against_wide<2>(build) < 1e-13);
}

// A lattice of four columns in a box of length 4 is one of sixteen in a box of length 16: where range and
// numbers let neighbours follow each other in the same order, to the last bit.
BOOST_AUTO_TEST_CASE(four_columns_in_a_box_of_length_four) {
    const double range = 3.0;
    Points<2> x = square_lattice<2>({4, 16});
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> u(-0.2, 0.2);
    for (auto& c : x.reshaped()) c = std::round((c + u(random)) * 0x1p32) * 0x1p-32;
    auto narrow = make_particles<2>(x, 1.0);
    for (double& m : narrow.mass) m += u(random);
    const Eigen::Index n = narrow.reference_position.cols();
    Particles<2> wide = narrow;
    wide.reference_position.resize(2, 4 * n);
    wide.mass.clear(), wide.id.clear();
    for (Eigen::Index i = 0; i < n; ++i)
        for (int copy = 0; copy < 4; ++copy) {
            wide.reference_position.col(4 * i + copy) =
                narrow.reference_position.col(i) + Point<2>(4.0 * copy, 0.0);
            wide.mass.push_back(narrow.mass[static_cast<std::size_t>(i)]);
            wide.id.push_back(4 * i + copy);
        }
    wide.body.assign(wide.mass.size(), 0);
    const auto compare = [&](Model<2>& small, Model<2>& large) {
        auto y = random_state(small, 12);
        std::vector<double> Y(large.layout().size());
        const State<2> of_small(small.layout(), y), of_large(large.layout(), Y);
        for (const auto& block : small.layout().blocks())
            for (Eigen::Index k = 0; k < 4 * n; ++k)
                of_large.field(block.field).col(k) = of_small.field(block.field).col(k / 4);
        of_large.position() = wide.reference_position;
        const auto rates = rates_of(small, y), expected = rates_of(large, Y);
        const ConstState<2> found(small.layout(), rates), right(large.layout(), expected);
        BOOST_TEST(found.velocity().cwiseAbs().maxCoeff() > 1e-3);
        for (const auto& block : small.layout().blocks()) {
            const auto all = right.field(block.field);
            const double size = all.cwiseAbs().maxCoeff();
            for (Eigen::Index i = 0; i < n; ++i) {
                const auto own = found.field(block.field).col(i);
                // The two copies in the middle do not see the border of the wide box.
                for (const int copy : {1, 2}) BOOST_TEST((own == all.col(4 * i + copy)));
                for (const int copy : {0, 3})
                    BOOST_TEST((own - all.col(4 * i + copy)).cwiseAbs().maxCoeff() < 1e-14 * size);
            }
        }
    };
    const Box<2> box({4.0, 16.0}), long_box({16.0, 16.0});
    PairPotentialModel<2> gas(narrow, range, box), long_gas(wide, range, long_box);
    compare(gas, long_gas);
    for (const auto transport : {Transport::plain, Transport::monaghan}) {
        const Scheme scheme{.transport = transport, .range = range};
        const ElasticSolid law{0.7, 0.4};
        SmoothParticleModel<2> solid(narrow, law, scheme, box),
            long_solid(wide, law, scheme, long_box);
        compare(solid, long_solid);
    }
}

// 3,000 pairs, each across a border and far from all others, in boxes of which half lie just above a power
// of two, where x + L is rounded most: forces are opposite to the last bit.
BOOST_AUTO_TEST_CASE(pairs_across_a_border_pull_with_opposite_forces) {
    std::size_t pairs = 0, not_opposite = 0, rounded_otherwise = 0;
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> u(0.0, 0.9), across(-0.5, 0.5);
    for (const double L : {8.0 * (1.0 + 1e-15), 9.3}) {
        const Box<2> box({L, 0.0});
        Points<2> x(2, 3000);
        for (Eigen::Index k = 0; k < x.cols(); k += 2) {
            x.col(k) << u(random), 5.0 * static_cast<double>(k);
            x.col(k + 1) << L - u(random), x(1, k) + across(random);
            rounded_otherwise += (x(0, k) + L) - x(0, k + 1) != -((x(0, k + 1) - L) - x(0, k));
        }
        auto particles = make_particles<2>(x, 1.0);
        particles.reference_position = x;  // pairs are neighbours in number too
        PairPotentialModel<2> model(particles, 2.5, box);
        auto y = random_state(model, 14);
        const auto y_dot = rates_of(model, y);
        const auto a = ConstState<2>(model.layout(), y_dot).velocity();
        for (Eigen::Index k = 0; k < x.cols(); k += 2, ++pairs) {
            BOOST_TEST(a.col(k).norm() > 0.0);
            not_opposite += a.col(k) == -a.col(k + 1) ? 0 : 1;
        }
    }
    BOOST_TEST(pairs == 3000U);
    BOOST_TEST(not_opposite == 0U);
    BOOST_TEST(rounded_otherwise >
               100U);  // so it would be without the grid of the period (box.hpp)
}
