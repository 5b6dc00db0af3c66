// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of a fluid: what they have follows from their corners.
#include <spam/core/exact_sum.hpp>
#include <spam/core/parts.hpp>
#include <spam/physics/quadrilateral.hpp>
#include <spam/rhs/elements.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {

std::optional<double> Elements::Material::sound_speed() const {
    if (solid()) return solid()->sound_speed(density);
    const AnyEquationOfState& state = fluid()->state;
    return state.sound_speed(density, state.starting_energy(density, temperature));
}

/// Densities, energies and pressures of elements of one fluid, and the stress at rest.
void Elements::find_pressures(const Nodes& nodes, const AnyEquationOfState& law, std::size_t first,
                              std::size_t count) {
    const double* const e = nodes.state.elements().find(Field::energy);
    for (std::size_t k = first; k < first + count; ++k) {
        density_[k] = mass_[k] / QuadrilateralShape<>(corners_of(nodes, places, k)).area;
        energy_[k] = e && !law.cold ? e[k] : 0.0;
    }
    const auto part = [&](std::vector<double>& all) {
        return std::span(all).subspan(first, count);
    };
    law.pressures(part(density_), part(energy_), part(pressure_));
    for (std::size_t k = first; k < first + count; ++k) {
        returned_[3 * k] = returned_[3 * k + 1] = -pressure_[k];
        returned_[3 * k + 2] = 0.0;
    }
}

/// Names the first element of a fluid that is outside its law.
std::string Elements::complaint() const {
    const auto outside = std::find_if_not(pressure_.begin(), pressure_.end(),
                                          [](double P) { return std::isfinite(P); });
    if (outside == pressure_.end()) return {};
    const auto k = static_cast<std::size_t>(outside - pressure_.begin());
    const Fluid& fluid = *material_of(k).fluid();
    return fmt::format("density {} {}of element {} is outside the law ({})", density_[k],
                       fluid.state.cold ? "" : fmt::format("and energy {} ", energy_[k]),
                       number_of(k), fluid.state.describe());
}

/// By mass.
double Elements::energy_of(const Nodes& nodes, std::size_t element) const {
    const ConstState<2> elements = nodes.state.elements();
    const Material& material = material_of(element);
    if (!material.cold()) return elements.find(Field::energy)[element];
    const double area = QuadrilateralShape<>(corners_of(nodes, places, element)).area;
    double e = material.fluid()->state.cold_energy(mass_[element] / area);
    for (const Field work : {Field(field_kind::hourglass_work), Field(field_kind::friction_work)})
        if (const double* const all = elements.find(work)) e += all[element];
    return e;
}

/// Of a stress lambda tr + 2 eta D, the fastest rate of one element alone, which none of the mesh exceeds: at most
/// 2 max(eta, lambda + eta) |grad v|^2 A is taken from sum v^2 M/8, and |grad v|^2 <= 2 b sum v^2 with b the
/// larger eigenvalue of b_0 b_0 + b_1 b_1.
double Elements::friction_damping(const Nodes& nodes) const {
    double fastest = 0.0;
    for (std::size_t k = 0; k < density_.size(); ++k) {
        const Fluid* const fluid = material_of(k).fluid();
        if (fluid == nullptr || !fluid->viscosity) continue;
        const QuadrilateralShape<> shape(corners_of(nodes, places, k));
        const double half = 0.5 * (dot(shape.b_0, shape.b_0) + dot(shape.b_1, shape.b_1)),
                     cross = shape.b_0[0] * shape.b_1[1] - shape.b_0[1] * shape.b_1[0];
        const double b = half + std::sqrt(std::max(half * half - cross * cross, 0.0));
        const auto& [lambda, eta] = *fluid->viscosity;
        fastest = std::max(fastest, 16.0 * std::max(eta, lambda + eta) * b * shape.area / mass_[k]);
    }
    return Parts::here().most(fastest);
}

void Elements::warm(std::span<double> y, std::optional<double> temperature) const {
    const State<2> state = among().of(State<2>(layout(), y));
    const Nodes nodes = nodes_of(state);
    for (std::size_t k = 0; k < density_.size(); ++k) {
        const Material& material = material_of(k);
        if (material.solid() || material.cold()) continue;
        const double area = QuadrilateralShape<>(corners_of(nodes, places, k)).area;
        state.elements().find(Field::energy)[k] = material.fluid()->state.starting_energy(
            mass_[k] / area, temperature.value_or(material.temperature));
    }
}

Elements::Fields Elements::fields(std::span<const double> y) const {
    const Nodes nodes = nodes_of(state_of(y));
    const ConstState<2> elements = nodes.state.elements();
    const double *const e = elements.find(Field::energy), *const held =
                                                              elements.find(Field::stress);
    const std::size_t n = mass_.size();
    Fields all{std::vector<double>(n), std::vector<double>(n), std::vector<SymTensor<2>>(n)};
    for (std::size_t k = 0; k < n; ++k) {
        const QuadrilateralShape<> shape(corners_of(nodes, places, k));
        all.density[k] = mass_[k] / shape.area;
        all.energy[k] = energy_of(nodes, k);
        SymTensor<2>& stress = all.stress[k];
        const Fluid* const fluid = material_of(k).fluid();
        if (fluid == nullptr) {
            stress = numbers_at<SymTensor<2>>(held + 3 * k);
            continue;
        }
        if (fluid->viscosity)
            stress =
                fluid->viscosity->viscous_stress(shape.gradient(corners_of(nodes, velocities, k)));
        const double P =
            fluid->state.pressure(all.density[k], fluid->state.cold || !e ? 0.0 : e[k]);
        stress(0, 0) -= P;
        stress(1, 1) -= P;
    }
    return all;
}

namespace {

const Elements* elements_of(const Model<2>& model) {
    const auto* const parts = dynamic_cast<const ParticleModel<2>*>(&model);
    return parts ? parts->term<Elements>() : nullptr;
}

}  // namespace

Elements::Fields fluid_elements(const Model<2>& model, std::span<const double> y) {
    const Elements* const elements = elements_of(model);
    return elements && elements->has_fluid() ? elements->fields(y) : Elements::Fields{};
}

double hourglass_work(const Model<2>& model, std::span<const double> y) {
    const double* const work =
        ConstState<2>(model.layout(), y).elements().find(field_kind::hourglass_work);
    if (work == nullptr) return 0.0;
    const std::vector<double>& mass = elements_of(model)->mass();
    return exact_sum(mass.size(), [&](std::size_t k) { return mass[k] * work[k]; });
}

}  // namespace spam
