// SPDX-License-Identifier: GPL-3.0-or-later
#include "carried_energy.hpp"
#include "constitution.hpp"
#include "gauss_forces.hpp"
#include "torque_factors_in_space.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/parts.hpp>
#include <spam/physics/closest_approach.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace spam {
namespace {

constexpr FieldKind works_kind{"gauss_works", Rank::scalar, Role::memory, "1"};

Scheme validated(const Scheme& scheme, int dim) {
    scheme.validate(dim);
    return scheme;
}

template <int Dim>
Sweeps<Dim> sweeps_of(const Scheme& scheme, const Constitution<Dim>& materials) {
    const Matter matter = materials.matter(scheme);
    auto sweeps =
        best_sweeps([&](auto level) { return smooth_particle_sweeps<Dim, level>(scheme, matter); });
    sweeps.numbers = std::max(sweeps.numbers, materials.numbers(scheme));
    return sweeps;
}

}  // namespace

template <int Dim>
SmoothParticles<Dim>::~SmoothParticles() = default;

template <int Dim>
SmoothParticles<Dim>::SmoothParticles(const Selection<Dim>& among,
                                      std::vector<Material<Dim>> solids, const Scheme& scheme)
    : SmoothParticles(among, solid_constitution<Dim>(among.particles(), std::move(solids)),
                      scheme) {}

template <int Dim>
SmoothParticles<Dim>::SmoothParticles(const Selection<Dim>& among, std::vector<Fluid> fluids,
                                      const Scheme& scheme)
    : SmoothParticles(
          among, std::make_unique<FluidConstitution<Dim>>(among.particles(), std::move(fluids)),
          scheme) {}

template <int Dim>
SmoothParticles<Dim>::SmoothParticles(const Selection<Dim>& among,
                                      std::unique_ptr<Constitution<Dim>> constitution,
                                      const Scheme& scheme)
    : Term<Dim>(among),
      constitution_(std::move(constitution)),
      scheme_(validated(scheme, Dim)),
      sweeps_(std::make_unique<const Sweeps<Dim>>(sweeps_of<Dim>(scheme, *constitution_))),
      packed_(
          std::make_unique<PackedParticles<Dim>>(GeneralWeight<Dim>(scheme_.kernel, scheme_.range),
                                                 ListUse::again_and_again, this->box(), *sweeps_)) {
    this->look_after(*packed_);
    const std::size_t n = this->particles().size();
    valid_range<Dim>(scheme.range, this->particles().spacing, n);
    scheme.validate_distances(this->particles().spacing);
    check_materials(this->particles(), constitution_->materials());
    constitution_->take(scheme);
    if (sweeps_->density != nullptr) summed_density_.resize(n);
    const AngularMomentum law = scheme.angular_momentum;
    if (law == AngularMomentum::gauss) {
        if (this->box().periodic())
            throw InputError(
                "angular-momentum: gauss turns bodies about their centres, which a periodic box does not have; use "
                "free or torque_pair, or a box without periods");
        gauss_ = std::make_unique<GaussForces<Dim>>();
    } else if (law != AngularMomentum::free) {
        torques_ = std::make_unique<TorqueFactors<Dim>>(n, scheme);
        if (sweeps_->gradient != nullptr) heat_.resize(n);
    }
    prepare_damping();
    set_bodies();
    set_nature();
}

template <int Dim>
void SmoothParticles<Dim>::set_nature() {
    auto& nature = this->nature_;
    nature.description = fmt::format("{}: {}", constitution_->describe(), scheme_.describe());
    nature.fields = constitution_->fields();
    if (scheme_.density != Density::summed) nature.fields.push_back(Field::density);
    nature.moves = true;
    nature.moves_with_velocity = scheme_.transport == Transport::plain;
    nature.potential = false;
    nature.sums_density = true;
    nature.conducts = constitution_->conducts();
    // Torques of particles jump where one changes its sign, and in space turn quickly where one passes near 0; Gauss'
    // principle sets in and out.
    nature.smooth = scheme_.angular_momentum != AngularMomentum::torque_particle &&
                    scheme_.angular_momentum != AngularMomentum::gauss && constitution_->smooth();
    // In space a fluid's pressures act along r_ij; everything else does not, unless it is balanced.
    nature.promises = scheme_.promises(Dim);
    if (constitution_->central(scheme_))
        nature.promises.angular_momentum = Promise::integrator_error;
    nature.reach = scheme_.range;
    // Torques are balanced among particles, and reflections are of pairs of them, without images.
    if (scheme_.angular_momentum != AngularMomentum::free)
        nature.no_images =
            "walls give angular momentum, which the scheme would take back; use "
            "--angular-momentum free";
    else if (scheme_.closest_approach > 0.0)
        nature.no_images =
            "the closest approach is of pairs of particles and lets them come nearer to a "
            "wall; leave --closest-approach out";
    nature.no_rezoning = constitution_->why_not_rezoned(scheme_);
    if (scheme_.closest_approach > 0.0)
        nature.events = [this](const std::vector<bool>& held) {
            return std::vector<Event>{closest_approach_event<Dim>(
                {this->particles().mass, this->box(), scheme_.closest_approach,
                 scheme_.transport == Transport::plain},
                this->layout(), held, this->among().first())};
        };
}

