// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/packed_particles.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/neighbors/pair_list.hpp>
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
    const int own = static_cast<int>(law.sweeps.pack.kinds.size());
    if (!(law.range > 0.0))
        throw InputError(fmt::format("range: {:g} of '{}' must be a positive length", law.range,
                                     law.description));
    if (law.sweeps.numbers < own + static_cast<int>(law.columns.size()))
        throw InputError(
            fmt::format("columns: '{}' has room for {} numbers behind those of a point, "
                        "and {} are given",
                        law.description, law.sweeps.numbers - own, law.columns.size()));
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
      packed_(std::make_unique<PackedParticles<Dim>>(
          GeneralWeight<Dim>(law_.kernel, std::isinf(law_.range) ? 1.0 : law_.range),
          ListUse::again_and_again, this->box(), law_.sweeps, law_.range)) {
    this->look_after(*packed_);
    this->nature_.description = law_.description;
    this->nature_.reach = law_.range;
    if (std::isinf(law_.range))
        this->nature_.no_images =
            "images behind a wall would attract and repel like particles; use rigid sides";
    this->nature_.potential = law_.sweeps.energy != nullptr;
    if (law_.heat) {
        this->nature_.fields = {*law_.heat};
        this->nature_.own_heat = true;
    }
}

template <int Dim>
PairTerm<Dim>::~PairTerm() = default;

template <int Dim>
std::vector<NumberKind> PairTerm<Dim>::record_kinds() const {
    std::vector<NumberKind> kinds(static_cast<std::size_t>(law_.sweeps.numbers));
    std::ranges::copy(law_.kinds, kinds.begin() + static_cast<std::ptrdiff_t>(own_columns()));
    return kinds;
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
    if (!packed.follow(this->particles().size(), {state.position().data(), state.velocity().data(),
                                                  this->particles().mass.data()}))
        return false;
    if (law_.columns.empty()) return true;
    packed.write(
        static_cast<int>(own_columns()), static_cast<int>(law_.columns.size()),
        [&](std::size_t i, double* number) {
            for (const auto& column : law_.columns) *number++ = column[i];
        },
        kinds_);
    return true;
}

template <int Dim>
std::string PairTerm<Dim>::rates(const Now& now) {
    if (!follow(*packed_, now.state)) return "a position is not finite";
    SweepOutput<Dim> out;
    out.v_dot = now.v_dot;
    if (law_.heat) out.e_dot = now.rate.find(*law_.heat);
    law_.sweeps.force(input(*packed_), out);
    sweep_walls(*packed_, input(*packed_), law_.sweeps.force);
    return {};
}

/// For observers, here and below: a list of its own, so that the one of the right-hand side stays as it is.
template <int Dim>
double PairTerm<Dim>::pair_energy(std::span<const double> y) const {
    const ConstState<Dim> state = this->state_of(y);
    std::vector<double> energy(this->particles().size());
    if (law_.sweeps.energy != nullptr) {
        auto own = packed_->for_observer();
        if (!follow(own, state)) return std::numeric_limits<double>::quiet_NaN();
        SweepOutput<Dim> out;
        out.energy = energy.data();
        law_.sweeps.energy(input(own), out);
    }
    if (law_.heat)
        for (std::size_t i = 0; i < energy.size(); ++i)
            energy[i] += this->particles().mass[i] * state.find(*law_.heat)[i];
    return exact_sum(energy.size(), [&](std::size_t i) { return energy[i]; });
}

template <int Dim>
auto PairTerm<Dim>::answer(Ask what, std::span<const double> y) const -> Answer {
    if (what == Ask::energy) return {pair_energy(y)};
    if (what == Ask::damping) return {law_.damping};
    if (what == Ask::neighbour_forces && law_.sweeps.energy == nullptr) return {};
    if (what == Ask::density && law_.sweeps.density != nullptr)
        return {0.0,
                packed_->for_observer().summed_density(
                    law_.sweeps.density, this->particles().size(),
                    {this->state_of(y).position().data(), nullptr, this->particles().mass.data()})};
    return Term<Dim>::answer(what, y);
}

template <int Dim>
std::optional<std::vector<PairForce<Dim>>> PairTerm<Dim>::pair_forces(
    std::span<const double> y) const {
    if (!law_.of_pair) return std::nullopt;
    const Points<Dim> x = this->state_of(y).position();
    std::vector<PairForce<Dim>> pairs;
    const auto add = [&](std::size_t i, std::size_t j) {
        const auto x_i = x.col(static_cast<Eigen::Index>(i)),
                   x_j = x.col(static_cast<Eigen::Index>(j));
        PairForce<Dim> pair{i, j, this->box().separation(x_i, x_j), 0.0, 0.0};
        law_.of_pair(pair, pair.r_ij - (x_i - x_j));
        pair.i += this->among().first();
        pair.j += this->among().first();
        pairs.push_back(pair);
    };
    if (std::isinf(law_.range)) {
        for (std::size_t i = 0; i < this->particles().size(); ++i)
            for (std::size_t j = 0; j < i; ++j) add(i, j);
        return pairs;
    }
    const PairList<Dim> near(x, law_.range, this->box());
    for (std::size_t i = 0; i < near.size(); ++i)
        for (const std::uint32_t j : near.neighbours(i))
            if (j < i) add(i, j);
    return pairs;
}

SPAM_COMPILED(template class PairTerm);

}  // namespace spam
