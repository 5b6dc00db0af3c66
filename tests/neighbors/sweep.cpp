// SPDX-License-Identifier: GPL-3.0-or-later
// A pass of one's own, in one file: the number of neighbours and the sum of their squared distances,
// swept with every width, in open space and in a box, against a look at every pair.
#include "support/brute_force.hpp"
#include <spam/neighbors/cluster_list.hpp>
#include <spam/neighbors/sweep.hpp>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace spam;

namespace {

/// A particle of this pass: where it is (and what every pair is given: velocity and mass).
template <int Dim, class T = double>
struct Dot {
    template <class U>
    using With = Dot<Dim, U>;
    static constexpr int numbers = 2 * Dim + 1;
    Vec<Dim, T> x, v;
    T m{};
    template <class F>
    constexpr void visit(const F& f) {
        int k = 0;
        for (T& c : x.c) f(c, k++);
        for (T& c : v.c) f(c, k++);
        f(m, k);
    }
};

/// 1 up to the range, 0 beyond: whole numbers, so that every order of summation is exact.
struct Step {
    double h;
    template <class T>
    T value(const T& r) const {
        const T inside = positive_part(T(h) - r);
        return inside / (inside + T(1e-300));
    }
    template <class T>
    T minus_slope_over_r(const T&) const {
        return T(0.0);
    }
};

struct Coordination {
    template <class T>
    struct Sums {
        T neighbours{}, distance2{};
    };
    template <int Dim, class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record&, const Record&, Sums<T>& sums) {
        sums.neighbours += pair.w;
        sums.distance2 += pair.w * pair.r2;
    }
};

template <int W, int Dim>
void compare(const Box<Dim>& box, double size) {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> u(0.0, size);
    Points<Dim> x(Dim, 301);
    for (auto& c : x.reshaped()) c = u(random);
    ClusterList<Dim> list(1.0, 0.1, box, W, Dot<Dim>::numbers);
    list.build(x);
    std::vector<double> records(list.slots() * Dot<Dim>::numbers, 1.0);
    for (std::size_t slot = 0; slot < list.order().size(); ++slot)
        for (int a = 0; a < Dim; ++a) {
            const auto axis = static_cast<std::size_t>(a);
            records[slot * Dot<Dim>::numbers + axis] =
                list.home()(list.order()[slot], axis, x(a, list.order()[slot]));
        }
    std::array<NumberKind, Dot<Dim>::numbers> kinds{};
    for (unsigned char a = 0; a < Dim; ++a) kinds[a] = {Quantity::position, a, a};
    list.refresh(records.data(), kinds);

    std::vector<double> neighbours(list.size(), -1.0), distance2(list.size());
    const ClusterView view = list.view();
    sweep<W, Dim, Dot<Dim>, Coordination>(view, Step{1.0}, {records.data(), Dot<Dim>::numbers},
                                          [&](std::size_t slot, const auto&, const auto& sums) {
                                              for_each_lane<W>(
                                                  view, slot, [&](int l, std::size_t i) {
                                                      neighbours[i] = lane(sums.neighbours, l);
                                                      distance2[i] = lane(sums.distance2, l);
                                                  });
                                          });

    const auto expected = brute_force_neighbours<Dim>(x, 1.0, box);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        BOOST_TEST(neighbours[i] == static_cast<double>(expected[i].size()));
        double sum = 0.0;
        for (const auto j : expected[i]) {
            for (int a = 0; a < Dim; ++a) {
                const double s = box.nearest_image(a, x(a, static_cast<Eigen::Index>(i)) - x(a, j));
                sum += s * s;
            }
        }
        BOOST_TEST(std::abs(distance2[i] - sum) < 1e-13 * (1.0 + sum));
    }
}

template <int Dim>
void every_width(double size) {
    std::array<double, Dim> lengths;
    lengths.fill(size);
    const Box<Dim> box(lengths), free;
    compare<1>(free, size);
    compare<2>(free, size);
    compare<4>(free, size);
    compare<8>(free, size);
    compare<1>(box, size);
    compare<2>(box, size);
    compare<4>(box, size);
    compare<8>(box, size);
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_line) { every_width<1>(60.0); }
BOOST_AUTO_TEST_CASE(in_the_plane) { every_width<2>(12.0); }
BOOST_AUTO_TEST_CASE(in_space) { every_width<3>(6.0); }