template <int Dim>
void SmoothParticles<Dim>::set_bodies() {
    group_ = this->particles().body;
    if (scheme_.balance == Balance::global) group_.assign(group_.size(), 0);
    group_count_ = 1;
    for (const std::int32_t g : group_)
        group_count_ = std::max(group_count_, static_cast<std::size_t>(g) + 1);
    group_count_ = static_cast<std::size_t>(Parts::here().most(static_cast<double>(group_count_)));
}

template <int Dim>
Groups SmoothParticles<Dim>::groups() const {
    return {this->particles().mass, group_, group_count_};
}

/// The order that the physics forces: pairs - density if summed - A - everything that needs one sweep
/// and the constitutive law - torque balance per body - what needs u or the balance - friction by pairs.
template <int Dim>
std::string SmoothParticles<Dim>::rates(const Now& now) {
    if (auto reason = load(now); !reason.empty()) return reason;
    SweepInput<Dim> in = packed_->input();
    in.constants.mean_density = scheme_.mean_density;
    in.constants.viscosity = viscosity_;
    in.constants.shifting = shifting_;
    constitution_->set_constants(in.constants);
    const std::span<const double> rho =
        sweeps_->density != nullptr
            ? std::span<const double>(summed_density_)
            : std::span<const double>(now.state.find(Field::density), this->particles().size());
    if (auto reason = constitution_->prepare(now, rho, in, *sweeps_, *packed_); !reason.empty())
        return reason;
    SweepOutput<Dim> out;
    out.x_dot = now.rate.position().data();
    out.v_dot = now.v_dot;
    out.e_dot = now.rate.energy().data();
    out.rho_dot = now.rate.find(Field::density);
    constitution_->close_forces(now, out);
    if (torques_) {
        balance(now, in, out);
    } else {
        sweeps_->force(in, out);
        sweep_walls(*packed_, in, sweeps_->force);
        if (sweeps_->second != nullptr) {
            load_transport(now);
            if (scheme_.density != Density::chain_rule) out.rho_dot = nullptr;
            out.close = nullptr;
            sweeps_->second(in, out);
            sweep_walls(*packed_, in, sweeps_->second);
        }
    }
    constitution_->add_forces(rho, in, out, *packed_);
    if (gauss_)
        gauss_->constrain(groups(), now.state.position().data(), out.x_dot,
                          now.state.velocity().data(), out.v_dot);
    return {};
}

/// The first sweep finds torques and the heat conducted, the last one forces and their work. One is enough
/// where all pairs have one R. In space there are more between them: Newton's method for the factors of pairs starts
/// from 1 at every state, or rates would depend on those before.
template <int Dim>
void SmoothParticles<Dim>::balance(const Now& now, const SweepInput<Dim>& in,
                                   SweepOutput<Dim>& out) {
    SweepOutput<Dim> first = out;
    torques_->take_sums(first);
    std::fill(heat_.begin(), heat_.end(), 0.0);
    first.e_dot = heat_.empty() ? nullptr : heat_.data();
    const double* const v = now.state.velocity().data();
    if constexpr (Dim == 2)
        if (sweeps_->one_balance != nullptr && group_count_ == 1) {
            first.torque_parts = torques_->parts();
            first.e_dot = out.e_dot;
            sweeps_->one_balance(in, first);
            torques_->balance(groups(), out.x_dot, v);
            return torques_->add_parts(out.v_dot, out.e_dot);
        }
    sweeps_->force(in, first);
    torques_->balance(groups(), out.x_dot, v);
    load_transport(now);
    while (torques_->wants_sums()) {
        SweepOutput<Dim> torques;
        torques_->take_sums(torques);
        sweeps_->torques(in, torques);
        torques_->go_on(groups());
        load_transport(now);
    }
    if (scheme_.density != Density::chain_rule) out.rho_dot = nullptr;
    out.close = nullptr;
    sweeps_->second(in, out);
    double* const e_dot = out.e_dot;
    if (!heat_.empty()) parallel_for(heat_.size(), [&](std::size_t i) { e_dot[i] += heat_[i]; });
}

template <int Dim>
PackedFields SmoothParticles<Dim>::fields_of(const ConstState<Dim>& state) const {
    return {state.position().data(),    state.velocity().data(),      this->particles().mass.data(),
            state.find(Field::density), constitution_->stress(state), scheme_.mean_density};
}

