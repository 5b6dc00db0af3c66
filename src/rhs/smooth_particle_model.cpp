// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/sums.hpp>
#include <spam/kernel/lucy.hpp>
#include <spam/neighbors/sweep.hpp>
#include <spam/physics/continuity.hpp>
#include <spam/physics/density_sum.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/physics/torque_balance.hpp>
#include <spam/physics/transport.hpp>
#include <spam/physics/velocity_gradient.hpp>
#include <spam/rhs/smooth_particle_model.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {
namespace {

/// The list looks a little beyond the range, so that it lasts several steps; 0.1 h costs about a
/// fifth more pairs. A tight periodic box leaves less.
template <int Dim>
double list_skin(double range, const Box<Dim>& box) {
    double skin = 0.1 * range;
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

template <int Dim>
void store(Eigen::Map<Points<Dim>> field, std::size_t i, const Vec<Dim>& value) {
    for (int a = 0; a < Dim; ++a) field(a, static_cast<Eigen::Index>(i)) = value[a];
}

}  // namespace

/// Runtime choices of the scheme turned into the sweeps compiled for them: once per model.
template <int Dim>
struct SmoothParticleModel<Dim>::Choices {
    using M = SmoothParticleModel;
    using Weight = Lucy<Dim>;

    template <class Mean, class Transport>
    static Sweep first(const Scheme& scheme) {
        if constexpr (Dim == 2)
            if (scheme.angular_momentum == AngularMomentum::torque_pair)
                return &M::template first_sweep<Weight, Mean, Transport, TorqueSums>;
        return &M::template first_sweep<Weight, Mean, Transport, StressForce<Dim>>;
    }
    template <class Mean>
    static Sweep first(const Scheme& scheme) {
        switch (scheme.transport) {
            case Transport::plain:
                return first<Mean, PlainTransport<Dim>>(scheme);
            case Transport::average:
                return first<Mean, AverageTransport<Dim>>(scheme);
            case Transport::monaghan:
                break;
        }
        return first<Mean, MonaghanTransport<Dim, Mean>>(scheme);
    }
    static Sweep first_of(const Scheme& scheme) {
        return scheme.mean_density == MeanDensityKind::arithmetic ? first<ArithmeticMean>(scheme)
                                                                  : first<GeometricMean>(scheme);
    }
    static Sweep second_of(const Scheme& scheme) {
        const bool chain_rule = scheme.density == Density::chain_rule;
        if constexpr (Dim == 2)
            if (scheme.angular_momentum == AngularMomentum::torque_pair)
                return chain_rule ? &M::template second_sweep<Weight, ChainRuleContinuity,
                                                              BalancedStressForce>
                                  : &M::template second_sweep<Weight, BalancedStressForce>;
        return chain_rule ? &M::template second_sweep<Weight, ChainRuleContinuity> : nullptr;
    }
};

template <int Dim>
SmoothParticleModel<Dim>::SmoothParticleModel(Particles<Dim> particles,
                                              const Material<Dim>& material, const Scheme& scheme,
                                              const Box<Dim>& box)
    : Model<Dim>(std::move(particles), box, fields_of(validated(scheme, Dim))),
      material_(material),
      scheme_(scheme),
      list_(scheme.range, list_skin(scheme.range, box), box) {
    const double spacing = this->particles().spacing;
    if (!(scheme.range > spacing) || !(scheme.range < 1e6 * spacing))
        throw InputError(
            fmt::format("range: {} must lie above the particle spacing {} (else no particle has a "
                        "neighbour) and "
                        "below 1e6 spacings; 2 to 4 spacings are usual",
                        scheme.range, spacing));
    first_sweep_ = Choices::first_of(scheme_);
    second_sweep_ = Choices::second_of(scheme_);
    const std::size_t n = this->particles().size();
    records_.resize(n);
    transport_velocity_.resize(n);
    grad_v_.resize(n);
    position_.resize(Dim, static_cast<Eigen::Index>(n));
    torque_factor_.assign(static_cast<std::size_t>(this->particles().bodies()), 1.0);
    if (second_sweep_ != nullptr) transport_records_.resize(n);
    if (scheme_.angular_momentum == AngularMomentum::torque_pair) {
        positive_torque_.resize(n);
        negative_torque_.resize(n);
    }
}

/// The order that the physics forces: pairs - density if summed - A - everything that needs one
/// sweep - constitutive law - torque balance per body - what needs u or the balance.
template <int Dim>
void SmoothParticleModel<Dim>::rates(double, std::span<const double> y, std::span<double> y_dot) {
    this->failure_.clear();
    if (!load(y, y_dot)) return;
    if (scheme_.density == Density::summed) sum_density();
    if (!density_is_physical(y_dot)) return;
    form_A(y);
    (this->*first_sweep_)(y_dot);
    material_.stress_rates(grad_v_, {this->layout(), y}, {this->layout(), y_dot});
    if (second_sweep_ == nullptr) return;
    if (scheme_.angular_momentum == AngularMomentum::torque_pair) balance_torques();
    load_transport();
    (this->*second_sweep_)(y_dot);
}

/// Records of all particles and the pair list for their positions.
template <int Dim>
bool SmoothParticleModel<Dim>::load(std::span<const double> y, std::span<double> y_dot) {
    const ConstState<Dim> state(this->layout(), y);
    const auto& particles = this->particles();
    const auto x = state.position();
    const auto v = state.velocity();
    position_ = x;
    if (!position_.allFinite()) {
        this->fail(y_dot, "a position is not finite");
        return false;
    }
    list_.update(position_);
    const bool integrated = state.has(Field::density);
    parallel_for(particles.size(), [&](std::size_t i) {
        const auto c = static_cast<Eigen::Index>(i);
        Record<Dim>& record = records_[i];
        for (int a = 0; a < Dim; ++a) {
            record.x[a] = this->box().periodic(a) ? this->box().wrap(a, x(a, c)) : x(a, c);
            record.v[a] = v(a, c);
        }
        record.m = particles.mass[i];
        if (integrated) record.rho = state.density()(0, c);
    });
    return true;
}

template <int Dim>
void SmoothParticleModel<Dim>::sum_density() {
    const std::span<const Record<Dim>> records(records_);
    sweep<Dim, DensitySum>(list_, Lucy<Dim>(scheme_.range), records,
                           [&](std::size_t i, const auto& sums) { records_[i].rho = sums.rho; });
}

template <int Dim>
bool SmoothParticleModel<Dim>::density_is_physical(std::span<double> y_dot) {
    for (std::size_t i = 0; i < records_.size(); ++i) {
        if (records_[i].rho > 0.0) continue;
        this->fail(y_dot, fmt::format("density {} of particle {} is not positive", records_[i].rho,
                                      this->particles().id[i]));
        return false;
    }
    return true;
}

template <int Dim>
void SmoothParticleModel<Dim>::form_A(std::span<const double> y) {
    const auto stress = ConstState<Dim>(this->layout(), y).stress();
    parallel_for(records_.size(), [&](std::size_t i) {
        const double scale = 1.0 / (records_[i].rho * records_[i].rho);
        for (std::size_t k = 0; k < records_[i].A.c.size(); ++k)
            records_[i].A.c[k] =
                scale * stress(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i));
    });
}

