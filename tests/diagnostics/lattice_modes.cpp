// SPDX-License-Identifier: GPL-3.0-or-later
// Modes of periodic lattices: against the Jacobian of a whole sample, against a simulation, and what
// symmetry and the absence of stress demand. Each with a law that breaks it.
#include "support/random_state.hpp"
#include <spam/analysis/kicked_lattice.hpp>
#include <spam/analysis/periodic_solid.hpp>
#include <spam/analysis/wave_vectors.hpp>
#include <spam/core/error.hpp>
#include <spam/diagnostics/fits.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/setup/initial_state.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

using Complex = std::complex<double>;
constexpr double density = 1.1547;
const ElasticSolid solid{0.5, 0.4};

/// Stiffer along x: turned by 60 degrees it is another material.
struct Grained {
    SymTensor<2> stress_rate(const Mat<2>& grad_v, const SymTensor<2>& stress) const {
        auto rate = solid.stress_rate(grad_v, stress);
        rate(0, 0) += 0.1 * grad_v(0, 0);
        return rate;
    }
    std::string describe() const { return "grained"; }
};

/// Shear that gives way.
const ElasticSolid unstable{0.5, -0.1};

std::vector<Scheme> schemes(double range) {
    std::vector<Scheme> all;
    for (Scheme scheme : all_schemes<2>()) {
        if (scheme.angular_momentum != AngularMomentum::free || scheme.viscosity > 0.0) continue;
        scheme.range = range;
        all.push_back(scheme);
    }
    return all;
}

/// Of a whole sample, energies left out: row and column r belong to entry `entries[r]` of y.
struct WholeJacobian {
    std::vector<std::size_t> entries;
    Eigen::MatrixXd matrix;
};

/// Central differences of every rate by every component.
WholeJacobian whole_jacobian(PeriodicSolid& sample) {
    auto y = sample.y0;
    std::vector<std::size_t> entries;
    for (const auto& block : sample.model->layout().blocks())
        for (std::size_t k = 0; block.field != Field::energy &&
                                k < block.components * sample.model->particles().size();
             ++k)
            entries.push_back(block.offset + k);
    const auto n = static_cast<Eigen::Index>(entries.size());
    Eigen::MatrixXd J(n, n);
    constexpr double step = 2e-5;
    for (Eigen::Index c = 0; c < n; ++c) {
        const std::size_t entry = entries[static_cast<std::size_t>(c)];
        const auto rates_at = [&](double value) {
            const double before = y[entry];
            y[entry] = value;
            const auto rates = rates_of(*sample.model, y);
            y[entry] = before;
            return rates;
        };
        const auto up = rates_at(y[entry] + step), down = rates_at(y[entry] - step);
        for (Eigen::Index r = 0; r < n; ++r) {
            const std::size_t to = entries[static_cast<std::size_t>(r)];
            J(r, c) = (up[to] - down[to]) / (2.0 * step);
        }
    }
    return {entries, J};
}

/// Largest distance from a value of one set to its partner in the other, partners chosen greedily.
double distance_of_sets(const Eigen::VectorXcd& a, std::vector<Complex> b) {
    double worst = 0.0;
    for (const Complex value : a) {
        const auto partner = std::min_element(b.begin(), b.end(), [&](Complex p, Complex q) {
            return std::abs(p - value) < std::abs(q - value);
        });
        worst = std::max(worst, std::abs(*partner - value));
        b.erase(partner);
    }
    return b.empty() ? worst : HUGE_VAL;
}

LatticeModes<2> modes_of(const Material<2>& material, const Scheme& scheme, double stress) {
    const auto lattice = smallest_triangular_solid(material, scheme, density, stress);
    return {*lattice.model, lattice.y0};
}

