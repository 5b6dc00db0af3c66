// SPDX-License-Identifier: GPL-3.0-or-later
// Passes in 1, 2, 4 and 8 lanes against their own pair bodies in plain numbers, pair by pair.
#pragma once

#include "support/brute_force.hpp"
#include "support/random_state.hpp"
#include <spam/kernel/lucy.hpp>
#include <spam/neighbors/cluster_list.hpp>
#include <spam/neighbors/sweep.hpp>
#include <spam/physics/pass_constants.hpp>

#include <boost/test/unit_test.hpp>

#include <cstring>

namespace spam::test {

/// A pass, with constants where it holds any.
template <class Pass>
Pass one() {
    if constexpr (requires { Pass::with(PassConstants{}); })
        return Pass::with({MeanDensityKind::geometric, {0.4, 1.1, 1.3}});
    else
        return {};
}

/// Records of random numbers on a jittered lattice.
template <int Dim, class R>
struct RandomCloud {
    static constexpr std::size_t stride = R::numbers;
    static constexpr double range = 2.6;
    Particles<Dim> particles;
    std::mt19937_64 random;
    std::uniform_real_distribution<double> u{-1.0, 1.0};
    std::vector<double> numbers;  ///< records by particle

    explicit RandomCloud(unsigned seed)
        : particles(jittered_particles<Dim>(Dim == 1   ? 60
                                            : Dim == 2 ? 11
                                                       : 5,
                                            seed)),
          random(seed + 1),
          numbers(particles.size() * stride) {
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
    void add(std::size_t i, std::size_t j, typename Pass::template Sums<double>& sums) const {
        const R ri = record(i), rj = record(j);
        one<Pass>().add(make_pair<Dim, double>(Lucy<Dim>(range), separation(ri.x, rj.x), ri, rj),
                        ri, rj, sums);
    }
};

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

template <class Pass, int Dim, class R>
Rows pair_by_pair(const RandomCloud<Dim, R>& cloud) {
    Rows results;
    for (const auto& neighbours :
         brute_force_neighbours<Dim>(cloud.particles.reference_position, cloud.range, Box<Dim>())) {
        typename Pass::template Sums<double> sums;
        for (const auto j : neighbours) cloud.template add<Pass>(results.size(), j, sums);
        results.push_back(flat(sums));
    }
    return results;
}

/// Of every pass, all in one sweep: one apart for each would take a minute to compile.
template <int W, class... Passes, int Dim, class R>
std::vector<Rows> swept(const RandomCloud<Dim, R>& cloud) {
    ClusterList<Dim> list(cloud.range, 0.2, {}, W, cloud.stride);
    list.build(cloud.particles.reference_position);
    std::vector<double> records;
    for (const auto i : list.order()) {
        const auto row = cloud.numbers.begin() + static_cast<std::ptrdiff_t>(i * cloud.stride);
        records.insert(records.end(), row, row + cloud.stride);
    }
    std::vector<Rows> results(sizeof...(Passes), Rows(list.size()));
    const ClusterView view = list.view();
    const auto keep = [&](Rows& rows, std::size_t slot, const std::vector<double>& values) {
        for_each_lane<W>(view, slot, [&](int l, std::size_t i) {
            for (std::size_t k = 0; k < values.size() / W; ++k)
                rows[i].push_back(values[k * W + static_cast<std::size_t>(l)]);
        });
    };
    sweep<W, Dim, R, Passes...>(
        view, Lucy<Dim>(cloud.range), {records.data(), cloud.stride},
        [&](std::size_t slot, const auto&, const auto&... sums) {
            auto rows = results.begin();
            (keep(*rows++, slot, flat(sums)), ...);
        },
        std::tuple<Passes...>{one<Passes>()...});
    return results;
}

inline double difference(const Rows& expected, const Rows& found) {
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

/// Of each pass.
template <int W, class... Passes, int Dim, class R>
std::vector<double> differences(const std::vector<Rows>& expected,
                                const RandomCloud<Dim, R>& cloud) {
    const auto found = swept<W, Passes...>(cloud);
    std::vector<double> all;
    for (std::size_t k = 0; k < found.size(); ++k) all.push_back(difference(expected[k], found[k]));
    return all;
}

template <class... Passes, int Dim, class R>
void every_width(const RandomCloud<Dim, R>& cloud, const char* what = "pass") {
    const std::vector<Rows> expected{pair_by_pair<Passes>(cloud)...};
    const auto check = [&](int width, const std::vector<double>& all) {
        for (std::size_t k = 0; k < all.size(); ++k)
            BOOST_TEST(all[k] < 1e-14, what << " " << k << " in " << width << " lanes and " << Dim
                                            << " dimensions: " << all[k]);
    };
    check(1, differences<1, Passes...>(expected, cloud));
    check(2, differences<2, Passes...>(expected, cloud));
    check(4, differences<4, Passes...>(expected, cloud));
    check(8, differences<8, Passes...>(expected, cloud));
}

}  // namespace spam::test
