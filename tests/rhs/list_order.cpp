// SPDX-License-Identifier: GPL-3.0-or-later
// Flows: neighbours are summed in ascending number, whatever slots a list has given them, so that rates have
// the same bits with a list of any age and looked at any number of neighbours ahead, whatever the formulation reads of
// neighbours.
#include "support/every_potential.hpp"
#include "support/plane_and_space.hpp"
#include "support/random_state.hpp"
#include <spam/core/look_ahead.hpp>
#include <spam/core/parallel.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

#include <functional>

using namespace spam;
using namespace spam::test;

namespace {

template <int Dim>
using Build = std::function<std::unique_ptr<ParticleModel<Dim>>(Particles<Dim>, const Box<Dim>&)>;

/// cells^Dim particles of unequal masses in [0, cells]^Dim, numbers in no order.
template <int Dim>
Particles<Dim> shuffled(int cells) {
    std::array<int, Dim> n;
    n.fill(cells);
    Points<Dim> x = square_lattice<Dim>(n);
    x.colwise() -= x.rowwise().minCoeff().eval();
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> u(-0.3, 0.3);
    for (auto& c : x.reshaped()) c += 0.5 + u(random);
    auto particles = make_particles<Dim>(x, 1.0);
    auto& at = particles.reference_position;
    for (Eigen::Index k = at.cols() - 1; k > 0; --k)
        at.col(k).swap(at.col(static_cast<Eigen::Index>(random() % static_cast<unsigned>(k + 1))));
    for (double& m : particles.mass) m += u(random);
    return particles;
}

/// Every coordinate a little elsewhere, but for those that a wall would not let through.
template <int Dim>
std::vector<double> stirred(const Model<Dim>& model, std::vector<double> y, double distance,
                            unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(-distance, distance);
    const Box<Dim>& box = model.box();
    for (auto x : State<Dim>(model.layout(), y).position().colwise())
        for (int a = 0; a < Dim; ++a) {
            const double moved = x[a] + u(random);
            const auto &lower = box.wall(a, false), &upper = box.wall(a, true);
            if ((lower.open() || moved > lower.at) && (upper.open() || moved < upper.at))
                x[a] = moved;
        }
    return y;
}

template <int Dim>
void any_list_does(const Build<Dim>& build, const Particles<Dim>& particles, const Box<Dim>& box,
                   const std::string& what) {
    auto used = build(particles, box), fresh = build(particles, box);
    auto y = random_state(*fresh, 8);
    const State<Dim> state(fresh->layout(), y);
    if (state.has(Field::energy))  // gases need a temperature
        for (auto& e : state.energy().reshaped()) e = std::abs(e) + 0.5;
    const auto expected = rates_of(*fresh, y);
    BOOST_TEST(fresh->failure().empty(), what << ": " << fresh->failure());
    for (unsigned k = 0; k < 3; ++k) rates_of(*used, stirred(*used, y, 1.5, k));
    rates_of(*used, stirred(*used, y, 0.02, 10));
    const std::size_t builds = used->list_builds();
    const std::size_t usual = neighbours_ahead();
    for (const std::size_t ahead : {1U, 2U, 4U}) {
        set_neighbours_ahead(ahead);
        BOOST_TEST((rates_of(*used, y) == expected), what << ", " << ahead << " ahead");
    }
    set_neighbours_ahead(usual);
    BOOST_TEST(used->list_builds() == builds);  // it was an old list
}

template <int Dim>
std::vector<std::pair<std::string, Box<Dim>>> boxes(double L, WallKind kind = WallKind::no_slip) {
    std::array<double, Dim> all, first{};
    all.fill(L), first[0] = L;
    Box<Dim> mirrors, between(first);
    for (const bool upper : {false, true}) {
        for (int a = 0; a < Dim; ++a)
            mirrors.set_wall(a, upper, {WallKind::mirror, upper ? L : 0.0});
        between.set_wall(Dim - 1, upper, {kind, upper ? L : 0.0});
    }
    return {{"open", {}}, {"periodic", Box<Dim>(all)}, {"mirrors", mirrors}, {"between", between}};
}

template <int Dim>
void in_every_box(const Build<Dim>& build, int cells, const std::string& what,
                  WallKind kind = WallKind::no_slip) {
    const auto particles = shuffled<Dim>(cells);
    for (const auto& [name, box] : boxes<Dim>(cells, kind))
        any_list_does<Dim>(build, particles, box, what + ", " + name);
}

template <int Dim>
Build<Dim> fluid(const Fluid& material, const Scheme& scheme) {
    return [=](Particles<Dim> particles, const Box<Dim>& box) {
        return std::make_unique<FluidModel<Dim>>(std::move(particles), material, scheme, box);
    };
}

const Fluid gas{IdealGas{}}, water{IdealGas{}, NewtonViscosity{0.3, 0.1}, FourierConduction{0.4}};

}  // namespace

