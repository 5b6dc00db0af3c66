// SPDX-License-Identifier: GPL-3.0-or-later
// Solids that yield, as models: settling changes no rate, what an elastic solid keeps is kept through plastic
// flow, and a solid that never yields is the elastic one to the last bit.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/core/parallel.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/total_energy.hpp>
#include <spam/material/hencky_solid.hpp>
#include <spam/material/johnson_cook.hpp>
#include <spam/material/perzyna.hpp>
#include <spam/material/smooth_hencky_solid.hpp>
#include <spam/material/smooth_yield.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/material/stress_in_reference.hpp>
#include <spam/material/yielding_solid.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

constexpr double lambda = 0.43, eta = 0.43, Y = 0.02;
const double site_density = 2.0 / std::sqrt(3.0);

template <int Dim>
using Build = std::function<std::unique_ptr<ParticleModel<Dim>>(Particles<Dim>)>;

template <int Dim>
Build<Dim> updated(const Material<Dim>& material) {
    return [material](Particles<Dim> particles) -> std::unique_ptr<ParticleModel<Dim>> {
        return std::make_unique<SmoothParticleModel<Dim>>(std::move(particles), material,
                                                          Scheme{.range = 2.5});
    };
}
template <int Dim>
Build<Dim> lagrangian(const HyperelasticMaterial<Dim>& material) {
    return [material](Particles<Dim> particles) -> std::unique_ptr<ParticleModel<Dim>> {
        return std::make_unique<TotalLagrangianModel<Dim>>(std::move(particles), material,
                                                           TotalLagrangianScheme{1.0, 2.5, 0.1});
    };
}

const LinearHardening hardening{Y, 0.05};

/// A random state, stretched and sheared so far that most of it yields.
template <int Dim>
std::vector<double> beyond_yield(ParticleModel<Dim>& model) {
    auto y = random_state<Dim>(model, 5);
    const State<Dim> state(model.layout(), y);
    for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
        state.position()(0, i) *= 1.2;
        state.position()(1, i) += 0.1 * state.position()(0, i);
    }
    return y;
}

template <int Dim>
void check_settling(const Build<Dim>& build) {
    auto model = build(jittered_particles<Dim>(Dim == 2 ? 12 : 6, 3, 0.05));
    auto y = beyond_yield(*model);
    const double t = 0.5;
    std::vector<double> before(y.size()), after(y.size());
    model->rates(t, y, before);
    BOOST_TEST_REQUIRE(model->failure().empty(), model->failure());
    const double energy = total_energy(*model, y);
    BOOST_TEST(model->settle(t, y));
    model->rates(t, y, after);
    BOOST_TEST(std::abs(total_energy(*model, y) / energy - 1.0) < 1e-13);
    for (const auto& block : model->layout().blocks()) {
        double largest = 0.0, difference = 0.0;
        for (std::size_t k = block.offset; k < block.offset + block.size; ++k) {
            largest = std::max(largest, std::abs(before[k]));
            difference = std::max(difference, std::abs(after[k] - before[k]));
        }
        BOOST_TEST(difference <= 1e-13 * largest, block.field.name() << " " << difference);
    }
    const ConstState<Dim> state(model->layout(), y);
    const auto strain = state.field(field_kind::plastic_strain);
    BOOST_TEST((strain.array() > 0.0).count() > strain.size() / 2);
    // Once is enough.
    const Eigen::MatrixXd once = strain;
    model->settle(t, y);
    BOOST_TEST((state.field(field_kind::plastic_strain) - once).cwiseAbs().maxCoeff() < 1e-14);
}

/// A block that bends and turns, as problems/plastic_block.
template <class Model, class Law, class... Arguments>
std::pair<std::unique_ptr<Model>, std::vector<double>> block(int columns, int rows, const Law& law,
                                                             const Arguments&... arguments) {
    Points<2> x = triangular_block(columns, rows);
    x.colwise() -= Point<2>(x.rowwise().mean());
    auto model = std::make_unique<Model>(make_particles<2>(x, 1.0), law, arguments...);
    auto y = initial_state<2>(*model, site_density, Y, [](const Point<2>& r) {
        return Point<2>(0.12 * std::sin(0.15 * r.x()) - 0.03 * r.y(), 0.03 * r.x());
    });
    return {std::move(model), std::move(y)};
}

IntegratorOptions rk4(double dt) {
    IntegratorOptions options;
    options.dt = dt;
    return options;
}

