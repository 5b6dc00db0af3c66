// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of flows and lists that have grown old, in periodic boxes.
#include "neighbors/random_points.hpp"
#include <spam/neighbors/brute_force.hpp>
#include <spam/neighbors/cluster_list.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace spam;
using spam::test::random_points;
using spam::test::renumbered;

namespace {

/// Pairs in range of which a cluster's list says that no image is nearer, and one is: the list built at
/// `x` is used at `now`.
std::size_t images_missed(ClusterList<2>& list, const Points<2>& now, double range,
                          const Box<2>& box) {
    const Points<2> wrapped = box.wrapped(now);
    const auto order = list.order();
    const auto width = static_cast<std::size_t>(list.width());
    std::size_t missed = 0;
    for (std::size_t c = 0; c < list.clusters(); ++c) {
        if (list.view().direct[c] == 0) continue;
        for (std::size_t l = 0; l < width; ++l)
            for (const auto slot : list.entries(c)) {
                const Point<2> r = wrapped.col(order[c * width + l]) - wrapped.col(order[slot]);
                const Point<2> image(box.nearest_image(0, r.x()), box.nearest_image(1, r.y()));
                missed += image.norm() < range && image != r ? 1 : 0;
            }
    }
    return missed;
}

}  // namespace

// Clusters far from the border are spared the images. A list that has grown old while its particles drift
// across the border, each as far as it may from where the drift takes it, must know which these are.
BOOST_AUTO_TEST_CASE(an_old_list_knows_who_is_near_the_border) {
    const Box<2> box({24.0, 24.0});
    const double range = 2.0, skin = 0.8;
    const Points<2> x = renumbered<2>(random_points<2>(900, 24.0, 31), box);
    std::mt19937_64 random(32);
    std::uniform_real_distribution<double> angle(0.0, 6.283185307179586);
    for (const int width : {2, 8}) {
        ClusterList<2> list(range, skin, box, width);
        list.build(x);
        std::size_t direct = 0, missed = 0;
        for (int step = 0; step < 200; ++step) {
            Points<2> now = x.colwise() + Point<2>(0.13 * step, -0.07 * step);
            for (Eigen::Index i = 0; i < now.cols(); ++i) {
                const double a = angle(random);
                now.col(i) += 0.49 * skin * Point<2>(std::cos(a), std::sin(a));
            }
            if (!list.serves(now)) continue;  // the mean of 900 random moves is not quite zero
            for (std::size_t c = 0; c < list.clusters(); ++c) direct += list.view().direct[c];
            missed += images_missed(list, now, range, box);
        }
        BOOST_TEST(list.builds() == 1U);
        BOOST_TEST(direct > 1000U);
        BOOST_TEST(missed == 0U);
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
