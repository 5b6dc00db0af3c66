// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of flows, lists that have grown old and narrow boxes: images of particles.
#include "neighbors/random_points.hpp"
#include "support/brute_force.hpp"
#include <spam/neighbors/cluster_list.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <boost/test/unit_test.hpp>

#include <map>
#include <random>

using namespace spam;
using spam::test::random_points;
using spam::test::renumbered;

namespace {

/// By slot, images among them, as sweeps see them.
template <int Dim>
std::vector<double> coordinates(const ClusterList<Dim>& list, const Points<Dim>& now) {
    const auto order = list.order();
    std::vector<double> x(list.slots() * Dim);
    for (std::size_t slot = 0; slot < order.size(); ++slot)
        for (std::size_t a = 0; a < Dim; ++a)
            x[slot * Dim + a] = list.home()(order[slot], a, now.data()[order[slot] * Dim + a]);
    std::array<NumberKind, Dim> kinds;
    for (unsigned char a = 0; a < Dim; ++a) kinds[a] = {Quantity::position, a, a};
    list.refresh(x.data(), kinds);
    return x;
}

/// Pairs in range, images among them, that the list built before and its images as they are now do not hold
/// exactly once from each end, or not with exactly opposite separations.
template <int Dim>
std::size_t wrong_pairs(ClusterList<Dim>& list, const Points<Dim>& now, double range,
                        const Box<Dim>& box) {
    const auto width = static_cast<std::size_t>(list.width());
    const auto order = list.order();
    const std::vector<double> x = coordinates(list, now);
    using Vector = std::array<double, Dim>;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Vector>> found;
    for (std::size_t slot = 0; slot < list.size(); ++slot)
        for (const auto entry : list.entries(slot / width)) {
            Vector r;
            double r2 = 0.0;
            for (std::size_t a = 0; a < Dim; ++a) {
                r[a] = x[entry + a] - x[slot * Dim + a];
                r2 += r[a] * r[a];
            }
            if (r2 < range * range) found[{order[slot], list.particle(entry / Dim)}].push_back(r);
        }
    std::size_t wrong = 0;
    for (auto& [pair, separations] : found) {
        auto back = found[{pair.second, pair.first}];
        for (Vector& r : back)
            for (double& c : r) c = c == 0.0 ? 0.0 : -c;
        std::sort(back.begin(), back.end());
        std::sort(separations.begin(), separations.end());
        wrong += separations == back ? 0 : 1;
        back = found[{pair.second, pair.first}];
    }
    // Against a look at every pair and every image of it.
    for (Eigen::Index i = 0; i < now.cols(); ++i)
        for (Eigen::Index j = 0; j < now.cols(); ++j) {
            std::size_t images = 0;
            const int most = 4;
            for (int k = 0; k < 81; ++k) {
                Point<Dim> r = now.col(j) - now.col(i);
                for (int a = 0, rest = k; a < Dim; ++a, rest /= 9) {
                    if (!box.periodic(a) && rest % 9 != most) r[a] = 1e300;
                    r[a] -= box.length(a) * std::round(r[a] / std::max(box.length(a), 1e-300) *
                                                       (box.periodic(a) ? 1.0 : 0.0));
                    r[a] += box.length(a) * (rest % 9 - most);
                }
                images += r.norm() < range ? 1 : 0;
            }
            const auto it =
                found.find({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
            wrong += images == (it == found.end() ? 0 : it->second.size()) ? 0 : 1;
        }
    return wrong;
}

}  // namespace

// A list that has grown old while its particles drift across the border, each as far as it may from where
// the drift takes it; in boxes half of which lie just above a power of two, where x + L is rounded.
BOOST_AUTO_TEST_CASE(images_of_an_old_list_are_complete_and_exactly_opposite) {
    for (const double length : {9.3, 8.0 * (1.0 + 1e-15), 17.0 / 3.0}) {
        const Box<2> box({length, length});
        const double range = 2.0, skin = 0.5;
        const Points<2> x = renumbered<2>(random_points<2>(120, length, 31), box);
        std::mt19937_64 random(32);
        std::uniform_real_distribution<double> angle(0.0, 6.283185307179586);
        for (const int width : {2, 8}) {
            ClusterList<2> list(range, skin, box, width, 2);
            list.build(x);
            std::size_t served = 0;
            for (int step = 0; step < 40; ++step) {
                Points<2> now = x.colwise() + Point<2>(0.63 * step, -0.37 * step);
                for (Eigen::Index i = 0; i < now.cols(); ++i) {
                    const double a = angle(random);
                    now.col(i) += 0.45 * skin * Point<2>(std::cos(a), std::sin(a));
                }
                if (!list.serves(now)) continue;  // the mean of many random moves is not quite zero
                ++served;
                BOOST_TEST(wrong_pairs(list, now, range, box) == 0U);
            }
            BOOST_TEST(list.builds() == 1U);
            BOOST_TEST(served > 10U);
        }
    }
}

// A particle may have several images in range, itself among them.
BOOST_AUTO_TEST_CASE(boxes_narrower_than_the_range) {
    for (const auto& lengths : {std::array{2.0, 9.0}, std::array{1.7, 0.0}, std::array{1.1, 1.3}}) {
        const Box<2> box(lengths);
        for (const int width : {1, 4}) {
            ClusterList<2> list(3.0, 0.2, box, width, 2);
            const Points<2> x = random_points<2>(60, 9.0, 5);
            list.build(x);
            BOOST_TEST(wrong_pairs(list, x, 3.0, box) == 0U);
        }
    }
}

namespace {

/// Clusters whose entries are not in ascending number of their particles, or images of one particle not in
/// ascending place, the first direction first; `by_slot` puts the entries into the order of their slots
/// before.
template <int Dim>
std::size_t disordered(const ClusterList<Dim>& list, const Points<Dim>& now, bool by_slot) {
    const std::vector<double> x = coordinates(list, now);
    std::size_t wrong = 0;
    for (std::size_t c = 0; c < list.clusters(); ++c) {
        std::vector<std::uint32_t> entries(list.entries(c).begin(), list.entries(c).end());
        if (by_slot) std::sort(entries.begin(), entries.end());
        wrong += std::is_sorted(entries.begin(), entries.end(),
                                [&](auto e, auto f) {
                                    const auto i = list.particle(e / Dim),
                                               j = list.particle(f / Dim);
                                    if (i != j) return i < j;
                                    return std::lexicographical_compare(&x[e], &x[e] + Dim, &x[f],
                                                                        &x[f] + Dim);
                                })
                     ? 0
                     : 1;
    }
    return wrong;
}

}  // namespace

BOOST_AUTO_TEST_CASE(entries_ascend_with_the_number_of_the_particle) {
    Box<2> walls({0.0, 30.0}), mirrors;
    for (const bool upper : {false, true}) {
        walls.set_wall(0, upper, {WallKind::mirror, upper ? 30.0 : 0.0});
        for (int a = 0; a < 2; ++a)
            mirrors.set_wall(a, upper, {WallKind::mirror, upper ? 30.0 : 0.0});
    }
    const Points<2> x = random_points<2>(3000, 30.0, 41);
    std::size_t clusters = 0, otherwise = 0;
    for (const auto& box : {Box<2>(), Box<2>({30.0, 30.0}), walls, mirrors})
        for (const Points<2>& position : {x, renumbered<2>(x, {})})
            for (const int width : {1, 2, 4, 8}) {
                ClusterList<2> list(1.5, 0.3, box, width, 2);
                for (int build = 0; build < 3; ++build) list.build(position);
                BOOST_TEST(disordered(list, position, false) == 0U);
                clusters += list.clusters(), otherwise += disordered(list, position, true);
            }
    BOOST_TEST(otherwise > clusters / 4);  // the order of slots is another one
    // Several images of a particle.
    for (const auto& lengths : {std::array{2.0, 9.0}, std::array{1.1, 1.3}})
        for (const Eigen::Index n : {60, 400}) {
            ClusterList<2> list(3.0, 0.2, Box<2>(lengths), 4, 2);
            const Points<2> narrow = random_points<2>(n, 9.0, 5);
            list.build(narrow);
            BOOST_TEST(disordered(list, narrow, false) == 0U);
        }
    const Points<3> z = random_points<3>(2500, 9.0, 42);
    for (const auto& box : {Box<3>(), Box<3>({9.0, 9.0, 9.0}), Box<3>({9.0, 0.0, 9.0})}) {
        ClusterList<3> list(1.5, 0.2, box, 8, 3);
        list.build(z);
        BOOST_TEST(disordered(list, z, false) == 0U);
    }
}

// Many particles in no order: those of a flow.
BOOST_AUTO_TEST_CASE(pair_lists_of_a_flow_ascend) {
    const Box<2> box({50.0, 50.0});
    const auto x = random_points<2>(3000, 50.0, 33);
    const auto expected = brute_force_neighbours<2>(x, 1.5, box);
    const PairList<2> list(x, 1.5, box);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < list.size(); ++i)
        wrong += std::ranges::equal(list.neighbours(i), expected[i]) ? 0 : 1;
    BOOST_TEST(wrong == 0U);
}
