// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/packed_particles.hpp"
#include "../sweeps/term_sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/physics/curvature_strength.hpp>
#include <spam/physics/density_passes.hpp>
#include <spam/physics/embedded_energy.hpp>
#include <spam/physics/record.hpp>
#include <spam/physics/surface_tension.hpp>
#include <spam/rhs/density_potentials.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {
namespace {

void check_strength(const char* name, double value) {
    if (!(value >= 0.0) || !std::isfinite(value))
        throw InputError(fmt::format(
            "{}: {} must be a finite number not below 0: a potential of the other sign pulls "
            "matter apart",
            name, value));
}

void check_core(const DensityPotentials& p) {
    check_strength("core", p.core.e_c);
    if (p.core.e_c > 0.0 && !(p.core.s > 0.0 && p.core.s < p.range))
        throw InputError(
            fmt::format("core-range: {} must lie above 0 and below the weight function's range {}; "
                        "0.7 spacings are usual",
                        p.core.s, p.range));
}

template <int Dim>
DensityPotentials validated(const DensityPotentials& p, const Particles<Dim>& particles) {
    valid_range<Dim>(p.range, particles.spacing, particles.size());
    check_strength("surface-tension", p.surface_tension);
    check_strength("strength", p.strength);
    check_core(p);
    if (!p.state && p.surface_tension == 0.0 && p.strength == 0.0 && p.core.e_c == 0.0)
        throw InputError(
            "potentials: none acts; give an equation of state, or a surface tension, strength or "
            "core energy above 0");
    if (p.state && !p.state->cold)
        throw InputError(fmt::format(
            "equation of state: '{}' is no potential, its energy does not depend on the density "
            "alone; use a cold law such as the embedded atom",
            p.state->describe()));
    const GeneralWeight<Dim> weight(p.kernel, p.range);
    if (p.surface_tension > 0.0)
        check_smooth_enough<Dim>(SurfaceTension{p.surface_tension}, weight);
    if (p.strength > 0.0) check_smooth_enough<Dim>(CurvatureStrength{p.strength}, weight);
    return p;
}

bool has_shape(const DensityPotentials& p) { return p.surface_tension > 0.0 || p.strength > 0.0; }

template <int Dim>
PackedFields fields(const Particles<Dim>& particles, const ConstState<Dim>& state) {
    return {state.position().data(), nullptr, particles.mass.data()};
}

/// Where in a record what begins: x and m, then rho and, where anything but the density and the core acts,
/// g and D (not on a line, where D is zero). The first sweep writes these; the slopes that the sweep of
/// forces reads are put in their place.
template <int Dim>
struct Places {
    static constexpr std::size_t mass = Dim, rho = PointRecord<Dim>::numbers, g = rho + 1,
                                 D = g + Dim;
};

}  // namespace

std::string DensityPotentials::describe() const {
    std::string words;
    if (state) words += state->describe() + "; ";
    if (surface_tension > 0.0) words += fmt::format("surface tension {:g}; ", surface_tension);
    if (strength > 0.0) words += fmt::format("strength {:g}; ", strength);
    if (core.e_c > 0.0) words += fmt::format("core {:g} of range {:g}; ", core.e_c, core.s);
    return words + fmt::format("{} weight of range {:g}", to_string(kernel), range);
}

template <int Dim>
struct DensityPotentialTerm<Dim>::Parts {
    using At = Places<Dim>;

    /// Without a core its range is any but zero, by whose square is divided.
    explicit Parts(const DensityPotentials& p)
        : potentials(p),
          shape(has_shape(p)),
          sweeps(best_sweeps(
              [this](auto level) { return density_potential_sweeps<Dim, level>(shape); })),
          weight(p.kernel, p.range),
          core(p.core.e_c > 0.0 ? p.core : CorePotential{0.0, p.range}) {}

