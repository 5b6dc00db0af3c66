// SPDX-License-Identifier: GPL-3.0-or-later
// For instructions.cmake: `instructions <scheme> <calls>` evaluates the rates of a jittered hexagon of
// 217 particles so many times and prints the number of its undirected pairs within the range.
#include <spam/core/parallel.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>

using namespace spam;

namespace {

std::unique_ptr<Model<2>> model_of(const std::string& scheme) {
    auto particles = make_particles<2>(triangular_hexagon(8), 1.0);
    const auto solid = ElasticSolid::triangular_lattice();
    if (scheme == "total_lagrangian")
        return std::make_unique<TotalLagrangianModel<2>>(
            std::move(particles), StVenantKirchhoff::like(solid),
            TotalLagrangianScheme{std::sqrt(4.0 / 3.0), 3.0, 0.1});
    Scheme updated{.transport = Transport::monaghan};
    if (scheme == "two_sweeps") updated.density = Density::summed;
    return std::make_unique<SmoothParticleModel<2>>(std::move(particles), solid, updated);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    set_threads(1);
    const auto made = model_of(argv[1]);
    Model<2>& model = *made;
    auto y = initial_state<2>(model, std::sqrt(4.0 / 3.0), 0.433, rigid_rotation(1e-3));
    std::vector<double> y_dot(y.size());
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> u(-0.01, 0.01);
    for (double& x : y) x += u(random);
    for (int k = std::atoi(argv[2]); k > 0; --k) model.rates(0.0, y, y_dot);

    const PairList<2> list(State<2>(model.layout(), y).position(), model.reach(), {});
    std::size_t directed = 0;
    for (std::size_t i = 0; i < list.size(); ++i) directed += list.neighbours(i).size() - 1;
    std::printf("%zu\n", directed / 2);
}
