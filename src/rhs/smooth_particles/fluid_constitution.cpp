// SPDX-License-Identifier: GPL-3.0-or-later
#include "constitution.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/physics/fluid_record.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/physics/pair_friction.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

bool has_gradients(const Fluid& fluid) { return fluid.diffuses() && !fluid.by_pairs; }
bool has_pairs(const Fluid& fluid) { return fluid.diffuses() && fluid.by_pairs; }

bool any(const std::vector<Fluid>& fluids, bool (*is)(const Fluid&)) {
    return std::any_of(fluids.begin(), fluids.end(), is);
}

/// Where friction and conduction are those of pairs.
void check_pairs(const std::vector<Fluid>& fluids, const Scheme& scheme) {
    if (!any(fluids, has_pairs)) return;
    if (any(fluids, has_gradients))
        throw InputError(
            "friction: some of the fluids have that of pairs and others that of gradients, and no law says what "
            "acts between the two; set by_pairs of all that have friction or conduction, or of none");
    if (scheme.balances_torques() && any(fluids, has_shear))
        throw InputError(
            "friction: that of pairs is no stress, and balanced torques scale what of stresses acts across r_ij; "
            "take lambda = eta, by which pairs act along r_ij, or friction by gradients, or --angular-momentum "
            "free");
}

void check_shifting(const std::vector<Fluid>& fluids, const Scheme& scheme) {
    if (scheme.transport == Transport::shifting && fluids.size() > 1)
        throw InputError(
            "transport: shifting would mix fluids, and several are given; use --transport plain, or "
            "one fluid");
}

void check_work(const std::vector<Fluid>& fluids, const Scheme& scheme) {
    if (scheme.work == Work::mean ||
        std::any_of(fluids.begin(), fluids.end(), [](const Fluid& f) { return f.state.thermal; }))
        return;
    throw InputError(fmt::format(
        "work: own is for laws with a temperature, and the pressure of ({}) does not depend on the "
        "energy: no particle can lack heat; use --work mean",
        fluids.front().state.describe()));
}

/// <v> changes the angular momentum, and without shear the torques that are to make up for it are rounding
/// errors.
void check_torques(const std::vector<Fluid>& fluids, const Scheme& scheme) {
    if (!scheme.balances_torques() || scheme.transport != Transport::average) return;
    if (any(fluids, has_shear)) return;
    throw InputError(fmt::format(
        "angular-momentum: {} scales what of the forces acts across r_ij, of which a fluid without friction "
        "has nothing; use --angular-momentum free, or --transport plain or monaghan, which keep it",
        to_string(scheme.angular_momentum)));
}

void check_temperature(const Fluid& fluid) {
    if (fluid.state.thermal) return;
    throw InputError(fmt::format(
        "conduction: needs a temperature, and the law ({}) has none; use an ideal gas or van der "
        "Waals, or leave the conductivity out",
        fluid.state.describe()));
}

}  // namespace

bool has_shear(const Fluid& fluid) {
    const auto& newton = fluid.viscosity;
    return newton && !(fluid.by_pairs && newton->lambda == newton->eta);
}

void check_fluid(const Fluid& fluid, int dim) {
    const auto refuse_negative = [](const char* name, double value) {
        if (!(value >= 0.0) || !std::isfinite(value))
            throw InputError(fmt::format(
                "{}: {:g} must be 0 or positive, or entropy would decrease", name, value));
    };
    if (fluid.viscosity) {
        refuse_negative("shear viscosity", fluid.viscosity->eta);
        const double bulk = fluid.viscosity->bulk_viscosity(dim);
        // lambda = -eta in the plane is exactly no bulk viscosity, up to rounding.
        if (std::abs(bulk) > 1e-14 * fluid.viscosity->eta) refuse_negative("bulk viscosity", bulk);
        if (fluid.by_pairs &&
            std::abs(fluid.viscosity->lambda) > fluid.viscosity->eta * (1.0 + 1e-14))
            throw InputError(fmt::format(
                "friction: that of pairs needs -eta <= lambda <= eta, and eta = {:g}, lambda = {:g}; "
                "choose another bulk viscosity",
                fluid.viscosity->eta, fluid.viscosity->lambda));
    }
    if (!fluid.conduction) return;
    refuse_negative("conductivity", fluid.conduction->kappa);
    check_temperature(fluid);
}

