// SPDX-License-Identifier: GPL-3.0-or-later
// Cluster lists and pair lists against a look at every pair; and that the comparison notices a list
// that is wrong.
#include "neighbors/random_points.hpp"
#include "support/brute_force.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/neighbors/cluster_list.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include <random>
#include <set>

using namespace spam;
using spam::test::random_points;
using spam::test::renumbered;

namespace {

constexpr std::size_t exact_below = 256;  // clusters; larger lists may hold some slots more

/// Clusters whose entries are not, in ascending number, all neighbours of their particles, or all
/// clusters if the slots are no permutation.
template <int Dim>
std::size_t wrong_clusters(const ClusterList<Dim>& list, const Points<Dim>& x, double cutoff,
                           const Box<Dim>& box) {
    const auto expected = brute_force_neighbours<Dim>(x, cutoff, box);
    const auto order = list.order();
    const auto width = static_cast<std::size_t>(list.width());
    const std::set<std::uint32_t> particles(order.begin(), order.end());
    std::size_t wrong = 0;
    for (std::size_t c = 0; c < list.clusters(); ++c) {
        std::set<std::uint32_t> neighbours;
        for (std::size_t l = 0; l < width; ++l)
            for (const auto j : expected[order[c * width + l]]) neighbours.insert(j);
        std::vector<std::uint32_t> found;
        const auto slots = list.entries(c);
        for (const auto slot : slots) found.push_back(list.particle(slot));
        std::sort(found.begin(), found.end());
        // Members of a cluster may have different images of a particle for neighbours.
        found.erase(std::unique(found.begin(), found.end()), found.end());
        const bool complete =
            list.clusters() < exact_below
                ? found == std::vector(neighbours.begin(), neighbours.end())
                : std::includes(found.begin(), found.end(), neighbours.begin(), neighbours.end()) &&
                      found.size() <= 4 * neighbours.size() + 32;
        std::vector<std::uint32_t> numbers;
        for (const auto slot : slots) numbers.push_back(list.particle(slot));
        const bool once =
            std::set<std::uint32_t>(slots.begin(), slots.end()).size() == slots.size();
        const bool right = complete && once && std::is_sorted(numbers.begin(), numbers.end());
        wrong += right ? 0 : 1;
    }
    const bool permutation = particles.size() == list.size() && list.size() == expected.size();
    return permutation ? wrong : list.clusters() + 1;
}

template <int Dim>
void check(const Box<Dim>& box, double size, double range, double skin) {
    for (const int width : {1, 2, 4, 8})
        for (unsigned seed = 1; seed <= 5; ++seed) {
            Points<Dim> x = random_points<Dim>(297 + seed, size, seed);
            if (seed == 4) x.array() -= 3.7 * size;  // never wrapped inside y
            ClusterList<Dim> list(range, skin, box, width);
            list.build(x);
            BOOST_TEST(wrong_clusters(list, x, range + skin, box) == 0U);
            std::size_t pairs = 0;
            const PairList<Dim> by_number(x, range + skin, box);
            const auto expected = brute_force_neighbours<Dim>(x, range + skin, box);
            for (std::size_t i = 0; i < expected.size(); ++i) {
                const auto found = by_number.neighbours(i);
                BOOST_TEST((std::vector(found.begin(), found.end()) == expected[i]));
                pairs += expected[i].size() - 1;
            }
            if (list.clusters() < exact_below)
                BOOST_TEST(2 * list.pairs() == pairs);
            else
                BOOST_TEST(std::abs(2.0 * static_cast<double>(list.pairs()) - double(pairs)) <
                           0.3 * double(pairs) + 10.0);
        }
}

Points<2> turned(const Points<2>& x, double angle, const Point<2>& shift) {
    return (Eigen::Rotation2Dd(angle).toRotationMatrix() * x).colwise() + shift;
}

}  // namespace

