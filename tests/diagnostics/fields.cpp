// SPDX-License-Identifier: GPL-3.0-or-later
// Fields between the particles against sums over all of them; their gradients against difference
// quotients; spectra of gridded fields against waves whose spectrum is known.
#include <spam/core/error.hpp>
#include <spam/diagnostics/field_grid.hpp>
#include <spam/diagnostics/field_interpolation.hpp>
#include <spam/kernel/lucy.hpp>
#include <spam/kernel/wn.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

using namespace spam;
using std::numbers::pi;

namespace {

constexpr double h = 1.3;

/// Particles anywhere in a box of side L, values of two components, and places to look at, some of them
/// far outside.
template <int Dim>
struct Sample {
    Box<Dim> box;
    Points<Dim> x, at;
    std::vector<double> mass;
    Eigen::MatrixXd f;

    Sample(unsigned seed, bool periodic, double L, Eigen::Index n)
        : x(Dim, n),
          at(Dim, 60),
          f(2, n) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> u(0.0, 1.0);
        std::array<double, Dim> lengths;
        lengths.fill(L);
        if (periodic) box = Box<Dim>(lengths);
        for (double& c : x.reshaped()) c = 3.0 * L * (u(random) - 1.0 / 3.0);  // not wrapped
        if (!periodic) x /= 3.0;
        for (double& c : at.reshaped()) c = 1.4 * L * (u(random) - 0.2);
        at.col(0).setConstant(1e9);
        at.col(1).setConstant(-7.0 * L);
        for (double& c : f.reshaped()) c = u(random) - 0.5;
        for (Eigen::Index k = 0; k < n; ++k) mass.push_back(0.5 + u(random));
    }
    FieldInterpolation<Dim> field() const { return {Wn<Dim, 4>(h), mass, x, box}; }

    /// rho and the two components of f at one place, by looking at every particle.
    Eigen::Vector3d everything(const Point<Dim>& place) const {
        const Wn<Dim, 4> w(h);
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (Eigen::Index j = 0; j < x.cols(); ++j) {
            double r2 = 0.0;
            for (int a = 0; a < Dim; ++a) {
                double s = place(a) - x(a, j);
                if (box.periodic(a)) s -= box.length(a) * std::round(s / box.length(a));
                r2 += s * s;
            }
            const double mw = mass[static_cast<std::size_t>(j)] * w.value(std::sqrt(r2));
            sum += mw * Eigen::Vector3d(1.0, f(0, j), f(1, j));
        }
        return {sum(0), sum(1) / sum(0), sum(2) / sum(0)};
    }
};

template <int Dim>
void check_against_everything(const Sample<Dim>& sample) {
    const auto field = sample.field();
    const auto rho = field.density(sample.at);
    const auto f = field.value(sample.f, sample.at);
    int inside = 0;
    for (Eigen::Index p = 0; p < sample.at.cols(); ++p) {
        // Rounding of far places is that of the places themselves.
        if (p == 0 && sample.box.periodic()) continue;
        const Eigen::Vector3d expected = sample.everything(sample.at.col(p));
        BOOST_TEST(std::abs(rho(p) - expected(0)) <= 1e-12 * (1.0 + expected(0)));
        for (int c = 0; c < 2; ++c) {
            if (expected(0) < 1e-9) continue;
            BOOST_TEST(std::abs(f(c, p) - expected(1 + c)) <= 1e-9);
            ++inside;
        }
        if (expected(0) == 0.0) BOOST_TEST(std::isnan(f(0, p)));
    }
    BOOST_TEST(inside > 10);
}

/// The largest error of `gradient`, C Dim x M, as the slope of value(at), C x M.
template <int Dim, class Value>
double gradient_error(const Points<Dim>& at, const Eigen::MatrixXd& gradient, const Value& value) {
    const double d = 1e-4;
    double worst = 0.0;
    for (int a = 0; a < Dim; ++a) {
        const auto shifted = [&](double s) {
            Points<Dim> moved = at;
            moved.row(a).array() += s;
            return Eigen::MatrixXd(value(moved));
        };
        const Eigen::MatrixXd slope =
            (8.0 * (shifted(d) - shifted(-d)) - (shifted(2 * d) - shifted(-2 * d))) / (12.0 * d);
        for (Eigen::Index c = 0; c < slope.rows(); ++c)
            for (Eigen::Index p = 0; p < slope.cols(); ++p)
                if (std::isfinite(slope(c, p)))
                    worst = std::max(worst, std::abs(slope(c, p) - gradient(a + Dim * c, p)));
    }
    return worst;
}

