// SPDX-License-Identifier: GPL-3.0-or-later
#include "../core/levels.hpp"
#include "carried_energy.hpp"
#include "gauss_forces.hpp"
#include "packed_particles.hpp"
#include "sweeps.hpp"
#include "torque_factors.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/sums.hpp>
#include <spam/kernel/any_weight.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/physics/closest_approach.hpp>
#include <spam/physics/record.hpp>
#include <spam/rhs/smooth_particle_model.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace spam {
namespace {

Scheme validated(const Scheme& scheme, int dim) {
    scheme.validate(dim);
    return scheme;
}

std::vector<Field> fields_of(const Scheme& scheme) {
    std::vector<Field> fields{Field::position, Field::velocity, Field::stress, Field::energy};
    if (scheme.density != Density::summed) fields.push_back(Field::density);
    return fields;
}

/// The material as the sweep calls it.
template <int Dim>
struct StressRates {
    const Material<Dim>& material;
    ConstState<Dim> state;
    State<Dim> rate;

    static void call(const void* context, const std::uint32_t* particle, std::size_t count,
                     const Mat<Dim>* grad_v) {
        const auto& self = *static_cast<const StressRates*>(context);
        self.material.stress_rates({particle, count}, {grad_v, count}, self.state, self.rate);
    }
};

template <int Dim>
Sweeps<Dim> best_sweeps(const Scheme& scheme) {
    return at_level(instruction_set(), [&](auto level) {
        Sweeps<Dim> sweeps = sweeps_of<Dim, level>(scheme);
        sweeps.pack = pack_for<Dim, level>();
        return sweeps;
    });
}

}  // namespace

template <int Dim>
SmoothParticleModel<Dim>::~SmoothParticleModel() = default;

template <int Dim>
SmoothParticleModel<Dim>::SmoothParticleModel(Particles<Dim> particles,
                                              const Material<Dim>& material, const Scheme& scheme,
                                              const Box<Dim>& box)
    : ParticleModel<Dim>(std::move(particles), box, fields_of(validated(scheme, Dim))),
      material_(material),
      scheme_(scheme),
      sweeps_(std::make_unique<const Sweeps<Dim>>(best_sweeps<Dim>(scheme))),
      packed_(packed_with(ListUse::again_and_again)) {
    valid_range<Dim>(scheme.range, this->particles().spacing, this->particles().size());
    if (scheme.closest_approach > 0.0 && scheme.closest_approach < 1e-3 * this->particles().spacing)
        throw InputError(
            fmt::format("closest-approach: {} must be 0 (none) or at least a thousandth of the "
                        "particle spacing "
                        "{}; 0.5 to 0.9 spacings are usual",
                        scheme.closest_approach, this->particles().spacing));
    if (scheme.closest_approach >= this->particles().spacing)
        throw InputError(fmt::format(
            "closest-approach: {} must be below the particle spacing {}: particles that are "
            "nearer from the start are not reflected; 0.5 to 0.9 spacings are usual",
            scheme.closest_approach, this->particles().spacing));
    const std::size_t n = this->particles().size();
    if (sweeps_->density != nullptr) summed_density_.resize(n);
    const AngularMomentum law = scheme.angular_momentum;
    if (law == AngularMomentum::gauss) {
        if (box.periodic())
            throw InputError(
                "angular-momentum: gauss turns bodies about their centres, which a periodic box "
                "does "
                "not have; use torque_pair, or a box without periods");
        gauss_ = std::make_unique<GaussForces>();
    } else if (law != AngularMomentum::free) {
        torques_ = std::make_unique<TorqueFactors>(n, law);
    }
    viscosity_ = viscosity();
    set_bodies(this->particles().body);
}

template <int Dim>
void SmoothParticleModel<Dim>::set_bodies(std::vector<std::int32_t> bodies) {
    Model<Dim>::set_bodies(std::move(bodies));
    group_ = this->particles().body;
    if (scheme_.balance == Balance::global) group_.assign(group_.size(), 0);
    group_count_ = 1;
    for (const std::int32_t g : group_)
        group_count_ = std::max(group_count_, static_cast<std::size_t>(g) + 1);
}

template <int Dim>
Groups SmoothParticleModel<Dim>::groups() const {
    return {this->particles().mass, group_, group_count_};
}

