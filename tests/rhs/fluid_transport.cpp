// SPDX-License-Identifier: GPL-3.0-or-later
// Heat and momentum diffuse through a lattice of smooth particles at rates that are known exactly
// (diffusion_waves/diffusion_waves.hpp): what comes out of the equations of motion against lattice sums.
#include "diffusion_waves/diffusion_waves.hpp"
#include "support/random_state.hpp"
#include <spam/material/elastic_solid.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/initial_state.hpp>

#include <boost/test/unit_test.hpp>

#include <functional>
#include <random>

using namespace spam;
using namespace spam::test;

namespace {

using std::numbers::pi;

struct Lattice {
    int cells;
    Kernel kernel;
    double range;

    double k() const { return 2.0 * pi / cells; }

    double half_life(double eta) const { return 0.5 / (eta * k() * k()); }

    SquareLatticeDiffusion exact() const {
        return {weight_function<2>(to_string(kernel), range), k()};
    }
    double factor() const { return exact().factor; }

    FluidModel<2> fluid(double kappa, double eta,
                        const AnyEquationOfState& state = IdealGas{2, 1.0},
                        bool by_pairs = false) const {
        return of({state, NewtonViscosity{-eta, eta}, FourierConduction{kappa}, by_pairs}, 0.0);
    }
    FluidModel<2> of(const Fluid& fluid, double viscosity) const {
        const Box<2> box({1.0 * cells, 1.0 * cells});
        return {make_particles<2>(square_lattice<2>({cells, cells}), 1.0, 1.0, box),
                fluid,
                {.viscosity = viscosity, .kernel = kernel, .range = range},
                box};
    }
};

/// Classical RK4 of what `keep` leaves of the rates.
template <class Keep>
void integrate(FluidModel<2>& model, std::vector<double>& y, double t, int steps,
               const Keep& keep) {
    const double dt = t / steps;
    const auto rate_at = [&](const std::vector<double>& at) {
        auto y_dot = rates_of(model, at);
        keep(State<2>(model.layout(), y_dot));
        return y_dot;
    };
    const auto moved = [&](const std::vector<double>& by, double h) {
        auto z = y;
        for (std::size_t n = 0; n < z.size(); ++n) z[n] += h * by[n];
        return z;
    };
    for (int s = 0; s < steps; ++s) {
        const auto a = rate_at(y), b = rate_at(moved(a, 0.5 * dt));
        const auto c = rate_at(moved(b, 0.5 * dt)), d = rate_at(moved(c, dt));
        for (std::size_t n = 0; n < y.size(); ++n)
            y[n] += dt / 6.0 * (a[n] + 2.0 * b[n] + 2.0 * c[n] + d[n]);
    }
}

/// Decay rate of a thermal sine of amplitude 0.01 about T = 1 with the particles nailed down.
double conduction_rate(const Lattice& lattice, double kappa) {
    auto model = lattice.fluid(kappa, 0.0);
    const auto& x = model.particles().reference_position;
    const Points<2> rest = Points<2>::Zero(2, x.cols());
    auto y = model.state(x, rest, 1.0);
    const auto amplitude = [&] {
        double sum = 0.0;
        const auto e = State<2>(model.layout(), y).energy();
        for (Eigen::Index i = 0; i < x.cols(); ++i)
            sum += e(0, i) * std::sin(lattice.k() * x(0, i));
        return sum;
    };
    auto e = State<2>(model.layout(), y).energy();
    for (Eigen::Index i = 0; i < x.cols(); ++i) e(0, i) += 0.01 * std::sin(lattice.k() * x(0, i));
    const double before = amplitude(), t = 0.5 / (kappa * lattice.k() * lattice.k());
    integrate(model, y, t, 40, [](const State<2>& rate) {
        rate.position().setZero();
        rate.velocity().setZero();
    });
    return std::log(before / amplitude()) / t;
}

/// What is left of the amplitude of a transverse wave that begins with speed v0, all particles free, after
/// half of the time in which friction would take it away.
double rest_of_shear_wave(const Lattice& lattice, double eta, double v0) {
    auto model = lattice.fluid(0.0, eta);
    const auto& x = model.particles().reference_position;
    Points<2> v = Points<2>::Zero(2, x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i) v(0, i) = v0 * std::sin(lattice.k() * x(1, i));
    auto y = model.state(x, v, 1.0);
    integrate(model, y, lattice.half_life(eta), 80, [](const State<2>&) {});
    double sum = 0.0, before = 0.0;
    const ConstState<2> now(model.layout(), y);
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        sum += now.velocity()(0, i) * std::sin(lattice.k() * now.position()(1, i));
        before += v(0, i) * std::sin(lattice.k() * x(1, i));
    }
    return sum / before;
}

}  // namespace

