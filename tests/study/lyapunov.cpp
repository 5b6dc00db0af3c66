// SPDX-License-Identifier: GPL-3.0-or-later
// Tangents: derivatives of right-hand sides, motions of tangents, and the exponents made of them.
#include "support/random_state.hpp"
#include <spam/analysis/lattice_modes.hpp>
#include <spam/analysis/periodic_solid.hpp>
#include <spam/analysis/wave_vectors.hpp>
#include <spam/core/error.hpp>
#include <spam/external/gravity.hpp>
#include <spam/external/thermostat.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/reflected_pairs.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>
#include <spam/study/lyapunov.hpp>

#include <Eigen/Dense>
#include <boost/test/unit_test.hpp>
#include <gsl/gsl_eigen.h>

using namespace spam;
using namespace spam::test;

namespace {

/// n x n soft disks in a periodic box of density 1, each with kinetic energy 1.
struct SoftDisks {
    explicit SoftDisks(int n)
        : box({double(n), double(n)}),
          model(one_body(make_particles<2>(cell_centres<2>({n, n}), 1.0, 1.0, box)), box) {
        model.add_term<Core<2>>(CorePotential{100.0, 1.0});
        y = initial_state<2>(model, 1.0, 1.0, at_rest<2>());
        auto v = State<2>(model.layout(), y).velocity();
        for (Eigen::Index i = 0; i < v.cols(); ++i)
            v.col(i) << std::sin(2.3 * double(i) + 1.0), std::cos(3.1 * double(i));
        v.colwise() -= Point<2>(v.rowwise().mean());
        v *= std::sqrt(2.0 * double(v.cols()) / v.squaredNorm());
        model.layout().set_scale(Field::velocity, 1.0);
    }
    Box<2> box;
    ParticleModel<2> model;
    std::vector<double> y;
};

/// J, column by column.
template <int Dim>
Eigen::MatrixXd jacobian(Model<Dim>& model, std::span<const double> y) {
    const auto n = static_cast<Eigen::Index>(y.size());
    Eigen::MatrixXd J(n, n);
    Eigen::VectorXd v = Eigen::VectorXd::Zero(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        v[k] = 1.0;
        model.tangent(0.0, y, {v.data(), y.size()}, {J.col(k).data(), y.size()});
        v[k] = 0.0;
    }
    return J;
}

/// By GSL: the eigenvalues of Eigen alone take a third of this file's time to compile.
double largest_growth(Eigen::MatrixXd J) {
    const auto n = static_cast<std::size_t>(J.rows());
    std::vector<double> values(2 * n);  // of the transpose: the same
    auto matrix = gsl_matrix_view_array(J.data(), n, n);
    auto eigenvalues = gsl_vector_complex_view_array(values.data(), n);
    auto* const workspace = gsl_eigen_nonsymm_alloc(n);
    const int failed = gsl_eigen_nonsymm(&matrix.matrix, &eigenvalues.vector, workspace);
    gsl_eigen_nonsymm_free(workspace);
    BOOST_REQUIRE(failed == 0);
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, values[2 * k]);
    return largest;
}

}  // namespace

// Its derivative along v of a potential's forces: by differences of the law itself, in other steps.
BOOST_AUTO_TEST_CASE(the_tangent_is_the_derivative) {
    SoftDisks disks(6);
    for (std::size_t k = 0; k < disks.y.size(); ++k) disks.y[k] += 0.1 * std::sin(1.7 * double(k));
    Eigen::VectorXd v = Eigen::VectorXd::Random(Eigen::Index(disks.y.size())), Jv = v, other = v;
    disks.model.tangent(0.0, disks.y, {v.data(), disks.y.size()}, {Jv.data(), disks.y.size()});
    const auto rates_at = [&](double step) -> Eigen::VectorXd {
        auto y = disks.y;
        for (std::size_t k = 0; k < y.size(); ++k) y[k] += step * v[Eigen::Index(k)];
        const auto y_dot = rates_of(disks.model, y);
        return Eigen::Map<const Eigen::VectorXd>(y_dot.data(), Eigen::Index(y_dot.size()));
    };
    // of fourth order
    const double h = 1e-4;
    other =
        (8.0 * (rates_at(h) - rates_at(-h)) - (rates_at(2 * h) - rates_at(-2 * h))) / (12.0 * h);
    BOOST_TEST((Jv - other).norm() < 1e-8 * Jv.norm());
    v *= 1e-30;  // whatever its size
    disks.model.tangent(0.0, disks.y, {v.data(), disks.y.size()}, {other.data(), disks.y.size()});
    BOOST_TEST((1e30 * other - Jv).norm() < 1e-8 * Jv.norm());
}