/// The sound speed is that of the body at rest, at its mean density. Neighbours that move against each
/// other, v_ij = 2 v_i, lose their velocity at the rate (2/D) (alpha c l/rho) sum m |w'|/r in the mean
/// over directions, by half of the pairs: those that approach.
template <int Dim>
ViscosityConstants SmoothParticleModel<Dim>::viscosity() {
    if (!(scheme_.viscosity > 0.0)) return {};
    const PairList<Dim> list(this->particles().reference_position, scheme_.range, this->box());
    double rho = 0.0, slope = 0.0;
    const auto weight = weight_function<Dim>(to_string(scheme_.kernel), scheme_.range);
    const auto& x = this->particles().reference_position;
    for (std::size_t i = 0; i < list.size(); ++i)
        for (const std::uint32_t j : list.neighbours(i)) {
            double r2 = 0.0;
            for (int a = 0; a < Dim; ++a) {
                const double s = this->box().nearest_image(
                    a, this->box().wrap(a, x(a, static_cast<Eigen::Index>(i))) -
                           this->box().wrap(a, x(a, j)));
                r2 += s * s;
            }
            const double m = this->particles().mass[j], r = std::sqrt(r2);
            rho += m * weight.value(r);
            if (i != j) slope += m * weight.minus_slope_over_r(r);
        }
    const auto c = material_.sound_speed(rho / static_cast<double>(list.size()));
    if (!c)
        throw InputError(fmt::format(
            "viscosity: {} needs a sound speed, and the material ({}) has none; give it a "
            "sound_speed(density), or leave --viscosity out",
            scheme_.viscosity, material_.describe()));
    const double length = 0.5 * scheme_.range;
    viscous_damping_ = scheme_.viscosity * *c * length / Dim * slope / rho;
    return {scheme_.viscosity, *c, length};
}

/// The order that the physics forces: pairs - density if summed - A - everything that needs one
/// sweep - constitutive law - torque balance per body - what needs u or the balance.
template <int Dim>
void SmoothParticleModel<Dim>::pair_rates(double, std::span<const double> y,
                                          std::span<double> y_dot) {
    this->failure_.clear();
    if (!load(y, y_dot)) return;
    const State<Dim> rate(this->layout(), y_dot);
    SweepInput<Dim> in = packed_->input();
    in.constants = {scheme_.mean_density, viscosity_};
    SweepOutput<Dim> out;
    out.x_dot = rate.position().data();
    out.v_dot = rate.velocity().data();
    out.e_dot = rate.energy().data();
    if (torques_) {
        out.positive_torque = torques_->positive();
        out.negative_torque = torques_->negative();
    }
    if (rate.has(Field::density)) out.rho_dot = rate.density().data();
    const StressRates<Dim> stress_rates{material_, {this->layout(), y}, rate};
    out.context = &stress_rates;
    out.stress_rates = StressRates<Dim>::call;
    sweeps_->first(in, out);

    const ConstState<Dim> state(this->layout(), y);
    const double* const v = state.velocity().data();
    if (torques_) torques_->balance(groups(), out.x_dot, v);
    if (sweeps_->second != nullptr) {
        load_transport({out.x_dot, this->particles().size() * Dim});
        if (scheme_.density != Density::chain_rule) out.rho_dot = nullptr;
        sweeps_->second(in, out);
    }
    if (gauss_) gauss_->constrain(groups(), state.position().data(), out.x_dot, v, out.v_dot);
}

template <int Dim>
std::unique_ptr<PackedParticles<Dim>> SmoothParticleModel<Dim>::packed_with(ListUse use) const {
    const int numbers =
        sweeps_->second != nullptr ? TransportRecord<Dim>::numbers : Record<Dim>::numbers;
    return std::make_unique<PackedParticles<Dim>>(GeneralWeight<Dim>(scheme_.kernel, scheme_.range),
                                                  use, this->box(), sweeps_->width,
                                                  static_cast<std::size_t>(numbers), sweeps_->pack);
}

template <int Dim>
PackedFields SmoothParticleModel<Dim>::fields(std::span<const double> y) const {
    const ConstState<Dim> state(this->layout(), y);
    return {
        state.position().data(),       state.velocity().data(),
        this->particles().mass.data(), state.has(Field::density) ? state.density().data() : nullptr,
        state.stress().data(),         scheme_.mean_density};
}

