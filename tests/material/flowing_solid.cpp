// SPDX-License-Identifier: GPL-3.0-or-later
// A polynomial solid that flows: the stress is the derivative of the energy with what is spent, that energy is the
// least there is, and a return that is carried out changes neither.
#include "support/random_gradient.hpp"
#include "support/refusal.hpp"
#include <spam/material/flowing_solid.hpp>
#include <spam/material/hyperelastic_material.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>
#include <vector>

using namespace spam;
using namespace spam::test;
using spam::test::refusal;

namespace {

constexpr PolynomialSolid elastic{0.43, 0.43};
constexpr double Y = 0.05, p_c = 0.03;
const FlowingSolid yields{elastic, Y}, tears{elastic, FlowingSolid::never, p_c},
    does_both{elastic, Y, p_c};

template <int Dim>
Mat<Dim> product(const Mat<Dim>& A, const Mat<Dim>& B, bool transpose = false) {
    Mat<Dim> C;
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b)
            for (int c = 0; c < Dim; ++c) C(a, b) += A(a, c) * (transpose ? B(b, c) : B(c, b));
    return C;
}

template <int Dim>
double difference(const Mat<Dim>& A, const Mat<Dim>& B) {
    double worst = 0.0;
    for (std::size_t c = 0; c < A.c.size(); ++c) worst = std::max(worst, std::abs(A.c[c] - B.c[c]));
    return worst;
}

template <int Dim>
double square(const Mat<Dim>& A) {
    double sum = 0.0;
    for (const double x : A.c) sum += x * x;
    return sum;
}

/// By central differences.
template <int Dim, class Law>
Mat<Dim> slope_of_energy(const Law& law, const Mat<Dim>& F) {
    constexpr double h = 1e-6;
    Mat<Dim> P;
    for (std::size_t c = 0; c < F.c.size(); ++c) {
        const auto at = [&](double x) {
            Mat<Dim> moved = F;
            moved.c[c] += x;
            return law.energy(moved);
        };
        P.c[c] = (at(h) - at(-h)) / (2.0 * h);
    }
    return P;
}

/// Stores what is stored after a return, and forgets what that spends.
struct Careless {
    FlowingSolid law;
    template <int Dim>
    double energy(const Mat<Dim>& F) const {
        const auto G = law.flow(F);
        return elastic.energy(G ? product<Dim>(F, *G) : F);
    }
};

/// Ascending. Where the second derivative jumps within the differences their error is of first order.
template <int Dim>
std::vector<double> slope_errors(const FlowingSolid& law, double size, int& flowed,
                                 bool careless = false) {
    std::vector<double> errors;
    for (unsigned seed = 0; seed < 200; ++seed) {
        const Mat<Dim> F = random_gradient<Dim>(seed, size);
        const Mat<Dim> slope =
            careless ? slope_of_energy<Dim>(Careless{law}, F) : slope_of_energy<Dim>(law, F);
        errors.push_back(difference(slope, law.stress(F)));
        flowed += law.flow(F).has_value();
    }
    std::sort(errors.begin(), errors.end());
    return errors;
}

template <int Dim>
void check_slopes() {
    for (const auto& law : {yields, tears, does_both})
        for (const double size : {0.05, 0.2, 0.5}) {
            int flowed = 0;
            const auto errors = slope_errors<Dim>(law, size, flowed);
            BOOST_TEST_MESSAGE(Dim << "D, " << law.describe() << ", strains " << size << ": "
                                   << errors[190] << ", at most " << errors.back() << ", " << flowed
                                   << " flow");
            BOOST_TEST(flowed > 20);
            BOOST_TEST(errors[190] < 3e-8);
            BOOST_TEST(errors.back() < 1e-5);
        }
    int flowed = 0;
    BOOST_TEST(slope_errors<Dim>(yields, 0.2, flowed, true).back() > 1e-3);
}

/// exp(-A) of a symmetric A, and d and v of it.
template <int Dim>
struct Attempt {
    SymTensor<Dim> G;
    double d = 0.0, v = 0.0;

    explicit Attempt(const SymTensor<Dim>& A) {
        auto axes = symmetric_eigen(A);
        for (const double x : axes.value.c) v += x;
        for (double& x : axes.value.c) {
            d += (x - v / Dim) * (x - v / Dim) / (Dim == 3 ? 1.5 : 2.0);
            x = std::exp(-x);
        }
        d = std::sqrt(d);
        G = from_eigen(axes.value, axes.vectors);
    }
};

