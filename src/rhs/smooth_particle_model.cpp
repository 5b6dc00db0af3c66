// SPDX-License-Identifier: GPL-3.0-or-later
#include "../core/levels.hpp"
#include "packed_particles.hpp"
#include "sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/sums.hpp>
#include <spam/physics/closest_approach.hpp>
#include <spam/physics/record.hpp>
#include <spam/physics/torque_balance.hpp>
#include <spam/rhs/smooth_particle_model.hpp>

#include <fmt/format.h>

#include <algorithm>

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
    : Model<Dim>(std::move(particles), box, fields_of(validated(scheme, Dim))),
      material_(material),
      scheme_(scheme),
      sweeps_(std::make_unique<const Sweeps<Dim>>(best_sweeps<Dim>(scheme))),
      packed_(packed_with(ListUse::again_and_again)) {
    valid_range(scheme.range, this->particles().spacing);
    if (scheme.closest_approach >= this->particles().spacing)
        throw InputError(fmt::format(
            "closest-approach: {} must be below the particle spacing {}: particles that are "
            "nearer from the start are not reflected; 0.5 to 0.9 spacings are usual",
            scheme.closest_approach, this->particles().spacing));
    const std::size_t n = this->particles().size();
    if (sweeps_->density != nullptr) summed_density_.resize(n);
    torque_factor_.assign(static_cast<std::size_t>(this->particles().bodies()), 1.0);
    if (scheme_.angular_momentum == AngularMomentum::torque_pair) {
        positive_torque_.resize(n);
        negative_torque_.resize(n);
        body_sums_.resize(torque_factor_.size());
    }
}

/// The order that the physics forces: pairs - density if summed - A - everything that needs one
/// sweep - constitutive law - torque balance per body - what needs u or the balance.
template <int Dim>
void SmoothParticleModel<Dim>::rates(double, std::span<const double> y, std::span<double> y_dot) {
    this->failure_.clear();
    if (!load(y, y_dot)) return;
    const State<Dim> rate(this->layout(), y_dot);
    const SweepInput<Dim> in = packed_->input();
    SweepOutput<Dim> out;
    out.x_dot = rate.position().data();
    out.v_dot = rate.velocity().data();
    out.e_dot = rate.energy().data();
    out.positive_torque = positive_torque_.data();
    out.negative_torque = negative_torque_.data();
    if (rate.has(Field::density)) out.rho_dot = rate.density().data();
    const StressRates<Dim> stress_rates{material_, {this->layout(), y}, rate};
    out.context = &stress_rates;
    out.stress_rates = StressRates<Dim>::call;
    sweeps_->first(in, out);
    if (sweeps_->second == nullptr) return;

    const std::span<const double> u(out.x_dot, this->particles().size() * Dim);
    if (scheme_.angular_momentum == AngularMomentum::torque_pair) balance_torques(y, u);
    load_transport(u);
    sweeps_->second(in, out);
}

template <int Dim>
std::unique_ptr<PackedParticles<Dim>> SmoothParticleModel<Dim>::packed_with(ListUse use) const {
    const int numbers =
        sweeps_->second != nullptr ? TransportRecord<Dim>::numbers : Record<Dim>::numbers;
    return std::make_unique<PackedParticles<Dim>>(scheme_.range, use, this->box(), sweeps_->width,
                                                  static_cast<std::size_t>(numbers), sweeps_->pack);
}

template <int Dim>
PackedFields SmoothParticleModel<Dim>::fields(std::span<const double> y) const {
    const ConstState<Dim> state(this->layout(), y);
    return {state.position().data(), state.velocity().data(), this->particles().mass.data(),
            state.has(Field::density) ? state.density().data() : nullptr, state.stress().data()};
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

/// R of every body from its own sums, taken in the order of the particles.
template <int Dim>
void SmoothParticleModel<Dim>::balance_torques(std::span<const double> y,
                                               std::span<const double> u) {
    if constexpr (Dim == 2) {
        const auto& particles = this->particles();
        const double* const v = ConstState<Dim>(this->layout(), y).velocity().data();
        std::fill(body_sums_.begin(), body_sums_.end(), BodySums{});
        for (std::size_t i = 0; i < particles.size(); ++i) {
            BodySums& body = body_sums_[static_cast<std::size_t>(particles.body[i])];
            body.P += 0.5 * positive_torque_[i];
            body.M += 0.5 * negative_torque_[i];
            body.X += particles.mass[i] * (u[2 * i] * v[2 * i + 1] - u[2 * i + 1] * v[2 * i]);
        }
        for (std::size_t b = 0; b < body_sums_.size(); ++b)
            torque_factor_[b] = torque_balance(body_sums_[b].P, body_sums_[b].M, body_sums_[b].X);
    }
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
        const double R = torque_factor_[static_cast<std::size_t>(this->particles().body[i])];
        *number++ = R;
        *number++ = 1.0 / R;
    });
}

template <int Dim>
double SmoothParticleModel<Dim>::internal_energy(std::span<const double> y) const {
    const auto e = ConstState<Dim>(this->layout(), y).energy();
    CompensatedSum sum;
    for (Eigen::Index i = 0; i < e.cols(); ++i)
        sum += this->particles().mass[static_cast<std::size_t>(i)] * e(0, i);
    return sum;
}

/// For observers: its own list, so that the one of the right-hand side stays as it is.
template <int Dim>
std::vector<double> SmoothParticleModel<Dim>::density(std::span<const double> y) const {
    if (sweeps_->density == nullptr) return Model<Dim>::density(y);
    return packed_with(ListUse::once)
        ->summed_density(sweeps_->density, this->particles().size(), fields(y));
}

template <int Dim>
std::optional<Event> SmoothParticleModel<Dim>::event() const {
    if (scheme_.closest_approach == 0.0) return std::nullopt;
    return closest_approach_event<Dim>(
        {this->particles().mass, this->box(), scheme_.closest_approach,
         scheme_.transport == Transport::plain},
        this->layout());
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
std::string SmoothParticleModel<Dim>::describe() const {
    return fmt::format("smooth particles, {}: {}", material_.describe(), scheme_.describe());
}

template class SmoothParticleModel<1>;
template class SmoothParticleModel<2>;
template class SmoothParticleModel<3>;

}  // namespace spam