/// List and records for this state.
template <int Dim>
bool SmoothParticleModel<Dim>::load(std::span<const double> y, std::span<double> y_dot) {
    const std::size_t n = this->particles().size();
    PackedFields given = fields(y);
    if (!packed_->follow(n, given)) {
        this->fail(y_dot, "a position is not finite");
        return false;
    }
    if (packed_->invalid_densities() > 0) return fail_density({given.rho, n}, y_dot);
    if (sweeps_->density == nullptr) return true;

    SweepOutput<Dim> out;
    out.rho = summed_density_.data();
    sweeps_->density(packed_->input(), out);
    given.rho = summed_density_.data();
    packed_->load_density(given);
    return packed_->invalid_densities() == 0 || fail_density(summed_density_, y_dot);
}

/// Names the first density that has no meaning. Returns false.
template <int Dim>
bool SmoothParticleModel<Dim>::fail_density(std::span<const double> rho, std::span<double> y_dot) {
    const auto bad = std::find_if(rho.begin(), rho.end(), [](double r) { return !(r > 0.0); });
    const auto number = static_cast<std::size_t>(std::distance(rho.begin(), bad));
    this->fail(y_dot, fmt::format("density {} of particle {} is not positive", *bad,
                                  this->particles().id[number]));
    return false;
}

/// What the second sweep reads beyond the first.
template <int Dim>
void SmoothParticleModel<Dim>::load_transport(std::span<const double> u) {
    constexpr auto d = static_cast<std::size_t>(Dim);
    const auto order = packed_->list().order();
    parallel_for(order.size(), [&](std::size_t slot) {
        const std::size_t i = order[slot];
        double* number = packed_->record(slot) + TransportRecord<Dim>::first;
        for (std::size_t a = 0; a < d; ++a) *number++ = u[i * d + a];
        const TorqueScale s = torques_ ? torques_->of(i, group_[i]) : TorqueScale{};
        *number++ = s.negative;
        *number++ = s.positive;
    });
}

template <int Dim>
std::span<const TorqueScale> SmoothParticleModel<Dim>::torque_scales() const {
    return torques_ ? torques_->scales() : std::span<const TorqueScale>{};
}

/// At the start it counts as singular: a body that rotates rigidly has no need of the constraint.
template <int Dim>
std::vector<Remark> SmoothParticleModel<Dim>::watch(double t, std::span<const double> y) {
    if (!gauss_) return {};
    watched_rates_.resize(y.size());
    this->rates(t, y, watched_rates_);
    const bool works = !gauss_->singular();
    if (works == std::exchange(gauss_works_, works)) return {};
    if (works) return {{"gauss constraint works", gauss_->health()}};
    return {{"gauss constraint singular", gauss_->health(),
             scheme_.gauss_singular == GaussSingular::stop}};
}

template <int Dim>
void SmoothParticleModel<Dim>::remember(Archive& archive) {
    Model<Dim>::remember(archive);
    archive(gauss_works_);
    if (archive.reading()) packed_ = packed_with(ListUse::again_and_again);
}

template <int Dim>
double SmoothParticleModel<Dim>::pair_energy(std::span<const double> y) const {
    return carried_energy(*this, y);
}

/// For observers: its own list, so that the one of the right-hand side stays as it is.
template <int Dim>
std::vector<double> SmoothParticleModel<Dim>::pair_density(std::span<const double> y) const {
    if (sweeps_->density == nullptr) return Model<Dim>::density(y);
    return packed_with(ListUse::once)
        ->summed_density(sweeps_->density, this->particles().size(), fields(y));
}

template <int Dim>
std::vector<Event> SmoothParticleModel<Dim>::pair_events() const {
    if (scheme_.closest_approach == 0.0) return {};
    return {
        closest_approach_event<Dim>({this->particles().mass, this->box(), scheme_.closest_approach,
                                     scheme_.transport == Transport::plain},
                                    this->layout())};
}

template <int Dim>
std::size_t SmoothParticleModel<Dim>::pairs() const {
    return packed_->list().pairs();
}
template <int Dim>
std::size_t SmoothParticleModel<Dim>::list_builds() const {
    return packed_->list().builds();
}

template <int Dim>
std::string SmoothParticleModel<Dim>::pair_description() const {
    return fmt::format("smooth particles, {}: {}", material_.describe(), scheme_.describe());
}

template class SmoothParticleModel<1>;
template class SmoothParticleModel<2>;
template class SmoothParticleModel<3>;

}  // namespace spam