BOOST_AUTO_TEST_CASE(free_space) {
    check<1>({}, 60.0, 1.0, 0.1);
    check<2>({}, 12.0, 1.0, 0.1);
    check<3>({}, 6.0, 1.0, 0.0);
    check<2>({}, 1.0, 3.0, 0.3);  // each sees all others
    check<2>({}, 1e6, 1.0, 0.1);  // far more bins than particles would be needed
}

BOOST_AUTO_TEST_CASE(periodic_space) {
    check<1>(Box<1>({60.0}), 60.0, 1.0, 0.1);
    check<2>(Box<2>({12.0, 12.0}), 12.0, 1.0, 0.1);
    check<2>(Box<2>({12.0, 12.0}), 12.0, 5.5, 0.4);  // barely above twice the range
    check<2>(Box<2>({12.0, 0.0}), 12.0, 1.0, 0.1);   // a strip
    check<3>(Box<3>({6.0, 6.0, 6.0}), 6.0, 1.0, 0.1);
    check<3>(Box<3>({6.0, 0.0, 6.0}), 6.0, 2.5, 0.2);
}

BOOST_AUTO_TEST_CASE(odd_sets_of_particles) {
    for (const int width : {1, 2, 4, 8}) {
        for (const Eigen::Index n : {0, 1, 2, 9}) {
            ClusterList<2> list(1.0, 0.1, {}, width);
            list.build(random_points<2>(n, 2.0, 1));
            BOOST_TEST(list.size() == static_cast<std::size_t>(n));
            BOOST_TEST(wrong_clusters(list, random_points<2>(n, 2.0, 1), 1.1, {}) == 0U);
        }
        ClusterList<2> nobody(1.0, 0.1, Box<2>({5.0, 5.0}), width);
        nobody.build(Points<2>(2, 0));
        BOOST_TEST(nobody.size() == 0U);
        BOOST_TEST(nobody.pairs() == 0U);
        Points<2> same = Points<2>::Constant(2, 20, 3.0);  // all in one place
        ClusterList<2> list(1.0, 0.1, {}, width);
        list.build(same);
        BOOST_TEST(wrong_clusters(list, same, 1.1, {}) == 0U);
        Points<2> line = random_points<2>(100, 30.0, 2);
        line.row(0).setZero();
        list.build(line);
        BOOST_TEST(wrong_clusters(list, line, 1.1, {}) == 0U);
        Points<2> flung = random_points<2>(200, 10.0, 3);
        flung.col(7) << 1e9, -1e12;
        list.build(flung);
        BOOST_TEST(wrong_clusters(list, flung, 1.1, {}) == 0U);
    }
}

namespace {

/// Builds for places that change; returns after how many of them slots were particle numbers.
template <int Dim>
int builds_in_own_order(const Points<Dim>& start, const Box<Dim>& box, double step) {
    int count = 0;
    for (const int width : {2, 4, 8}) {
        Points<Dim> x = start;
        ClusterList<Dim> list(1.0, 0.1, box, width);
        std::mt19937_64 random(5);
        std::uniform_real_distribution<double> u(-step, step);
        for (int k = 0; k < 5; ++k) {
            list.build(x);
            BOOST_TEST(wrong_clusters(list, x, 1.1, box) == 0U);
            bool own = true;
            for (std::size_t slot = 0; slot < list.size(); ++slot)
                own = own && list.order()[slot] == slot;
            count += own ? 1 : 0;
            for (auto& c : x.reshaped()) c += u(random);
        }
    }
    return count;
}

}  // namespace