/// The law that is often written down: plastic work put into the energy, where the stress work is already.
struct PlasticWorkTwice {
    YieldingSolid<PlaneVonMises> law{{lambda, eta}, LinearHardening{Y}};
    SymTensor<2> stress_rate(const Mat<2>& g, const SymTensor<2>& s) const {
        return law.stress_rate(g, s);
    }
    std::string describe() const { return "work twice"; }
    std::vector<Field> history() const { return law.history(); }
    auto return_map(double t, const ConstState<2>& state) const { return law.return_map(t, state); }
    bool settle(double t, std::size_t i, const State<2>& state) const {
        double& strain = state.find(field_kind::plastic_strain)[i];
        const double before = strain;
        const bool changed = law.settle(t, i, state);
        state.energy()(0, static_cast<Eigen::Index>(i)) += Y * (strain - before) / site_density;
        return changed;
    }
};

/// As a law of F, in solids that keep their reference.
template <int Dim = 2, class Law>
auto by_rates(const Law& law, double density = site_density) {
    return StressInReference<Law, Dim>(law, density, eta);
}

template <class Model, class Law, class... Arguments>
double energy_change(double dt, const Law& law, const Arguments&... arguments) {
    auto [model, y0] = block<Model>(20, 11, law, arguments...);
    const double before = total_energy(*model, y0);
    Motion<2> motion(*model, y0, rk4(dt));
    motion.advance_to(20.0);
    BOOST_TEST(motion.state().field(field_kind::plastic_strain).maxCoeff() > 0.1);
    return std::abs(total_energy(*model, motion.y()) / before - 1.0);
}

const YieldingSolid<PlaneVonMises> plane({lambda, eta}, LinearHardening{Y});
const HenckySolid<PlaneVonMises> logarithmic({lambda, eta}, LinearHardening{Y});
const TotalLagrangianScheme reference{site_density};

}  // namespace

BOOST_AUTO_TEST_CASE(settling_changes_no_rate_and_no_energy) {
    check_settling(updated<2>(YieldingSolid<PlaneVonMises>({lambda, eta}, hardening)));
    check_settling(updated<2>(YieldingSolid<PlaneStrainVonMises>({lambda, eta}, hardening)));
    check_settling(updated<2>(YieldingSolid<PlaneStressVonMises>({lambda, eta}, hardening)));
    check_settling(updated<3>(YieldingSolid<SpaceVonMises>({lambda, eta}, hardening)));
    check_settling(
        updated<2>(YieldingSolid<PlaneVonMises, Perzyna>({lambda, eta}, {hardening, 0.2})));
    check_settling(lagrangian<2>(HenckySolid<PlaneVonMises>({lambda, eta}, hardening)));
    check_settling(lagrangian<2>(HenckySolid<PlaneStrainVonMises>({lambda, eta}, hardening)));
    check_settling(lagrangian<3>(HenckySolid<SpaceVonMises>({lambda, eta}, hardening)));
    check_settling(
        lagrangian<2>(by_rates(YieldingSolid<PlaneStrainVonMises>({lambda, eta}, hardening))));
    check_settling(
        lagrangian<2>(by_rates(YieldingSolid<PlaneStressVonMises>({lambda, eta}, hardening))));
    check_settling(
        lagrangian<3>(by_rates<3>(YieldingSolid<SpaceVonMises>({lambda, eta}, hardening))));
    check_settling(lagrangian<2>(
        by_rates(YieldingSolid<PlaneVonMises, Perzyna>({lambda, eta}, {hardening, 0.2}))));
}

/// P is the derivative of the energy with what flow takes, in every stage.
BOOST_AUTO_TEST_CASE(a_body_of_logarithmic_strain_keeps_everything_through_plastic_flow) {
    auto [model, y0] = block<TotalLagrangianModel<2>>(20, 11, logarithmic, reference);
    const auto before = measure_invariants<2>(*model, y0);
    Motion<2> motion(*model, y0, rk4(0.25));
    motion.advance_to(20.0);
    const auto after = measure_invariants<2>(*model, motion.y());
    BOOST_TEST(motion.state().field(field_kind::plastic_strain).maxCoeff() > 0.1);
    BOOST_TEST((after.momentum - before.momentum).norm() < 1e-12);
    BOOST_TEST(std::abs(after.angular_momentum[0] / before.angular_momentum[0] - 1.0) < 1e-7);
    BOOST_TEST(std::abs(after.energy / before.energy - 1.0) < 2e-6);
}

