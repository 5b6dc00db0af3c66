// SPDX-License-Identifier: GPL-3.0-or-later
// A friction of one's own, in one file: f_ij = -gamma w_ij (v_ij . r_ij/r) r_ij/r, as in dissipative particle
// dynamics, beside springs. What it takes from the motion is heat in a field of its own.
#if defined(SPAM_LEVEL)
#include <spam/physics/stress_force.hpp>
#include <spam/rhs/run_sweep.hpp>
using namespace spam;
namespace {

struct CentralFriction {
    double gamma, range;
    static CentralFriction with(const PassConstants& c) { return {c.own[0], c.own[1]}; }
    template <class T>
    using Sums = ForceSums<2, T>;
    template <class T, class R>
    void add(const Pair<2, T>& pair, const R& i, const R& j, Sums<T>& sums) const {
        const T weight = positive_part(T(1.0) - pair.r2 * T(1.0 / (range * range)));
        const T along = dot(pair.v_ji, pair.r_ji) / (pair.r2 + T(1e-300));
        // By the mass of j, as forces of smooth particles are: f/(m_i m_j).
        sums.add(j.m, (T(gamma) * weight * along / (i.m * j.m)) * pair.r_ji, pair.v_ji);
    }
};
const RegisterSweeps<2> friction(
    "central friction", InstructionSet::SPAM_LEVEL,
    pair_sweeps<InstructionSet::SPAM_LEVEL, GeneralSweep, 2, MotionRecord<2>, CentralFriction>);

}  // namespace
#else
#include <spam/diagnostics/invariants.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/pair_term.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;
namespace {
constexpr FieldKind own_heat{"own_heat", Rank::scalar, Role::integrated, "l^2/t^2"};
}  // namespace

BOOST_AUTO_TEST_CASE(it_brakes_and_its_heat_closes_the_energy) {
    Particles<2> particles = make_particles<2>(triangular_block(9, 7), 1.0);
    for (std::size_t i = 0; i < particles.size(); ++i)
        particles.mass[i] = 1.0 + 0.1 * static_cast<double>(i % 3);
    ParticleModel<2> model(particles);
    model.add_term<Springs<2>>(HarmonicSpring{});
    PairLaw<2> law{registered_sweeps<2>("central friction"), 1.6, "friction of one's own"};
    law.constants.own = {0.4, 1.6};
    law.heat = own_heat;
    model.add_term<PairTerm<2>>(law);
    const auto y0 = initial_state<2>(model, 1.0, 1.0, [](const Point<2>& x) {
        return Point<2>(0.2 * std::sin(2.0 * x[1]) - 0.02 * x[1], 0.02 * x[0]);
    });
    IntegratorOptions rk4;
    rk4.dt = 0.05;
    Motion<2> motion(model, y0, rk4);
    const auto before = measure_invariants<2>(model, motion.y());
    motion.advance_to(10.0);
    const auto after = measure_invariants<2>(model, motion.y());
    double heat = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i)
        heat += model.particles().mass[i] * motion.state().find(own_heat)[i];
    BOOST_TEST(heat > 0.1 * before.energy);
    BOOST_TEST(std::abs(after.energy - before.energy) < 1e-7 * before.energy);
    BOOST_TEST((after.momentum - before.momentum).norm() < 1e-13);
    BOOST_TEST(std::abs(after.angular_momentum[0] - before.angular_momentum[0]) < 1e-8);
}
#endif
