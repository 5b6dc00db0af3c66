// SPDX-License-Identifier: GPL-3.0-or-later
// What is compared.
#include "lattice.hpp"
#include <spam/analysis/lattice_modes.hpp>
#include <spam/analysis/periodic_solid.hpp>
#include <spam/material/polynomial_solid.hpp>

#include <Eigen/LU>

namespace stability {
namespace {

template <class Modes>
Waves waves_of(std::shared_ptr<Modes> modes, double noise) {
    return {[modes](const Point<2>& k) { return modes->growth_rate(k); },
            [modes](const Point<2>& k) { return modes->frequencies(k); },
            [modes](const Point<2>& k, const Point<2>& direction) {
                return modes->frequency(k, direction);
            },
            Eigen::Matrix2d::Identity(), noise};
}

Analysed smooth(const Parameters& p, const Scheme& scheme, const std::string& label) {
    Analysed one;
    one.label = label;
    one.title = velocity_title(scheme.transport, "plain v");
    one.row = to_string(scheme.transport);
    one.description = scheme.describe();
    one.elastic = scheme.kernel == Kernel::lucy && scheme.range >= 2.5 && scheme.range <= 4.0;
    // A lattice just wide enough for the analysis tells the modes of samples of any size.
    one.analyse = [p, scheme](RunStatistics& statistics) {
        const auto solid = smallest_triangular_solid(ElasticSolid::triangular_lattice(), scheme,
                                                     triangular_density, p.stress);
        const auto modes = std::make_shared<LatticeModes<2>>(*solid.model, solid.y0);
        statistics.particles = solid.model->particles().size();
        statistics.rhs_evaluations += modes->rhs_evaluations();
        statistics.pair_interactions += modes->rhs_evaluations() * solid.model->pairs();
        return waves_of(modes, 1e-5);  // square roots of what should be zero
    };
    return one;
}

Analysed vectors(const Parameters& p, double range, double penalty, BondMemory memory,
                 const std::string& label) {
    const auto solid = PolynomialSolid::like(ElasticSolid::triangular_lattice());
    const MaterialVectorScheme scheme{triangular_density, range, penalty};
    const bool kept = memory == BondMemory::kept;
    Analysed one;
    one.label = label;
    one.title = kept ? fmt::format("κ = {:g}", penalty) : "no memory";
    one.row = kept ? fmt::format("{:g}", penalty) : "no memory";
    one.description =
        fmt::format("material vectors, {}, range {:g}, {}", solid.describe(), range,
                    kept ? fmt::format("penalty kappa = {:g}", penalty) : "without memory");
    // and under pressure (tests/diagnostics/bonded_lattice.cpp)
    one.stable = kept && penalty > 0.0 && p.stress >= -0.2 &&
                 p.stress + std::abs(p.shear_stress) <= scheme.safe_tension(solid.stiffness(), 1.0);
    one.elastic = p.shear_stress == 0.0 && std::abs(p.stress) <= 0.02 && range >= 2.5 &&
                  range <= 4.0 && penalty <= 3.0;
    one.analyse = [p, solid, scheme, memory](RunStatistics&) {
        Eigen::Matrix2d stress;
        stress << p.stress, p.shear_stress, p.shear_stress, p.stress;
        const Eigen::Matrix2d F = deformation_under<2>(solid, stress);
        Waves waves = waves_of(
            std::make_shared<BondedLattice<2>>(triangular_basis(), solid, scheme, F, memory), 1e-9);
        waves.strained = F.inverse().transpose();
        return waves;
    };
    return one;
}

}  // namespace

std::vector<Analysed> smooth_particles(const Parameters& p, const Scheme& scheme, bool single) {
    if (single) return {smooth(p, scheme, "")};
    std::vector<Analysed> all;
    for (const auto transport : {Transport::plain, Transport::average, Transport::monaghan}) {
        Scheme other = scheme;
        other.transport = transport;
        all.push_back(smooth(p, other, std::string(to_string(transport))));
    }
    return all;
}

std::vector<Analysed> material_vectors(const Parameters& p, double range, bool single) {
    if (p.memoryless) return {vectors(p, range, 0.0, BondMemory::renewed, "")};
    if (single) return {vectors(p, range, *p.penalty, BondMemory::kept, "")};
    std::vector<Analysed> all{vectors(p, range, 0.0, BondMemory::renewed, "no_memory")};
    for (const double penalty : {0.0, 0.1, 0.3, 1.0, 2.0})
        all.push_back(
            vectors(p, range, penalty, BondMemory::kept, fmt::format("penalty_{:g}", penalty)));
    return all;
}

}  // namespace stability
