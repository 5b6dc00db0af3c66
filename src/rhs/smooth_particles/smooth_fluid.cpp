// SPDX-License-Identifier: GPL-3.0-or-later
// What can be asked of smooth particles only where they are fluid.
#include "carried_energy.hpp"
#include "constitution.hpp"
#include <spam/core/error.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <fmt/format.h>

namespace spam {

template <int Dim>
const Fluid& SmoothParticles<Dim>::fluid() const {
    return dynamic_cast<const FluidConstitution<Dim>&>(*constitution_).first();
}

template <int Dim>
std::vector<double> FluidConstitution<Dim>::of_all(Value value, std::span<const double> rho,
                                                   std::span<const double> e) const {
    std::vector<double> all(rho.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = (of(i).state.*value)(rho[i], e[i]);
    return all;
}

template <int Dim>
std::vector<double> SmoothParticles<Dim>::pressure(std::span<const double> y) const {
    const auto rho = this->densities(y);
    return dynamic_cast<const FluidConstitution<Dim>&>(*constitution_)
        .of_all(&AnyEquationOfState::pressure, rho,
                {this->state_of(y).energy().data(), rho.size()});
}

template <int Dim>
std::vector<double> SmoothParticles<Dim>::temperature(std::span<const double> y) const {
    const auto rho = this->densities(y);
    return dynamic_cast<const FluidConstitution<Dim>&>(*constitution_)
        .of_all(&AnyEquationOfState::temperature, rho,
                {this->state_of(y).energy().data(), rho.size()});
}

template <int Dim>
std::vector<double> SmoothParticles<Dim>::start(const Points<Dim>& position,
                                                const Points<Dim>& velocity, double T) {
    expect_start<Dim>(*this, position, velocity);
    const auto& fluids = dynamic_cast<const FluidConstitution<Dim>&>(*constitution_);
    const auto sum = best_sweeps([&](auto level) {
        Scheme summed = scheme_;
        summed.density = Density::summed;
        return smooth_particle_sweeps<Dim, level>(summed, fluids.matter(summed));
    });
    PackedParticles<Dim> once(GeneralWeight<Dim>(scheme_.kernel, scheme_.range), ListUse::once,
                              this->box(), sum);
    const auto rho =
        once.summed_density(sum.density, this->particles().size(),
                            {position.data(), velocity.data(), this->particles().mass.data()});
    return fluid_start<Dim>(
        this->model(),
        [&](std::size_t i) -> const AnyEquationOfState& { return fluids.of(i).state; }, position,
        velocity, rho, T);
}

/// Halves with the density of the whole, as where it is integrated, have its cold energy; sums have another one.
template <int Dim>
void SmoothParticles<Dim>::take_over(const Term<Dim>& /*before*/, const ConstState<Dim>& /*was*/,
                                     const Change<Dim>& change, const State<Dim>& /*now*/) {
    if (!constitution_->cold()) return;
    for (std::size_t k = 0; k < change.parts.size(); ++k)
        if (!change.same(k) && (scheme_.density == Density::summed || change.parts[k].size() > 1))
            throw InputError(fmt::format(
                "population: the energy of '{}' is a function of the density, which changes where particle {} is "
                "split or merged, and nothing can pay; use a law with an energy, such as GammaGas",
                constitution_->describe(), change.id[change.parts[k].front().particle]));
}

#define SPAM_INSTANTIATE(D)                                                                      \
    template std::vector<double> FluidConstitution<D>::of_all(Value, std::span<const double>,    \
                                                              std::span<const double>) const;    \
    template const Fluid& SmoothParticles<D>::fluid() const;                                     \
    template std::vector<double> SmoothParticles<D>::pressure(std::span<const double>) const;    \
    template std::vector<double> SmoothParticles<D>::temperature(std::span<const double>) const; \
    template std::vector<double> SmoothParticles<D>::start(const Points<D>&, const Points<D>&,   \
                                                           double);                              \
    template void SmoothParticles<D>::take_over(const Term<D>&, const ConstState<D>&,            \
                                                const Change<D>&, const State<D>&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
