// SPDX-License-Identifier: GPL-3.0-or-later
// For instructions.cmake: `instructions <scheme> <calls>` evaluates the rates of a jittered hexagon of
// 217 particles so many times and prints the number of its undirected pairs within the range.
#include <spam/core/parallel.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/rhs/smooth_particle_model.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

using namespace spam;

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    set_threads(1);
    Scheme scheme{.transport = Transport::monaghan};
    if (argv[1] == std::string("two_sweeps")) scheme.density = Density::summed;
    SmoothParticleModel<2> model(make_particles<2>(triangular_hexagon(8), 1.0),
                                 ElasticSolid::triangular_lattice(), scheme);
    auto y = initial_state<2>(model, std::sqrt(4.0 / 3.0), 0.433, rigid_rotation(1e-3));
    std::vector<double> y_dot(y.size());
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> u(-0.01, 0.01);
    for (double& x : y) x += u(random);
    for (int k = std::atoi(argv[2]); k > 0; --k) model.rates(0.0, y, y_dot);

    const PairList<2> list(State<2>(model.layout(), y).position(), scheme.range, {});
    std::size_t directed = 0;
    for (std::size_t i = 0; i < list.size(); ++i) directed += list.neighbours(i).size() - 1;
    std::printf("%zu\n", directed / 2);
}