// A list need not be sorted again for particles that stay together, and must be for others.
BOOST_AUTO_TEST_CASE(particles_in_an_order_of_their_own) {
    const Box<2> free, box({16.0, 16.0});
    const Points<2> x = renumbered<2>(random_points<2>(700, 16.0, 1), free);
    BOOST_TEST(builds_in_own_order<2>(x, free, 0.05) == 15);
    BOOST_TEST(builds_in_own_order<2>(x, free, 8.0) == 3);
    const Points<2> y = renumbered<2>(random_points<2>(700, 16.0, 2), box);
    BOOST_TEST(builds_in_own_order<2>(y, box, 0.05) == 15);
    BOOST_TEST(builds_in_own_order<2>(random_points<2>(700, 16.0, 2), box, 0.05) == 0);
    const Box<3> box3({7.0, 7.0, 7.0});
    const Points<3> z = renumbered<3>(random_points<3>(800, 7.0, 3), box3);
    BOOST_TEST(builds_in_own_order<3>(z, box3, 0.05) > 0);

    Points<2> two(2, 2 * x.cols());  // bodies: some clusters have particles of both
    two << x, (x.colwise() + Point<2>(1e4, 0.0));
    builds_in_own_order<2>(renumbered<2>(two, free), free, 0.05);
    Points<2> flung = x;
    for (int k = 0; k < 5; ++k) flung.col(100 * k) *= 1e3;
    builds_in_own_order<2>(flung, free, 0.05);
}

// Many clusters in strips, bodies, gases, boxes: no particle is missed.
BOOST_AUTO_TEST_CASE(large_lists) {
    const Box<2> box({50.0, 50.0});
    for (const auto& space : {Box<2>(), box, Box<2>({50.0, 0.0})})
        for (const int width : {1, 2, 4, 8}) {
            const auto x = random_points<2>(2500, 50.0, 21);
            ClusterList<2> list(1.5, 0.3, space, width);
            list.build(x);
            BOOST_TEST(wrong_clusters(list, x, 1.8, space) == 0U);
        }
    const Box<3> box3({14.0, 14.0, 14.0});
    const auto y = random_points<3>(2700, 14.0, 22);
    ClusterList<3> list(1.5, 0.3, box3, 8);
    list.build(y);
    BOOST_TEST(wrong_clusters(list, y, 1.8, box3) == 0U);
}

BOOST_AUTO_TEST_CASE(the_comparison_notices_a_short_list) {
    const auto x = random_points<2>(300, 12.0, 1);
    ClusterList<2> list(0.98, 0.0, {}, 4);
    list.build(x);
    BOOST_TEST(wrong_clusters(list, x, 1.0, {}) > 10U);
    ClusterList<2> unwrapped(1.0, 0.0, {}, 4);  // forgets the images
    unwrapped.build(x);
    BOOST_TEST(wrong_clusters(unwrapped, x, 1.0, Box<2>({12.0, 12.0})) > 10U);
}

BOOST_AUTO_TEST_CASE(threads_build_the_same_list) {
    const auto x = random_points<2>(5000, 70.0, 6);
    std::vector<std::uint32_t> entries[2];
    for (const int threads : {1, 2}) {
        set_threads(threads);
        ClusterList<2> list(3.0, 0.3, {}, 8);
        list.build(x);
        for (std::size_t c = 0; c < list.clusters(); ++c)
            for (const auto slot : list.entries(c)) entries[threads - 1].push_back(slot);
    }
    set_threads(1);
    BOOST_TEST((entries[0] == entries[1]));
}

// A list takes several images of a particle; what takes the nearest one cannot.
BOOST_AUTO_TEST_CASE(boxes_too_narrow_are_refused) {
    BOOST_CHECK_THROW(ClusterList<2>(3.0, 0.0, Box<2>({0.6, 20.0}), 8), InputError);
    BOOST_CHECK_NO_THROW(ClusterList<2>(3.0, 0.0, Box<2>({0.61, 20.0}), 8));
    const Points<2> x = random_points<2>(10, 6.0, 1);
    BOOST_CHECK_THROW(PairList<2>(x, 3.0, Box<2>({6.0, 20.0})), InputError);
    BOOST_CHECK_NO_THROW(PairList<2>(x, 3.0, Box<2>({6.01, 20.0})));
}

