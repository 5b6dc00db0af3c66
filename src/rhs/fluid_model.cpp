// SPDX-License-Identifier: GPL-3.0-or-later
#include "../core/levels.hpp"
#include "carried_energy.hpp"
#include "fluid_sweeps.hpp"
#include "packed_particles.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/sums.hpp>
#include <spam/kernel/weight_integrals.hpp>
#include <spam/physics/fluid_record.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/rhs/fluid_model.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

bool has_gradients(const Fluid& fluid) { return fluid.viscosity || fluid.conduction; }

std::vector<Field> fields_of(const FluidScheme& scheme) {
    std::vector<Field> fields{Field::position, Field::velocity, Field::energy};
    if (scheme.density == Density::continuity) fields.push_back(Field::density);
    return fields;
}

void check(const Fluid& fluid, const FluidScheme& scheme, int dim) {
    if (scheme.density == Density::chain_rule)
        throw InputError(
            "density: chain_rule is for particles that move with an averaged velocity, those of a "
            "fluid move with their own; use --density summed or continuity");
    if (fluid.conduction && !fluid.state.thermal)
        throw InputError(
            fmt::format("conduction: needs a temperature, and the law ({}) has none; use an ideal "
                        "gas or van der Waals, or leave the conductivity out",
                        fluid.state.describe()));
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
    }
    if (fluid.conduction) refuse_negative("conductivity", fluid.conduction->kappa);
}

template <int Dim>
FluidSweeps<Dim> best_sweeps(const Fluid& fluid) {
    return at_level(instruction_set(), [&](auto level) {
        FluidSweeps<Dim> sweeps = fluid_sweeps<Dim, level>(has_gradients(fluid));
        sweeps.pack = pack_for<Dim, level>();
        return sweeps;
    });
}

}  // namespace

std::string FluidScheme::describe(bool gradients) const {
    return fmt::format("density {}, {}{} weight of range {}", to_string(density),
                       gradients ? fmt::format("{} mean density, ", to_string(mean_density)) : "",
                       to_string(kernel), range);
}

template <int Dim>
FluidModel<Dim>::~FluidModel() = default;

template <int Dim>
FluidModel<Dim>::FluidModel(Particles<Dim> particles, const Fluid& fluid, const FluidScheme& scheme,
                            const Box<Dim>& box)
    : ParticleModel<Dim>(std::move(particles), box, fields_of(scheme)),
      fluid_(fluid),
      scheme_(scheme),
      weight_(scheme.kernel, scheme.range),
      sweeps_(std::make_unique<const FluidSweeps<Dim>>(best_sweeps<Dim>(fluid))),
      density_(this->particles().size()),
      pressure_(density_.size()),
      temperature_(density_.size()) {
    valid_range<Dim>(scheme.range, this->particles().spacing, this->particles().size());
    check(fluid, scheme, Dim);
    packed_ = packed_with(ListUse::again_and_again);
    if (has_gradients(fluid)) damping_ = estimate_damping();
}

template <int Dim>
std::unique_ptr<PackedParticles<Dim>> FluidModel<Dim>::packed_with(ListUse use) const {
    return std::make_unique<PackedParticles<Dim>>(weight_, use, this->box(), sweeps_->width,
                                                  stride(), sweeps_->pack);
}

template <int Dim>
std::size_t FluidModel<Dim>::stride() const {
    return static_cast<std::size_t>(has_gradients(fluid_) ? ConductingRecord<Dim>::numbers
                                                          : InviscidRecord<Dim>::numbers);
}

/// By the shortest waves felt: momentum diffuses at (2 eta + lambda) k^2/rho or eta k^2/rho, heat at
/// kappa k^2/(rho c_v), c_v = D/2 of a unit mass.
template <int Dim>
double FluidModel<Dim>::estimate_damping() const {
    const auto rho = summed_density(this->particles().reference_position);
    CompensatedSum sum;
    for (const double r : rho) sum += r;
    const double mean = sum / static_cast<double>(rho.size());
    const double k = steepest_wave<Dim>(weight_);
    double diffusion = 0.0;
    if (fluid_.viscosity)
        diffusion =
            std::max(fluid_.viscosity->eta, 2.0 * fluid_.viscosity->eta + fluid_.viscosity->lambda);
    if (fluid_.conduction) diffusion = std::max(diffusion, 2.0 / Dim * fluid_.conduction->kappa);
    return diffusion * k * k / mean;
}

