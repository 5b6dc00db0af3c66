// SPDX-License-Identifier: GPL-3.0-or-later
// An external of one's own, in one file: a rotating frame's Coriolis and centrifugal forces. A body at
// rest in the laboratory goes round in the frame, and its accounts close.
#include <spam/diagnostics/invariants.hpp>
#include <spam/external/external.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

using namespace spam;
namespace {

class RotatingFrame final : public External<2> {
  public:
    explicit RotatingFrame(double omega) : omega_(omega) {}

    void add(const Now& now, Eigen::Index first, Eigen::Index last) const override {
        const auto x = now.state.position(), v = now.state.velocity();
        auto v_dot = now.rate.velocity();
        for (Eigen::Index i = first; i < last; ++i) {
            v_dot(0, i) += omega_ * omega_ * x(0, i) + 2.0 * omega_ * v(1, i);
            v_dot(1, i) += omega_ * omega_ * x(1, i) - 2.0 * omega_ * v(0, i);
        }
    }
    std::string inseparable() const override { return "its force depends on the velocity"; }
    std::string describe() const override { return "rotating frame"; }

  private:
    double omega_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_resting_body_goes_round_in_a_rotating_frame) {
    const double omega = 0.3, t = 5.0;
    BondedModel<2> model(make_particles<2>(triangular_block(6, 5), 1.0), HarmonicSpring{});
    model.add(std::make_unique<RotatingFrame>(omega));
    const auto y0 = initial_state<2>(model, 1.1547, 0.43, [&](const Point<2>& x) {
        return Point<2>(omega * x.y(), -omega * x.x());
    });
    const auto before = measure_invariants<2>(model, y0);
    IntegratorOptions options;
    options.dt = 0.01;
    Motion<2> motion(model, y0, options);
    motion.advance_to(t);
    const auto X = model.particles().reference_position;
    const Eigen::Rotation2Dd back(-omega * t);
    BOOST_TEST((motion.state().position() - back.toRotationMatrix() * X).norm() < 1e-6);
    const auto after = measure_invariants<2>(model, motion.y());
    BOOST_TEST((after.momentum_balance() - before.momentum_balance()).norm() < 1e-9);
    BOOST_TEST(std::abs(after.energy_balance() - before.energy_balance()) < 1e-7);
    BOOST_TEST(after.momentum_balance().norm() > 1e-3);
}
