// SPDX-License-Identifier: GPL-3.0-or-later
// Every pass in 1, 2, 4 and 8 lanes against its own pair body in plain numbers, pair by pair.
#include "physics/swept_passes.hpp"
#include <spam/physics/continuity.hpp>
#include <spam/physics/density_sum.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/physics/record.hpp>
#include <spam/physics/torque_balance.hpp>
#include <spam/physics/transport.hpp>
#include <spam/physics/velocity_gradient.hpp>
#include <spam/physics/viscosity.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

template <int Dim>
struct Cloud : RandomCloud<Dim, TransportRecord<Dim>> {
    Cloud() : Cloud::RandomCloud(71) {
        for (std::size_t i = 0; i < this->particles.size(); ++i) {
            double* const row = &this->numbers[i * this->stride];
            row[2 * Dim] = this->particles.mass[i];
            row[2 * Dim + 1] = 1.0 + 0.2 * this->u(this->random);  // density
            for (std::size_t k = 1; k <= 2; ++k)
                row[this->stride - k] = 1.0 + 0.2 * this->u(this->random);
        }
    }
};

template <int Dim, class... More>
void every_pass() {
    every_width<DensitySum, Continuity, ChainRuleContinuity, VelocityGradient<Dim, ArithmeticMean>,
                VelocityGradient<Dim, EitherMean>, PlainTransport<Dim>, AverageTransport<Dim>,
                MonaghanTransport<Dim, ArithmeticMean>, MonaghanTransport<Dim, EitherMean>,
                StressForce<Dim>, ViscousForce<Dim, ArithmeticMean>, ViscousForce<Dim, EitherMean>,
                More...>(Cloud<Dim>());
}

/// Forgets the masses: the comparison must notice.
struct WithoutMass {
    template <class T>
    struct Sums {
        T rho{};
    };
    template <int Dim, class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record&, const Record& j, Sums<T>& sums) {
        sums.rho += j.m * pair.w;
        if constexpr (!std::is_same_v<T, double>) sums.rho += T(0.01) * pair.w;
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_line) { every_pass<1>(); }
BOOST_AUTO_TEST_CASE(in_the_plane) { every_pass<2, TorqueSums<2>, BalancedStressForce<2>>(); }
BOOST_AUTO_TEST_CASE(in_space) { every_pass<3>(); }
BOOST_AUTO_TEST_CASE(a_wrong_pass_is_noticed) {
    const Cloud<2> cloud;
    const std::vector<Rows> expected{pair_by_pair<WithoutMass>(cloud),
                                     pair_by_pair<DensitySum>(cloud)};
    const auto all = differences<4, WithoutMass, DensitySum>(expected, cloud);
    BOOST_TEST(all[0] > 1e-3);
    BOOST_TEST(all[1] < 1e-14);
}
