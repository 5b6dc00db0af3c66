// SPDX-License-Identifier: GPL-3.0-or-later
// What a model remembers beside y, and how it passes to other particles.
#include <spam/neighbors/neighbourhood.hpp>
#include <spam/rhs/particle_model.hpp>

#include <algorithm>
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

template <int Dim>
void ParticleModel<Dim>::take_over(const Model<Dim>& before, std::span<const double> was,
                                   const Change<Dim>& change, std::span<const double> y) {
    const Terms& others = dynamic_cast<const ParticleModel&>(before).terms_;
    const ConstState<Dim> from(before.layout(), was), to(this->layout(), y);
    for (std::size_t n = 0; n < terms_.size(); ++n) {
        const Selection<Dim>&now = terms_[n]->among(), &then = others[n]->among();
        terms_[n]->take_over(*others[n], then.of(from),
                             change.among(now.first(), now.count(), then.first(), then.count()),
                             now.of(to));
    }
}

#define SPAM_INSTANTIATE(D)                                                                       \
    template void ParticleModel<D>::remember(Memory<D>&);                                         \
    template std::vector<Mat<D>> ParticleModel<D>::deformation_gradients(std::span<const double>) \
        const;                                                                                    \
    template void ParticleModel<D>::take_over(const Model<D>&, std::span<const double>,           \
                                              const Change<D>&, std::span<const double>);
SPAM_INSTANTIATE(1)
SPAM_INSTANTIATE(2)
SPAM_INSTANTIATE(3)
#undef SPAM_INSTANTIATE

}  // namespace spam
