// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/packed_particles.hpp"
#include "../sweeps/term_sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/physics/long_range.hpp>
#include <spam/rhs/pair_potentials.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {
namespace {

/// PairLaw::of_pair of a potential that knows the distance alone.
template <int Dim, DistancePotential Potential>
auto of_distance(const Potential& potential) {
    return [potential](PairForce<Dim>& pair, const Point<Dim>&) {
        const double r2 = pair.r_ij.squaredNorm();
        pair.energy = potential.energy(r2);
        pair.force_over_r = potential.force_over_r(r2);
    };
}

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
    law.of_pair = of_distance<Dim>(core);
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
    law.of_pair = of_distance<Dim>(potential);
    return law;
}

template <int Dim>
PairLaw<Dim> law_of(const LongRangeScheme& scheme, const Particles<Dim>& particles) {
    const std::vector<double>& q = scheme.charge.empty() ? particles.mass : scheme.charge;
    if (scheme.strength == 0.0 || !std::isfinite(scheme.strength))
        throw InputError(fmt::format(
            "strength: {:g} of long-range forces must be a number other than 0; -G is that of gravity",
            scheme.strength));
    const auto below = [](double charge) { return charge < 0.0; };
    const auto negative = std::count_if(q.begin(), q.end(), below);
    const bool alike = negative == 0 || negative == static_cast<std::ptrdiff_t>(q.size());
    if (!(scheme.softening > 0.0 || (scheme.softening == 0.0 && alike && scheme.strength > 0.0)) ||
        !std::isfinite(scheme.softening))
        throw InputError(fmt::format(
            "softening: {:g} must be above 0 where particles attract each other, which else may meet at infinite "
            "speed, and 0 or more where all repel; a tenth of the spacing is usual",
            scheme.softening));
    PairLaw<Dim> law{best_sweeps([](auto level) { return long_range_sweeps<Dim, level>(); }),
                     std::numeric_limits<double>::infinity(),
                     fmt::format("{} of all pairs, {:g} {}/sqrt(r^2 + {:g}^2)",
                                 scheme.charge.empty() ? "gravity" : "charges", scheme.strength,
                                 scheme.charge.empty() ? "m_i m_j" : "q_i q_j", scheme.softening)};
    law.constants.core_energy = scheme.strength;
    law.constants.core_range = scheme.softening;
    law.columns = {q};
    law.of_pair = [q, potential = LongRangePotential::with(law.constants)](PairForce<Dim>& pair,
                                                                           const Point<Dim>&) {
        const double r2 = pair.r_ij.squaredNorm(), u = potential.inverse(r2);
        pair.energy = potential.strength * q[pair.i] * potential.potential(r2, q[pair.j]);
        pair.force_over_r = pair.energy * (u * u);
    };
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
    law.of_pair = [a, mass = particles.mass, weight = GeneralWeight<Dim>(kernel, range)](
                      PairForce<Dim>& pair, const Point<Dim>&) {
        const double factor = a * mass[pair.i] * mass[pair.j], r = pair.r_ij.norm();
        pair.energy = factor * weight.value(r);
        pair.force_over_r = factor * weight.minus_slope_over_r(r);
    };
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
LongRange<Dim>::LongRange(const Selection<Dim>& among, const LongRangeScheme& scheme)
    : PairTerm<Dim>(among, law_of<Dim>(scheme, among.particles())) {}

template <int Dim>
WeightPotential<Dim>::WeightPotential(const Selection<Dim>& among, double range, double a,
                                      Kernel kernel)
    : PairTerm<Dim>(among, weights_law<Dim>(among.particles(), range, a, kernel)) {}

SPAM_COMPILED(template class Core);
SPAM_COMPILED(template class Cohesion);
SPAM_COMPILED(template class LongRange);
SPAM_COMPILED(template class WeightPotential);

}  // namespace spam