template <int Dim>
PackedFields FluidModel<Dim>::fields(std::span<const double> y) const {
    const ConstState<Dim> state(this->layout(), y);
    return {state.position().data(), state.velocity().data(), this->particles().mass.data()};
}

/// pairs - density if summed - pressure and temperature - gradients, stress and heat flux if there are
/// any - forces.
template <int Dim>
void FluidModel<Dim>::pair_rates(double, std::span<const double> y, std::span<double> y_dot) {
    this->failure_.clear();
    const ConstState<Dim> state(this->layout(), y);
    const State<Dim> rate(this->layout(), y_dot);
    if (!packed_->follow(this->particles().size(), fields(y)))
        return this->fail(y_dot, "a position is not finite");
    SweepInput<Dim> in = packed_->input();
    in.constants.mean_density = scheme_.mean_density;
    FluidOutput<Dim> out;
    if (rate.has(Field::density)) {
        std::copy_n(state.density().data(), density_.size(), density_.begin());
        out.rho_dot = rate.density().data();
    } else {
        out.rho = density_.data();
        sweeps_->density(in, out);
    }
    const std::span<const double> e{state.energy().data(), density_.size()};
    parallel_blocks(e.size(), [&](std::size_t first, std::size_t count) {
        const std::span<const double> rho{density_.data() + first, count};
        const auto of_block = e.subspan(first, count);
        fluid_.state.pressures(rho, of_block, {pressure_.data() + first, count});
        if (fluid_.state.thermal)
            fluid_.state.temperatures(rho, of_block, {temperature_.data() + first, count});
    });
    if (!meaningful(e, y_dot)) return;
    fill_records();
    if (sweeps_->gradient != nullptr) {
        out.context = this;
        out.gradients = [](const void* self, auto... gradients) {
            static_cast<const FluidModel*>(self)->close(gradients...);
        };
        sweeps_->gradient(in, out);
    }
    rate.position() = state.velocity();
    out.v_dot = rate.velocity().data();
    out.e_dot = rate.energy().data();
    sweeps_->force(in, out);
}

/// Names the first particle that is outside the law. Returns whether there is none.
template <int Dim>
bool FluidModel<Dim>::meaningful(std::span<const double> e, std::span<double> y_dot) {
    const auto outside = [&](std::size_t i) {
        return !(density_[i] > 0.0) || !std::isfinite(pressure_[i]) ||
               (fluid_.state.thermal && !(temperature_[i] >= 0.0));
    };
    if (parallel_count(e.size(), [&](std::size_t i) { return std::size_t{outside(i)}; }) == 0)
        return true;
    std::size_t i = 0;
    while (!outside(i)) ++i;
    const auto id = this->particles().id[i];
    if (!(density_[i] > 0.0))
        this->fail(y_dot,
                   fmt::format("density {} of particle {} is not positive", density_[i], id));
    else
        this->fail(
            y_dot,
            fmt::format("density {} and energy {} of particle {} are outside the law ({}){}",
                        density_[i], e[i], id, fluid_.state.describe(),
                        fluid_.state.thermal ? ": no temperature above zero belongs to them" : ""));
    return false;
}

/// What the next sweep reads beyond x, v and m.
template <int Dim>
void FluidModel<Dim>::fill_records() {
    const auto order = packed_->list().order();
    const bool gradients = sweeps_->gradient != nullptr;
    parallel_for(order.size(), [&](std::size_t slot) {
        const std::size_t i = order[slot];
        double* const record = packed_->record(slot);
        if (gradients) {
            record[GradientRecord<Dim>::rho_at] =
                EitherMean::number(scheme_.mean_density, density_[i]);
            record[GradientRecord<Dim>::rho_at + 1] = temperature_[i];
        } else {
            record[InviscidRecord<Dim>::a_at] = pressure_[i] / (density_[i] * density_[i]);
        }
    });
}

