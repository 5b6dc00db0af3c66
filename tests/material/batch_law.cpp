// SPDX-License-Identifier: GPL-3.0-or-later
// A law that is asked for many stresses at a time gives what one asked for each of them gives.
#include <spam/material/elastic_solid.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <atomic>
#include <limits>

using namespace spam;

namespace {

std::atomic<std::size_t> largest_batch{0}, asked{0};

template <int Dim>
struct ManyAtATime {
    ElasticSolid solid;
    bool gives_up = false;

    std::string describe() const { return "elastic solid, many at a time"; }
    double sound_speed(double density) const { return solid.sound_speed(density); }
    void stress_rates(std::span<const Mat<Dim>> grad_v, std::span<const SymTensor<Dim>> stress,
                      std::span<SymTensor<Dim>> rate) const {
        largest_batch = std::max<std::size_t>(largest_batch, grad_v.size());
        asked += grad_v.size();
        for (std::size_t k = 0; k < rate.size(); ++k)
            rate[k] = gives_up ? SymTensor<Dim>{{std::numeric_limits<double>::quiet_NaN()}}
                               : solid.stress_rate(grad_v[k], stress[k]);
    }
};

static_assert(BatchStressLaw<ManyAtATime<2>, 2> && !StressLaw<ManyAtATime<2>, 2>);

/// Rates of a block of particles that are sheared and stretched.
template <int Dim>
std::vector<double> rates_with(const Material<Dim>& material, std::string* failure = nullptr) {
    std::array<int, Dim> cells;
    cells.fill(Dim == 1 ? 700 : Dim == 2 ? 27 : 9);
    Scheme scheme;
    scheme.viscosity = 1.0;  // asks for the sound speed
    SmoothParticleModel<Dim> model(make_particles<Dim>(square_lattice<Dim>(cells), 1.0), material,
                                   scheme);
    auto y = initial_state<Dim>(model, 1.0, 1.0, [](const Point<Dim>& x) {
        return Point<Dim>(0.01 * x.reverse() + 0.003 * x);
    });
    State<Dim> state(model.layout(), y);
    for (Eigen::Index i = 0; i < state.stress().cols(); ++i)
        state.stress().col(i).setLinSpaced(0.01, 0.02 + 1e-5 * static_cast<double>(i));
    std::vector<double> y_dot(y.size());
    model.rates(0.0, y, y_dot);
    if (failure) *failure = model.failure();
    return y_dot;
}

}  // namespace

BOOST_AUTO_TEST_CASE(batches_give_the_rates_of_single_calls) {
    const ElasticSolid solid{0.7, 0.4};
    largest_batch = asked = 0;
    BOOST_TEST(rates_with<1>(ManyAtATime<1>{solid}) == rates_with<1>(solid));
    BOOST_TEST(asked == 700U);
    BOOST_TEST(rates_with<2>(ManyAtATime<2>{solid}) == rates_with<2>(solid));
    BOOST_TEST(rates_with<3>(ManyAtATime<3>{solid}) == rates_with<3>(solid));
    BOOST_TEST(asked == 700U + 729U + 729U);
    BOOST_TEST(largest_batch <= batch_of_stresses);
    BOOST_TEST(largest_batch > 1U);
}

BOOST_AUTO_TEST_CASE(a_law_that_gives_no_rate_is_seen) {
    const auto y_dot = rates_with<2>(ManyAtATime<2>{{0.7, 0.4}, true});
    BOOST_TEST(std::any_of(y_dot.begin(), y_dot.end(), [](double r) { return std::isnan(r); }));
}