// A tangent that begins as y_dot stays y_dot, to the error of the method.
BOOST_AUTO_TEST_CASE(a_tangent_along_the_motion_stays_along_it) {
    const auto difference = [](double dt) {
        SoftDisks disks(6);
        const auto y_dot = rates_of(disks.model, disks.y);
        const Eigen::MatrixXd begin =
            Eigen::Map<const Eigen::VectorXd>(y_dot.data(), Eigen::Index(y_dot.size()));
        TangentMotion<2> motion(disks.model, disks.y, begin, {.method = "rk4", .dt = dt});
        motion.advance_to(1.0);
        const auto now = rates_of(disks.model, motion.y());
        const Eigen::VectorXd expected =
            Eigen::Map<const Eigen::VectorXd>(now.data(), Eigen::Index(now.size()));
        return (motion.tangents().col(0) - expected).norm() / expected.norm();
    };
    const double coarse = difference(0.01), fine = difference(0.005);
    BOOST_TEST(fine < 3e-4);
    BOOST_TEST(coarse > 6.0 * fine);
    BOOST_TEST(coarse < 16.0 * fine);
}

// Leapfrog's map is symplectic: so are its tangents.
BOOST_AUTO_TEST_CASE(leapfrog_keeps_the_symplectic_form) {
    SoftDisks disks(6);
    const Eigen::Index half = Eigen::Index(disks.y.size()) / 2;
    const auto form = [&](const Eigen::MatrixXd& V) {
        return V.col(0).head(half).dot(V.col(1).tail(half)) -
               V.col(1).head(half).dot(V.col(0).tail(half));
    };
    Eigen::MatrixXd V = Eigen::MatrixXd::Random(2 * half, 2);
    TangentMotion<2> motion(disks.model, disks.y, V, {.method = "leapfrog", .dt = 0.005});
    motion.advance_to(2.0);
    const auto now = motion.tangents();
    BOOST_TEST(now.norm() > 10.0 * V.norm());
    // J v is known to about 1e-10 of its size (Model::tangent), and errors of 400 kicks add like the steps of a walk.
    const double error = 1e-10 * std::sqrt(400.0);
    BOOST_TEST(std::abs(form(now) - form(V)) < error * now.col(0).norm() * now.col(1).norm());
}

BOOST_AUTO_TEST_CASE(exponents_of_a_gas_come_in_pairs) {
    SoftDisks disks(3);
    const auto found =
        lyapunov_spectrum<2>(disks.model, disks.y, {.method = "leapfrog", .dt = 0.005},
                             {.duration = 60.0, .exponents = 36});
    const auto& e = found.exponents;
    BOOST_TEST(e.front() > 1.0);
    double sum = 0.0, pairs = 0.0;
    for (std::size_t k = 0; k < e.size(); ++k) {
        sum += e[k];
        pairs = std::max(pairs, std::abs(e[k] + e[e.size() - 1 - k]));
    }
    BOOST_TEST(std::abs(sum) < 1e-6);
    BOOST_TEST(std::abs(found.trace) < 1e-6);
    BOOST_TEST(pairs < 0.2);  // as exact as 60 times are long
    BOOST_TEST(found.windows.size() == 40U);
}

// At the end of each window: the state, and a tangent of length one that positions and velocities share.
BOOST_AUTO_TEST_CASE(shares_of_the_leading_tangent) {
    SoftDisks disks(3);
    std::vector<double> times;
    LyapunovOptions options{.duration = 4.0, .window = 1.0};
    options.at_window = [&](double t, std::span<const double> y, std::span<const double> leading) {
        times.push_back(t);
        BOOST_TEST(y.size() == disks.y.size());
        const auto share = shares(disks.model, leading);
        double sum = 0.0;
        for (std::size_t i = 0; i < share.size(); ++i) {
            double expected = 0.0;
            for (const std::size_t k : {2 * i, 2 * i + 1, 18 + 2 * i, 18 + 2 * i + 1})
                expected += leading[k] * leading[k];
            BOOST_TEST(std::abs(share[i] - expected) < 1e-14);
            sum += share[i];
        }
        BOOST_TEST(std::abs(sum - 1.0) < 1e-12);
    };
    const auto found =
        lyapunov_spectrum<2>(disks.model, disks.y, {.method = "leapfrog", .dt = 0.005}, options);
    BOOST_TEST(times.size() == 4U);
    BOOST_TEST(found.windows.size() == times.size());
}

// Intervals are shorter than asked for where the duration would have too few of them.
BOOST_AUTO_TEST_CASE(short_spectra_have_windows_and_errors) {
    SoftDisks disks(3);
    const auto found =
        lyapunov_spectrum<2>(disks.model, disks.y, {.method = "leapfrog", .dt = 0.005},
                             {.duration = 1.0, .interval = 0.1, .window = 0.5, .discarded = 0.6});
    BOOST_TEST(found.windows.size() == 2U);
    BOOST_TEST(std::isfinite(found.errors.front()));
}

// A bath takes volume of phase space away: the sum of all exponents is the mean trace of J.
BOOST_AUTO_TEST_CASE(the_sum_of_exponents_is_the_trace) {
    SoftDisks disks(3);
    disks.model.add(std::make_unique<Gravity<2>>(Point<2>(1.0, 0.0)));  // drives
    disks.model.add(std::make_unique<Thermostat<2>>(0.5, 1.0));
    const auto y = [&] {
        auto with_accounts = initial_state<2>(disks.model, 1.0, 1.0, at_rest<2>());
        std::copy(disks.y.begin(), disks.y.end(), with_accounts.begin());
        return with_accounts;
    }();
    disks.model.layout().set_scale(Field::velocity, 1.0);
    const auto found = lyapunov_spectrum<2>(disks.model, y, {.method = "rk4", .dt = 0.01},
                                            {.duration = 40.0, .interval = 0.05, .exponents = 36});
    double sum = 0.0;
    for (const double e : found.exponents) sum += e;
    BOOST_TEST(sum < -0.1);
    BOOST_TEST(std::abs(sum - found.trace) < 0.02);
}

