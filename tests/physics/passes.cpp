// SPDX-License-Identifier: GPL-3.0-or-later
// Every pass in 1, 2, 4 and 8 lanes against its own pair body in plain numbers, pair by pair.
#include "support/random_state.hpp"
#include <spam/kernel/lucy.hpp>
#include <spam/neighbors/brute_force.hpp>
#include <spam/neighbors/cluster_list.hpp>
#include <spam/neighbors/sweep.hpp>
#include <spam/physics/continuity.hpp>
#include <spam/physics/density_sum.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/physics/record.hpp>
#include <spam/physics/torque_balance.hpp>
#include <spam/physics/transport.hpp>
#include <spam/physics/velocity_gradient.hpp>
#include <spam/physics/viscosity.hpp>

#include <boost/test/unit_test.hpp>

#include <cstring>

using namespace spam;

namespace {

template <int Dim>
using R = TransportRecord<Dim>;

constexpr double range = 2.6;

template <int Dim>
struct Cloud {
    Particles<Dim> particles = test::jittered_particles<Dim>(Dim == 1 ? 60 : Dim == 2 ? 11 : 5, 71);
    std::vector<double> numbers;  ///< records by particle

    Cloud() : numbers(particles.size() * R<Dim>::numbers) {
        std::mt19937_64 random(72);
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        for (double& number : numbers) number = u(random);
        for (std::size_t i = 0; i < particles.size(); ++i) {
            double* const row = &numbers[i * R<Dim>::numbers];
            for (int a = 0; a < Dim; ++a)
                row[a] = particles.reference_position(a, static_cast<Eigen::Index>(i));
            row[2 * Dim] = particles.mass[i];
            row[2 * Dim + 1] = 1.0 + 0.2 * u(random);  // density
            for (int k = 1; k <= 2; ++k) row[R<Dim>::numbers - k] = 1.0 + 0.2 * u(random);
        }
    }
    R<Dim> record(std::size_t i) const {
        R<Dim> r;
        r.visit([&](double& number, int k) {
            number = numbers[i * R<Dim>::numbers + static_cast<std::size_t>(k)];
        });
        return r;
    }
};

/// A pass, with constants where it holds any.
template <class Pass>
Pass one() {
    if constexpr (requires { Pass::with(PassConstants{}); })
        return Pass::with({MeanDensityKind::geometric, {0.4, 1.1, 1.3}});
    else
        return {};
}

/// Sums are structs of numbers only.
template <class Sums>
std::vector<double> flat(const Sums& sums) {
    std::vector<double> values(sizeof(Sums) / sizeof(double));
    if constexpr (!std::is_empty_v<Sums>)
        std::memcpy(values.data(), &sums, values.size() * sizeof(double));
    return values;
}

/// By particle.
using Rows = std::vector<std::vector<double>>;

template <int Dim, class Pass>
Rows pair_by_pair(const Cloud<Dim>& cloud, double h) {
    const auto neighbours =
        brute_force_neighbours<Dim>(cloud.particles.reference_position, h, Box<Dim>());
    Rows results;
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
        typename Pass::template Sums<double> sums;
        for (const auto j : neighbours[i]) {
            const auto ri = cloud.record(i), rj = cloud.record(j);
            one<Pass>().add(make_pair<Dim, double>(Lucy<Dim>(h), separation(ri.x, rj.x), ri, rj),
                            ri, rj, sums);
        }
        results.push_back(flat(sums));
    }
    return results;
}