/// Stress and heat flux of `count` particles from their gradients, into their records.
template <int Dim>
void FluidModel<Dim>::close(std::size_t first_slot, const std::uint32_t* particle,
                            std::size_t count, const Mat<Dim>* grad_v,
                            const Vec<Dim>* grad_T) const {
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = particle[k];
        SymTensor<Dim> sigma;
        Vec<Dim> Q;
        if (fluid_.viscosity) sigma = fluid_.viscosity->viscous_stress(grad_v[k]);
        if (fluid_.conduction) Q = fluid_.conduction->heat_flux(grad_T[k]);
        for (int a = 0; a < Dim; ++a) sigma(a, a) -= pressure_[i];
        const double scale = 1.0 / (density_[i] * density_[i]);
        double* const record = packed_->record(first_slot + k);
        for (std::size_t c = 0; c < sigma.c.size(); ++c)
            record[ConductingRecord<Dim>::A_at + static_cast<int>(c)] = scale * sigma.c[c];
        for (int a = 0; a < Dim; ++a) record[ConductingRecord<Dim>::q_at + a] = scale * Q[a];
    }
}

template <int Dim>
std::vector<double> FluidModel<Dim>::summed_density(const Points<Dim>& x) const {
    const auto packed = packed_with(ListUse::once);
    const Points<Dim> at_rest = Points<Dim>::Zero(Dim, x.cols());
    std::vector<double> rho(density_.size(), std::numeric_limits<double>::quiet_NaN());
    if (!packed->follow(rho.size(), {x.data(), at_rest.data(), this->particles().mass.data()}))
        return rho;
    FluidOutput<Dim> out;
    out.rho = rho.data();
    sweeps_->density(packed->input(), out);
    return rho;
}

/// For observers: its own list, so that the one of the right-hand side stays as it is.
template <int Dim>
std::vector<double> FluidModel<Dim>::pair_density(std::span<const double> y) const {
    if (scheme_.density == Density::continuity) return Model<Dim>::density(y);
    return summed_density(ConstState<Dim>(this->layout(), y).position());
}

template <int Dim>
std::vector<double> FluidModel<Dim>::pressure(std::span<const double> y) const {
    const auto rho = pair_density(y);
    std::vector<double> P(rho.size());
    fluid_.state.pressures(rho, {ConstState<Dim>(this->layout(), y).energy().data(), P.size()}, P);
    return P;
}

template <int Dim>
std::vector<double> FluidModel<Dim>::temperature(std::span<const double> y) const {
    const auto rho = pair_density(y);
    std::vector<double> T(rho.size());
    fluid_.state.temperatures(rho, {ConstState<Dim>(this->layout(), y).energy().data(), T.size()},
                              T);
    return T;
}

template <int Dim>
std::vector<double> FluidModel<Dim>::state(const Points<Dim>& position, const Points<Dim>& velocity,
                                           double T) {
    return fluid_start(*this, fluid_.state, position, velocity, summed_density(position), T);
}

template <int Dim>
double FluidModel<Dim>::pair_energy(std::span<const double> y) const {
    return carried_energy(*this, y);
}

template <int Dim>
double FluidModel<Dim>::neighbour_forces(std::span<const double> y) const {
    const auto rho = pair_density(y);
    std::vector<double> P(rho.size());
    fluid_.state.pressures(rho, {ConstState<Dim>(this->layout(), y).energy().data(), P.size()}, P);
    double sum = 0.0;
    for (std::size_t i = 0; i < P.size(); ++i)
        sum += this->particles().mass[i] * std::abs(P[i]) / rho[i];
    return Model<Dim>::neighbour_forces(y) + sum / this->particles().spacing;
}

/// Pressures act along r_ij; viscous stresses do not.
template <int Dim>
Promises FluidModel<Dim>::pair_promises() const {
    Promises promises;
    if (Dim == 1 || !fluid_.viscosity) promises.angular_momentum = Promise::integrator_error;
    return this->in_box(promises);
}

template <int Dim>
void FluidModel<Dim>::remember(Archive& archive) {
    Model<Dim>::remember(archive);
    if (archive.reading()) packed_ = packed_with(ListUse::again_and_again);
}

template <int Dim>
std::size_t FluidModel<Dim>::pairs() const {
    return packed_->list().pairs();
}
template <int Dim>
std::size_t FluidModel<Dim>::list_builds() const {
    return packed_->list().builds();
}

template <int Dim>
std::string FluidModel<Dim>::pair_description() const {
    return fmt::format("fluid of smooth particles, {}: {}", fluid_.describe(),
                       scheme_.describe(has_gradients(fluid_)));
}

template class FluidModel<1>;
template class FluidModel<2>;
template class FluidModel<3>;

}  // namespace spam