BOOST_AUTO_TEST_CASE(gases_and_liquids) {
    Fluid rubbing = water;
    rubbing.by_pairs = true;
    rubbing.viscosity = NewtonViscosity{0.1, 0.3};
    Scheme scheme{.density = Density::continuity, .range = 3.0};
    for (const Fluid& material : {gas, water, rubbing})
        in_every_box<2>(fluid<2>(material, scheme), 48, material.describe());
    scheme.kernel = Kernel::w4, scheme.density = Density::summed;
    in_every_box<2>(fluid<2>(water, scheme), 48, scheme.describe());
    const Scheme cube{.density = Density::continuity, .range = 2.5};
    in_every_box<3>(fluid<3>(water, cube), 12, "cube");
    const Scheme line{.density = Density::summed, .range = 3.0};
    any_list_does<1>(fluid<1>(water, line), shuffled<1>(600), Box<1>({600.0}), "line");
}

BOOST_AUTO_TEST_CASE(averaged_and_shifted_velocities) {
    for (const auto transport : {Transport::average, Transport::monaghan}) {
        const Scheme scheme{
            .density = Density::continuity, .transport = transport, .viscosity = 0.3, .range = 3.0};
        any_list_does<2>(fluid<2>(gas, scheme), shuffled<2>(48), Box<2>({48.0, 48.0}),
                         scheme.describe());
    }
    const Fluid cold{EmbeddedAtom{}, NewtonViscosity{0.1, 0.3}};
    any_list_does<2>(fluid<2>(cold, {.transport = Transport::shifting, .range = 3.0}),
                     shuffled<2>(48), Box<2>({48.0, 48.0}), "shifting");
}

BOOST_AUTO_TEST_CASE(potentials) {
    const Build<2> lucy = [](Particles<2> particles, const Box<2>& box) {
        return std::make_unique<PairPotentialModel<2>>(std::move(particles), 4.0, box);
    };
    const Build<2> of_density = [](Particles<2> particles, const Box<2>& box) {
        return std::make_unique<DensityPotentialModel<2>>(std::move(particles), every_potential(),
                                                          box);
    };
    in_every_box<2>(of_density, 48, "potentials of the density", WallKind::mirror);
    in_every_box<2>(lucy, 48, "pair potential", WallKind::mirror);
    const Build<2> own_ranges = [](Particles<2> particles, const Box<2>& box) {
        return std::make_unique<VariableRangeModel<2>>(std::move(particles), gas,
                                                       VariableRangeScheme{}, box);
    };
    in_every_box<2>(own_ranges, 48, "ranges by density", WallKind::mirror);
}

// With balanced torques the sums over a body are in the order of particles.
BOOST_AUTO_TEST_CASE_TEMPLATE(solids_in_pieces, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    set_threads(1);  // of few particles two wait for each other
    for (Scheme scheme : all_schemes<Dim>()) {
        scheme.range = 3.0;
        const Build<Dim> build = [&](Particles<Dim> particles, const Box<Dim>& box) {
            return std::make_unique<SmoothParticleModel<Dim>>(std::move(particles),
                                                              ElasticSolid{0.7, 0.4}, scheme, box);
        };
        any_list_does<Dim>(build, shuffled<Dim>(Dim == 2 ? 17 : 7), {}, scheme.describe());
    }
}

// A particle in several places at once: its images are in the order of their places, and it does not matter
// which of them is the particle itself.
BOOST_AUTO_TEST_CASE(which_image_is_at_home_does_not_matter) {
    const Box<2> box({4.0, 5.0});
    Particles<2> particles = shuffled<2>(6);
    for (const double range : {2.7, 5.5}) {
        const Build<2> build = fluid<2>(water, {.density = Density::continuity, .range = range});
        auto one = build(particles, box), other = build(particles, box);
        auto y = random_state(*one, 3);
        const State<2> state(one->layout(), y);
        for (auto& e : state.energy().reshaped()) e = std::abs(e) + 0.5;
        // The list is made where all are somewhere else, and keeps the images that are in the box there.
        auto z = y;
        State<2>(one->layout(), z).position().colwise() += Point<2>(1.75, 2.25);
        rates_of(*other, z);
        BOOST_TEST((rates_of(*one, y) == rates_of(*other, y)));
        BOOST_TEST(other->list_builds() == 1U);
    }
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter) {
    const Build<2> build = fluid<2>(water, {.density = Density::continuity, .range = 3.0});
    const auto particles = shuffled<2>(48);
    for (const auto& [name, box] : boxes<2>(48.0)) {
        std::vector<std::vector<double>> rates;
        for (const int threads : {1, 2, 3}) {
            set_threads(threads);
            auto model = build(particles, box);
            auto y = random_state(*model, 5);
            for (auto& e : State<2>(model->layout(), y).energy().reshaped()) e = std::abs(e) + 0.5;
            rates.push_back(rates_of(*model, y));
        }
        set_threads(1);
        BOOST_TEST((rates[0] == rates[1] && rates[0] == rates[2]), name);
    }
}