/// Of every pass, all in one sweep: one apart for each would take a minute to compile.
template <int W, int Dim, class... Passes>
std::vector<Rows> swept(const Cloud<Dim>& cloud, double h) {
    ClusterList<Dim> list(h, 0.2, {}, W, R<Dim>::numbers);
    list.build(cloud.particles.reference_position);
    std::vector<double> records;
    for (const auto i : list.order()) {
        const auto row = cloud.numbers.begin() + static_cast<std::ptrdiff_t>(i) * R<Dim>::numbers;
        records.insert(records.end(), row, row + R<Dim>::numbers);
    }
    std::vector<Rows> results(sizeof...(Passes), Rows(list.size()));
    const ClusterView view = list.view();
    const auto keep = [&](Rows& rows, std::size_t slot, const std::vector<double>& values) {
        for_each_lane<W>(view, slot, [&](int l, std::size_t i) {
            for (std::size_t k = 0; k < values.size() / W; ++k)
                rows[i].push_back(values[k * W + static_cast<std::size_t>(l)]);
        });
    };
    sweep<W, Dim, R<Dim>, Passes...>(
        view, Lucy<Dim>(h), {records.data(), R<Dim>::numbers},
        [&](std::size_t slot, const auto&, const auto&... sums) {
            auto rows = results.begin();
            (keep(*rows++, slot, flat(sums)), ...);
        },
        std::tuple<Passes...>{one<Passes>()...});
    return results;
}

double difference(const Rows& expected, const Rows& found) {
    double worst = 0.0, size = 1e-3;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        BOOST_REQUIRE(found[i].size() == expected[i].size());
        for (std::size_t k = 0; k < expected[i].size(); ++k) {
            worst = std::max(worst, std::abs(found[i][k] - expected[i][k]));
            size = std::max(size, std::abs(expected[i][k]));
        }
    }
    return worst / size;
}

/// Of each pass.
template <int W, int Dim, class... Passes>
std::vector<double> differences(const std::vector<Rows>& expected, const Cloud<Dim>& cloud) {
    const auto found = swept<W, Dim, Passes...>(cloud, range);
    std::vector<double> all;
    for (std::size_t k = 0; k < found.size(); ++k) all.push_back(difference(expected[k], found[k]));
    return all;
}

template <int Dim, class... Passes>
void every_width() {
    const Cloud<Dim> cloud;
    const std::vector<Rows> expected{pair_by_pair<Dim, Passes>(cloud, range)...};
    const auto check = [](int width, const std::vector<double>& all) {
        for (std::size_t k = 0; k < all.size(); ++k)
            BOOST_TEST(all[k] < 1e-14, "pass " << k << " in " << width << " lanes and " << Dim
                                               << " dimensions: " << all[k]);
    };
    check(1, differences<1, Dim, Passes...>(expected, cloud));
    check(2, differences<2, Dim, Passes...>(expected, cloud));
    check(4, differences<4, Dim, Passes...>(expected, cloud));
    check(8, differences<8, Dim, Passes...>(expected, cloud));
}

template <int Dim, class... More>
void every_pass() {
    every_width<Dim, DensitySum, Continuity, ChainRuleContinuity,
                VelocityGradient<Dim, ArithmeticMean>, VelocityGradient<Dim, EitherMean>,
                PlainTransport<Dim>, AverageTransport<Dim>, MonaghanTransport<Dim, ArithmeticMean>,
                MonaghanTransport<Dim, EitherMean>, StressForce<Dim>,
                ViscousForce<Dim, ArithmeticMean>, ViscousForce<Dim, EitherMean>, More...>();
}

/// Forgets the masses: the comparison must notice.
struct WithoutMass {
    template <class T>
    struct Sums {
        T rho{};
    };
    template <int Dim, class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record&, const Record& j, Sums<T>& sums) {
        sums.rho += j.m * pair.w;
        if constexpr (!std::is_same_v<T, double>) sums.rho += T(0.01) * pair.w;
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_line) { every_pass<1>(); }
BOOST_AUTO_TEST_CASE(in_the_plane) { every_pass<2, TorqueSums<2>, BalancedStressForce<2>>(); }
BOOST_AUTO_TEST_CASE(in_space) { every_pass<3>(); }
BOOST_AUTO_TEST_CASE(a_wrong_pass_is_noticed) {
    const Cloud<2> cloud;
    const std::vector<Rows> expected{pair_by_pair<2, WithoutMass>(cloud, range),
                                     pair_by_pair<2, DensitySum>(cloud, range)};
    const auto all = differences<4, 2, WithoutMass, DensitySum>(expected, cloud);
    BOOST_TEST(all[0] > 1e-3);
    BOOST_TEST(all[1] < 1e-14);
}
