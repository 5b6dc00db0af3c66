// SPDX-License-Identifier: GPL-3.0-or-later
// What a model remembers beside y, and how it passes to other particles.
#include <spam/core/error.hpp>
#include <spam/neighbors/neighbourhood.hpp>
#include <spam/rhs/particle_model.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <typeinfo>

namespace spam {
namespace {

constexpr FieldKind reflections_kind{"reflections", Rank::scalar, Role::memory, "1"};

}  // namespace

template <int Dim>
void ParticleModel<Dim>::remember(Memory<Dim>& memory) {
    Model<Dim>::remember(memory);
    if (walled_) memory.run(reflections_kind, reflections_);
    std::string laws;
    for (const auto& term : terms_) {
        const Term<Dim>& law = *term;
        laws += typeid(law).name();
    }
    memory.laws(std::move(laws));
    for (const auto& term : terms_) {
        if (memory.reading())
            for (auto* near : term->neighbourhoods())
                if (!near->for_good()) near->forget();
        memory.among(term->among().first(), term->among().count());
        term->remember(memory);
    }
}

template <int Dim>
std::vector<Mat<Dim>> ParticleModel<Dim>::deformation_gradients(std::span<const double> y) const {
    std::vector<Mat<Dim>> all;
    for (const auto& term : terms_) {
        const auto of_term = term->deformation_gradients(y);
        if (of_term.empty()) continue;
        if (all.empty()) all.assign(this->particles().size(), into_material(Mat<Dim>{}));
        std::ranges::copy(of_term,
                          all.begin() + static_cast<std::ptrdiff_t>(term->among().first()));
    }
    return all;
}

/// What potentials have changed by with the places of particles is paid by the energies of those that were split or
/// merged, in proportion to their masses. Laws that remember the material put children where it costs least, and leave
/// the rest to the accounts.
template <int Dim>
void ParticleModel<Dim>::pay_for_potentials(const ParticleModel& before,
                                            std::span<const double> was, const Change<Dim>& change,
                                            std::span<double> y) const {
    std::vector<std::size_t> others;
    double mass = 0.0;
    for (std::size_t k = 0; k < change.parts.size(); ++k)
        if (!change.same(k)) {
            others.push_back(k);
            mass += this->particles().mass[k];
        }
    if (others.empty()) return;
    double price = 0.0, size = 0.0;
    std::string law;
    for (std::size_t n = 0; n < terms_.size(); ++n) {
        const auto& nature = terms_[n]->nature();
        if (!nature.potential || nature.own_heat || !terms_[n]->deformation_gradients(y).empty())
            continue;
        const double then = before.terms_[n]->energy(was), now = terms_[n]->energy(y);
        price += now - then;
        size += std::abs(now) + std::abs(then);
        law = nature.description;
    }
    if (std::abs(price) <= 1e-14 * size) return;
    const State<Dim> state(this->layout(), y);
    if (!state.has(Field::energy))
        throw InputError(fmt::format(
            "population: splits and merges change the energy of '{}' by {:.3g}, and particles have no "
            "energy of their own to pay for it; use a law with one, such as GammaGas",
            law, price));
    for (const std::size_t k : others) {
        double& e = state.energy()(0, static_cast<Eigen::Index>(k));
        e -= price / mass;
        if (e < 0.0)
            throw InputError(fmt::format(
                "population: particle {} would pay with an energy below 0 for what the energy of '{}' "
                "changes by, {:.3g}; split and merge fewer particles, or less far apart",
                this->particles().id[k], law, price));
    }
}

template <int Dim>
void ParticleModel<Dim>::take_over(const Model<Dim>& before, std::span<const double> was,
                                   const Change<Dim>& change, std::span<double> y) {
    const auto& earlier = dynamic_cast<const ParticleModel&>(before);
    const Terms& others = earlier.terms_;
    const ConstState<Dim> from(before.layout(), was);
    const State<Dim> to(this->layout(), y);
    for (std::size_t n = 0; n < terms_.size(); ++n) {
        const Selection<Dim>&now = terms_[n]->among(), &then = others[n]->among();
        terms_[n]->take_over(*others[n], then.of(from),
                             change.among(now.first(), now.count(), then.first(), then.count()),
                             now.of(to));
    }
    pay_for_potentials(earlier, was, change, y);
}

// pay_for_potentials too: particle_model.cpp, which instantiates the class, may be compiled by itself.
#define SPAM_INSTANTIATE(D)                                                                       \
    template void ParticleModel<D>::remember(Memory<D>&);                                         \
    template std::vector<Mat<D>> ParticleModel<D>::deformation_gradients(std::span<const double>) \
        const;                                                                                    \
    template void ParticleModel<D>::pay_for_potentials(                                           \
        const ParticleModel<D>&, std::span<const double>, const Change<D>&, std::span<double>)    \
        const;                                                                                    \
    template void ParticleModel<D>::take_over(const Model<D>&, std::span<const double>,           \
                                              const Change<D>&, std::span<double>);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
