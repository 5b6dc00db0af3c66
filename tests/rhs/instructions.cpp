// SPDX-License-Identifier: GPL-3.0-or-later
// For instructions.cmake: `instructions <dimensions> <system> <calls>` evaluates the rates of a system of
// measured_systems.hpp, 217 particles in the plane and 104 in space, so many times and prints the number of its
// undirected pairs within the range.
#include "support/measured_systems.hpp"
#include <spam/core/parallel.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <cstdio>
#include <cstdlib>

using namespace spam;

namespace {

template <int Dim>
std::size_t pairs_after(const std::string& name, int calls) {
    test::MeasuredSystem<Dim> system(name, Dim == 2 ? 217 : 104);
    for (; calls > 0; --calls) system.rates();
    const PairList<Dim> list(system.position(), system.model->reach(), {});
    std::size_t directed = 0;
    for (std::size_t i = 0; i < list.size(); ++i) directed += list.neighbours(i).size() - 1;
    return directed / 2;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    set_threads(1);
    const auto pairs_of = argv[1] == std::string("2") ? pairs_after<2> : pairs_after<3>;
    std::printf("%zu\n", pairs_of(argv[2], std::atoi(argv[3])));
}