BOOST_AUTO_TEST_CASE(heat_through_a_frozen_lattice) {
    const Lattice lattice{24, Kernel::lucy, 3.0};
    const double k2 = lattice.k() * lattice.k(), kappa = 0.7;
    const double measured = conduction_rate(lattice, kappa) / (kappa * k2);
    BOOST_TEST(std::abs(measured - 0.9398) < 5e-5);  // c^2/rho_s^3 by hand
    BOOST_TEST(std::abs(measured - lattice.factor()) < 1e-9);
    for (const Kernel kernel : {Kernel::monaghan, Kernel::w5}) {
        const Lattice other{20, kernel, 3.3};
        const double rate = conduction_rate(other, kappa) / (kappa * other.k() * other.k());
        BOOST_TEST(std::abs(rate - other.factor()) < 1e-9);
    }
}

BOOST_AUTO_TEST_CASE(momentum_across_a_lattice_that_shears) {
    const double eta = 0.8;
    for (const Lattice lattice : {Lattice{24, Kernel::lucy, 3.0}, Lattice{16, Kernel::w5, 3.3}}) {
        const SquareLatticeDiffusion exact = lattice.exact();
        const double t = lattice.half_life(eta), P = exact.site_density;  // T = 1
        const double expected = exact.shear_wave(t, lattice.k(), eta, P);
        const double friction = exact.shear_wave(t, lattice.k(), eta, 0.0);
        // The first is a spring, the second pushes on (Omega^2 < 0): 2 % and 0.8 % apart.
        BOOST_TEST(std::abs(rest_of_shear_wave(lattice, eta, 1e-6) - expected) < 1e-6);
        BOOST_TEST(std::abs(rest_of_shear_wave(lattice, eta, 1e-6) - friction) > 5e-3);
        // Mixed by a wave a fifth as fast as sound, friction alone is right to 3 %.
        BOOST_TEST(std::abs(rest_of_shear_wave(lattice, eta, 0.3) - friction) < 0.03 * friction);
    }
}

BOOST_AUTO_TEST_CASE(the_error_is_of_second_order_in_the_wavelength) {
    // Beyond what the lattice sums leave at k = 0, 0.7 % for this range.
    const double floor = Lattice{100000, Kernel::lucy, 3.0}.factor();
    BOOST_TEST(std::abs(floor - 1.0) < 0.01);
    const auto error = [floor](int cells) {
        return floor - Lattice{cells, Kernel::lucy, 3.0}.factor();
    };
    for (const int cells : {24, 48, 96})
        BOOST_TEST(std::abs(std::log2(error(cells) / error(2 * cells)) - 2.0) < 0.05);
}

namespace {

/// The rate at which the fastest of all changes decays: powers of the rates' differences from those at
/// rest, of temperature (`what` energy) or of motion.
double fastest_decay(FluidModel<2>& model, Field what) {
    const auto& x = model.particles().reference_position;
    const Points<2> rest = Points<2>::Zero(2, x.cols());
    const auto y0 = model.state(x, rest, 1.0);
    const auto still = rates_of(model, y0);
    std::mt19937_64 random(3);
    std::normal_distribution<double> g;
    const auto* block = model.layout().find(what);
    const auto size = block->components * model.particles().size();
    Eigen::VectorXd change(static_cast<Eigen::Index>(size));
    for (auto& c : change) c = g(random);
    double rate = 0.0;
    for (int n = 0; n < 400; ++n) {
        change *= 1e-4 / change.norm();
        auto y = y0;
        for (std::size_t k = 0; k < size; ++k)
            y[block->offset + k] += change(static_cast<Eigen::Index>(k));
        const auto now = rates_of(model, y);
        Eigen::VectorXd next(change.size());
        for (std::size_t k = 0; k < size; ++k)
            next(static_cast<Eigen::Index>(k)) = now[block->offset + k] - still[block->offset + k];
        rate = -change.dot(next) / change.squaredNorm();
        change = next;
    }
    return rate;
}

/// At temperature 1 and rest.
void check_announced(FluidModel<2>& model, double fastest, double least, double most,
                     double T = 1.0) {
    const auto& x = model.particles().reference_position;
    const auto y = model.state(x, Points<2>::Zero(2, x.cols()), T);
    const double announced = model.fastest_damping(y);
    BOOST_TEST_CONTEXT(model.describe()
                       << ", T = " << T << ": " << fastest << ", announced " << announced) {
        BOOST_TEST(fastest > 0.0);
        BOOST_TEST(announced > least * fastest);
        BOOST_TEST(announced < most * fastest);
    }
}

/// A law that does not tell its heat capacity, 0.4.
struct OfTemperature {
    double pressure(double rho, double e) const { return rho * e; }
    double sound_speed_squared(double, double e) const { return 2.0 * e; }
    double temperature(double, double e) const { return 2.5 * e; }
    double energy(double, double T) const { return T / 2.5; }
    std::string describe() const { return "own law"; }
};

}  // namespace

