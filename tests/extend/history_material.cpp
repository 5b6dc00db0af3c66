// SPDX-License-Identifier: GPL-3.0-or-later
// A material with a memory, in one file: a solid that softens where its stress was large, with its damage
// as a history field of y.
#include <spam/core/error.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
namespace {

constexpr FieldKind damage{"damage", Rank::scalar, Role::history, "1"};

struct SofteningSolid {
    ElasticSolid whole{0.43, 0.43};
    double limit = 2e-3;

    template <int Dim>
    SymTensor<Dim> stress_rate(const Mat<Dim>& grad_v, const SymTensor<Dim>& stress) const {
        return whole.stress_rate(grad_v, stress);
    }
    std::string describe() const { return "softening " + whole.describe(); }
    std::vector<Field> history() const { return {damage}; }
    template <int Dim>
    bool settle(double, std::size_t i, const State<Dim>& state) const {
        auto stress = state.stress().col(static_cast<Eigen::Index>(i));
        if (stress.norm() <= limit) return false;
        state.field(damage)(0, static_cast<Eigen::Index>(i)) += stress.norm() / limit - 1.0;
        stress *= limit / stress.norm();
        return true;
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(damage_grows_between_steps_and_bounds_the_stress) {
    for (const char* method : {"rk4", "arkode:DORMAND_PRINCE_7_4_5", "gsl:rkf45"}) {
        SmoothParticleModel<2> model(make_particles<2>(triangular_block(8, 6), 1.0),
                                     SofteningSolid{}, Scheme{});
        auto y0 = initial_state<2>(model, 1.1547, 0.43,
                                   [](const Point<2>& x) { return Point<2>(0.01 * x.x(), 0.0); });
        IntegratorOptions options;
        options.method = method;
        if (options.method == "rk4") options.dt = 0.05;
        Motion<2> motion(model, y0, options);
        motion.advance_to(3.0);
        const ConstState<2> state = motion.state();
        BOOST_TEST(state.stress().colwise().norm().maxCoeff() < 2e-3 * (1.0 + 1e-12), method);
        BOOST_TEST(state.field(damage).maxCoeff() > 0.01, method);
        BOOST_TEST(state.field(damage).minCoeff() >= 0.0, method);
        options = {};
        options.method = "cvode:adams";
        BOOST_CHECK_THROW(Motion<2>(model, y0, options), InputError);
    }
}
