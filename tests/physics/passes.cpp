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

template <int Dim, class Pass>
std::vector<std::vector<double>> pair_by_pair(const Cloud<Dim>& cloud, double h) {
    const auto neighbours =
        brute_force_neighbours<Dim>(cloud.particles.reference_position, h, Box<Dim>());
    std::vector<std::vector<double>> results;
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

template <int W, int Dim, class Pass>
std::vector<std::vector<double>> swept(const Cloud<Dim>& cloud, double h) {
    ClusterList<Dim> list(h, 0.2, {}, W, R<Dim>::numbers);
    list.build(cloud.particles.reference_position);
    std::vector<double> records;
    for (const auto i : list.order()) {
        const auto row = cloud.numbers.begin() + static_cast<std::ptrdiff_t>(i) * R<Dim>::numbers;
        records.insert(records.end(), row, row + R<Dim>::numbers);
    }
    std::vector<std::vector<double>> results(list.size());
    const ClusterView view = list.view();
    sweep<W, Dim, R<Dim>, Pass>(
        view, Lucy<Dim>(h), {records.data(), R<Dim>::numbers},
        [&](std::size_t slot, const auto&, const auto& sums) {
            const auto values = flat(sums);
            for_each_lane<W>(view, slot, [&](int l, std::size_t i) {
                for (std::size_t k = 0; k < values.size() / W; ++k)
                    results[i].push_back(values[k * W + static_cast<std::size_t>(l)]);
            });
        },
        std::tuple<Pass>{one<Pass>()});
    return results;
}

template <int W, int Dim, class Pass>
double difference(const Cloud<Dim>& cloud) {
    const double h = 2.6;
    const auto expected = pair_by_pair<Dim, Pass>(cloud, h);
    const auto found = swept<W, Dim, Pass>(cloud, h);
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

template <int Dim, class Pass>
void every_width(const char* name) {
    const Cloud<Dim> cloud;
    BOOST_TEST_CONTEXT(name << " in " << Dim << " dimensions") {
        BOOST_TEST((difference<1, Dim, Pass>(cloud)) < 1e-14);
        BOOST_TEST((difference<2, Dim, Pass>(cloud)) < 1e-14);
        BOOST_TEST((difference<4, Dim, Pass>(cloud)) < 1e-14);
        BOOST_TEST((difference<8, Dim, Pass>(cloud)) < 1e-14);
    }
}

template <int Dim>
void every_pass() {
    every_width<Dim, DensitySum>("density sum");
    every_width<Dim, Continuity>("continuity");
    every_width<Dim, ChainRuleContinuity>("chain rule");
    every_width<Dim, VelocityGradient<Dim, ArithmeticMean>>("velocity gradient");
    every_width<Dim, VelocityGradient<Dim, EitherMean>>("velocity gradient, geometric");
    every_width<Dim, PlainTransport<Dim>>("v");
    every_width<Dim, AverageTransport<Dim>>("<v>");
    every_width<Dim, MonaghanTransport<Dim, ArithmeticMean>>("<v>_Monaghan");
    every_width<Dim, MonaghanTransport<Dim, EitherMean>>("<v>_Monaghan, geometric");
    every_width<Dim, StressForce<Dim>>("stress force");
    every_width<Dim, ViscousForce<Dim, ArithmeticMean>>("viscous force");
    every_width<Dim, ViscousForce<Dim, EitherMean>>("viscous force, geometric");
    if constexpr (Dim == 2) {
        every_width<Dim, TorqueSums>("torque sums");
        every_width<Dim, BalancedStressForce>("balanced stress force");
    }
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
BOOST_AUTO_TEST_CASE(in_the_plane) { every_pass<2>(); }
BOOST_AUTO_TEST_CASE(in_space) { every_pass<3>(); }
BOOST_AUTO_TEST_CASE(a_wrong_pass_is_noticed) {
    BOOST_TEST((difference<4, 2, WithoutMass>(Cloud<2>())) > 1e-3);
}
