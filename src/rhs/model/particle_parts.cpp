// SPDX-License-Identifier: GPL-3.0-or-later
// The model of one part of a run (core/parts.hpp), made as the whole was.
#include <spam/core/error.hpp>
#include <spam/rhs/particle_model.hpp>

#include <algorithm>

namespace spam {

template <int Dim>
std::unique_ptr<ParticleModel<Dim>> ParticleModel<Dim>::part(
    std::span<const std::uint32_t> numbers) const {
    auto part = std::make_unique<ParticleModel>(this->particles().some(numbers), this->box());
    for (const Again& add : again_) add(*part, numbers);
    part->take_scales(*this);
    return part;
}

template <int Dim>
ParticleModel<Dim>::Own::Own(std::span<const std::uint32_t> numbers, std::size_t from,
                             std::size_t count)
    : first(static_cast<std::size_t>(std::ranges::lower_bound(numbers, from) - numbers.begin())) {
    for (const auto i : numbers.subspan(first))
        if (i < from + count) among.push_back(static_cast<std::uint32_t>(i - from));
}

/// An external of the whole is one of each part, and finds its particles there by their numbers in the whole.
template <int Dim>
void ParticleModel<Dim>::take(std::shared_ptr<External<Dim>> external) {
    again_.push_back([external](ParticleModel& part, auto) { part.take(external); });
    externals_.push_back(std::move(external));
    add_accounts();
}

template <int Dim>
void ParticleModel<Dim>::refuse_parts() {
    throw InputError(
        "ranks: a law of this model is made of something that cannot be copied, and so not for the "
        "particles of each rank; leave --ranks out");
}

#define SPAM_INSTANTIATE(D)                                                                        \
    template std::unique_ptr<ParticleModel<D>> ParticleModel<D>::part(                             \
        std::span<const std::uint32_t>) const;                                                     \
    template ParticleModel<D>::Own::Own(std::span<const std::uint32_t>, std::size_t, std::size_t); \
    template void ParticleModel<D>::take(std::shared_ptr<External<D>>);                            \
    template void ParticleModel<D>::refuse_parts();
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