/// No other return, of other axes or another amount, stores and spends less.
template <int Dim>
void check_that_it_is_the_least() {
    std::mt19937_64 random(7);
    std::normal_distribution<double> g;
    double nearest = 1.0;
    for (unsigned seed = 0; seed < 100; ++seed) {
        const Mat<Dim> F = random_gradient<Dim>(seed, 0.15);
        const auto returned = does_both.flow(F);
        if (!returned || determinant(F) < 0.6) continue;
        SymTensor<Dim> own;
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b) own(a, b) = (*returned)(a, b);
        auto axes = symmetric_eigen(own);
        for (double& x : axes.value.c) x = -std::log(x);
        const SymTensor<Dim> D = from_eigen(axes.value, axes.vectors);
        const double least = does_both.energy(F);
        const Attempt<Dim> same(D);
        BOOST_TEST(std::abs(elastic.energy(F * same.G) + Y * same.d + p_c * same.v - least) <
                   1e-14);
        for (int k = 0; k < 200; ++k) {
            SymTensor<Dim> A = D;
            for (double& x : A.c) x += 0.02 * g(random);
            const Attempt<Dim> other(A);
            if (other.v < 0.0) continue;
            const double more = elastic.energy(F * other.G) + Y * other.d + p_c * other.v - least;
            nearest = std::min(nearest, more);
        }
    }
    BOOST_TEST(nearest > 0.0);
    BOOST_TEST(nearest < 1e-4);
}

template <int Dim>
void check_what_a_return_leaves() {
    for (const auto& law : {yields, tears, does_both}) {
        double stress = 0.0, energy = 0.0;
        for (unsigned seed = 0; seed < 200; ++seed) {
            const Mat<Dim> F = random_gradient<Dim>(seed, 0.2);
            const auto G = law.flow(F);
            if (!G) {
                BOOST_TEST(law.energy(F) == elastic.energy(F));
                BOOST_TEST(difference(law.stress(F), elastic.stress(F)) == 0.0);
                continue;
            }
            const Mat<Dim> after = product<Dim>(F, *G);
            BOOST_TEST(!law.flow(after).has_value());
            // Of what is crushed and becomes harder the stress changes with the work.
            if (determinant(F) > 0.5)
                stress = std::max(
                    stress, difference(law.stress(F), product<Dim>(law.stress(after), *G, true)));
            energy = std::max(energy, std::abs(law.energy(after) - elastic.energy(after)));
            BOOST_TEST(law.energy(F) < elastic.energy(F));
            BOOST_TEST(law.energy(F) > elastic.energy(after));
        }
        BOOST_TEST(stress < 1e-13);
        BOOST_TEST(energy < 1e-14);
    }
}

/// From what is whole to what is turned inside out nothing jumps, and there nothing flows.
template <int Dim>
void check_what_is_crushed() {
    for (const auto& law : {yields, tears, does_both})
        for (unsigned seed = 0; seed < 20; ++seed) {
            const Mat<Dim> F = random_gradient<Dim>(seed, 0.1);
            const auto at = [&](double x) {
                Mat<Dim> flat = F;
                for (int b = 0; b < Dim; ++b) flat(0, b) = x * F(0, b);
                return flat;
            };
            double jump = 0.0, off = 0.0;
            constexpr double step = 1e-3;
            for (int n = 1000; n > -500; --n) {
                const Mat<Dim> from = at(n * step), to = at((n - 1) * step);
                const Mat<Dim> P = law.stress(from), Q = law.stress(to);
                double work = 0.0;
                for (std::size_t c = 0; c < F.c.size(); ++c)
                    work += 0.5 * (P.c[c] + Q.c[c]) * (to.c[c] - from.c[c]);
                jump = std::max(jump, std::abs(law.energy(to) - law.energy(from) - work));
                if (n % 50 == 0)
                    off = std::max(off, difference(slope_of_energy<Dim>(law, from), P) /
                                            (1.0 + std::sqrt(square(P))));
                if (n < 0) BOOST_TEST(!law.flow(from).has_value());
            }
            BOOST_TEST(jump < 1e-4);
            BOOST_TEST(off < 1e-6);
        }
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_stress_is_the_slope_of_what_is_stored_and_spent) {
    check_slopes<2>();
    check_slopes<3>();
}
BOOST_AUTO_TEST_CASE(no_other_return_is_cheaper) {
    check_that_it_is_the_least<2>();
    check_that_it_is_the_least<3>();
}
BOOST_AUTO_TEST_CASE(a_return_leaves_stress_and_energy) {
    check_what_a_return_leaves<2>();
    check_what_a_return_leaves<3>();
}
BOOST_AUTO_TEST_CASE(crushed_and_turned_inside_out) {
    check_what_is_crushed<2>();
    check_what_is_crushed<3>();
}

BOOST_AUTO_TEST_CASE(limits_that_make_no_sense) {
    const auto refused = [](double yield_stress, double tension_limit) {
        return refusal([&] {
            HyperelasticMaterial<2>(FlowingSolid{elastic, yield_stress, tension_limit});
        });
    };
    BOOST_TEST(refused(0.05, 0.03) == "accepted");
    BOOST_TEST(refused(0.0, 0.03).starts_with("yield_stress: 0"));
    BOOST_TEST(refused(0.05, -1.0).starts_with("tension_limit: -1"));
    BOOST_TEST(refused(std::nan(""), 0.03).starts_with("yield_stress: nan"));
}

BOOST_AUTO_TEST_CASE(what_has_no_meaning_stays_without) {
    Mat<2> F;
    F(0, 0) = F(1, 1) = std::numeric_limits<double>::quiet_NaN();
    BOOST_TEST(std::isnan(does_both.stress(F)(0, 0)));
    F(0, 0) = std::numeric_limits<double>::infinity();
    BOOST_TEST(!std::isfinite(does_both.stress(F)(0, 0)));
}
