// SPDX-License-Identifier: GPL-3.0-or-later
#include "packed_particles.hpp"
#include "term_sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/rhs/pair_potentials.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {
namespace {

template <int Dim>
PairLaw<Dim> law_of(const CorePotential& core) {
    if (!(core.e_c > 0.0) || !std::isfinite(core.e_c))
        throw InputError(fmt::format(
            "core: energy {:g} must be above 0, or the core would not push; try 0.1", core.e_c));
    if (!(core.s > 0.0) || !std::isfinite(core.s))
        throw InputError(
            fmt::format("core-range: {:g} must be above 0; 0.7 to 0.8 spacings are usual", core.s));
    PairLaw<Dim> law{best_sweeps([](auto level) { return core_sweeps<Dim, level>(); }), core.s,
                     fmt::format("core {:g} of range {:g}", core.e_c, core.s)};
    law.constants.core_energy = core.e_c;
    law.constants.core_range = core.s;
    return law;
}

template <int Dim>
PairLaw<Dim> law_of(const CohesivePotential& potential) {
    if (!(potential.e_b > 0.0) || !(potential.a > 0.0) ||
        !std::isfinite(potential.e_b * potential.a))
        throw InputError(
            fmt::format("cohesion: energy {:g} and spacing {:g} must be above 0; 1 and 1 "
                        "are those of the lectures",
                        potential.e_b, potential.a));
    PairLaw<Dim> law{
        best_sweeps([](auto level) { return cohesive_sweeps<Dim, level>(); }), potential.range(),
        fmt::format("molecular dynamics, (2 - r^2)^8 - 2 (2 - r^2)^4 by the energy {:g} "
                    "and the spacing {:g}",
                    potential.e_b, potential.a)};
    law.constants.core_energy = potential.e_b;
    law.constants.core_range = potential.a;
    return law;
}

template <int Dim>
PairLaw<Dim> weights_law(const Particles<Dim>& particles, double range, double a, Kernel kernel) {
    PairLaw<Dim> law{
        best_sweeps([&](auto level) { return weight_potential_sweeps<Dim, level>(kernel); }),
        valid_range<Dim>(range, particles.spacing, particles.size()),
        fmt::format("molecular dynamics, {} of range {:g} as pair potential",
                    kernel == Kernel::lucy ? "Lucy's weight function"
                                           : fmt::format("the weight {}", to_string(kernel)),
                    range)};
    law.constants.core_energy = a;
    law.kernel = kernel;
    return law;
}

}  // namespace

template <int Dim>
Core<Dim>::Core(const Selection<Dim>& among, const CorePotential& core)
    : PairTerm<Dim>(among, law_of<Dim>(core)) {}

template <int Dim>
Cohesion<Dim>::Cohesion(const Selection<Dim>& among, const CohesivePotential& potential)
    : PairTerm<Dim>(among, law_of<Dim>(potential)) {}

template <int Dim>
WeightPotential<Dim>::WeightPotential(const Selection<Dim>& among, double range, double a,
                                      Kernel kernel)
    : PairTerm<Dim>(among, weights_law<Dim>(among.particles(), range, a, kernel)) {}

template class Core<1>;
template class Core<2>;
template class Core<3>;
template class Cohesion<1>;
template class Cohesion<2>;
template class Cohesion<3>;
template class WeightPotential<1>;
template class WeightPotential<2>;
template class WeightPotential<3>;

}  // namespace spam