BOOST_AUTO_TEST_CASE(plastic_work_is_in_the_energy_once) {
    const Scheme monaghan{.transport = Transport::monaghan};
    BOOST_TEST(energy_change<SmoothParticleModel<2>>(0.25, plane, monaghan) < 2e-6);
    BOOST_TEST(energy_change<SmoothParticleModel<2>>(0.25, PlasticWorkTwice{}, monaghan) > 1e-2);
    BOOST_TEST(energy_change<TotalLagrangianModel<2>>(0.25, by_rates(plane), reference) < 2e-6);
    BOOST_TEST(energy_change<TotalLagrangianModel<2>>(0.25, by_rates(PlasticWorkTwice{}),
                                                      reference) > 1e-2);
    using Smooth = SmoothHenckySolid<PlaneVonMises>;
    BOOST_TEST(energy_change<TotalLagrangianModel<2>>(
                   1.0 / 16.0, Smooth({lambda, eta}, LinearHardening{Y}), reference) < 2e-6);
}

BOOST_AUTO_TEST_CASE(a_solid_that_never_yields_is_the_elastic_one) {
    const auto end = [](const Material<2>& material) {
        auto [model, y0] = block<SmoothParticleModel<2>>(20, 11, material, Scheme{});
        Motion<2> motion(*model, y0, rk4(0.25));
        motion.advance_to(10.0);
        return Eigen::MatrixXd(motion.state().position());
    };
    const LinearHardening never{1e9};
    const ElasticSolid elastic{lambda, eta};
    BOOST_TEST((end(elastic) == end(YieldingSolid<PlaneVonMises>({lambda, eta}, never))));
    BOOST_TEST((end(elastic) == end(YieldingSolid<PlaneStrainVonMises>({lambda, eta}, never))));
    BOOST_TEST((end(elastic) == end(SmoothYield<PlaneVonMises>({lambda, eta}, never))));
    const PlaneStressVonMises thin{lambda, eta};
    BOOST_TEST((end(thin.elastic()) == end(YieldingSolid<PlaneStressVonMises>(thin, never))));
    BOOST_TEST((end(elastic) != end(plane)));
}

/// A law by the rate of strain gives the stress of Saint Venant's and Kirchhoff's law up to squares of the strain,
/// turned with the body: the difference falls fourfold where the strain is halved.
BOOST_AUTO_TEST_CASE(small_strains_of_a_turning_body_have_one_stress) {
    const auto apart = [](double strain) {
        const auto accelerations = [&](const HyperelasticMaterial<2>& law, bool integrates) {
            auto [model, y] = block<TotalLagrangianModel<2>>(12, 8, law, reference);
            const State<2> state(model->layout(), y);
            // x = Q(t) (1 + t E) X from t = 0 to 1: sigma in y is what the law makes of that.
            const Points<2> X = model->particles().reference_position;
            Mat<2> F;
            const auto at = [&](double t) {
                const double c = std::cos(2.0 * t), s = std::sin(2.0 * t), e = strain * t;
                return Mat<2>{{c * (1.0 + e) - s * 0.3 * e, c * 0.3 * e - s * (1.0 - 0.5 * e),
                               s * (1.0 + e) + c * 0.3 * e, s * 0.3 * e + c * (1.0 - 0.5 * e)}};
            };
            const auto put = [&](double t) {
                F = at(t);
                for (Eigen::Index i = 0; i < X.cols(); ++i)
                    for (int a = 0; a < 2; ++a)
                        state.position()(a, i) = F(a, 0) * X(0, i) + F(a, 1) * X(1, i);
            };
            const int steps = 400;
            for (int k = 0; integrates && k < steps; ++k) {
                const double t = (k + 0.5) / steps, h = 1.0 / steps;
                put(t);
                const Mat<2> before = at(t - 0.5 * h), after = at(t + 0.5 * h);
                for (Eigen::Index i = 0; i < X.cols(); ++i)
                    for (int a = 0; a < 2; ++a)
                        state.velocity()(a, i) = ((after(a, 0) - before(a, 0)) * X(0, i) +
                                                  (after(a, 1) - before(a, 1)) * X(1, i)) /
                                                 h;
                const auto rates = rates_of(*model, y);
                const ConstState<2> rate(model->layout(), rates);
                state.stress() += h * rate.stress();
            }
            put(1.0);
            const auto rates = rates_of(*model, y);
            return Eigen::MatrixXd(ConstState<2>(model->layout(), rates).velocity());
        };
        const ElasticSolid elastic{lambda, eta};
        const auto by_F = accelerations(StVenantKirchhoff::like(elastic), false);
        const auto by_rate = accelerations(by_rates(elastic), true);
        return (by_F - by_rate).cwiseAbs().maxCoeff() / by_F.cwiseAbs().maxCoeff();
    };
    const double coarse = apart(0.02), fine = apart(0.01);
    BOOST_TEST(coarse < 0.1);
    BOOST_TEST(fine < 0.6 * coarse);  // relative: the strain itself is halved too
}

