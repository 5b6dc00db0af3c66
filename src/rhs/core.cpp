// SPDX-License-Identifier: GPL-3.0-or-later
#include "packed_particles.hpp"
#include "term_sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/core/sums.hpp>
#include <spam/rhs/core.hpp>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace spam {
namespace {

CorePotential validated(const CorePotential& core) {
    if (!(core.e_c > 0.0) || !std::isfinite(core.e_c))
        throw InputError(
            fmt::format("core: energy {:g} must be above 0, or the core would attract", core.e_c));
    if (!(core.s > 0.0) || !std::isfinite(core.s))
        throw InputError(
            fmt::format("core-range: {:g} must be above 0; 0.7 to 0.8 spacings are usual", core.s));
    return core;
}

template <int Dim>
PackedFields fields(const Particles<Dim>& particles, const ConstState<Dim>& state) {
    return {state.position().data(), nullptr, particles.mass.data()};
}

}  // namespace

template <int Dim>
Core<Dim>::Core(Model<Dim>& model, const CorePotential& core)
    : Term<Dim>(model),
      core_(validated(core)),
      sweeps_(std::make_unique<const Sweeps<Dim>>(
          best_sweeps([](auto level) { return core_sweeps<Dim, level>(); }))),
      packed_(packed_with(ListUse::again_and_again)) {}

template <int Dim>
Core<Dim>::~Core() = default;

template <int Dim>
std::unique_ptr<PackedParticles<Dim>> Core<Dim>::packed_with(ListUse use) const {
    return std::make_unique<PackedParticles<Dim>>(GeneralWeight<Dim>(Kernel::lucy, core_.s), use,
                                                  this->box(), *sweeps_);
}

template <int Dim>
SweepInput<Dim> Core<Dim>::input(const PackedParticles<Dim>& packed) const {
    SweepInput<Dim> in = packed.input();
    in.constants.core_energy = core_.e_c;
    in.constants.core_range = core_.s;
    return in;
}

template <int Dim>
std::string Core<Dim>::rates(const Now& now) {
    if (!packed_->follow(this->particles().size(), fields(this->particles(), now.state)))
        return "a position is not finite";
    SweepOutput<Dim> out;
    out.v_dot = now.v_dot;
    sweeps_->force(input(*packed_), out);
    return {};
}

/// For observers: its own list, so that the one of the right-hand side stays as it is.
template <int Dim>
double Core<Dim>::energy(std::span<const double> y) const {
    const auto own = packed_with(ListUse::once);
    std::vector<double> half(this->particles().size());
    if (!own->follow(half.size(), fields(this->particles(), this->state_of(y))))
        return std::numeric_limits<double>::quiet_NaN();
    SweepOutput<Dim> out;
    out.energy = half.data();
    sweeps_->energy(input(*own), out);
    CompensatedSum sum;
    for (const double e : half) sum += e;
    return sum;
}

template <int Dim>
std::string Core<Dim>::describe() const {
    return fmt::format("core {:g} of range {:g}", core_.e_c, core_.s);
}

template <int Dim>
std::size_t Core<Dim>::pairs() const {
    return packed_->list().pairs();
}
template <int Dim>
std::size_t Core<Dim>::list_builds() const {
    return packed_->list().builds();
}

template <int Dim>
void Core<Dim>::remember(Archive& archive) {
    if (archive.reading()) packed_ = packed_with(ListUse::again_and_again);
}

template class Core<1>;
template class Core<2>;
template class Core<3>;

}  // namespace spam
