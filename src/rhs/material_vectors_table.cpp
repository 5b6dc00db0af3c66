// SPDX-License-Identifier: GPL-3.0-or-later
// What is not done in every right-hand side: in plain numbers, particle by particle.
#include "material_vector_parts.hpp"
#include <spam/core/sums.hpp>

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
    const FitSolver<Dim, double> solver(sums.N, parts_->little());
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
    const double misfit = 0.5 * V * parts_->stiffness * fit.misfit;
    return th == 0.0 ? misfit : V * th * material_.energy(k, fit.F, state) + misfit;
}

template <int Dim>
std::vector<double> MaterialVectors<Dim>::energies(const ConstState<Dim>& state) const {
    const double* const x = state.position().data();
    std::vector<double> energies(parts_->numbers.size());
    parallel_for(energies.size(),
                 [&](std::size_t k) { energies[k] = energy_of(fit(x, k), k, state); });
    return energies;
}

template <int Dim>
double MaterialVectors<Dim>::energy(std::span<const double> y) const {
    CompensatedSum sum;
    for (const double energy : energies(this->state_of(y))) sum += energy;
    sum += heat();
    return sum;
}

template <int Dim>
double MaterialVectors<Dim>::heat() const {
    CompensatedSum sum;
    for (const double heat : parts_->heat) sum += heat;
    return sum;
}

template <int Dim>
bool MaterialVectors<Dim>::settle(double, const State<Dim>& state) {
    const bool flowed = material_.flows() && flow(ConstState<Dim>(state));
    return (!parts_->table.serves(state.position()) && update(ConstState<Dim>(state))) || flowed;
}

/// F <- F G, X <- G^-1 X: F X stays.
template <int Dim>
bool MaterialVectors<Dim>::flow(const ConstState<Dim>& state) {
    Parts& p = *parts_;
    const double* const x = state.position().data();
    return parallel_count(p.numbers.size(), [&](std::size_t k) -> std::size_t {
               const Fit before = fit(x, k);
               if (!Wholeness::of(before.K, p.N0).spans()) return 0;
               const std::optional<Mat<Dim>> G = material_.flow(before.F);
               if (!G) return 0;
               const Mat<Dim> back = inverse(*G);
               for (std::size_t m = 0; m < p.table.row(k); ++m)
                   p.table.set_X(k, m, back * p.table.X(k, m));
               p.heat[k] += energy_of(before, k, state) - energy_of(fit(x, k), k, state);
               return 1;
           }) > 0;
}

/// Whether somebody has entered who weighs something: else the rates are the same bits as before.
template <int Dim>
bool MaterialVectors<Dim>::update(const ConstState<Dim>& state) {
    Parts& p = *parts_;
    const double* const x = state.position().data();
    const std::size_t n = p.numbers.size();
    std::vector<Mat<Dim>> back(n);  // F^-1
    std::vector<double> before(n);
    parallel_for(n, [&](std::size_t k) {
        const Fit now = fit(x, k);
        before[k] = energy_of(now, k, state);
        // Where neighbours do not span space there is no F^-1, and r is as good as any.
        if (Wholeness::of(now.K, p.N0).spans() && std::abs(determinant(now.F)) > 1e-3)
            back[k] = inverse(now.F);
        else
            for (int a = 0; a < Dim; ++a) back[k](a, a) = 1.0;
    });
    std::vector<unsigned char> entered(n, 0);
    const double range2 = scheme_.range * scheme_.range;
    p.table.update(state.position(), [&](std::size_t k, const Vec<Dim>& r) {
        const Vec<Dim> X = back[k] * r;
        if (dot(r, r) < range2 && scheme_.weight(std::sqrt(dot(X, X)), scheme_.range) > 0.0)
            entered[k] = 1;
        return X;
    });
    return parallel_count(n, [&](std::size_t k) -> std::size_t {
               if (entered[k] == 0) return 0;
               p.heat[k] += before[k] - energy_of(fit(x, k), k, state);
               return 1;
           }) > 0;
}

template <int Dim>
std::vector<Mat<Dim>> MaterialVectors<Dim>::deformation_gradients(std::span<const double> y) const {
    const double* const x = this->state_of(y).position().data();
    std::vector<Mat<Dim>> F(parts_->numbers.size());
    parallel_for(F.size(), [&](std::size_t k) { F[k] = fit(x, k).F; });
    return F;
}

template <int Dim>
std::vector<double> MaterialVectors<Dim>::density(std::span<const double> y) const {
    std::vector<double> rho;
    for (const Mat<Dim>& F : deformation_gradients(y))
        rho.push_back(scheme_.density / determinant(F));
    return rho;
}

template <int Dim>
auto MaterialVectors<Dim>::bonds(std::span<const double> y, std::size_t k) const
    -> std::vector<Bond> {
    return bonds_at(this->state_of(y).position().data(), k);
}

template <int Dim>
auto MaterialVectors<Dim>::bonds_at(const double* x, std::size_t k) const -> std::vector<Bond> {
    const BondTable<Dim>& table = parts_->table;
    std::vector<Bond> bonds;
    for (std::size_t m = 0; m < table.row(k); ++m) {
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
    template double MaterialVectors<D>::energy(std::span<const double>) const;                   \
    template double MaterialVectors<D>::heat() const;                                            \
    template bool MaterialVectors<D>::settle(double, const State<D>&);                           \
    template bool MaterialVectors<D>::flow(const ConstState<D>&);                                \
    template bool MaterialVectors<D>::update(const ConstState<D>&);                              \
    template std::vector<Mat<D>> MaterialVectors<D>::deformation_gradients(                      \
        std::span<const double>) const;                                                          \
    template std::vector<double> MaterialVectors<D>::density(std::span<const double>) const;     \
    template std::vector<MaterialVectors<D>::Bond> MaterialVectors<D>::bonds(                    \
        std::span<const double>, std::size_t) const;                                             \
    template std::vector<MaterialVectors<D>::Bond> MaterialVectors<D>::bonds_at(                 \
        const double*, std::size_t) const;
SPAM_INSTANTIATE(2)
SPAM_INSTANTIATE(3)
#undef SPAM_INSTANTIATE

}  // namespace spam
