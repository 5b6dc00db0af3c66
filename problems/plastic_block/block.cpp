// SPDX-License-Identifier: GPL-3.0-or-later
#include "block.hpp"

#include "after_steps.hpp"
#include <spam/material/smooth_hencky_solid.hpp>
#include <spam/material/smooth_yield.hpp>
#include <spam/rhs/total_lagrangian.hpp>

namespace plastic_block {
namespace {

const double modulus = triangular_modulus, site_density = triangular_density;

Material<2> stress_law(const Parameters& p, const PlaneVonMises& surface,
                       const LinearHardening& flow) {
    if (p.yielding == Yielding::smooth) return SmoothYield<PlaneVonMises>(surface, flow, p.width);
    const YieldingSolid<PlaneVonMises> solid(surface, flow);
    if (p.yielding == Yielding::after_steps) return AfterSteps{solid};
    return solid;
}

HyperelasticMaterial<2> hyperelastic_law(const Parameters& p, const PlaneVonMises& surface,
                                         const LinearHardening& flow) {
    if (p.yielding == Yielding::smooth)
        return SmoothHenckySolid<PlaneVonMises>(surface, flow, p.width);
    if (p.yielding == Yielding::after_steps) return LogarithmicAfterSteps(surface, flow);
    return HenckySolid<PlaneVonMises>(surface, flow);
}

VelocityField<2> start(const Parameters& p) {
    return [A = p.amplitude, w = p.spin](const Point<2>& r) {
        constexpr double pi = std::numbers::pi;
        const double x = r.x(), y = r.y(), bend = std::sin(pi * x / 20.0);
        return Point<2>(A * bend - w * y,
                        0.7 * A * bend * std::sin(pi * x / 10.0) * y / 5.0 + w * x);
    };
}

}  // namespace

Block make_block(const Parameters& p) {
    Points<2> sites = triangular_block(p.columns, p.rows);
    const Point<2> centre = 0.5 * (sites.rowwise().minCoeff() + sites.rowwise().maxCoeff());
    sites.colwise() -= centre;
    auto particles = make_particles<2>(sites, 1.0);
    const PlaneVonMises surface{modulus, modulus};
    const LinearHardening flow{p.yield_stress, p.hardening};
    Block block;
    if (p.formulation == Formulation::total_lagrangian)
        block.model = std::make_shared<TotalLagrangianModel<2>>(
            std::move(particles), hyperelastic_law(p, surface, flow),
            TotalLagrangianScheme{site_density, p.range, p.penalty});
    else
        block.model = std::make_shared<SmoothParticleModel<2>>(
            std::move(particles), stress_law(p, surface, flow),
            Scheme{.transport = p.transport, .range = p.range});
    block.y0 = initial_state<2>(*block.model, site_density, p.yield_stress, start(p));
    return block;
}

double plastic_work(const Model<2>& model, std::span<const double> y) {
    const ConstState<2> state(model.layout(), y);
    if (state.has(field_kind::plastic_work))
        return state.field(field_kind::plastic_work).sum() / site_density;
    const PlaneVonMises surface{modulus, modulus};
    double work = 0.0;
    for (Eigen::Index i = 0; i < state.energy().cols(); ++i) {
        SymTensor<2> stress;
        for (std::size_t c = 0; c < 3; ++c)
            stress.c[c] = state.stress()(static_cast<Eigen::Index>(c), i);
        const auto parts = PlaneVonMises::parts(stress, 0.0);
        work += state.energy()(0, i) -
                surface.elastic_energy(parts.mean, parts.q) / state.density()(0, i);
    }
    return work;
}

std::vector<double> plastic_strains(const Model<2>& model, std::span<const double> y) {
    const auto strain = ConstState<2>(model.layout(), y).field(field_kind::plastic_strain);
    return {strain.data(), strain.data() + strain.size()};
}

}  // namespace plastic_block
