// SPDX-License-Identifier: GPL-3.0-or-later
#include "../core/levels.hpp"
#include "packed_particles.hpp"
#include "sweeps.hpp"
#include <spam/core/sums.hpp>
#include <spam/kernel/lucy.hpp>
#include <spam/physics/record.hpp>
#include <spam/rhs/pair_potential_model.hpp>

#include <fmt/format.h>

namespace spam {
namespace {

template <int Dim>
Sweeps<Dim> best_sweeps() {
    return at_level(instruction_set(), [](auto level) { return potential_sweeps<Dim, level>(); });
}

template <int Dim>
PackedFields fields(const Model<Dim>& model, std::span<const double> y) {
    const ConstState<Dim> state(model.layout(), y);
    return {state.position().data(), nullptr, model.particles().mass.data()};
}

}  // namespace

template <int Dim>
PairPotentialModel<Dim>::PairPotentialModel(Particles<Dim> particles, double range,
                                            const Box<Dim>& box)
    : ParticleModel<Dim>(std::move(particles), box, {Field::position, Field::velocity}),
      range_(valid_range<Dim>(range, this->particles().spacing, this->particles().size())),
      sweeps_(std::make_unique<const Sweeps<Dim>>(best_sweeps<Dim>())),
      packed_(packed_with(ListUse::again_and_again)) {}

template <int Dim>
PairPotentialModel<Dim>::~PairPotentialModel() = default;

template <int Dim>
std::unique_ptr<PackedParticles<Dim>> PairPotentialModel<Dim>::packed_with(ListUse use) const {
    return std::make_unique<PackedParticles<Dim>>(
        GeneralWeight<Dim>(Kernel::lucy, range_), use, this->box(), sweeps_->width,
        static_cast<std::size_t>(PointRecord<Dim>::numbers), sweeps_->pack);
}

template <int Dim>
void PairPotentialModel<Dim>::pair_rates(double, std::span<const double> y,
                                         std::span<double> y_dot) {
    this->failure_.clear();
    if (!packed_->follow(this->particles().size(), fields(*this, y))) {
        this->fail(y_dot, "a position is not finite");
        return;
    }
    const State<Dim> rate(this->layout(), y_dot);
    rate.position() = ConstState<Dim>(this->layout(), y).velocity();
    SweepOutput<Dim> out;
    out.v_dot = rate.velocity().data();
    sweeps_->first(packed_->input(), out);
}

template <int Dim>
void PairPotentialModel<Dim>::remember(Archive& archive) {
    Model<Dim>::remember(archive);
    if (archive.reading()) packed_ = packed_with(ListUse::again_and_again);
}

/// For observers: its own list, so that the one of the right-hand side stays as it is.
template <int Dim>
std::vector<double> PairPotentialModel<Dim>::pair_density(std::span<const double> y) const {
    return packed_with(ListUse::once)
        ->summed_density(sweeps_->density, this->particles().size(), fields(*this, y));
}

template <int Dim>
double PairPotentialModel<Dim>::pair_energy(std::span<const double> y) const {
    const std::vector<double> rho = pair_density(y);
    const double w_0 = Lucy<Dim>(range_).value(0.0);
    CompensatedSum sum;
    for (std::size_t i = 0; i < rho.size(); ++i) {
        const double m = this->particles().mass[i];
        sum += 0.5 * m * (rho[i] - m * w_0);
    }
    return sum;
}

template <int Dim>
Promises PairPotentialModel<Dim>::pair_promises() const {
    Promises p;
    p.angular_momentum = Promise::integrator_error;
    return this->in_box(p);
}

template <int Dim>
std::string PairPotentialModel<Dim>::pair_description() const {
    return fmt::format("molecular dynamics, Lucy's weight function of range {:g} as pair potential",
                       range_);
}

template <int Dim>
std::size_t PairPotentialModel<Dim>::pairs() const {
    return packed_->list().pairs();
}
template <int Dim>
std::size_t PairPotentialModel<Dim>::list_builds() const {
    return packed_->list().builds();
}

template class PairPotentialModel<1>;
template class PairPotentialModel<2>;
template class PairPotentialModel<3>;

}  // namespace spam