    SweepInput<Dim> input(const PackedParticles<Dim>& particles) const {
        SweepInput<Dim> in = particles.input();
        in.constants.core_energy = core.e_c;
        in.constants.core_range = core.s;
        return in;
    }
    /// Of the record that the sweep of forces reads.
    std::span<const NumberKind> kinds() const {
        if (!shape) return SlopeRecord<Dim, double, DensityItself>::kinds;
        if constexpr (Dim == 1)
            return SlopeRecord<Dim, double, DensityItself, SurfaceTension>::kinds;
        else
            return SlopeRecord<Dim, double, DensityItself, SurfaceTension,
                               CurvatureStrength>::kinds;
    }
    void find_fields(PackedParticles<Dim>& particles) const {
        SweepOutput<Dim> out;
        out.records = particles.record(0);
        sweeps.density(input(particles), out);
    }
    std::size_t make_slopes();
    void make_slopes(double* record, double P) const;
    double energy(double m, const double* record) const;

    DensityPotentials potentials;
    bool shape;  ///< whether g and D are wanted
    Sweeps<Dim> sweeps;
    GeneralWeight<Dim> weight;
    CorePotential core;
    std::unique_ptr<PackedParticles<Dim>> packed{};
    std::vector<double> densities{}, pressures{};  ///< by slot
};

namespace {

template <class Field>
void write_slope(double* number, double inverse_mass, const Field& slope) {
    for (const double component : slope.c) *number++ = inverse_mass * component;
}

/// rho > 0 and P(rho) with a meaning.
bool within_law(double rho, double P) { return rho > 0.0 && std::isfinite(P); }

}  // namespace

/// S = G/m in place of the fields: P/rho^2 for the density.
template <int Dim>
void DensityPotentialTerm<Dim>::Parts::make_slopes(double* record, double P) const {
    double& rho = record[At::rho];
    rho = P / (rho * rho);
    if (!shape) return;
    const double m = record[At::mass];
    const SurfaceTension tension{potentials.surface_tension};
    write_slope(record + At::g, 1.0 / m,
                tension.slope<Dim>(m, numbers_at<Vec<Dim>>(record + At::g)));
    if constexpr (Dim > 1) {
        const CurvatureStrength strength{potentials.strength};
        write_slope(record + At::D, 1.0 / m,
                    strength.slope<Dim>(m, numbers_at<SymTensor<Dim>>(record + At::D)));
    }
}

/// Of all slots, some hundred at a time. Returns how many densities are outside the law.
template <int Dim>
std::size_t DensityPotentialTerm<Dim>::Parts::make_slopes() {
    constexpr std::size_t block = 256;
    const std::size_t slots = packed->list().size();
    densities.resize(slots);
    pressures.assign(slots, 0.0);
    return parallel_count((slots + block - 1) / block,
                          [&](std::size_t b) {
                              const std::size_t first = b * block,
                                                count = std::min(block, slots - first);
                              for (std::size_t s = first; s < first + count; ++s)
                                  densities[s] = packed->record(s)[At::rho];
                              const std::span<const double> rho(&densities[first], count);
                              const std::span<double> P(&pressures[first], count);
                              if (potentials.state) potentials.state->pressures(rho, rho, P);
                              std::size_t outside = 0;
                              for (std::size_t s = first; s < first + count; ++s) {
                                  make_slopes(packed->record(s), pressures[s]);
                                  outside += within_law(densities[s], pressures[s]) ? 0 : 1;
                              }
                              return outside;
                          },
                          block);
}

/// Of the fields of one particle.
template <int Dim>
double DensityPotentialTerm<Dim>::Parts::energy(double m, const double* record) const {
    double energy = potentials.state ? m * potentials.state->cold_energy(record[At::rho]) : 0.0;
    if (!shape) return energy;
    energy += SurfaceTension{potentials.surface_tension}.energy<Dim>(
        m, numbers_at<Vec<Dim>>(record + At::g));
    if constexpr (Dim > 1)
        energy += CurvatureStrength{potentials.strength}.energy<Dim>(
            m, numbers_at<SymTensor<Dim>>(record + At::D));
    return energy;
}

template <int Dim>
DensityPotentialTerm<Dim>::DensityPotentialTerm(const Selection<Dim>& among,
                                                const DensityPotentials& potentials)
    : Term<Dim>(among),
      potentials_(validated(potentials, this->particles())),
      parts_(std::make_unique<Parts>(potentials_)) {
    parts_->packed = std::make_unique<PackedParticles<Dim>>(
        parts_->weight, ListUse::again_and_again, this->box(), parts_->sweeps);
    this->look_after(*parts_->packed);
    this->nature_.description =
        fmt::format("molecular dynamics, potentials of the density: {}", potentials_.describe());
    this->nature_.reach = potentials_.range;
    this->nature_.sums_density = true;
}