void set_pair_constants(const Fluid& fluid, PassConstants& constants) {
    if (const auto& newton = fluid.viscosity) {
        constants.shear = newton->eta;
        constants.second_viscosity = newton->lambda;
    }
    if (fluid.conduction) constants.conductivity = fluid.conduction->kappa;
}

double pair_damping(const Fluid& fluid, int dim, double rho, double e) {
    if (!fluid.by_pairs) return 0.0;
    double most = 0.0;
    if (const auto& newton = fluid.viscosity)
        most = newton->eta - newton->lambda + (dim + 2.0) / dim * (newton->lambda + newton->eta);
    if (fluid.conduction)
        most = std::max(most, 2.0 * fluid.conduction->kappa / fluid.state.heat_capacity(rho, e));
    return most;
}

template <int Dim>
FluidConstitution<Dim>::FluidConstitution(const Particles<Dim>& particles,
                                          std::vector<Fluid> fluids)
    : Constitution<Dim>(particles),
      fluids_(std::move(fluids)),
      thermal_(!fluids_.empty()),
      gradients_(std::any_of(fluids_.begin(), fluids_.end(), has_gradients)),
      pressure_(particles.size()),
      temperature_(particles.size()) {
    if (fluids_.empty()) throw InputError("material: none is given; give one at least");
    for (const Fluid& fluid : fluids_) {
        thermal_ = thermal_ && fluid.state.thermal;
        if (conducts()) check_temperature(fluid);
    }
}

template <int Dim>
void FluidConstitution<Dim>::take(const Scheme& scheme) {
    if (scheme.density == Density::summed && scheme.transport != Transport::plain &&
        scheme.transport != Transport::shifting)
        throw InputError(
            "density: a fluid whose density is summed gains energy without limit where its "
            "particles move with an averaged velocity, because densities then change at another "
            "rate than work is done; use --density continuity, or --transport plain");
    for (const Fluid& fluid : fluids_) check_fluid(fluid, Dim);
    check_pairs(fluids_, scheme);
    check_shifting(fluids_, scheme);
    check_work(fluids_, scheme);
    check_torques(fluids_, scheme);
    matter_ = matter(scheme);
    if (numbers(scheme) > 0)
        friction_ = best_sweeps([](auto level) { return friction_sweep<Dim, level>(); });
}

/// What neither friction and conduction nor the scheme ask for is left out. Of pairs there is one sweep with the
/// pressures of one fluid that moves with its own velocity or is shifted; else they are added (add_forces).
template <int Dim>
Matter FluidConstitution<Dim>::matter(const Scheme& scheme) const {
    if (scheme.transport == Transport::shifting)
        return gradients_ || scheme.viscosity > 0.0 ? Matter::conducting : Matter::shifted;
    const bool plain = scheme.transport == Transport::plain && scheme.viscosity == 0.0 &&
                       (scheme.angular_momentum == AngularMomentum::free ||
                        scheme.angular_momentum == AngularMomentum::gauss);
    if (plain && fluids_.size() == 1 && has_pairs(first())) return Matter::rubbing;
    return gradients_ || !plain || scheme.work == Work::own ? Matter::conducting : Matter::inviscid;
}

template <int Dim>
int FluidConstitution<Dim>::numbers(const Scheme& scheme) const {
    const Matter made = matter(scheme);
    const bool included = made == Matter::rubbing || made == Matter::shifted;
    return any(fluids_, has_pairs) && !included ? FrictionRecord<Dim>::numbers : 0;
}

template <int Dim>
std::string FluidConstitution<Dim>::describe() const {
    std::string words = "fluid of smooth particles, ";
    for (const Fluid& fluid : fluids_)
        words += (&fluid == fluids_.data() ? "" : " | ") + fluid.describe();
    return words;
}

/// Pressures act along r_ij, viscous stresses do not; <v> moves particles without regard to where they are,
/// shifting without regard to where they go.
template <int Dim>
bool FluidConstitution<Dim>::central(const Scheme& scheme) const {
    return std::none_of(fluids_.begin(), fluids_.end(), has_shear) &&
           scheme.transport != Transport::average && scheme.transport != Transport::shifting;
}

template <int Dim>
const Fluid& FluidConstitution<Dim>::of(std::size_t i) const {
    const auto& material = this->particles_.material;
    return fluids_[material.empty() ? 0 : static_cast<std::size_t>(material[i])];
}

