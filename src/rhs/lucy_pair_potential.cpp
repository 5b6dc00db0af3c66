// SPDX-License-Identifier: GPL-3.0-or-later
#include "packed_particles.hpp"
#include "term_sweeps.hpp"
#include <spam/core/sums.hpp>
#include <spam/kernel/lucy.hpp>
#include <spam/physics/record.hpp>
#include <spam/rhs/lucy_pair_potential.hpp>

#include <fmt/format.h>

namespace spam {
namespace {

template <int Dim>
PackedFields fields(const Particles<Dim>& particles, const ConstState<Dim>& state) {
    return {state.position().data(), nullptr, particles.mass.data()};
}

}  // namespace

template <int Dim>
LucyPairPotential<Dim>::LucyPairPotential(Model<Dim>& model, double range)
    : Term<Dim>(model),
      range_(valid_range<Dim>(range, this->particles().spacing, this->particles().size())),
      sweeps_(std::make_unique<const Sweeps<Dim>>(
          best_sweeps([](auto level) { return pair_potential_sweeps<Dim, level>(); }))),
      packed_(packed_with(ListUse::again_and_again)) {}

template <int Dim>
LucyPairPotential<Dim>::~LucyPairPotential() = default;

template <int Dim>
std::unique_ptr<PackedParticles<Dim>> LucyPairPotential<Dim>::packed_with(ListUse use) const {
    return std::make_unique<PackedParticles<Dim>>(GeneralWeight<Dim>(Kernel::lucy, range_), use,
                                                  this->box(), *sweeps_);
}

template <int Dim>
std::string LucyPairPotential<Dim>::rates(const Now& now) {
    if (!packed_->follow(this->particles().size(), fields(this->particles(), now.state)))
        return "a position is not finite";
    SweepOutput<Dim> out;
    out.v_dot = now.v_dot;
    sweeps_->force(packed_->input(), out);
    return {};
}

template <int Dim>
void LucyPairPotential<Dim>::remember(Archive& archive) {
    if (archive.reading()) packed_ = packed_with(ListUse::again_and_again);
}

/// For observers: its own list, so that the one of the right-hand side stays as it is.
template <int Dim>
std::vector<double> LucyPairPotential<Dim>::density(std::span<const double> y) const {
    return packed_with(ListUse::once)
        ->summed_density(sweeps_->density, this->particles().size(),
                         fields(this->particles(), this->state_of(y)));
}

template <int Dim>
double LucyPairPotential<Dim>::energy(std::span<const double> y) const {
    const std::vector<double> rho = density(y);
    const double w_0 = Lucy<Dim>(range_).value(0.0);
    CompensatedSum sum;
    for (std::size_t i = 0; i < rho.size(); ++i) {
        const double m = this->particles().mass[i];
        sum += 0.5 * m * (rho[i] - m * w_0);
    }
    return sum;
}

template <int Dim>
std::string LucyPairPotential<Dim>::describe() const {
    return fmt::format("molecular dynamics, Lucy's weight function of range {:g} as pair potential",
                       range_);
}

template <int Dim>
std::size_t LucyPairPotential<Dim>::pairs() const {
    return packed_->list().pairs();
}
template <int Dim>
std::size_t LucyPairPotential<Dim>::list_builds() const {
    return packed_->list().builds();
}

template class LucyPairPotential<1>;
template class LucyPairPotential<2>;
template class LucyPairPotential<3>;

}  // namespace spam