template <int Dim>
DensityPotentialTerm<Dim>::~DensityPotentialTerm() = default;

/// The order that the equations force: rho, g and D; their slopes; forces.
template <int Dim>
std::string DensityPotentialTerm<Dim>::rates(const Now& now) {
    PackedParticles<Dim>& packed = *parts_->packed;
    if (!packed.follow(this->particles().size(), fields(this->particles(), now.state)))
        return "a position is not finite";
    if (parts_->shape || potentials_.state) {
        parts_->find_fields(packed);
        if (parts_->make_slopes() > 0) return complaint();
        packed.refresh(parts_->kinds(), PointRecord<Dim>::numbers);
    }
    SweepOutput<Dim> out;
    out.v_dot = now.v_dot;
    parts_->sweeps.force(parts_->input(packed), out);
    sweep_walls(packed, parts_->input(packed), parts_->sweeps.force);
    return {};
}

/// Names the first particle whose density is outside the law.
template <int Dim>
std::string DensityPotentialTerm<Dim>::complaint() const {
    const auto order = parts_->packed->list().order();
    std::size_t first = this->particles().size(), at = 0;
    for (std::size_t slot = 0; slot < parts_->densities.size(); ++slot)
        if (order[slot] < first && !within_law(parts_->densities[slot], parts_->pressures[slot])) {
            first = order[slot];
            at = slot;
        }
    const std::string law = potentials_.state ? potentials_.state->describe() : "a density";
    return fmt::format("density {} of particle {} is outside the law '{}'", parts_->densities[at],
                       this->particles().id[first], law);
}

/// For observers, here and below: a list of its own, so that the one of the right-hand side stays as
/// it is.
template <int Dim>
std::vector<double> DensityPotentialTerm<Dim>::summed_density(std::span<const double> y) const {
    auto own = parts_->packed->for_observer();
    std::vector<double> rho(this->particles().size(), std::numeric_limits<double>::quiet_NaN());
    if (!own.follow(rho.size(), fields(this->particles(), this->state_of(y)))) return rho;
    parts_->find_fields(own);
    for (std::size_t slot = 0; slot < rho.size(); ++slot)
        rho[own.list().order()[slot]] = own.record(slot)[Places<Dim>::rho];
    return rho;
}

template <int Dim>
double DensityPotentialTerm<Dim>::phi(std::span<const double> y) const {
    auto own = parts_->packed->for_observer();
    const std::size_t n = this->particles().size();
    if (!own.follow(n, fields(this->particles(), this->state_of(y))))
        return std::numeric_limits<double>::quiet_NaN();
    std::vector<double> energy(n, 0.0);
    if (potentials_.core.e_c > 0.0) {
        SweepOutput<Dim> out;
        out.energy = energy.data();
        parts_->sweeps.energy(parts_->input(own), out);
    }
    parts_->find_fields(own);
    for (std::size_t slot = 0; slot < n; ++slot) {
        const std::size_t i = own.list().order()[slot];
        energy[i] += parts_->energy(this->particles().mass[i], own.record(slot));
    }
    return exact_sum(n, [&](std::size_t i) { return energy[i]; });
}

template <int Dim>
auto DensityPotentialTerm<Dim>::answer(Ask what, std::span<const double> y) const -> Answer {
    if (what == Ask::energy) return {phi(y)};
    if (what == Ask::density) return {0.0, summed_density(y)};
    if (what != Ask::neighbour_forces) return {};
    double sum = std::abs(phi(y));
    if (potentials_.state) {
        const auto rho = summed_density(y);
        std::vector<double> P(rho.size());
        potentials_.state->pressures(rho, rho, P);
        sum += exact_sum(P.size(), [&](std::size_t i) {
            return this->particles().mass[i] * std::abs(P[i]) / rho[i];
        });
    }
    return {sum / this->particles().spacing};
}

SPAM_COMPILED(template class DensityPotentialTerm);

}  // namespace spam
