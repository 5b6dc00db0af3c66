// SPDX-License-Identifier: GPL-3.0-or-later
#include "../core/levels.hpp"
#include "sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/sums.hpp>
#include <spam/physics/record.hpp>
#include <spam/physics/torque_balance.hpp>
#include <spam/rhs/smooth_particle_model.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {
namespace {

/// The list looks a little beyond the range, so that it lasts several steps; 0.075 h costs about a
/// tenth more lanes. A tight periodic box leaves less.
template <int Dim>
double list_skin(double range, const Box<Dim>& box) {
    double skin = 0.075 * range;
    for (int a = 0; a < Dim; ++a)
        if (box.periodic(a) && box.length(a) > 2.0 * range)
            skin = std::min(skin, 0.49 * (box.length(a) - 2.0 * range));
    return skin;
}

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
void wrap(const Box<Dim>& box, double* x) {
    for (int a = 0; a < Dim; ++a)
        if (box.periodic(a)) x[a] = box.wrap(a, x[a]);
}

template <int Dim>
Sweeps<Dim> best_sweeps(const Scheme& scheme) {
    return at_level(instruction_set(), [&](auto level) { return sweeps_of<Dim, level>(scheme); });
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
      list_(scheme.range, list_skin(scheme.range, box), box, sweeps_->width),
      stride_(static_cast<std::size_t>(sweeps_->second != nullptr ? TransportRecord<Dim>::numbers
                                                                  : Record<Dim>::numbers)) {
    const double spacing = this->particles().spacing;
    if (!(scheme.range > spacing) || !(scheme.range < 1e6 * spacing))
        throw InputError(
            fmt::format("range: {} must lie above the particle spacing {} (else no particle has a "
                        "neighbour) and "
                        "below 1e6 spacings; 2 to 4 spacings are usual",
                        scheme.range, spacing));
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
    std::span<const double> rho = summed_density_;
    if (sweeps_->density != nullptr)
        sum_density(list_, records_, summed_density_);
    else
        rho = {ConstState<Dim>(this->layout(), y).density().data(), this->particles().size()};
    if (!pack_density(y, rho, y_dot)) return;

    const State<Dim> rate(this->layout(), y_dot);
    const SweepInput<Dim> in{list_.view(), {records_.data(), stride_}, scheme_.range, &this->box()};
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

/// The list for these positions, and the records in its order.
template <int Dim>
bool SmoothParticleModel<Dim>::load(std::span<const double> y, std::span<double> y_dot) {
    const auto x = ConstState<Dim>(this->layout(), y).position();
    const bool fits = list_.size() == this->particles().size();
    if (!fits || !pack(y, list_, records_)) {
        if (!list_.serves(x)) {
            if (!x.allFinite()) {
                this->fail(y_dot, "a position is not finite");
                return false;
            }
            list_.build(x);
            records_.resize(list_.order().size() * stride_);
            pack(y, list_, records_);
        }
    }
    return true;
}

/// x, v and m by slot. Returns whether no particle has gone too far for the list.
template <int Dim>
bool SmoothParticleModel<Dim>::pack(std::span<const double> y, const ClusterList<Dim>& list,
                                    std::span<double> records) const {
    constexpr auto d = static_cast<std::size_t>(Dim);
    const ConstState<Dim> state(this->layout(), y);
    const double* const x = state.position().data();
    const double* const v = state.velocity().data();
    const double* const m = this->particles().mass.data();
    const Box<Dim>& box = this->box();
    const bool wraps = box.periodic();
    const auto far = list.displacement();
    const auto order = list.order();
    const std::size_t gone = parallel_count(order.size(), [&](std::size_t slot) {
        const std::size_t i = order[slot];
        double* const record = &records[slot * stride_];
        for (std::size_t a = 0; a < d; ++a) record[a] = x[i * d + a];
        for (std::size_t a = 0; a < d; ++a) record[d + a] = v[i * d + a];
        record[2 * d] = m[i];
        if (wraps) wrap(box, record);
        return far(i, x);
    });
    return gone == 0;
}

/// The rest of the records, which depends on the density. Fails where that has no meaning.
template <int Dim>
bool SmoothParticleModel<Dim>::pack_density(std::span<const double> y, std::span<const double> rho,
                                            std::span<double> y_dot) {
    constexpr std::size_t first = 2 * Dim + 1;
    constexpr auto n = static_cast<std::size_t>(symmetric_size(Dim));
    const double* const sigma = ConstState<Dim>(this->layout(), y).stress().data();
    const auto order = list_.order();
    const std::size_t wrong = parallel_count(order.size(), [&](std::size_t slot) {
        const std::size_t i = order[slot];
        double* const record = &records_[slot * stride_ + first];
        const double density = rho[i], scale = 1.0 / (density * density);
        record[0] = density;
        for (std::size_t k = 0; k < n; ++k) record[1 + k] = scale * sigma[i * n + k];
        return static_cast<std::size_t>(!(density > 0.0));
    });
    if (wrong == 0) return true;
    const auto bad = std::find_if(rho.begin(), rho.end(), [](double r) { return !(r > 0.0); });
    const auto number = static_cast<std::size_t>(std::distance(rho.begin(), bad));
    this->fail(y_dot, fmt::format("density {} of particle {} is not positive", *bad,
                                  this->particles().id[number]));
    return false;
}

template <int Dim>
void SmoothParticleModel<Dim>::sum_density(const ClusterList<Dim>& list,
                                           std::span<const double> records,
                                           std::span<double> rho) const {
    SweepOutput<Dim> out;
    out.rho = rho.data();
    sweeps_->density({list.view(), {records.data(), stride_}, scheme_.range, &this->box()}, out);
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
    const auto order = list_.order();
    parallel_for(order.size(), [&](std::size_t slot) {
        const std::size_t i = order[slot];
        double* number = &records_[slot * stride_ + TransportRecord<Dim>::first];
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
    ClusterList<Dim> list(scheme_.range, 0.0, this->box(), sweeps_->width);
    list.build(ConstState<Dim>(this->layout(), y).position());
    std::vector<double> records(list.order().size() * stride_), rho(list.size());
    pack(y, list, records);
    sum_density(list, records, rho);
    return rho;
}

template <int Dim>
std::string SmoothParticleModel<Dim>::describe() const {
    return fmt::format("smooth particles, {}: {}", material_.describe(), scheme_.describe());
}

template class SmoothParticleModel<1>;
template class SmoothParticleModel<2>;
template class SmoothParticleModel<3>;

}  // namespace spam