/// Pressure and temperature - A of an inviscid fluid, or gradients, then stress and heat flux.
template <int Dim>
std::string FluidConstitution<Dim>::prepare(const Now& now, std::span<const double> rho,
                                            const SweepInput<Dim>& in, const Sweeps<Dim>& sweeps,
                                            PackedParticles<Dim>& packed) {
    const std::span<const double> e{now.state.energy().data(), rho.size()};
    rho_ = rho, e_ = e;
    find_pressures(rho, e);
    if (auto reason = complaint(rho, e); !reason.empty()) return reason;
    fill(rho, in.constants, packed);
    if (!gradients_) return {};
    fluxes_.resize(packed.list().order().size());
    struct Context {
        FluidConstitution& self;
    } const context{*this};
    SweepOutput<Dim> out;
    out.context = &context;
    out.close = [](const void* given, const SweptBlock& block) {
        FluidConstitution& self = static_cast<const Context*>(given)->self;
        self.close_gradients(block, self.rho_);
    };
    sweeps.gradient(in, out);
    load_fluxes(packed);
    return {};
}

template <int Dim>
void FluidConstitution<Dim>::find_pressures(std::span<const double> rho,
                                            std::span<const double> e) {
    parallel_blocks(rho.size(), [&](std::size_t begin, std::size_t size) {
        for_each_material(
            this->particles_.material, begin, size,
            [&](std::size_t m, std::size_t first, std::size_t count) {
                const AnyEquationOfState& law = fluids_[m].state;
                const auto of_rho = rho.subspan(first, count), of_e = e.subspan(first, count);
                law.pressures(of_rho, of_e, {pressure_.data() + first, count});
                if (thermal_) law.temperatures(of_rho, of_e, {temperature_.data() + first, count});
            });
    });
}

/// Names the first particle that is outside its law.
template <int Dim>
std::string FluidConstitution<Dim>::complaint(std::span<const double> rho,
                                              std::span<const double> e) const {
    const auto outside = [&](std::size_t i) {
        return !(rho[i] > 0.0) || !std::isfinite(pressure_[i]) ||
               (thermal_ && !(temperature_[i] >= 0.0));
    };
    if (parallel_count(rho.size(), [&](std::size_t i) { return std::size_t{outside(i)}; }) == 0)
        return {};
    std::size_t i = 0;
    while (!outside(i)) ++i;
    const auto id = this->particles_.id[i];
    if (!(rho[i] > 0.0))
        return fmt::format("density {} of particle {} is not positive", rho[i], id);
    return fmt::format("density {} and energy {} of particle {} are outside the law ({}){}", rho[i],
                       e[i], id, of(i).state.describe(),
                       thermal_ ? ": no temperature above zero belongs to them" : "");
}

/// What the next sweep reads beyond x, v and m.
template <int Dim>
void FluidConstitution<Dim>::fill(std::span<const double> rho, const PassConstants& constants,
                                  PackedParticles<Dim>& packed) const {
    using R = ConductingRecord<Dim>;
    const auto order = packed.list().order();
    const MeanDensityKind mean = constants.mean_density;
    const bool tensors = matter_ == Matter::conducting, shifted = matter_ == Matter::shifted,
               rubbing = shifted || matter_ == Matter::rubbing;
    parallel_for(order.size(), [&](std::size_t slot) {
        const std::size_t i = order[slot];
        double* const record = packed.record(slot);
        const double a = pressure_[i] / (rho[i] * rho[i]);
        if (!tensors) {
            record[InviscidRecord<Dim>::template at<column::Pressure>] = a;
            if (!rubbing) return;
            record[RubbingRecord<Dim>::template at<column::InverseDensity>] = 1.0 / rho[i];
            record[RubbingRecord<Dim>::template at<column::Temperature>] = temperature_[i];
            if (shifted)
                record[ShiftedRecord<Dim>::template at<column::Density>] =
                    EitherMean::number(mean, rho[i]);
            return;
        }
        record[R::template at<column::Density>] = EitherMean::number(mean, rho[i]);
        record[R::template at<column::Temperature>] = temperature_[i];
        if (gradients_) return;
        constexpr int A_at = R::template at<column::Stress>,
                      q_at = R::template at<column::HeatFlux>;
        for (int c = 0; c < symmetric_size(Dim); ++c) record[A_at + c] = c < Dim ? -a : 0.0;
        for (int c = 0; c < Dim; ++c) record[q_at + c] = 0.0;
    });
    if (tensors)
        packed.template refresh<R>(R::template at<column::Density>);
    else
        packed.template refresh<ShiftedRecord<Dim>>(
            InviscidRecord<Dim>::template at<column::Pressure>);
}

