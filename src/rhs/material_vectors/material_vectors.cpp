// SPDX-License-Identifier: GPL-3.0-or-later
#include "../smooth_particles/constitution.hpp"
#include "../sweeps/packed_particles.hpp"
#include "material_vector_parts.hpp"
#include <spam/core/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

namespace spam {
namespace {

// A whole particle is one of the lattice at the start.
constexpr FieldKind stiffness_kind{"whole_particle", Rank::scalar, Role::constant, "1"};
constexpr FieldKind heat_kind{"heat_of_vectors", Rank::scalar, Role::memory, "m l^2/t^2", 100,
                              Quantity::scalar,  Share::sum};
constexpr FieldKind broken_kind{"broken", Rank::scalar, Role::memory, "1"};
constexpr FieldKind breaks_kind{"breaks", Rank::scalar, Role::memory, "1"};
constexpr FieldKind watched_kind{"watched", Rank::scalar, Role::memory, "1"};

template <int Dim>
MaterialVectorScheme validated(const MaterialVectorScheme& scheme, const Particles<Dim>& particles,
                               const HyperelasticMaterial<Dim>& material) {
    check_materials(particles, material.count());
    valid_range<Dim>(scheme.range, particles.spacing, particles.size());
    if (!(scheme.density > 0.0) || !std::isfinite(scheme.density))
        throw InputError(fmt::format(
            "density: {} at the start must be positive; sqrt(4/3) m is that of the triangular lattice",
            scheme.density));
    if (!(scheme.penalty >= 0.0) || !std::isfinite(scheme.penalty))
        throw InputError(fmt::format("penalty: {} must be a number not below 0; try --penalty 2",
                                     scheme.penalty));
    if (!(scheme.weight.reach > 0.0) || !(scheme.weight.power >= 0.0) ||
        !std::isfinite(scheme.weight.reach) || !std::isfinite(scheme.weight.power))
        throw InputError(fmt::format(
            "weight: a reach of {} ranges must be positive, a power of {} not below 0; 1.25 and 4 are usual",
            scheme.weight.reach, scheme.weight.power));
    if (!(scheme.bond_yield >= 0.0) || !std::isfinite(scheme.bond_yield))
        throw InputError(fmt::format(
            "bond_yield: {} must be a number not below 0, in yield strains; try 4, or 0 "
            "for bonds that do not yield",
            scheme.bond_yield));
    if (!(scheme.stretch_limit > 1.0))
        throw InputError(fmt::format(
            "stretch_limit: {} must be above 1; leave it out where bonds do not break by stretch",
            scheme.stretch_limit));
    if (!(scheme.stress_limit > 0.0))
        throw InputError(fmt::format(
            "stress_limit: {} must be above 0; leave it out where bonds do not break by stress",
            scheme.stress_limit));
    if (!material.history().empty())
        throw InputError(fmt::format(
            "material: '{}' remembers its plastic flow from a reference configuration, and material "
            "vectors have none; use --formulation total_lagrangian",
            material.describe()));
    if (!particles.reference_position.allFinite())
        throw InputError("particles: a reference position is not finite");
    return scheme;
}

}  // namespace

template <int Dim>
MaterialVectors<Dim>::~MaterialVectors() = default;

template <int Dim>
MaterialVectors<Dim>::MaterialVectors(const Selection<Dim>& among,
                                      const HyperelasticMaterial<Dim>& material,
                                      const MaterialVectorScheme& scheme)
    : Term<Dim>(among),
      material_(material.of(this->particles())),
      scheme_(validated(scheme, this->particles(), material)) {
    const auto sweeps = at_level(instruction_set(), [&](auto level) {
        return bond_sweeps<Dim, level>(this->box().periodic());
    });
    const auto updates = at_level(instruction_set(), [&](auto level) {
        return bond_updates<Dim, level>(this->box().periodic());
    });
    const Particles<Dim>& all = this->particles();
    parts_ = std::make_unique<Parts>(
        Parts{sweeps, BondTable<Dim>(scheme.range, this->box(), sweeps.lanes, updates,
                                     all.reference_position, all.body, scheme.weight)});
    Parts& p = *parts_;
    const std::size_t n = all.size();
    p.numbers.resize(n);
    std::iota(p.numbers.begin(), p.numbers.end(), 0U);
    p.heat.assign(n, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
        BondFit<Dim, double> sums;
        for (const Bond& bond : bonds_at(p.table.places(all.reference_position.data()), k))
            sums.add(bond.weight, bond.X, bond.X);
        double trace = 0.0;
        for (int a = 0; a < Dim; ++a) trace += sums.N(a, a);
        p.N0 = std::max(p.N0, trace / Dim);
    }
    p.N0 = spam::Parts::here().most(p.N0);
    if (!(p.N0 > 0.0)) throw InputError("range: no particle has a neighbour; widen --range");
    const double stiffest = material.stiffness();
    double least = stiffest;
    p.stiffness = scheme.penalty * stiffest / p.N0;
    if (scheme.bond_yield > 0.0) p.misfit_limit = scheme.bond_yield * material.yield_strain();
    p.brittle = std::min(scheme.stretch_limit, scheme.stress_limit) < HUGE_VAL;
    for (std::size_t k = 0; k < n; ++k) {
        p.volume.push_back(all.mass[k] / scheme.density);
        const double own = material_.law(k).stiffness();
        p.share.push_back(own == stiffest ? 1.0 : own / stiffest);
        least = std::min(least, own);
    }
    least = -spam::Parts::here().most(-least);
    if (scheme.penalty > 0.0 && !(least > 0.0))
        throw InputError(fmt::format(
            "penalty: {} is measured in the material's stiffness, which is {}; use --penalty 0 or "
            "another material",
            scheme.penalty, least));
    p.least_share = least == stiffest ? 1.0 : least / stiffest;
    set_nature();
}

/// P, which stands where G will be, and what follows from it. `whole`: as it was, or false. Returns false
/// where a stress is not finite.
template <int Dim>
bool MaterialVectors<Dim>::close(const BondView<Dim>& view, std::size_t first, std::size_t count,
                                 const ConstState<Dim>& state, double* records, bool& whole) {
    using Record = BondRecord<Dim>;
    if (!material_.stresses({&parts_->numbers[first], count}, Record::numbers, records + Record::F,
                            records + Record::G, state))
        return false;
    const auto spans_of = [&](std::size_t i) {
        return Wholeness::of(numbers_at<SymTensor<Dim>>(records + i * Record::numbers + Record::K),
                             parts_->N0);
    };
    for (std::size_t i = 0; i < count && whole; ++i) whole = !(spans_of(i).slope > 0.0);
    if (!whole) {
        const auto lanes = static_cast<std::size_t>(parts_->sweeps.lanes);
        parts_->table.loops().misfits(view, records, first / lanes,
                                      (first + count + lanes - 1) / lanes);
    }
    for (std::size_t i = 0; i < count; ++i) {
        double* const record = records + i * Record::numbers;
        const auto K = numbers_at<SymTensor<Dim>>(record + Record::K);
        const auto P = numbers_at<Mat<Dim>>(record + Record::G);
        SymTensor<Dim> H;
        const double V = parts_->volume[first + i];
        const Wholeness spans = Wholeness::of(K, parts_->N0);
        const Mat<Dim> G = (V * spans.th) * (P * K);
        std::copy(G.c.begin(), G.c.end(), record + Record::G);
        if (spans.slope > 0.0) {
            const auto F = numbers_at<Mat<Dim>>(record + Record::F);
            Mat<Dim> root;
            for (int a = 0; a < Dim; ++a)
                for (int b = 0; b < Dim; ++b) root(a, b) = K(a, b);
            const Mat<Dim> square = root * K;
            const double by = V * spans.slope *
                              (material_.energy(first + i, F, state) +
                               0.5 * parts_->penalty(first + i) * record[Record::c]);
            for (int a = 0; a < Dim; ++a)
                for (int b = a; b < Dim; ++b) H(a, b) = by * square(a, b);
        }
        record[Record::c] = spans.th * V * parts_->penalty(first + i);
        std::copy(H.c.begin(), H.c.end(), record + Record::H);
    }
    return true;
}

template <int Dim>
std::string MaterialVectors<Dim>::rates(const Now& now) {
    Parts& p = *parts_;
    p.table.load(now.state.position().data());
    const BondSchedule& schedule = p.schedule();
    const BondView<Dim> view = p.view();
    const auto lanes = static_cast<std::size_t>(p.sweeps.lanes);
    std::atomic<bool> finite = true;
    const auto find = [&](std::size_t first, std::size_t last) {
        constexpr std::size_t numbers = BondRecord<Dim>::numbers;
        std::array<double, BondTable<Dim>::block * numbers> records;
        const std::size_t k = first * lanes, filled = std::min(last * lanes, view.particles) - k;
        std::fill(records.data() + filled * numbers,
                  records.data() + (last - first) * lanes * numbers, 0.0);
        p.sweeps.fit(view, records.data(), first, last);
        bool whole = true;
        if (!close(view, k, filled, now.state, records.data(), whole)) finite = false;
        p.sweeps.forces(view, records.data(), whole, now.v_dot, first, last);
    };
    const double* const mass = this->particles().mass.data();
    p.for_blocks(schedule, find, [&](std::size_t first, std::size_t last) {
        p.sweeps.gather(view, mass, now.v_dot, first, last);
    });
    return finite ? std::string() : complaint(now.state);
}

/// Names the first particle whose stress has no meaning.
template <int Dim>
std::string MaterialVectors<Dim>::complaint(const ConstState<Dim>& state) const {
    const auto finite = [](const Mat<Dim>& t) {
        return std::all_of(t.c.begin(), t.c.end(), [](double x) { return std::isfinite(x); });
    };
    const double* const x = parts_->table.places(state.position().data());
    for (const std::uint32_t& k : parts_->numbers) {
        const Mat<Dim> F = fit(x, k).F;
        Mat<Dim> P;
        material_.stresses({&k, 1}, F.c.size(), F.c.data(), P.c.data(), state);
        if (!finite(F) || !finite(P))
            return fmt::format("the {} of particle {} is not finite",
                               finite(F) ? "stress" : "deformation gradient",
                               this->particles().id[k]);
    }
    return "a stress is not finite";
}

template <int Dim>
auto MaterialVectors<Dim>::counts() const -> Counts {
    return {parts_->table.pairs(), parts_->table.updates()};
}

template <int Dim>
void MaterialVectors<Dim>::remember(Memory<Dim>& memory) {
    Parts& p = *parts_;
    memory.run(stiffness_kind, p.N0, p.stiffness);
    memory.particles(heat_kind, p.heat);
    p.table.remember(memory);
    auto excluded = p.excluded;
    memory.pairs(broken_kind, excluded);
    if (memory.reading()) {
        p.keep_own(excluded);
        p.excluded = std::move(excluded);
    }
    memory.run(breaks_kind, p.breaks, p.told);
    memory.run(watched_kind, p.watched, p.warned);
}

template <int Dim>
void MaterialVectors<Dim>::set_nature() {
    auto& nature = this->nature_;
    nature.reach = scheme_.range;
    nature.settles = true;
    // Neighbours come and go with no weight: unless the law flows or bonds break.
    nature.settles_seldom = !material_.flows() && !parts_->brittle;
    // A return to the yield surface makes the order of a fixed step less than the method's.
    nature.smooth = !material_.flows();
    nature.no_rezoning =
        "bonds are what a solid with material vectors remembers, and one that flows through many changes would "
        "forget; use an updated solid, or remake() between two runs";
    nature.no_images = "particles have no bonds with their images behind a wall; use rigid sides";
    std::string words = fmt::format(
        "material vectors, {}, density {:.6g}, range {}, penalty kappa = {}, stable up to a tension "
        "of {:.3g}",
        material_.describe(), scheme_.density, scheme_.range, scheme_.penalty, safe_tension());
    if (parts_->misfit_limit < HUGE_VAL)
        words += fmt::format(", bonds yield at {:g} yield strains", scheme_.bond_yield);
    if (scheme_.stretch_limit < HUGE_VAL)
        words += fmt::format(", bonds break at {:g} times their length", scheme_.stretch_limit);
    if (scheme_.stress_limit < HUGE_VAL)
        words += fmt::format(", bonds break at stress {:g}", scheme_.stress_limit);
    nature.description = words;
}

template class MaterialVectors<2>;
template class MaterialVectors<3>;

}  // namespace spam