template <int Dim>
void check() {
    const double L = 2.7;  // two cells of the range
    const Eigen::Index n = Dim == 1 ? 20 : Dim == 2 ? 120 : 500;
    for (const bool periodic : {false, true})
        for (const double side : {L, 4.0 * L})
            BOOST_TEST_CONTEXT(Dim << "d, " << (periodic ? "periodic" : "free")
                                   << ", L = " << side) {
                const auto many = static_cast<Eigen::Index>(side > L ? 4.0 : 1.0) * n;
                const Sample<Dim> sample(3, periodic, side, many);
                check_against_everything(sample);
                const auto field = sample.field();
                const Points<Dim> at = sample.at.rightCols(50);
                BOOST_TEST(gradient_error<Dim>(at, field.density_gradient(at), [&](const auto& p) {
                               return field.density(p);
                           }) < 1e-8);
                const Points<Dim> among = sample.x.leftCols(15);  // where there are particles
                const auto value = [&](const auto& p) { return field.value(sample.f, p); };
                const Eigen::MatrixXd gradient = field.gradient(sample.f, among);
                BOOST_TEST(gradient_error<Dim>(among, gradient, value) < 1e-8);
                // Without the second term, -f grad rho, it is the slope of something else.
                const Eigen::MatrixXd f = value(among), rho = field.density(among);
                Eigen::MatrixXd wrong = gradient;
                const Points<Dim> grad_rho = field.density_gradient(among);
                for (Eigen::Index p = 0; p < among.cols(); ++p)
                    for (int a = 0; a < Dim; ++a) wrong(a, p) += f(0, p) * grad_rho(a, p) / rho(p);
                BOOST_TEST(gradient_error<Dim>(among, wrong, value) > 1e-2);
            }
}

}  // namespace

BOOST_AUTO_TEST_CASE(interpolation_is_the_sum_over_all_1d) { check<1>(); }
BOOST_AUTO_TEST_CASE(interpolation_is_the_sum_over_all_2d) { check<2>(); }
BOOST_AUTO_TEST_CASE(interpolation_is_the_sum_over_all_3d) { check<3>(); }

BOOST_AUTO_TEST_CASE(constants_are_reproduced_and_planes_nearly) {
    const Points<2> x = triangular_block(20, 20);
    const FieldInterpolation<2> field(Lucy<2>(3.0), std::vector<double>(400, 1.0), x, {});
    Eigen::MatrixXd f(2, 400);
    f.row(0).setConstant(7.0);
    f.row(1) = 2.0 * x.row(0) - x.row(1);
    Points<2> at(2, 2);
    at << 9.1, 10.3, 8.2, 7.7;
    const Eigen::MatrixXd value = field.value(f, at), gradient = field.gradient(f, at);
    for (Eigen::Index p = 0; p < 2; ++p) {
        BOOST_TEST(std::abs(value(0, p) - 7.0) < 1e-14);
        BOOST_TEST(std::abs(gradient(0, p)) < 1e-14);
        BOOST_TEST(std::abs(value(1, p) - (2.0 * at(0, p) - at(1, p))) < 2e-3);
        BOOST_TEST(std::abs(gradient(2, p) - 2.0) < 0.02);
        BOOST_TEST(std::abs(gradient(3, p) + 1.0) < 0.02);
    }
}

BOOST_AUTO_TEST_CASE(a_grid_holds_all_the_mass) {
    const Sample<2> sample(5, true, 5.0, 100);
    const auto grid = FieldGrid<2>::over(sample.box, {64, 48});
    const double mean = sample.field().density(grid.points()).mean();
    const double mass = std::accumulate(sample.mass.begin(), sample.mass.end(), 0.0);
    BOOST_TEST(std::abs(mean * 25.0 - mass) < 1e-4 * mass);
}

