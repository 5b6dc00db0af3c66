// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/packed_particles.hpp"
#include "../sweeps/term_sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/kernel/weight_integrals.hpp>
#include <spam/physics/fick_flux.hpp>
#include <spam/rhs/reaction.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {
namespace {

const ReactionScheme& validated(const ReactionScheme& s, bool has_energies) {
    for (const auto& [name, value] : {std::pair{"diffusivity", s.diffusivity}, {"rate", s.rate}})
        if (!(value >= 0.0) || !std::isfinite(value))
            throw InputError(fmt::format("reaction: {} {:g} must be 0 or more", name, value));
    if (s.diffusivity == 0.0 && s.rate == 0.0)
        throw InputError("reaction: diffusivity and rate are both 0, and nothing would happen");
    if (!std::isfinite(s.threshold) || !std::isfinite(s.heat))
        throw InputError(fmt::format("reaction: threshold {:g} and heat {:g} must be finite",
                                     s.threshold, s.heat));
    if (s.heat != 0.0 && !has_energies)
        throw InputError(fmt::format(
            "reaction: its heat {:g} needs particles with energies; add a law that has them, such as a fluid, before "
            "the reaction",
            s.heat));
    return s;
}

}  // namespace

template <int Dim>
Reaction<Dim>::Reaction(const Selection<Dim>& among, const ReactionScheme& scheme)
    : Term<Dim>(among),
      scheme_(validated(scheme, this->layout().has(Field::energy))),
      sweeps_(std::make_unique<const Sweeps<Dim>>(
          best_sweeps([](auto level) { return species_sweeps<Dim, level>(); }))),
      packed_(std::make_unique<PackedParticles<Dim>>(
          GeneralWeight<Dim>(
              scheme_.kernel,
              valid_range<Dim>(scheme_.range, this->particles().spacing, this->particles().size())),
          ListUse::again_and_again, this->box(), *sweeps_)),
      rho_(this->particles().size()) {
    this->look_after(*packed_);
    this->nature_.description = fmt::format(
        "a reaction, D = {:g}, {:g} c (1 - c)(c - {:g}){}, range {:g}", scheme_.diffusivity,
        scheme_.rate, scheme_.threshold,
        scheme_.heat != 0.0 ? fmt::format(", heat {:g}", scheme_.heat) : "", scheme_.range);
    this->nature_.fields = {field_kind::concentration};
    this->nature_.reach = scheme_.range;
    this->nature_.potential = false;
    this->nature_.own_heat = scheme_.heat != 0.0;  // what has not reacted is no energy of particles
    this->nature_.sums_density = true;
}

template <int Dim>
Reaction<Dim>::~Reaction() = default;

template <int Dim>
std::string Reaction<Dim>::rates(const Now& now) {
    using R = SpeciesRecord<Dim>;
    const std::size_t n = this->particles().size();
    std::fill_n(now.v_dot, Dim * n, 0.0);
    const double* const c = now.state.find(field_kind::concentration);
    double* const c_dot = now.rate.find(field_kind::concentration);
    double* const e_dot = scheme_.heat != 0.0 ? now.rate.find(Field::energy) : nullptr;
    if (!packed_->follow(n, {now.state.position().data(), nullptr, this->particles().mass.data()}))
        return "a position is not finite";
    SweepInput<Dim> in = packed_->input();
    in.constants.conductivity = scheme_.diffusivity;
    SweepOutput<Dim> out;
    out.rho = rho_.data();
    sweeps_->density(in, out);
    packed_->template write<R>(R::template at<column::Density>, 2,
                               [&](std::size_t i, double* number) {
                                   number[0] = rho_[i];
                                   number[1] = c[i];
                               });
    out.records = packed_->record(0);
    sweeps_->gradient(in, out);
    packed_->template refresh<R>(R::template at<column::HeatFlux>);
    parallel_for(n, [&](std::size_t i) {
        c_dot[i] = scheme_.rate * c[i] * (1.0 - c[i]) * (c[i] - scheme_.threshold);
        if (e_dot != nullptr) e_dot[i] += scheme_.heat * c_dot[i];
    });
    out.e_dot = c_dot;
    sweeps_->force(in, out);
    return {};
}

template <int Dim>
auto Reaction<Dim>::answer(Ask what, std::span<const double> y) const -> Answer {
    if (what == Ask::energy) {
        if (scheme_.heat == 0.0) return {};
        const auto& mass = this->particles().mass;
        const double* const c = this->state_of(y).find(field_kind::concentration);
        return {scheme_.heat *
                exact_sum(mass.size(), [&](std::size_t i) { return mass[i] * (1.0 - c[i]); })};
    }
    if (what == Ask::damping) {
        const double k = steepest_wave<Dim>(GeneralWeight<Dim>(scheme_.kernel, scheme_.range));
        return {scheme_.diffusivity * k * k + scheme_.rate};
    }
    if (what == Ask::neighbour_forces) return {};
    return Term<Dim>::answer(what, y);
}

SPAM_COMPILED(template class Reaction);

}  // namespace spam
