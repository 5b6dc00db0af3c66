// SPDX-License-Identifier: GPL-3.0-or-later
// The pair list against a look at every pair; and that the comparison notices a list that is wrong.
#include <spam/core/error.hpp>
#include <spam/neighbors/brute_force.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace spam;

namespace {

template <int Dim>
Points<Dim> random_points(Eigen::Index n, double size, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(0.0, size);
    Points<Dim> points(Dim, n);
    for (auto& x : points.reshaped()) x = u(random);
    return points;
}

/// Particles whose neighbours in `list` are not those of the brute force.
template <int Dim>
int wrong_particles(const PairList<Dim>& list, const Points<Dim>& x, double cutoff,
                    const Box<Dim>& box) {
    const auto expected = brute_force_neighbours<Dim>(x, cutoff, box);
    int wrong = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto found = list.neighbours(i);
        wrong += std::vector<std::uint32_t>(found.begin(), found.end()) == expected[i] ? 0 : 1;
    }
    return wrong;
}

template <int Dim>
void check(const Box<Dim>& box, double size, double range, double skin) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        Points<Dim> x = random_points<Dim>(300, size, seed);
        if (seed == 4) x.array() -= 3.7 * size;  // never wrapped inside y
        PairList<Dim> list(range, skin, box);
        list.build(x);
        BOOST_TEST(wrong_particles(list, x, range + skin, box) == 0);
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(free_space) {
    check<1>({}, 60.0, 1.0, 0.1);
    check<2>({}, 12.0, 1.0, 0.1);
    check<3>({}, 6.0, 1.0, 0.0);
    check<2>({}, 1.0, 3.0, 0.3);  // everyone sees everyone
    check<2>({}, 1e6, 1.0, 0.1);  // far more cells than particles would be needed
}

BOOST_AUTO_TEST_CASE(periodic_space) {
    check<1>(Box<1>({60.0}), 60.0, 1.0, 0.1);
    check<2>(Box<2>({12.0, 12.0}), 12.0, 1.0, 0.1);
    check<2>(Box<2>({12.0, 12.0}), 12.0, 5.5, 0.4);  // barely above twice the range: two cells
    check<2>(Box<2>({12.0, 0.0}), 12.0, 1.0, 0.1);   // a strip
    check<3>(Box<3>({6.0, 6.0, 6.0}), 6.0, 1.0, 0.1);
    check<3>(Box<3>({6.0, 0.0, 6.0}), 6.0, 2.5, 0.2);
}

BOOST_AUTO_TEST_CASE(the_comparison_notices_a_short_list) {
    const auto x = random_points<2>(300, 12.0, 1);
    PairList<2> list(0.98, 0.0, {});
    list.build(x);
    BOOST_TEST(wrong_particles(list, x, 1.0, {}) > 10);
    PairList<2> unwrapped(1.0, 0.0, {});  // forgets the images
    unwrapped.build(x);
    BOOST_TEST(wrong_particles(unwrapped, x, 1.0, Box<2>({12.0, 12.0})) > 10);
}

BOOST_AUTO_TEST_CASE(a_box_not_wider_than_twice_the_range_is_refused) {
    BOOST_CHECK_THROW(PairList<2>(3.0, 0.0, Box<2>({6.0, 20.0})), InputError);
    BOOST_CHECK_NO_THROW(PairList<2>(3.0, 0.0, Box<2>({6.01, 20.0})));
}

BOOST_AUTO_TEST_CASE(rebuilt_when_someone_moved_half_the_skin) {
    Points<2> x = random_points<2>(100, 8.0, 3);
    PairList<2> list(1.0, 0.2, {});
    BOOST_TEST(list.update(x));
    x(0, 17) += 0.09;
    BOOST_TEST(!list.update(x));
    x(0, 17) += 0.02;
    BOOST_TEST(list.update(x));
    BOOST_TEST(wrong_particles(list, x, 1.2, {}) == 0);
    BOOST_TEST(list.builds() == 2U);
}

BOOST_AUTO_TEST_CASE(no_pair_within_range_is_missed_between_builds) {
    std::mt19937_64 random(4);
    std::normal_distribution<double> g(0.0, 0.01);
    Points<2> x = random_points<2>(300, 12.0, 5);
    PairList<2> list(1.0, 0.2, {});
    for (int step = 0; step < 100; ++step) {
        for (auto& c : x.reshaped()) c += g(random);
        list.update(x);
        const auto expected = brute_force_neighbours<2>(x, 1.0, {});
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const auto found = list.neighbours(i);
            BOOST_TEST(
                std::includes(found.begin(), found.end(), expected[i].begin(), expected[i].end()));
        }
    }
    BOOST_TEST(list.builds() > 1U);
    BOOST_TEST(list.builds() < 100U);
}