// Offsets of records have 32 bits: beyond them neighbours would be others.
BOOST_AUTO_TEST_CASE(more_records_than_a_list_can_point_to_are_refused) {
    const Points<2> x = random_points<2>(64, 8.0, 3);
    for (const double range : {1.0, HUGE_VAL}) {
        ClusterList<2> most(range, 0.0, {}, 1, std::size_t{1} << 26U);
        BOOST_CHECK_NO_THROW(most.build(x));
        ClusterList<2> beyond(range, 0.0, {}, 1, (std::size_t{1} << 26U) + 1);
        BOOST_CHECK_THROW(beyond.build(x), InputError);
    }
}

BOOST_AUTO_TEST_CASE(serves_until_someone_moved_half_the_skin) {
    Points<2> x = random_points<2>(100, 8.0, 3);
    ClusterList<2> list(1.0, 0.2, {}, 4);
    BOOST_TEST(!list.serves(x));
    list.build(x);
    x(0, 17) += 0.09;
    BOOST_TEST(list.serves(x));
    x(0, 17) += 0.02;
    BOOST_TEST(!list.serves(x));
    list.build(x);
    BOOST_TEST(wrong_clusters(list, x, 1.2, {}) == 0U);
    BOOST_TEST(list.builds() == 2U);
    x(1, 3) = std::numeric_limits<double>::quiet_NaN();
    BOOST_TEST(!list.serves(x));
    x(1, 3) = std::numeric_limits<double>::infinity();
    BOOST_TEST(!list.serves(x));
}

BOOST_AUTO_TEST_CASE(rigid_motion_needs_no_new_list) {
    const Points<2> x = random_points<2>(200, 10.0, 7);
    ClusterList<2> free({1.0, 0.1, {}, 4}), periodic(1.0, 0.1, Box<2>({10.0, 10.0}), 4);
    free.build(x);
    periodic.build(x);
    for (int step = 1; step <= 100; ++step) {
        const Point<2> shift(0.31 * step, -0.2 * step);
        BOOST_TEST(free.serves(turned(x, 0.1 * step, shift)));
        BOOST_TEST(periodic.serves(turned(x, 0.0, shift)));
    }
    // Turning is no symmetry of a periodic box, and stretching none of anything.
    BOOST_TEST(!periodic.serves(turned(x, 0.1, {0.0, 0.0})));
    Points<2> stretched = turned(x, 1.0, {3.0, 4.0});
    stretched.row(0) *= 1.03;
    BOOST_TEST(!free.serves(stretched));
    free.build(stretched);
    BOOST_TEST(wrong_clusters(free, stretched, 1.1, {}) == 0U);

    const Points<3> y = random_points<3>(200, 5.0, 8);
    ClusterList<3> solid(1.0, 0.1, {}, 8);
    solid.build(y);
    const Eigen::AngleAxisd turn(2.0, Eigen::Vector3d(1.0, 2.0, -0.5).normalized());
    BOOST_TEST(solid.serves((turn.toRotationMatrix() * y).array().matrix()));
    BOOST_TEST(!solid.serves(Points<3>(-y)));  // a mirror image is not reached by turning
}

BOOST_AUTO_TEST_CASE(no_pair_within_range_is_missed_between_builds) {
    std::mt19937_64 random(4);
    std::normal_distribution<double> g(0.0, 0.01);
    Points<2> x = random_points<2>(300, 12.0, 5);
    ClusterList<2> list(1.0, 0.2, {}, 4);
    for (int step = 0; step < 100; ++step) {
        for (auto& c : x.reshaped()) c += g(random);
        x = turned(x, 0.05, {0.1, 0.0});
        if (!list.serves(x)) list.build(x);
        const auto expected = brute_force_neighbours<2>(x, 1.0, {});
        for (std::size_t slot = 0; slot < list.size(); ++slot) {
            std::vector<std::uint32_t> found;
            for (const auto j : list.entries(slot / 4)) found.push_back(list.particle(j));
            std::sort(found.begin(), found.end());
            const auto& near = expected[list.order()[slot]];
            BOOST_TEST(std::includes(found.begin(), found.end(), near.begin(), near.end()));
        }
    }
    BOOST_TEST(list.builds() > 1U);
    BOOST_TEST(list.builds() < 100U);
}
