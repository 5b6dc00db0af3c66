// SPDX-License-Identifier: GPL-3.0-or-later
// The passes of a total-Lagrangian solid in 1, 2, 4 and 8 lanes against their own pair bodies in plain
// numbers, pair by pair; what a pair exchanges is antisymmetric bit for bit.
#include "physics/swept_passes.hpp"
#include <spam/physics/deformation_gradient.hpp>
#include <spam/physics/reference_force.hpp>
#include <spam/physics/zero_energy_penalty.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

template <int Dim>
using Cloud = RandomCloud<Dim, StressedRecord<Dim>>;

/// Momentum given and taken, for unit volumes of both ends.
template <int Dim, class Pass>
bool antisymmetric(Cloud<Dim> cloud) {
    for (const std::size_t i : {0UL, 1UL, 2UL, 3UL})
        cloud.numbers[i * Cloud<Dim>::stride + 2 * Dim] = 1.0;
    const auto force = [&](std::size_t i, std::size_t j) {
        typename Pass::template Sums<double> sums;
        cloud.template add<Pass>(i, j, sums);
        return sums.force;
    };
    bool exact = true, nonzero = false;
    for (const std::size_t i : {0UL, 1UL, 2UL})
        for (const std::size_t j : {1UL, 2UL, 3UL}) {
            exact = exact && force(i, j) == -1.0 * force(j, i);
            nonzero = nonzero || force(i, j)[0] != 0.0;
        }
    return exact && nonzero;
}

/// Takes the stress of one end for both.
template <int Dim>
struct OwnStress {
    template <class T>
    using Sums = typename ReferenceForce<Dim>::template Sums<T>;
    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        sums.force += j.volume * ((i.B + i.B) * pair.grad_w);
        if constexpr (!std::is_same_v<T, double>) sums.force += T(0.01) * pair.grad_w;
    }
};

template <int Dim>
void every_pass() {
    const Cloud<Dim> cloud(75);
    every_width<DeformationGradient<Dim>, ZeroEnergyPenalty<Dim>, PenaltyEnergy<Dim>,
                ReferenceForce<Dim>>(cloud);
    BOOST_TEST((antisymmetric<Dim, ReferenceForce<Dim>>(cloud)));
    BOOST_TEST((antisymmetric<Dim, ZeroEnergyPenalty<Dim>>(cloud)));
    BOOST_TEST((!antisymmetric<Dim, OwnStress<Dim>>(cloud)));
    const auto own = differences<4, OwnStress<Dim>>({pair_by_pair<OwnStress<Dim>>(cloud)}, cloud);
    BOOST_TEST(own[0] > 1e-4);
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_line) { every_pass<1>(); }
BOOST_AUTO_TEST_CASE(in_the_plane) { every_pass<2>(); }
BOOST_AUTO_TEST_CASE(in_space) { every_pass<3>(); }