/// Its heat is in e, by which it yields earlier.
BOOST_AUTO_TEST_CASE(heat_softens_a_solid_that_keeps_its_reference) {
    const auto strain = [](double heat_capacity) {
        const JohnsonCook flow{
            .A = Y, .B = 0.05, .n = 0.5, .heat_capacity = heat_capacity, .density = site_density};
        const YieldingSolid<PlaneVonMises, JohnsonCook> law({lambda, eta}, flow);
        auto [model, y0] = block<TotalLagrangianModel<2>>(20, 11, by_rates(law), reference);
        const double before = total_energy(*model, y0);
        Motion<2> motion(*model, y0, rk4(0.1));
        motion.advance_to(20.0);
        BOOST_TEST(std::abs(total_energy(*model, motion.y()) / before - 1.0) < 2e-4);
        return motion.state().field(field_kind::plastic_strain).maxCoeff();
    };
    BOOST_TEST(strain(0.05) > 1.02 * strain(1e6));
}

BOOST_AUTO_TEST_CASE(any_number_of_threads_gives_the_same_bits) {
    const auto end = [](int threads, bool by_reference) {
        set_threads(threads);
        std::unique_ptr<ParticleModel<2>> model;
        std::vector<double> y0;
        if (by_reference)
            std::tie(model, y0) = block<TotalLagrangianModel<2>>(60, 40, logarithmic, reference);
        else
            std::tie(model, y0) = block<SmoothParticleModel<2>>(60, 40, plane, Scheme{});
        Motion<2> motion(*model, y0, rk4(0.25));
        motion.advance_to(2.0);
        set_threads(0);
        return std::vector<double>(motion.y().begin(), motion.y().end());
    };
    for (const bool by_reference : {false, true})
        BOOST_TEST((end(1, by_reference) == end(2, by_reference)));
}

/// One that knows a stress across the plane beside one that does not.
BOOST_AUTO_TEST_CASE(materials_of_one_body_have_memories_of_their_own) {
    Particles<2> particles = make_particles<2>(triangular_block(12, 6), 1.0);
    for (Eigen::Index i = 0; i < particles.reference_position.cols(); ++i)
        particles.material.push_back(particles.reference_position(0, i) < 6.0 ? 0 : 1);
    const std::vector<Material<2>> both{
        ElasticSolid{lambda, eta},
        YieldingSolid<PlaneStrainVonMises>({lambda, eta}, LinearHardening{Y})};
    ParticleModel<2> model(particles);
    model.add_term<SmoothParticles<2>>(both, Scheme{});
    auto y0 = initial_state<2>(model, site_density, Y, [](const Point<2>& r) {
        return Point<2>(0.1 * r.x(), -0.05 * r.y());
    });
    Motion<2> motion(model, y0, rk4(0.1));
    motion.advance_to(1.0);
    const auto zz = motion.state().field(field_kind::stress_zz);
    const auto strain = motion.state().field(field_kind::plastic_strain);
    for (Eigen::Index i = 0; i < zz.cols(); ++i) {
        const bool yields = model.particles().material[static_cast<std::size_t>(i)] == 1;
        BOOST_TEST((zz(0, i) != 0.0) == yields);
        BOOST_TEST((strain(0, i) > 0.0) == yields);
    }
}

BOOST_AUTO_TEST_CASE(every_one_step_method_serves_and_multistep_ones_are_refused) {
    const auto body = block<SmoothParticleModel<2>>(12, 6, plane, Scheme{});
    const auto end = [&](const IntegratorOptions& options) {
        Motion<2> motion(*body.first, body.second, options);
        motion.advance_to(10.0);
        return Eigen::MatrixXd(motion.state().position());
    };
    const auto fine = end(rk4(1.0 / 64.0));
    for (const char* method : {"arkode:DORMAND_PRINCE_7_4_5", "gsl:rkf45"}) {
        IntegratorOptions options;
        options.method = method;
        options.rtol = 1e-6;
        options.max_step = 0.25;
        BOOST_TEST((end(options) - fine).cwiseAbs().maxCoeff() < 0.01, method);
    }
    IntegratorOptions adams;
    adams.method = "cvode:adams";
    BOOST_TEST(refusal([&] { end(adams); }).find("cvode:adams") != std::string::npos);
}
