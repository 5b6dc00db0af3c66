// SPDX-License-Identifier: GPL-3.0-or-later
// Every method that takes fixed steps has its order on a hexagon of smooth particles (of springs where it
// needs y = (x, v)): within 0.1, above rounding errors. Two mutants do not. Errors of ARKODE's efficient
// tables fall faster than their order until they are rounding errors: that they have no higher order is
// taken from their coefficients.
#include "support/small_hexagons.hpp"
#include <spam/diagnostics/fits.hpp>
#include <spam/integrate/driver.hpp>

#include <arkode/arkode_butcher_erk.h>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <memory>
#include <numeric>

using namespace spam;
using namespace spam::test;

namespace {

constexpr double t_end = 7.0, amplitude = 0.3;
constexpr double round_off = 3e-15;  // what states differ by at the finest steps of most methods

using Make = std::function<std::unique_ptr<Integrator>(const System&, Vector& y, double dt,
                                                       const SundialsContext&)>;

std::vector<double> state_at_end(const System& system, double dt, const Make& make) {
    const SundialsContext context;
    Vector y = start_of(system, context);
    const auto integrator = make(system, y, dt, context);
    drive(*integrator, {t_end, t_end, t_end}, {});
    return {y.span().begin(), y.span().end()};
}

Make by_name(const std::string& method) {
    return [method](const System& system, Vector& y, double dt, const SundialsContext& context) {
        return make_integrator({.method = method, .dt = dt}, system.ode, y, 0.0, context);
    };
}

struct FreeTable {
    void operator()(ARKodeButcherTable table) const { ARKodeButcherTable_Free(table); }
};
using Table = std::unique_ptr<std::remove_pointer_t<ARKodeButcherTable>, FreeTable>;

/// None for methods that are not ARKODE's.
Table table_of(const std::string& method) {
    if (!method.starts_with("arkode:")) return {};
    return Table(ARKodeButcherTable_LoadERKByName(("ARKODE_" + method.substr(7)).c_str()));
}

/// A step adds h b_i f_i with a rounding error each, so errors below round_off times the sum of |b_i|
/// (1 to 30; 354 for VERNER_9_5_6) mean nothing; and nothing below fifty times round_off is looked at.
double least_error(const ARKodeButcherTableMem* table) {
    double sum = 0.0;
    for (int i = 0; table != nullptr && i < table->stages; ++i) sum += std::abs(table->b[i]);
    return round_off * std::max(50.0, sum);
}

/// sum_i b_i z_i
double weighed(const ARKodeButcherTableMem& table, const std::vector<double>& z) {
    return std::inner_product(z.begin(), z.end(), table.b, 0.0);
}

/// Whether b A^(k-1) e = 1/k! and sum b c^(k-1) = 1/k, two of the conditions for order k.
bool may_have_order(const ARKodeButcherTableMem& table, int k) {
    const auto s = static_cast<std::size_t>(table.stages);
    std::vector<double> tall(s, 1.0), bushy(s, 1.0);
    double factorial = 1.0;
    for (int power = 1; power < k; ++power) {
        std::vector<double> next(s, 0.0);
        for (std::size_t i = 0; i < s; ++i) {
            next[i] = std::inner_product(tall.begin(), tall.end(), table.A[i], 0.0);
            bushy[i] *= table.c[i];
        }
        tall = next;
        factorial *= power + 1;
    }
    return std::abs(factorial * weighed(table, tall) - 1.0) < 1e-9 &&
           std::abs(k * weighed(table, bushy) - 1.0) < 1e-9;
}

/// Of the four shortest steps whose errors are at least `least`; the shortest of all are `finer` times
/// shorter than usual.
double order_of(const System& system, const Make& make, int finer = 1,
                double least = 50.0 * round_off) {
    const auto exact = state_at_end(system, t_end / 300, by_name("gsl:rk8pd"));
    std::vector<double> steps, errors;
    for (const int n : {4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 40, 48, 64, 80, 96, 128, 160, 192}) {
        const double error =
            largest_difference(state_at_end(system, t_end / (finer * n), make), exact);
        if (error < least) break;
        steps.push_back(t_end / (finer * n));
        errors.push_back(error);
    }
    BOOST_TEST_REQUIRE(steps.size() >= 4U);
    const auto last = [](const std::vector<double>& all) { return std::span(all).last(4); };
    return observed_order(last(steps), last(errors));
}

/// Runge-Kutta's four stages with other weights, and a leapfrog that forgets its second kick.
class Mutant final : public Integrator {
  public:
    Mutant(const System& system, Vector& y, double dt, bool leapfrog)
        : Integrator(system.ode, y, 0.0),
          dt_(dt),
          leapfrog_(leapfrog) {}
    bool lands_on_stops() const override { return false; }
    void reset(double) override {}