/// Stress and heat flux of some particles from their gradients, by slot. Their records are being read.
template <int Dim>
void FluidConstitution<Dim>::close_gradients(const SweptBlock& block, std::span<const double> rho) {
    const Mat<Dim>* const grad_v = block.sums<Mat<Dim>>(0);
    const Vec<Dim>* const grad_T = block.sums<Vec<Dim>>(1);
    for (std::size_t k = 0; k < block.count; ++k) {
        const std::size_t i = block.particle[k];
        const Fluid& fluid = of(i);
        SymTensor<Dim> sigma;
        Vec<Dim> Q;
        if (fluid.viscosity) sigma = fluid.viscosity->viscous_stress(grad_v[k]);
        if (fluid.conduction) Q = fluid.conduction->heat_flux(grad_T[k]);
        for (int a = 0; a < Dim; ++a) sigma(a, a) -= pressure_[i];
        const double scale = 1.0 / (rho[i] * rho[i]);
        fluxes_[block.first_slot + k] = {scale * sigma, scale * Q};
    }
}

/// Into the records, once all are known.
template <int Dim>
void FluidConstitution<Dim>::load_fluxes(PackedParticles<Dim>& packed) const {
    using R = ConductingRecord<Dim>;
    parallel_for(fluxes_.size(), [&](std::size_t slot) {
        double* const record = packed.record(slot);
        const auto& [A, q] = fluxes_[slot];
        std::copy(A.c.begin(), A.c.end(), record + R::template at<column::Stress>);
        std::copy(q.c.begin(), q.c.end(), record + R::template at<column::HeatFlux>);
    });
    packed.template refresh<R>(R::template at<column::Stress>);
}

/// Density and temperature are those of prepare(). Walls have their share next to the sweep, as of every one.
template <int Dim>
void FluidConstitution<Dim>::add_forces(std::span<const double> rho, const SweepInput<Dim>& in,
                                        const SweepOutput<Dim>& out, PackedParticles<Dim>& packed) {
    using R = FrictionRecord<Dim>;
    if (friction_ == nullptr) return;
    constexpr int from = R::template at<column::InverseDensity>;
    static_assert(R::template at<column::Temperature> == from + 1 &&
                  R::template at<column::FrictionFactor> == from + 2 &&
                  R::template at<column::AlongFactor> == from + 3 &&
                  R::template at<column::ConductionFactor> == from + 4);
    packed.template write<R>(from, 5, [&](std::size_t i, double* number) {
        PassConstants of_fluid;
        set_pair_constants(of(i), of_fluid);
        const auto friction = PairFriction<Dim>::with(of_fluid);
        number[0] = 1.0 / rho[i];
        number[1] = temperature_[i];
        number[2] = friction.a;
        number[3] = friction.b;
        number[4] = PairConduction::with(of_fluid).twice_kappa;
    });
    SweepOutput<Dim> forces;
    forces.v_dot = out.v_dot;
    forces.e_dot = out.e_dot;
    friction_(in, forces);
    sweep_walls(packed, in, friction_);
}

template <int Dim>
void FluidConstitution<Dim>::set_constants(PassConstants& constants) const {
    set_pair_constants(first(), constants);
}

template <int Dim>
std::optional<double> FluidConstitution<Dim>::sound_speed(double density) const {
    double fastest = 0.0;
    for (const Fluid& fluid : fluids_) {
        const double c =
            fluid.state.sound_speed(density, fluid.state.starting_energy(density, 0.0));
        if (c > fastest) fastest = c;
    }
    return fastest;
}

template <int Dim>
double FluidConstitution<Dim>::sound_speed_of(std::size_t i) const {
    return of(i).state.sound_speed(rho_[i], e_[i]);
}

template <int Dim>
double FluidConstitution<Dim>::stress_forces(const ConstState<Dim>& state,
                                             std::span<const double> rho) const {
    const auto P = pressures(rho, {state.energy().data(), rho.size()});
    return exact_sum(P.size(), [&](std::size_t i) {
        return this->particles_.mass[i] * std::abs(P[i]) / rho[i];
    });
}

SPAM_COMPILED(template class FluidConstitution);

}  // namespace spam