/// Largest change of growth and frequencies when wave vectors are turned by 60 degrees.
double asymmetry(const LatticeModes<2>& modes) {
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(std::numbers::pi / 3.0).toRotationMatrix();
    double worst = 0.0;
    const WavePath path = triangular_path(12);
    for (const auto& k : path.k.colwise()) {
        const Point<2> oblique = k + Point<2>(0.1, 0.2), turned = turn * oblique;
        worst = std::max(worst, std::abs(modes.growth_rate(oblique) - modes.growth_rate(turned)));
        const auto a = modes.frequencies(oblique), b = modes.frequencies(turned);
        for (std::size_t n = 0; n < 2; ++n) worst = std::max(worst, std::abs(a[n] - b[n]));
    }
    return worst;
}

double largest_growth(const LatticeModes<2>& modes) {
    double largest = 0.0;
    const WavePath path = triangular_path(30);
    for (const auto& k : path.k.colwise()) largest = std::max(largest, modes.growth_rate(k));
    return largest;
}

void refused(const std::string& word, const auto& make) {
    BOOST_CHECK_EXCEPTION(make(), InputError, [&](const InputError& e) {
        return std::string(e.what()).find(word) != std::string::npos;
    });
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_modes_of_a_whole_sample) {
    for (const Scheme& scheme : schemes(1.6)) {
        if (scheme.mean_density == MeanDensityKind::geometric) continue;
        BOOST_TEST_CONTEXT(scheme.describe()) {
            auto sample = triangular_solid(7, 8, solid, scheme, density, 0.03);
            const auto whole = whole_jacobian(sample).matrix;
            const auto modes = modes_of(solid, scheme, 0.03);
            const auto other = modes_of(solid, scheme, 0.05);
            const auto k = allowed_wave_vectors<2>(sample.model->box(), {7, 8});
            std::vector<Complex> bloch, wrong;
            for (const auto& wave : k.colwise()) {
                const Eigen::VectorXcd own = modes.jacobian(wave).eigenvalues();
                bloch.insert(bloch.end(), own.begin(), own.end());
                const Eigen::VectorXcd others = other.jacobian(wave).eigenvalues();
                wrong.insert(wrong.end(), others.begin(), others.end());
            }
            const Eigen::VectorXcd all = whole.cast<Complex>().eigenvalues();
            // Zeros that belong together split by the root of the differences' error.
            BOOST_TEST(distance_of_sets(all, bloch) < 1e-4);
            BOOST_TEST(distance_of_sets(all, wrong) > 1e-2);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_wave_stays_a_wave) {
    // The whole Jacobian times z exp(i k r) is J(k) z exp(i k r); with -k it is not.
    for (const Scheme& scheme : schemes(1.6)) {
        BOOST_TEST_CONTEXT(scheme.describe()) {
            auto sample = triangular_solid(7, 8, solid, scheme, density, 0.03);
            const WholeJacobian whole = whole_jacobian(sample);
            const auto modes = modes_of(solid, scheme, 0.03);
            const Point<2> k = allowed_wave_vectors<2>(sample.model->box(), {7, 8}).col(17);
            const auto& layout = sample.model->layout();
            const auto error = [&](double sign) {
                const Eigen::MatrixXcd J = modes.jacobian(sign * k);
                Eigen::VectorXcd z = Eigen::VectorXcd::Zero(J.rows());
                for (Eigen::Index c = 0; c < z.size(); ++c)
                    z[c] = {std::sin(1.0 + 7.0 * static_cast<double>(c)), 0.3};
                const Eigen::VectorXcd z_dot = J * z;
                Eigen::VectorXcd wave(whole.matrix.rows()), expected(wave.size());
                for (Eigen::Index r = 0; r < wave.size(); ++r) {
                    const auto at = layout.entry(whole.entries[static_cast<std::size_t>(r)]);
                    Eigen::Index c = static_cast<Eigen::Index>(at.component);
                    for (const auto& block : layout.blocks()) {
                        if (block.field == at.field) break;
                        c += static_cast<Eigen::Index>(block.components);
                    }
                    const auto& x = sample.model->particles().reference_position;
                    const auto phase =
                        std::polar(1.0, k.dot(x.col(static_cast<Eigen::Index>(at.number))));
                    wave[r] = z[c] * phase;
                    expected[r] = z_dot[c] * phase;
                }
                return (whole.matrix * wave - expected).cwiseAbs().maxCoeff();
            };
            BOOST_TEST(error(1.0) < 1e-8);
            BOOST_TEST(error(-1.0) > 1e-2);
        }
    }
}

BOOST_AUTO_TEST_CASE(nothing_grows_without_stress) {
    for (const Scheme& scheme : schemes(2.6))
        BOOST_TEST(largest_growth(modes_of(solid, scheme, 0.0)) < 1e-6, scheme.describe());
    BOOST_TEST(largest_growth(modes_of(unstable, Scheme{}, 0.0)) > 1e-2);
    BOOST_TEST(largest_growth(modes_of(solid, Scheme{}, 0.02)) > 1e-2);
}

BOOST_AUTO_TEST_CASE(turning_the_lattice_by_60_degrees_changes_nothing) {
    for (const Scheme& scheme : schemes(2.6))
        BOOST_TEST(asymmetry(modes_of(solid, scheme, 0.02)) < 1e-8, scheme.describe());
    BOOST_TEST(asymmetry(modes_of(Grained{}, {.range = 2.6}, 0.02)) > 1e-3);
}

BOOST_AUTO_TEST_CASE(error_falls_with_the_step) {
    // Fourth order (Richardson). Where the range meets a shell of neighbours (h = 3) the slope of the
    // weight function has a kink, and only the first is left.
    const Point<2> k(2.2, 1.3);
    for (const auto& [range, order] : {std::pair{2.5, 4.0}, std::pair{3.0, 1.0}}) {
        const auto lattice = smallest_triangular_solid(solid, {.range = range}, density, 0.5);
        const auto at = [&](double step) -> Eigen::MatrixXcd {
            return LatticeModes<2>(*lattice.model, lattice.y0, step).jacobian(k);
        };
        const Eigen::MatrixXcd exact = at(range == 3.0 ? 1e-6 : 1e-3);
        std::vector<double> steps{0.04, 0.02, 0.01}, errors;
        for (const double step : steps) errors.push_back((at(step) - exact).norm());
        BOOST_TEST(observed_order(steps, errors) == order, boost::test_tools::tolerance(0.1));
    }
}

BOOST_AUTO_TEST_CASE(linear_elasticity_of_long_waves) {
    const auto modes = modes_of(solid, {.range = 4.0}, 0.0);
    const Point<2> k(0.0, 0.01);
    BOOST_TEST(modes.frequency(k, {1.0, 0.0}) == 0.01 * std::sqrt(solid.eta / density),
               boost::test_tools::tolerance(2e-3));
    const double c_L = std::sqrt((solid.lambda + 2.0 * solid.eta) / density);
    BOOST_TEST(modes.frequency(k, {0.0, 1.0}) == 0.01 * c_L, boost::test_tools::tolerance(2e-3));
    BOOST_TEST(modes.frequencies(k)[0] == modes.frequency(k, {0.0, 1.0}),
               boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_kicked_lattice_follows_all_its_waves) {
    for (const auto transport : {Transport::plain, Transport::average, Transport::monaghan}) {
        const Scheme scheme{.transport = transport, .range = 2.6};
        auto sample = triangular_solid(8, 8, solid, scheme, density, 0.05);
        const Point<2> v0(3e-6, 1e-6);
        const auto k = allowed_wave_vectors<2>(sample.model->box(), {8, 8});
        const KickedLattice<2> linear(modes_of(solid, scheme, 0.05), k, 1.0, v0);
        const bool plain = transport == Transport::plain;
        const Scheme other{.transport = plain ? Transport::average : Transport::plain,
                           .range = 2.6};
        const KickedLattice<2> wrong(modes_of(solid, other, 0.05), k, 1.0, v0);
        auto y = sample.y0;
        const State<2> state(sample.model->layout(), y);
        state.velocity().col(11) = v0;
        const Eigen::Map<Eigen::VectorXd> all(y.data(), static_cast<Eigen::Index>(y.size()));
        const double dt = 0.05;
        for (int step = 1; step <= 600; ++step) {
            const Eigen::VectorXd start = all;
            Eigen::VectorXd sum = Eigen::VectorXd::Zero(all.size()), stage = start;
            for (const auto& [to_next, weight] :
                 {std::pair{0.5, 1.0}, {0.5, 2.0}, {1.0, 2.0}, {0.0, 1.0}}) {
                const auto rates = rates_of(*sample.model, std::span(stage.data(), y.size()));
                const Eigen::Map<const Eigen::VectorXd> slope(rates.data(), all.size());
                sum += weight / 6.0 * slope;
                stage = start + to_next * dt * slope;
            }
            Eigen::Map<Eigen::VectorXd>(y.data(), all.size()) = start + dt * sum;
            if (step % 200 != 0) continue;
            const double K = 0.5 * state.velocity().squaredNorm();
            BOOST_TEST(K == linear.kinetic(step * dt), boost::test_tools::tolerance(1e-3));
            BOOST_TEST(std::abs(K / wrong.kinetic(step * dt) - 1.0) > 1e-2);
        }
        const double t = 30.0, d = 1e-4;
        BOOST_TEST(linear.kinetic_rate(t) ==
                       std::log(linear.kinetic(t + d) / linear.kinetic(t - d)) / (2.0 * d),
                   boost::test_tools::tolerance(1e-6));
        if (plain)
            BOOST_TEST(linear.kinetic_rate(5000.0) == 2.0 * linear.fastest_rate(),
                       boost::test_tools::tolerance(0.02));
    }
}

BOOST_AUTO_TEST_CASE(wave_vectors_of_a_sample) {
    const Box<2> box = triangular_box(6, 4);
    const auto k = allowed_wave_vectors<2>(box, {6, 4});
    BOOST_TEST(k.cols() == 24);
    for (Eigen::Index p = 0; p < k.cols(); ++p) {
        const Point<2> zone = first_zone(k.col(p));
        BOOST_TEST(zone.norm() < 4.0 * std::numbers::pi / 3.0 + 1e-9);
        BOOST_TEST((first_zone(zone) - zone).norm() < 1e-9);
        const Points<2> sites = triangular_block(6, 4);
        for (const auto& r : sites.colwise())  // the same phase at every particle
            BOOST_TEST(std::abs(std::polar(1.0, zone.dot(r)) - std::polar(1.0, k.col(p).dot(r))) <
                       1e-9);
        for (Eigen::Index q = 0; q < p; ++q) BOOST_TEST((first_zone(k.col(q)) - zone).norm() > 0.1);
    }
    const auto path = triangular_path(100);
    BOOST_TEST(path.corners.size() == 4U);
    BOOST_TEST(path.distance.back() == path.corners.back().distance);
    BOOST_TEST(path.k.rightCols<1>().norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE(states_and_schemes_without_modes_are_refused) {
    auto good = triangular_solid(8, 8, solid, {}, density, 0.0);
    const auto make = [](const PeriodicSolid& s) {
        return [&s] { LatticeModes<2>(*s.model, s.y0); };
    };
    make(good)();
    refused("torques",
            make(triangular_solid(8, 8, solid, {.angular_momentum = AngularMomentum::torque_pair},
                                  density, 0.02)));
    refused("viscosity", make(triangular_solid(8, 8, solid, {.viscosity = 1.0}, density, 0.02)));
    refused("more cells",
            make(triangular_solid(8, 8, solid, {.density = Density::summed}, density, 0)));
    const State<2> state(good.model->layout(), good.y0);
    state.velocity()(0, 3) = 1e-8;
    refused("at rest", make(good));
    state.velocity()(0, 3) = 0.0;
    state.stress()(2, 5) = 0.1;
    refused("stress", make(good));
    state.stress()(2, 5) = 0.0;
    state.position()(0, 5) += 1e-3;
    refused("Bravais", make(good));
    SmoothParticleModel<2> free(make_particles<2>(triangular_block(8, 8), 1.0), solid, {});
    const auto y = initial_state<2>(free, density, 1.0, at_rest<2>());
    refused("periodic", [&] { LatticeModes<2>(free, y); });
}
