// SPDX-License-Identifier: GPL-3.0-or-later
// What is not done in every right-hand side: of all particles in lanes, of single ones in plain numbers.
#include "material_vector_parts.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>

#include <algorithm>
#include <cmath>

namespace spam {

template <int Dim>
typename MaterialVectors<Dim>::Fit MaterialVectors<Dim>::fit(const double* x, std::size_t k) const {
    const BondTable<Dim>& table = parts_->table;
    const auto weight = [&](std::size_t m, const Vec<Dim>& r) {
        return table.g(k, m) * BondFade<double>(dot(r, r), 1.0 / scheme_.range).s;
    };
    BondFit<Dim, double> sums;
    for (std::size_t m = 0; m < table.row(k); ++m) {
        const Vec<Dim> r = table.separation(x, k, table.partner(k, m));
        sums.add(weight(m, r), r, table.X(k, m));
    }
    Fit fit;
    const FitSolver<Dim, double> solver(sums.N, FitSolver<Dim, double>::little(parts_->N0));
    fit.K = solver.inverse();
    fit.F = solver.divided(sums.A);
    for (std::size_t m = 0; m < table.row(k); ++m) {
        const Vec<Dim> r = table.separation(x, k, table.partner(k, m));
        Vec<Dim> e = r;
        e -= fit.F * table.X(k, m);
        fit.misfit += weight(m, r) * dot(e, e);
    }
    return fit;
}

template <int Dim>
double MaterialVectors<Dim>::energy_of(const Fit& fit, std::size_t k,
                                       const ConstState<Dim>& state) const {
    const double V = parts_->volume[k], th = Wholeness::of(fit.K, parts_->N0).th;
    if (th == 0.0) return 0.0;
    return V * th * (material_.energy(k, fit.F, state) + 0.5 * parts_->penalty(k) * fit.misfit);
}

template <int Dim>
std::vector<double> MaterialVectors<Dim>::energies(const ConstState<Dim>& state) const {
    std::vector<double> energies(parts_->numbers.size());
    parts_->each_fit(state.position().data(), [&](std::size_t k, const Fit& fit) {
        energies[k] = energy_of(fit, k, state);
    });
    return energies;
}

template <int Dim>
auto MaterialVectors<Dim>::answer(Ask what, std::span<const double> y) const -> Answer {
    if (what == Ask::energy) {
        const auto stored = energies(this->state_of(y));
        const auto [energy, heat] = exact_sums(stored.size(), [&](std::size_t k) {
            return std::array<double, 2>{stored[k], parts_->heat[k]};
        });
        return {energy + heat};
    }
    Answer found = Term<Dim>::answer(what, y);
    if (what != Ask::density && what != Ask::deformation) return found;
    found.deformation.resize(parts_->numbers.size());
    parts_->each_fit(this->state_of(y).position().data(),
                     [&](std::size_t k, const Fit& fit) { found.deformation[k] = fit.F; });
    if (what == Ask::density)
        for (const Mat<Dim>& F : found.deformation)
            found.density.push_back(scheme_.density / determinant(F));
    return found;
}

template <int Dim>
double MaterialVectors<Dim>::heat() const {
    return exact_sum(parts_->heat.size(), [&](std::size_t k) { return parts_->heat[k]; });
}

template <int Dim>
const std::vector<double>& MaterialVectors<Dim>::heat_of_particles() const {
    return parts_->heat;
}

template <int Dim>
bool MaterialVectors<Dim>::settle(double, const State<Dim>& state) {
    const ConstState<Dim> now(state);
    bool changed = material_.flows() && flow(now);
    if (parts_->brittle) changed = break_bonds(now) || changed;
    if (!parts_->table.serves(state.position())) {
        if (material_.flows()) changed = weigh(now) || changed;
        changed = update(now) || changed;
    }
    return changed;
}

/// Whether a particle has entered that weighs something: else the rates are the same bits as before.
template <int Dim>
bool MaterialVectors<Dim>::update(const ConstState<Dim>& state) {
    Parts& p = *parts_;
    p.table.renew(state.position(), p.N0);
    const double* const x = p.table.places(state.position().data());
    const auto anchored = [&](const auto& bond) { return p.table.anchoring(bond.k) * bond.r; };
    const auto weighs = [&](const auto& bond) {
        const Vec<Dim> X = anchored(bond);
        return dot(bond.r, bond.r) < scheme_.range * scheme_.range &&
               scheme_.weight(std::sqrt(dot(X, X)), scheme_.range) > 0.0;
    };
    std::vector<std::uint32_t> changed;  // particles whose sums are others
    for (const auto* bonds : {&p.table.newcomers(), &p.table.idle()})
        for (const auto& bond : *bonds)
            if (weighs(bond) && !p.excludes(bond.k, bond.j)) changed.push_back(bond.k);
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    std::vector<Fit> before(changed.size());
    parallel_for(changed.size(), [&](std::size_t n) { before[n] = fit(x, changed[n]); });
    p.table.admit();
    for (const auto* bonds : {&p.table.newcomers(), &p.table.idle()})
        parallel_for(bonds->size(), [&](std::size_t n) {
            const auto& bond = (*bonds)[n];
            p.table.set_X(bond.k, bond.row, anchored(bond));
        });
    exclude(x);
    parallel_for(changed.size(), [&](std::size_t n) {
        book_loss(changed[n], energy_of(before[n], changed[n], state), before[n], state);
    });
    return !changed.empty();
}

/// Bonds that no change concerns are the same bits, and their particles lose exactly nothing. What merged particles
/// moved about their centre is heat.
template <int Dim>
void MaterialVectors<Dim>::take_over(const Term<Dim>& before, const ConstState<Dim>& was,
                                     const Change<Dim>& change, const State<Dim>& now) {
    if (std::ranges::any_of(change.parts, Population<Dim>::is_twin))
        throw InputError(
            "population: particles with material vectors cannot be merged into two, which would turn about each other "
            "against their bonds; merge them into one");
    const auto& from = dynamic_cast<const MaterialVectors&>(before);
    Parts& p = *parts_;
    const double *const x = now.position().data(), *const x_was = was.position().data();
    for (std::size_t k = 0; k < change.parts.size(); ++k)
        for (std::size_t m = 0; m < p.table.row(k); ++m)
            if (p.table.g(k, m) > 0.0 && !(change.same(k) && change.same(p.table.partner(k, m))))
                p.table.set_X(k, m, p.table.X(k, m));
    exclude(x);
    const auto v = now.velocity();
    const auto v_was = was.velocity();
    parallel_for(change.parts.size(), [&](std::size_t k) {
        Fit kept;
        double energy = 0.0;
        for (const auto& part : change.parts[k]) {
            const auto a = static_cast<Eigen::Index>(part.particle);
            const Fit fit = from.fit(x_was, part.particle);
            energy += part.of * from.energy_of(fit, part.particle, was);
            kept.F += part.share * fit.F;
            kept.K = fit.K;
            p.heat[k] += 0.5 * part.of * from.particles().mass[part.particle] *
                         (v_was.col(a) - v.col(static_cast<Eigen::Index>(k))).squaredNorm();
        }
        book_loss(k, energy, kept, now);
    });
    update(now);
}

template <int Dim>
auto MaterialVectors<Dim>::bonds(std::span<const double> y, std::size_t k) const
    -> std::vector<Bond> {
    return bonds_at(parts_->table.places(this->state_of(y).position().data()), k);
}

template <int Dim>
auto MaterialVectors<Dim>::bonds_at(const double* x, std::size_t k) const -> std::vector<Bond> {
    const BondTable<Dim>& table = parts_->table;
    std::vector<Bond> bonds;
    for (std::size_t m = 0; m < table.row(k); ++m) {
        if (table.vacant(k, m)) continue;
        const std::uint32_t j = table.partner(k, m);
        const Vec<Dim> r = table.separation(x, k, j);
        bonds.push_back(
            {j, table.X(k, m), table.g(k, m) * BondFade<double>(dot(r, r), 1.0 / scheme_.range).s});
    }
    return bonds;
}

#define SPAM_INSTANTIATE(D)                                                                      \
    template MaterialVectors<D>::Fit MaterialVectors<D>::fit(const double*, std::size_t) const;  \
    template double MaterialVectors<D>::energy_of(const Fit&, std::size_t, const ConstState<D>&) \
        const;                                                                                   \
    template std::vector<double> MaterialVectors<D>::energies(const ConstState<D>&) const;       \
    template MaterialVectors<D>::Answer MaterialVectors<D>::answer(Ask, std::span<const double>) \
        const;                                                                                   \
    template double MaterialVectors<D>::heat() const;                                            \
    template const std::vector<double>& MaterialVectors<D>::heat_of_particles() const;           \
    template bool MaterialVectors<D>::settle(double, const State<D>&);                           \
    template bool MaterialVectors<D>::update(const ConstState<D>&);                              \
    template void MaterialVectors<D>::take_over(const Term<D>&, const ConstState<D>&,            \
                                                const Change<D>&, const State<D>&);              \
    template std::vector<MaterialVectors<D>::Bond> MaterialVectors<D>::bonds(                    \
        std::span<const double>, std::size_t) const;                                             \
    template std::vector<MaterialVectors<D>::Bond> MaterialVectors<D>::bonds_at(                 \
        const double*, std::size_t) const;
SPAM_INSTANTIATE(2)
SPAM_INSTANTIATE(3)

}  // namespace spam