BOOST_AUTO_TEST_CASE(one_particle_and_none) {
    const Points<3> here = Points<3>::Zero(3, 1);
    const FieldInterpolation<3> one(Lucy<3>(1.0), {2.0}, here, {});
    BOOST_TEST(one.density(here)(0) == 2.0 * Lucy<3>(1.0).value(0.0));
    const FieldInterpolation<3> none(Lucy<3>(1.0), {}, Points<3>(3, 0), {});
    BOOST_TEST(none.density(here)(0) == 0.0);
    BOOST_CHECK_THROW(FieldInterpolation<1>(Lucy<1>(1.0), {}, Points<1>(1, 0), Box<1>({2.0})),
                      InputError);
}

BOOST_AUTO_TEST_CASE(nodes_of_grids) {
    const auto grid = FieldGrid<2>::between({-1.0, 2.0}, {2.0, 2.5}, 0.5);
    BOOST_TEST((grid.nodes == std::array<int, 2>{7, 2}));
    BOOST_TEST(grid.size() == 14u);
    const Points<2> at = grid.points();
    BOOST_TEST((at.col(0) == Point<2>(-1.0, 2.0)));
    BOOST_TEST((at.col(8) == Point<2>(-0.5, 2.5)));
    const auto periodic = FieldGrid<2>::over(Box<2>({4.0, 3.0}), {8, 3});
    BOOST_TEST((periodic.points().col(23) == Point<2>(3.5, 2.0)));
    BOOST_CHECK_THROW(FieldGrid<2>::over(Box<2>({4.0, 0.0}), {8, 8}), InputError);
    BOOST_CHECK_THROW(FieldGrid<2>::over(Box<2>({4.0, 3.0}), {8, 0}), InputError);
    BOOST_CHECK_THROW(FieldGrid<2>::between({0.0, 0.0}, {1.0, 1.0}, 0.0), InputError);
    BOOST_CHECK_THROW(FieldGrid<2>::between({0.0, 0.0}, {1.0, 1.0}, 1e-6), InputError);
}

BOOST_AUTO_TEST_CASE(waves_have_their_power_in_their_shells) {
    for (const std::array<int, 2> nodes : {std::array{16, 12}, {15, 9}, {8, 31}}) {
        const auto grid = FieldGrid<2>::over(Box<2>({8.0, 4.0}), nodes);
        const Points<2> at = grid.points();
        std::vector<double> f;
        for (const auto& r : at.colwise())  // k = (2 pi/8)(1, 2) and (3, 0), d = 2 pi/8
            f.push_back(1.5 + 2.0 * std::cos(2.0 * pi * (r.x() / 8.0 + r.y() / 4.0)) +
                        0.5 * std::sin(2.0 * pi * 3.0 * r.x() / 8.0));
        const WaveSpectrum spectrum = wave_spectrum(grid, f);
        BOOST_TEST(std::abs(spectrum.power[0] - 2.25) < 1e-14);
        BOOST_TEST(std::abs(spectrum.power[2] - 2.0) < 1e-14);  // sqrt(5) = 2.24
        BOOST_TEST(std::abs(spectrum.power[3] - 0.125) < 1e-14);
        BOOST_TEST(std::abs(spectrum.k[3] - 3.0 * 2.0 * pi / 8.0) < 1e-14);
        BOOST_TEST(std::accumulate(spectrum.waves.begin(), spectrum.waves.end(), 0) ==
                   nodes[0] * nodes[1]);
    }
}

BOOST_AUTO_TEST_CASE(the_power_of_all_waves_is_the_mean_square) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> g;
    const auto check = [&](const auto& grid) {
        std::vector<double> f(grid.size());
        for (double& x : f) x = g(random);
        double square = 0.0;
        for (const double x : f) square += x * x / static_cast<double>(f.size());
        const auto spectrum = wave_spectrum(grid, f);
        const double power = std::accumulate(spectrum.power.begin(), spectrum.power.end(), 0.0);
        BOOST_TEST(std::abs(power - square) < 1e-13 * square);
    };
    check(FieldGrid<1>::over(Box<1>({3.0}), {17}));
    check(FieldGrid<2>::over(Box<2>({3.0, 2.0}), {16, 9}));
    check(FieldGrid<3>::over(Box<3>({3.0, 2.0, 4.0}), {6, 5, 8}));
}