/// List and records for this state. Returns why it has no meaning.
template <int Dim>
std::string SmoothParticles<Dim>::load(const Now& now) {
    const std::size_t n = this->particles().size();
    PackedFields given = fields_of(now.state);
    given.sigma = constitution_->returned_stress(now);
    if (!packed_->follow(n, given)) return "a position is not finite";
    if (packed_->invalid_densities() > 0) return complaint({given.rho, n});
    if (sweeps_->density == nullptr) return {};
    SweepOutput<Dim> out;
    out.rho = summed_density_.data();
    sweeps_->density(packed_->input(), out);
    given.rho = summed_density_.data();
    packed_->load_density(given);
    return packed_->invalid_densities() == 0 ? std::string() : complaint(summed_density_);
}

/// Names the first density that has no meaning.
template <int Dim>
std::string SmoothParticles<Dim>::complaint(std::span<const double> rho) const {
    const auto bad = std::find_if(rho.begin(), rho.end(), [](double r) { return !(r > 0.0); });
    const auto number = static_cast<std::size_t>(std::distance(rho.begin(), bad));
    return fmt::format("density {} of particle {} is not positive", *bad,
                       this->particles().id[number]);
}

/// What the second sweep reads beyond the first.
template <int Dim>
void SmoothParticles<Dim>::load_transport(const Now& now) {
    using R = BalancedRecord<Dim>;
    constexpr auto d = static_cast<std::size_t>(Dim);
    const double* const u = now.rate.position().data();
    const bool sound = sweeps_->gradient != nullptr && scheme_.viscosity > 0.0;
    constexpr int from = R::template at<column::Transport>;
    static_assert(R::template at<column::NegativeFactor> == from + Dim &&
                  R::template at<column::PositiveFactor> == from + Dim + 1 &&
                  R::template at<column::SoundSpeed> == from + Dim + 2 &&
                  R::template at<column::TorqueMultiplier> == from + Dim + 3);
    const bool balanced_in_space = Dim == 3 && torques_ != nullptr;
    const int count = balanced_in_space ? Dim + 3 + Dim : Dim + 3;
    packed_->template write<R>(from, count, [&](std::size_t i, double* number) {
        std::copy_n(u + i * d, d, number);
        number[d] = number[d + 1] = 1.0;
        if (torques_) torques_->write(i, group_[i], number + d);
        if (sound)
            number[d + 2] = constitution_->sound_speed_of(i);
        else if (balanced_in_space)  // these records have the column, needed or not
            number[d + 2] = viscosity_.sound_speed;
    });
}

template <int Dim>
std::span<const TorqueScale> SmoothParticles<Dim>::torque_scales() const {
    return torques_ ? torques_->scales() : std::span<const TorqueScale>{};
}

template <int Dim>
TorqueSearch SmoothParticles<Dim>::torque_search() const {
    return torques_ ? torques_->search() : TorqueSearch{};
}

/// At the start it counts as singular: a body that rotates rigidly has no need of the constraint.
template <int Dim>
std::vector<Remark> SmoothParticles<Dim>::watch(double t, std::span<const double> y) {
    const bool may_fail =
        Dim == 3 && torques_ != nullptr && scheme_.transport == Transport::average;
    if (!gauss_ && !may_fail) return {};
    watched_rates_.resize(y.size());
    this->model().rates(t, y, watched_rates_);
    if (may_fail) {
        const double left = torques_->search().residual;
        const bool fails = left > 1e-12;
        if (fails == std::exchange(torques_fail_, fails)) return {};
        return {{fails ? "torques not balanced" : "torques balanced", left}};
    }
    const bool works = !gauss_->singular();
    if (works == std::exchange(gauss_works_, works)) return {};
    if (works) return {{"gauss constraint works", gauss_->health()}};
    return {{"gauss constraint singular", gauss_->health(),
             scheme_.gauss_singular == GaussSingular::stop}};
}

template <int Dim>
void SmoothParticles<Dim>::remember(Memory<Dim>& memory) {
    memory.run(works_kind, gauss_works_, torques_fail_);
    if (torques_) torques_->remember(memory);
}

template <int Dim>
bool SmoothParticles<Dim>::settle(double t, const State<Dim>& state) {
    return constitution_->settle(t, state);
}

template <int Dim>
auto SmoothParticles<Dim>::answer(Ask what, std::span<const double> y) const -> Answer {
    if (what == Ask::damping) return {fastest_damping_in(y)};  // also of no state
    const ConstState<Dim> state = this->state_of(y);
    switch (what) {
        case Ask::energy:
            return {carried_energy(this->particles(), state)};
        case Ask::density:
            if (sweeps_->density == nullptr) return {};
            return {0.0, summed_density(fields_of(state))};
        case Ask::neighbour_forces:
            return {(carried_energies(this->particles(), state) +
                     constitution_->stress_forces(state, this->densities(y))) /
                    this->particles().spacing};
        case Ask::damping:
        case Ask::deformation:
            break;
    }
    return {};
}

/// For observers: its own list, so that the one of the right-hand side stays as it is.
template <int Dim>
std::vector<double> SmoothParticles<Dim>::summed_density(const PackedFields& fields) const {
    return packed_->for_observer().summed_density(sweeps_->density, this->particles().size(),
                                                  fields);
}

SPAM_COMPILED(template class SmoothParticles);

}  // namespace spam
