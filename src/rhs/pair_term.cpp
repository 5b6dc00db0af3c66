// SPDX-License-Identifier: GPL-3.0-or-later
#include "packed_particles.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/physics/record.hpp>
#include <spam/rhs/pair_term.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {
namespace {

template <int Dim>
PairLaw<Dim> validated(PairLaw<Dim> law, std::size_t particles) {
    if (!(law.range > 0.0) || !std::isfinite(law.range))
        throw InputError(fmt::format("range: {:g} of '{}' must be a positive length", law.range,
                                     law.description));
    if (law.sweeps.numbers < PointRecord<Dim>::numbers + static_cast<int>(law.columns.size()))
        throw InputError(fmt::format(
            "columns: '{}' has room for {} numbers behind those of a point, "
            "and {} are given",
            law.description, law.sweeps.numbers - PointRecord<Dim>::numbers, law.columns.size()));
    for (const auto& column : law.columns)
        if (column.size() != particles)
            throw InputError(fmt::format("columns: '{}' is given {} numbers for {} particles",
                                         law.description, column.size(), particles));
    if (!law.kinds.empty() && law.kinds.size() != law.columns.size())
        throw InputError(fmt::format("columns: '{}' says of {} what they are, and gives {}",
                                     law.description, law.kinds.size(), law.columns.size()));
    return law;
}

}  // namespace

template <int Dim>
PairTerm<Dim>::PairTerm(const Selection<Dim>& among, PairLaw<Dim> law)
    : Term<Dim>(among),
      law_(validated(std::move(law), among.particles().size())),
      kinds_(record_kinds()),
      packed_(packed_with(ListUse::again_and_again)) {}

template <int Dim>
PairTerm<Dim>::~PairTerm() = default;

template <int Dim>
std::vector<NumberKind> PairTerm<Dim>::record_kinds() const {
    std::vector<NumberKind> kinds(static_cast<std::size_t>(law_.sweeps.numbers));
    std::copy(law_.kinds.begin(), law_.kinds.end(), kinds.begin() + PointRecord<Dim>::numbers);
    return kinds;
}

template <int Dim>
std::unique_ptr<PackedParticles<Dim>> PairTerm<Dim>::packed_with(ListUse use) const {
    return std::make_unique<PackedParticles<Dim>>(GeneralWeight<Dim>(Kernel::lucy, law_.range), use,
                                                  this->box(), law_.sweeps);
}

template <int Dim>
SweepInput<Dim> PairTerm<Dim>::input(const PackedParticles<Dim>& packed) const {
    SweepInput<Dim> in = packed.input();
    in.constants = law_.constants;
    return in;
}

/// List and records for this state. False where a position is not finite.
template <int Dim>
bool PairTerm<Dim>::follow(PackedParticles<Dim>& packed, const ConstState<Dim>& state) const {
    if (!packed.follow(this->particles().size(),
                       {state.position().data(), nullptr, this->particles().mass.data()}))
        return false;
    if (law_.columns.empty()) return true;
    const auto order = packed.list().order();
    const Home<Dim> home = packed.list().home();
    parallel_for(order.size(), [&](std::size_t slot) {
        double* const number = packed.record(slot) + PointRecord<Dim>::numbers;
        const std::uint32_t i = order[slot];
        for (std::size_t k = 0; k < law_.columns.size(); ++k) {
            const double own = law_.columns[k][i];
            const bool moved = !law_.kinds.empty() && law_.kinds[k].quantity == Quantity::position;
            number[k] = moved ? home(i, law_.kinds[k].a, own) : own;
        }
    });
    packed.refresh(kinds_, PointRecord<Dim>::numbers);
    return true;
}

template <int Dim>
std::string PairTerm<Dim>::rates(const Now& now) {
    if (!follow(*packed_, now.state)) return "a position is not finite";
    SweepOutput<Dim> out;
    out.v_dot = now.v_dot;
    law_.sweeps.force(input(*packed_), out);
    packed_->sweep_walls(input(*packed_), law_.sweeps.force);
    return {};
}

/// For observers, here and below: a list of its own, so that the one of the right-hand side stays as it is.
template <int Dim>
double PairTerm<Dim>::energy(std::span<const double> y) const {
    const auto own = packed_with(ListUse::once);
    std::vector<double> half(this->particles().size());
    if (!follow(*own, this->state_of(y))) return std::numeric_limits<double>::quiet_NaN();
    SweepOutput<Dim> out;
    out.energy = half.data();
    law_.sweeps.energy(input(*own), out);
    return exact_sum(half.size(), [&](std::size_t i) { return half[i]; });
}

template <int Dim>
std::vector<double> PairTerm<Dim>::density(std::span<const double> y) const {
    if (law_.sweeps.density == nullptr) return {};
    return packed_with(ListUse::once)
        ->summed_density(
            law_.sweeps.density, this->particles().size(),
            {this->state_of(y).position().data(), nullptr, this->particles().mass.data()});
}

template <int Dim>
const WallRates<Dim>* PairTerm<Dim>::wall_rates(int a, bool upper) const {
    return packed_->walls().find(a, upper);
}

template <int Dim>
std::size_t PairTerm<Dim>::pairs() const {
    return packed_->list().pairs();
}
template <int Dim>
std::size_t PairTerm<Dim>::list_builds() const {
    return packed_->list().builds();
}

template <int Dim>
void PairTerm<Dim>::remember(Memory<Dim>& memory) {
    if (memory.reading()) packed_ = packed_with(ListUse::again_and_again);
}

template class PairTerm<1>;
template class PairTerm<2>;
template class PairTerm<3>;

}  // namespace spam
