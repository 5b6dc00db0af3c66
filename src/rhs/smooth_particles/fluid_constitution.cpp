// SPDX-License-Identifier: GPL-3.0-or-later
#include "constitution.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/physics/fluid_record.hpp>
#include <spam/physics/mean_density.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
template <int Dim>
FluidConstitution<Dim>::FluidConstitution(const Particles<Dim>& particles,
                                          std::vector<Fluid> fluids)
    : Constitution<Dim>(particles),
      fluids_(std::move(fluids)),
      thermal_(!fluids_.empty()),
      gradients_(any(fluids_, by_gradients)),
      pressure_(particles.size()),
      temperature_(particles.size()) {
    check_fluids(fluids_, Dim);
    for (const Fluid& fluid : fluids_) thermal_ = thermal_ && fluid.state.thermal;
}

template <int Dim>
void FluidConstitution<Dim>::take(const Scheme& scheme) {
    if (scheme.density == Density::summed && scheme.transport != Transport::plain &&
        scheme.transport != Transport::shifting)
        throw InputError(
            "density: a fluid whose density is summed gains energy without limit where its "
            "particles move with an averaged velocity, because densities then change at another "
            "rate than work is done; use --density continuity, or --transport plain");
    check_scheme(fluids_, scheme);
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
    if (plain && fluids_.size() == 1 && by_pairs(first())) return Matter::rubbing;
    return gradients_ || !plain || scheme.work == Work::own ? Matter::conducting : Matter::inviscid;
}

template <int Dim>
int FluidConstitution<Dim>::numbers(const Scheme& scheme) const {
    const Matter made = matter(scheme);
    const bool included = made == Matter::rubbing || made == Matter::shifted;
    return any(fluids_, by_pairs) && !included ? FrictionRecord<Dim>::numbers : 0;
}

template <int Dim>
std::string FluidConstitution<Dim>::describe() const {
    return "fluid of smooth particles, " + spam::describe(fluids_);
}

/// Pressures act along r_ij, viscous stresses do not; <v> moves particles without regard to where they are,
/// shifting without regard to where they go.
template <int Dim>
bool FluidConstitution<Dim>::central(const Scheme& scheme) const {
    return !any(fluids_, has_shear) && scheme.transport != Transport::average &&
           scheme.transport != Transport::shifting;
}

template <int Dim>
const Fluid& FluidConstitution<Dim>::of(std::size_t i) const {
    return fluid_of(fluids_, this->particles_.material, i);
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
    static_assert(R::template at<column::Temperature> == from + 1);
    packed.template write<R>(from, 2 + pair_factors, [&](std::size_t i, double* number) {
        number[0] = 1.0 / rho[i];
        number[1] = temperature_[i];
        write_pair_factors<R, Dim, from + 2>(of(i), number + 2);
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
    const auto P = of_all(&AnyEquationOfState::pressure, rho, {state.energy().data(), rho.size()});
    return exact_sum(P.size(), [&](std::size_t i) {
        return this->particles_.mass[i] * std::abs(P[i]) / rho[i];
    });
}

SPAM_COMPILED(template class FluidConstitution);

}  // namespace spam
