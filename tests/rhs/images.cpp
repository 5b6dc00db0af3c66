// SPDX-License-Identifier: GPL-3.0-or-later
// Periodic boxes by images: a box narrower than twice the range is the same as its repetition in a wide one,
// whatever the formulation reads of neighbours; momentum across a border is kept to round-off.
#include "support/every_potential.hpp"
#include "support/random_state.hpp"
#include <spam/core/sums.hpp>
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
Box<Dim> cube(double L) {
    std::array<double, Dim> lengths;
    lengths.fill(L);
    return Box<Dim>(lengths);
}

template <int Dim>
constexpr Eigen::Index all_copies = Dim == 2 ? copies* copies : copies;

template <int Dim>
Particles<Dim> patch(unsigned seed) {
    std::array<int, Dim> n;
    n.fill(cells);
    Points<Dim> x = square_lattice<Dim>(n);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(-0.1, 0.1);
    for (auto& c : x.reshaped()) c = std::round((c + u(random)) * 0x1p32) * 0x1p-32;
    auto particles = make_particles<Dim>(x, 1.0, 1.0, cube<Dim>(length));
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
    const auto one = patch<Dim>(7);
    auto narrow = build(one, cube<Dim>(length));
    auto wide = build(repeated<Dim>(one), cube<Dim>(copies * length));
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
        CompensatedSum total, size;
        for (Eigen::Index i = 0; i < n; ++i) {
            const double f = one.mass[static_cast<std::size_t>(i)] * found.velocity()(a, i);
            total += f, size += std::abs(f);
        }
        BOOST_TEST(std::abs(double(total)) < 1e-14 * double(size));
    }
    return worst;
}

}  // namespace

BOOST_AUTO_TEST_CASE(solids) {
    for (Scheme scheme : all_schemes<2>()) {
        if (scheme.angular_momentum == AngularMomentum::gauss) continue;  // not in periodic boxes
        const Build<2> build = [&](Particles<2> particles, const Box<2>& box) {
            return std::make_unique<SmoothParticleModel<2>>(std::move(particles),
                                                            ElasticSolid{0.7, 0.4}, scheme, box);
        };
        BOOST_TEST(narrow_against_wide<2>(build) < 2e-14, scheme.describe());
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
                    if (fluid.by_pairs && (transport != Transport::plain || viscosity > 0.0))
                        continue;
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
