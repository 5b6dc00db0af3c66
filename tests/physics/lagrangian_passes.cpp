// SPDX-License-Identifier: GPL-3.0-or-later
// The passes of a total-Lagrangian solid in 1, 2, 4 and 8 lanes against their own pair bodies in plain
// numbers, pair by pair; what a pair exchanges is antisymmetric bit for bit.
#include "support/random_state.hpp"
#include <spam/kernel/lucy.hpp>
#include <spam/neighbors/brute_force.hpp>
#include <spam/neighbors/cluster_list.hpp>
#include <spam/neighbors/sweep.hpp>
#include <spam/physics/deformation_gradient.hpp>
#include <spam/physics/reference_force.hpp>
#include <spam/physics/zero_energy_penalty.hpp>

#include <boost/test/unit_test.hpp>

#include <cstring>

using namespace spam;

namespace {

constexpr double h = 2.6;

/// Records of random numbers on a jittered lattice.
template <int Dim>
struct Cloud {
    using R = StressedRecord<Dim>;
    static constexpr std::size_t stride = R::numbers;
    Particles<Dim> particles = test::jittered_particles<Dim>(Dim == 1 ? 60 : Dim == 2 ? 11 : 5, 75);
    std::vector<double> numbers;  ///< by particle

    Cloud() : numbers(particles.size() * stride) {
        std::mt19937_64 random(76);
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        for (double& number : numbers) number = u(random);
        for (std::size_t i = 0; i < particles.size(); ++i)
            for (std::size_t a = 0; a < Dim; ++a)
                numbers[i * stride + a] = particles.reference_position.data()[i * Dim + a];
    }
    R record(std::size_t i) const {
        R r;
        r.visit([&](double& n, int k) { n = numbers[i * stride + static_cast<std::size_t>(k)]; });
        return r;
    }
    template <class Pass>
    typename Pass::template Sums<double> pair(std::size_t i, std::size_t j) const {
        typename Pass::template Sums<double> sums;
        add<Pass>(i, j, sums);
        return sums;
    }
    template <class Pass, class Sums>
    void add(std::size_t i, std::size_t j, Sums& sums) const {
        const R ri = record(i), rj = record(j);
        Pass::add(make_pair<Dim, double>(Lucy<Dim>(h), separation(ri.x, rj.x), ri, rj), ri, rj,
                  sums);
    }
};

template <class Sums>
std::vector<double> flat(const Sums& sums) {
    std::vector<double> values(sizeof(Sums) / sizeof(double));
    std::memcpy(values.data(), &sums, sizeof sums);
    return values;
}

template <int Dim, class Pass>
std::vector<std::vector<double>> pair_by_pair(const Cloud<Dim>& cloud) {
    const auto neighbours =
        brute_force_neighbours<Dim>(cloud.particles.reference_position, h, Box<Dim>());
    std::vector<std::vector<double>> results;
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
        typename Pass::template Sums<double> sums;
        for (const auto j : neighbours[i]) cloud.template add<Pass>(i, j, sums);
        results.push_back(flat(sums));
    }
    return results;
}

template <int W, int Dim, class Pass>
std::vector<std::vector<double>> swept(const Cloud<Dim>& cloud) {
    constexpr std::size_t stride = Cloud<Dim>::stride;
    ClusterList<Dim> list(h, 0.2, {}, W, stride);
    list.build(cloud.particles.reference_position);
    std::vector<double> records;
    for (const auto i : list.order()) {
        const auto row = cloud.numbers.begin() + static_cast<std::ptrdiff_t>(i * stride);
        records.insert(records.end(), row, row + stride);
    }
    std::vector<std::vector<double>> results(list.size());
    const ClusterView view = list.view();
    sweep<W, Dim, StressedRecord<Dim>, Pass>(
        view, Lucy<Dim>(h), {records.data(), stride},
        [&](std::size_t slot, const auto&, const auto& sums) {
            const auto values = flat(sums);
            for_each_lane<W>(view, slot, [&](int l, std::size_t i) {
                for (std::size_t k = 0; k < values.size() / W; ++k)
                    results[i].push_back(values[k * W + static_cast<std::size_t>(l)]);
            });
        });
    return results;
}

template <int W, int Dim, class Pass>
double difference(const Cloud<Dim>& cloud) {
    const auto expected = pair_by_pair<Dim, Pass>(cloud);
    const auto found = swept<W, Dim, Pass>(cloud);
    double worst = 0.0, size = 1e-3;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        BOOST_REQUIRE(found[i].size() == expected[i].size());
        for (std::size_t k = 0; k < expected[i].size(); ++k) {
            worst = std::max(worst, std::abs(found[i][k] - expected[i][k]));
            size = std::max(size, std::abs(expected[i][k]));
            if (std::isnan(found[i][k])) return HUGE_VAL;
        }
    }
    return worst / size;
}

template <int Dim, class Pass>
void every_width(const Cloud<Dim>& cloud, const char* name) {
    BOOST_TEST_CONTEXT(name << " in " << Dim << " dimensions") {
        BOOST_TEST((difference<1, Dim, Pass>(cloud)) < 1e-14);
        BOOST_TEST((difference<2, Dim, Pass>(cloud)) < 1e-14);
        BOOST_TEST((difference<4, Dim, Pass>(cloud)) < 1e-14);
        BOOST_TEST((difference<8, Dim, Pass>(cloud)) < 1e-14);
    }
}

/// Momentum given and taken, for unit volumes of both ends.
template <int Dim, class Pass>
bool antisymmetric(Cloud<Dim> cloud) {
    for (const std::size_t i : {0UL, 1UL, 2UL, 3UL})
        cloud.numbers[i * Cloud<Dim>::stride + 2 * Dim] = 1.0;
    bool exact = true, nonzero = false;
    for (const std::size_t i : {0UL, 1UL, 2UL})
        for (const std::size_t j : {1UL, 2UL, 3UL}) {
            const auto ij = cloud.template pair<Pass>(i, j).force;
            exact = exact && ij == -1.0 * cloud.template pair<Pass>(j, i).force;
            nonzero = nonzero || ij[0] != 0.0;
        }
    return exact && nonzero;
}

/// Takes the stress of one end for both.
template <int Dim>
struct OwnStress {
    template <class T>
    using Sums = typename ReferenceForce<Dim>::template Sums<T>;
    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        sums.force += j.volume * ((i.B + i.B) * pair.grad_w);
        if constexpr (!std::is_same_v<T, double>) sums.force += T(0.01) * pair.grad_w;
    }
};

template <int Dim>
void every_pass() {
    const Cloud<Dim> cloud;
    every_width<Dim, DeformationGradient<Dim>>(cloud, "deformation gradient");
    every_width<Dim, ZeroEnergyPenalty<Dim>>(cloud, "penalty");
    every_width<Dim, PenaltyEnergy<Dim>>(cloud, "penalty energy");
    every_width<Dim, ReferenceForce<Dim>>(cloud, "reference force");
    BOOST_TEST((antisymmetric<Dim, ReferenceForce<Dim>>(cloud)));
    BOOST_TEST((antisymmetric<Dim, ZeroEnergyPenalty<Dim>>(cloud)));
    BOOST_TEST((!antisymmetric<Dim, OwnStress<Dim>>(cloud)));
    BOOST_TEST((difference<4, Dim, OwnStress<Dim>>(cloud)) > 1e-4);
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_line) { every_pass<1>(); }
BOOST_AUTO_TEST_CASE(in_the_plane) { every_pass<2>(); }
BOOST_AUTO_TEST_CASE(in_space) { every_pass<3>(); }