template <int Dim>
template <class Weight, class Mean, class Transport, class Force>
void SmoothParticleModel<Dim>::first_sweep(std::span<double> y_dot) {
    const State<Dim> rate(this->layout(), y_dot);
    const std::span<const Record<Dim>> records(records_);
    sweep<Dim, VelocityGradient<Dim, Mean>, Continuity, Transport, Force>(
        list_, Weight(scheme_.range), records,
        [&](std::size_t i, const auto& gradient, const auto& continuity, const auto& transport,
            const auto& force) {
            const auto c = static_cast<Eigen::Index>(i);
            transport_velocity_[i] = Transport::velocity(records_[i], transport);
            store<Dim>(rate.position(), i, transport_velocity_[i]);
            if (scheme_.density == Density::continuity) rate.density()(0, c) = continuity.rho_dot;
            grad_v_[i] = gradient.grad_v;
            if constexpr (std::is_same_v<Force, TorqueSums>) {
                positive_torque_[i] = force.positive;
                negative_torque_[i] = force.negative;
            } else {
                store<Dim>(rate.velocity(), i, force.v_dot);
                rate.energy()(0, c) = force.e_dot;
            }
        });
}

/// R of every body from its own sums, taken in the order of the particles.
template <int Dim>
void SmoothParticleModel<Dim>::balance_torques() {
    if constexpr (Dim == 2) {
        for (std::size_t body = 0; body < torque_factor_.size(); ++body) {
            CompensatedSum P, M, X;
            for (std::size_t i = 0; i < records_.size(); ++i) {
                if (static_cast<std::size_t>(this->particles().body[i]) != body) continue;
                P += 0.5 * positive_torque_[i];
                M += 0.5 * negative_torque_[i];
                X += records_[i].m * cross(transport_velocity_[i], records_[i].v);
            }
            torque_factor_[body] = torque_balance(P, M, X);
        }
    }
}

template <int Dim>
void SmoothParticleModel<Dim>::load_transport() {
    parallel_for(records_.size(), [&](std::size_t i) {
        const double R = torque_factor_[static_cast<std::size_t>(this->particles().body[i])];
        static_cast<Record<Dim>&>(transport_records_[i]) = records_[i];
        transport_records_[i].u = transport_velocity_[i];
        transport_records_[i].negative_factor = R;
        transport_records_[i].positive_factor = 1.0 / R;
    });
}

template <int Dim>
template <class Weight, class... Passes>
void SmoothParticleModel<Dim>::second_sweep(std::span<double> y_dot) {
    const State<Dim> rate(this->layout(), y_dot);
    const std::span<const TransportRecord<Dim>> records(transport_records_);
    sweep<Dim, Passes...>(list_, Weight(scheme_.range), records,
                          [&](std::size_t i, const auto&... sums) {
                              const auto c = static_cast<Eigen::Index>(i);
                              const auto store_one = [&](const auto& s) {
                                  if constexpr (requires { s.rho_dot; }) {
                                      rate.density()(0, c) = s.rho_dot;
                                  } else {
                                      store<Dim>(rate.velocity(), i, s.v_dot);
                                      rate.energy()(0, c) = s.e_dot;
                                  }
                              };
                              (store_one(sums), ...);
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
    if (scheme_.density != Density::summed) return Model<Dim>::density(y);
    const Points<Dim> x = ConstState<Dim>(this->layout(), y).position();
    PairList<Dim> list(scheme_.range, 0.0, this->box());
    list.build(x);
    std::vector<Record<Dim>> records(this->particles().size());
    for (std::size_t i = 0; i < records.size(); ++i) {
        for (int a = 0; a < Dim; ++a)
            records[i].x[a] = this->box().wrap(a, x(a, static_cast<Eigen::Index>(i)));
        records[i].m = this->particles().mass[i];
    }
    std::vector<double> rho(records.size());
    sweep<Dim, DensitySum>(list, Lucy<Dim>(scheme_.range), std::span<const Record<Dim>>(records),
                           [&](std::size_t i, const auto& sums) { rho[i] = sums.rho; });
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