  private:
    std::vector<double> plus(std::span<const double> y, double h, std::span<const double> f) const {
        std::vector<double> z(y.begin(), y.end());
        for (std::size_t k = 0; k < z.size(); ++k) z[k] += h * f[k];
        return z;
    }
    std::vector<double> rates(const std::vector<double>& y) const {
        std::vector<double> f(y.size());
        ode_.rates(0.0, y, f);
        return f;
    }
    double take_step(double t_stop) override {
        const double h = std::min(dt_, t_stop - t_);
        std::vector<double> y(y_.span().begin(), y_.span().end());
        if (leapfrog_) {
            const std::size_t n = y.size() / 2;
            const auto a = rates(y);
            for (std::size_t k = 0; k < n; ++k) {
                y[n + k] += h * a[n + k];
                y[k] += h * y[n + k];
            }
        } else {
            const auto k1 = rates(y), k2 = rates(plus(y, 0.5 * h, k1));
            const auto k3 = rates(plus(y, 0.5 * h, k2)), k4 = rates(plus(y, h, k3));
            for (const auto* k : {&k1, &k2, &k3, &k4}) y = plus(y, 0.25 * h, *k);
        }
        std::copy(y.begin(), y.end(), y_.span().begin());
        return t_ = t_stop - t_ <= dt_ * (1.0 + 1e-9) ? t_stop : t_ + h;
    }

    double dt_;
    bool leapfrog_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(every_method_has_its_order) {
    std::size_t tried = 0;
    for (const IntegrationMethod& method : integration_methods()) {
        // Errors of an order above 8 are rounding errors before they are small.
        if (!method.fixed || method.order > 8) continue;
        const Table table = table_of(method.name);
        const double order = order_of(*hexagon_for(method, 1, amplitude), by_name(method.name),
                                      method.order <= 2 ? 4 : 1, least_error(table.get()));
        BOOST_TEST(order > method.order - 0.1, method.name << ": " << order);
        // Those of composed leapfrogs have few steps whose errors are small but not yet rounding errors.
        const double above = method.name.starts_with("sprk:") ? 0.3 : 0.1;
        if (!table) BOOST_TEST(order < method.order + above, method.name << ": " << order);
        BOOST_TEST_MESSAGE(method.name << ": " << order);
        ++tried;
    }
    BOOST_TEST(tried >= 22U);
}

BOOST_AUTO_TEST_CASE(no_table_has_more_than_its_order) {
    for (const IntegrationMethod& method : integration_methods())
        if (const Table table = table_of(method.name)) {
            for (int k = 1; k <= method.order; ++k)
                BOOST_TEST(may_have_order(*table, k), method.name << ": " << k);
            BOOST_TEST(!may_have_order(*table, method.order + 1), method.name);
        }
}

BOOST_AUTO_TEST_CASE(mutants_have_not) {
    const auto mutant = [](bool leapfrog) -> Make {
        return [leapfrog](const System& system, Vector& y, double dt, const SundialsContext&) {
            return std::make_unique<Mutant>(system, y, dt, leapfrog);
        };
    };
    BOOST_TEST(std::abs(order_of(*smooth_hexagon(1, amplitude), mutant(false)) - 4.0) > 0.5);
    BOOST_TEST(std::abs(order_of(*bonded_hexagon(1, amplitude), mutant(true)) - 2.0) > 0.5);
}

BOOST_AUTO_TEST_CASE(classical_rk4_is_zonneveld_with_a_fixed_step) {
    const auto system = smooth_hexagon(3, 0.05);
    const auto ours = state_at_end(*system, 0.1, by_name("rk4"));
    const auto theirs = state_at_end(*system, 0.1, by_name("arkode:ZONNEVELD_5_3_4"));
    BOOST_TEST(largest_difference(ours, theirs) < 1e-12);
}

BOOST_AUTO_TEST_CASE(tolerances_are_what_errors_are_proportional_to) {
    for (const IntegrationMethod& method : integration_methods()) {
        if (!method.adaptive) continue;
        const auto system = smooth_hexagon(1, amplitude);
        const auto exact = state_at_end(*system, t_end / 300, by_name("gsl:rk8pd"));
        std::vector<double> tolerances, errors;
        for (const double rtol : {1e-4, 1e-6, 1e-8, 1e-10}) {
            std::fill(system->ode.absolute_tolerance.begin(), system->ode.absolute_tolerance.end(),
                      rtol);
            const auto adaptive = [&](const System& of, Vector& y, double,
                                      const SundialsContext& context) {
                IntegratorOptions options;
                options.method = method.name;
                options.rtol = rtol;
                return make_integrator(options, of.ode, y, 0.0, context);
            };
            tolerances.push_back(rtol);
            errors.push_back(largest_difference(state_at_end(*system, 0.0, adaptive), exact));
        }
        // error ~ tolerance^1, for methods that go on with the better solution a little more
        const double power = observed_order(tolerances, errors);
        BOOST_TEST(power > 0.75, method.name << ": " << power);
        BOOST_TEST(power < 1.4, method.name << ": " << power);
        for (std::size_t k = 0; k < errors.size(); ++k)
            BOOST_TEST(errors[k] < 200.0 * tolerances[k], method.name << ": " << errors[k]);
    }
}