// What the model announces decides whether rk4 is refused: near the fastest rate there is, and not below
// it.
BOOST_AUTO_TEST_CASE(the_fastest_damping_is_announced) {
    for (const Lattice lattice : {Lattice{12, Kernel::lucy, 3.0}, Lattice{12, Kernel::w5, 3.3}})
        for (const Field what : {Field::energy, Field::velocity}) {
            const bool heat = what == Field::energy;
            auto model = lattice.fluid(heat ? 0.7 : 0.0, heat ? 0.0 : 0.7);
            check_announced(model, fastest_decay(model, what), 1.0, 2.0);
        }
}

// Heat decays with the heat capacity of the law: D/2 by mass of molecules of mass 1 alone.
BOOST_AUTO_TEST_CASE(the_fastest_conduction_is_announced_of_every_gas) {
    const Lattice lattice{12, Kernel::lucy, 3.0};
    for (const AnyEquationOfState& gas :
         {AnyEquationOfState(IdealGas{2, 7.0}), AnyEquationOfState(GammaGas{1.4}),
          AnyEquationOfState(GammaGas{3.0}), AnyEquationOfState(OfTemperature{})})
        for (const bool by_pairs : {false, true}) {
            auto model = lattice.fluid(0.7, 0.0, gas, by_pairs);
            check_announced(model, fastest_decay(model, Field::energy), 0.99, 2.0);
        }
}

namespace {

/// The same of a solid without stress and its artificial viscosity. That acts on particles that approach: no
/// matrix, but changes still tend towards what decays fastest.
double fastest_decay(Model<2>& model, std::vector<double> y) {
    const State<2> state(model.layout(), y);
    std::mt19937_64 random(5);
    std::normal_distribution<double> g;
    Points<2> v(2, state.velocity().cols());
    for (auto& c : v.reshaped()) c = g(random);
    double fastest = 0.0;
    for (int n = 0; n < 200; ++n) {
        v *= 1e-6 / v.norm();
        state.velocity() = v;
        const auto now = rates_of(model, y);
        const Points<2> a = ConstState<2>(model.layout(), now).velocity();
        fastest = std::max(fastest, -v.cwiseProduct(a).sum() / v.squaredNorm());
        v = -a;
    }
    return fastest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_fastest_damping_of_a_solid_is_announced) {
    const Box<2> box({12.0, 12.0});
    for (const Kernel kernel : {Kernel::lucy, Kernel::w5}) {
        SmoothParticleModel<2> model(
            make_particles<2>(square_lattice<2>({12, 12}), 1.3, 1.0, box),
            ElasticSolid::triangular_lattice(),
            {.density = Density::summed, .viscosity = 0.7, .kernel = kernel, .range = 3.0}, box);
        const auto y = initial_state<2>(model, 1.3, 1.0, at_rest<2>());
        const double fastest = fastest_decay(model, y), announced = model.fastest_damping(y);
        BOOST_TEST_MESSAGE(model.describe() << ": " << fastest << ", announced " << announced);
        BOOST_TEST(fastest > 0.0);
        BOOST_TEST(announced > 0.9 * fastest);
        BOOST_TEST(announced < 1.3 * fastest);
    }
}

// A gas is viscous by the sound of the state it is in: without heat there is none.
BOOST_AUTO_TEST_CASE(the_fastest_damping_of_a_hot_gas_is_announced) {
    auto model = Lattice{12, Kernel::lucy, 3.0}.of({GammaGas{1.4}}, 0.7);
    const auto& x = model.particles().reference_position;
    for (const double T : {0.01, 1.0, 100.0}) {
        const auto y = model.state(x, Points<2>::Zero(2, x.cols()), T);
        check_announced(model, fastest_decay(model, y), 0.9, 1.3, T);
    }
    BOOST_TEST(model.fastest_damping({}) == 0.0);  // no state, no heat
}