// Waves of a loaded periodic lattice grow as its modes say, with plain and with averaged velocities.
BOOST_AUTO_TEST_CASE(growth_of_a_loaded_lattice) {
    for (const Transport transport : {Transport::plain, Transport::average}) {
        const int cells = 8;
        const auto material = ElasticSolid::triangular_lattice();
        const Scheme scheme{.transport = transport};
        const auto solid =
            triangular_solid(cells, cells, material, scheme, triangular_density, 0.02);
        const LatticeModes<2> modes(*solid.model, solid.y0);
        const Points<2> k = allowed_wave_vectors<2>(solid.model->box(), {cells, cells});
        double expected = 0.0;
        for (const auto& wave : k.colwise()) expected = std::max(expected, modes.growth_rate(wave));
        BOOST_TEST(expected > 1e-3);
        BOOST_TEST(std::abs(largest_growth(jacobian<2>(*solid.model, solid.y0)) - expected) < 1e-6);
    }
}

// At rest a free body has three motions without force; the next is a bend, twice.
BOOST_AUTO_TEST_CASE(modes_of_a_hexagon_at_rest) {
    const auto particles = make_particles<2>(triangular_hexagon(3), 1.0);
    TotalLagrangianModel<2> model(particles,
                                  StVenantKirchhoff::like(ElasticSolid::triangular_lattice()),
                                  TotalLagrangianScheme{triangular_density, 3.0, 0.1});
    const auto y = lattice_state(model, [](const Point<2>&) { return Point<2>::Zero().eval(); });
    const Eigen::Index n = 2 * 37;
    const Eigen::MatrixXd K = -jacobian<2>(model, y).block(n, 0, n, n);
    BOOST_TEST((K - K.transpose()).norm() < 1e-8 * K.norm());
    const Eigen::VectorXd force =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (K + K.transpose())).eigenvalues();
    for (int k = 0; k < 3; ++k) BOOST_TEST(std::abs(force[k]) < 1e-9);
    for (int k = 3; k < 5; ++k) BOOST_TEST(std::abs(force[k] - 0.0328464) < 1e-6);
    BOOST_TEST(force[5] > 0.034);
}

BOOST_AUTO_TEST_CASE(what_has_no_tangents) {
    SoftDisks disks(3);
    const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(Eigen::Index(disks.y.size()), 1);
    const auto refused = [&](Model<2>& model, const IntegratorOptions& options) {
        BOOST_CHECK_THROW(TangentMotion<2>(model, disks.y, one, options), InputError);
    };
    refused(disks.model, {.method = "arkode:DORMAND_PRINCE_7_4_5", .dt = {}});
    for (const char* method : {"cvode:adams", "cvode:bdf", "gsl:msadams"})
        refused(disks.model, {.method = method, .dt = {}});
    const auto particles = make_particles<2>(triangular_hexagon(1), 1.0);
    for (const AngularMomentum balanced :
         {AngularMomentum::torque_particle, AngularMomentum::gauss}) {
        SmoothParticleModel<2> jumps(particles, ElasticSolid::triangular_lattice(),
                                     Scheme{.angular_momentum = balanced});
        BOOST_CHECK_THROW(require_spectrum<2>(jumps, {.method = "rk4", .dt = 0.1}, 1), InputError);
    }
    SmoothParticleModel<2> pairs(particles, ElasticSolid::triangular_lattice(),
                                 Scheme{.angular_momentum = AngularMomentum::torque_pair});
    require_spectrum<2>(pairs, {.method = "rk4", .dt = 0.1}, 1);
    SoftDisks many(23);  // of 2116 numbers
    BOOST_CHECK_THROW(require_spectrum<2>(many.model, {.method = "rk4", .dt = 0.1}, 2001),
                      InputError);
    for (const LyapunovOptions& none :
         {LyapunovOptions{.duration = 0.0}, LyapunovOptions{.interval = 0.0},
          LyapunovOptions{.discarded = 1.0}})
        BOOST_CHECK_THROW(
            lyapunov_spectrum<2>(disks.model, disks.y, {.method = "rk4", .dt = 0.01}, none),
            InputError);
    disks.model.add_term<ReflectedPairs<2>>(0.3);
    refused(disks.model, {.method = "rk4", .dt = 0.01});
    for (const std::size_t exponents : {std::size_t{0}, std::size_t{1000}})
        BOOST_CHECK_THROW(lyapunov_spectrum<2>(disks.model, disks.y, {.method = "rk4", .dt = 0.01},
                                               {.exponents = exponents}),
                          InputError);
}
