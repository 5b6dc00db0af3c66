// SPDX-License-Identifier: GPL-3.0-or-later
// Brittle bonds of a solid with material vectors, after accepted steps.
#include "material_vector_parts.hpp"
#include <spam/core/exact_sum.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace spam {

/// P F^t of a particle, by the law of the rates; 0 where F means nothing.
template <int Dim>
SymTensor<Dim> MaterialVectors<Dim>::kirchhoff_stress(std::size_t k,
                                                      const ConstState<Dim>& state) const {
    SymTensor<Dim> tau;
    const Fit now = fit(parts_->table.places(state.position().data()), k);
    const Wholeness whole = Wholeness::of(now.K, parts_->N0);
    if (!whole.spans()) return tau;
    Mat<Dim> P;
    material_.stresses({&parts_->numbers[k], 1}, now.F.c.size(), now.F.c.data(), P.c.data(), state);
    for (int a = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b)
            for (int c = 0; c < Dim; ++c) tau(a, b) += whole.th * P(a, c) * now.F(b, c);
    return tau;
}

/// Takes the weight from both bonds of every pair beyond a limit.
template <int Dim>
bool MaterialVectors<Dim>::break_bonds(const ConstState<Dim>& state) {
    Parts& p = *parts_;
    const std::size_t n = p.numbers.size();
    const double stretch2 = scheme_.stretch_limit * scheme_.stretch_limit,
                 range2 = scheme_.range * scheme_.range;
    const bool by_stress = scheme_.stress_limit < HUGE_VAL;
    p.breaking.assign(n, 0);
    bool any = p.count_particles(state.position().data(), HUGE_VAL, stretch2,
                                 [&](std::size_t k, const Mat<Dim>&, bool beyond) -> std::size_t {
                                     p.breaking[k] = beyond;
                                     return beyond;
                                 }) > 0;
    const OtherPartners& others = p.table.others();
    const double* const x = p.table.places(state.position().data());
    p.tau.resize(by_stress ? others.places() : 0);
    if (by_stress) {
        parallel_for(n, [&](std::size_t k) { p.tau[k] = kirchhoff_stress(k, state); });
        others.fetch<SymTensor<Dim>>([&](std::size_t k) { return p.tau[k]; },
                                     [&](std::size_t j, const auto& tau) { p.tau[j] = tau; });
    }
    const auto breaks = [&](std::size_t k, std::size_t m) {
        if (!(p.table.g(k, m) > 0.0)) return false;
        const std::uint32_t j = p.table.partner(k, m);
        const Vec<Dim> r = p.table.separation(x, k, j), X = p.table.X(k, m);
        const double r2 = dot(r, r);
        if (!(r2 < range2)) return false;
        return r2 > stretch2 * dot(X, X) ||
               (by_stress && dot(r, (p.tau[k] + p.tau[j]) * r) > 2.0 * scheme_.stress_limit * r2);
    };
    if (by_stress)
        any = parallel_count(n, [&](std::size_t k) -> std::size_t {
                  for (std::size_t m = 0; m < p.table.row(k); ++m)
                      if (breaks(k, m)) p.breaking[k] = 1;
                  return p.breaking[k];
              }) > 0;
    spam::Parts& run = spam::Parts::here();
    if (!run.any(any)) return false;

    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (std::uint32_t k = 0; k < n; ++k)
        if (p.breaking[k] != 0)
            for (std::size_t m = 0; m < p.table.row(k); ++m)
                if (breaks(k, m)) pairs.push_back(p.pair_of(k, p.table.partner(k, m)));
    p.add_other_pairs(pairs);
    if (pairs.empty()) return false;
    p.breaks.pairs += pairs.size();
    p.keep_own(pairs);
    std::vector<std::uint32_t> ends;
    for (const auto& pair : pairs)
        for (const std::uint32_t number : pair)
            if (const std::uint32_t k = others.place(number); p.is_own(k)) ends.push_back(k);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());

    std::vector<Fit> before(ends.size());
    parallel_for(ends.size(), [&](std::size_t e) { before[e] = fit(x, ends[e]); });
    for (const auto& pair : pairs) p.part(pair);
    std::vector<double> loss(ends.size());
    parallel_for(ends.size(), [&](std::size_t e) {
        const std::size_t k = ends[e];
        const double energy = energy_of(before[e], k, state);
        loss[e] = book_loss(k, energy, before[e], state);
    });
    const auto gain = [&](std::size_t e) { return std::max(-loss[e], 0.0); };
    p.breaks.gains += run.total(
        parallel_count(loss.size(), [&](std::size_t e) -> std::size_t { return gain(e) > 0.0; }));
    p.breaks.gained += exact_sum(loss.size(), gain);
    p.excluded.insert(p.excluded.end(), pairs.begin(), pairs.end());
    std::sort(p.excluded.begin(), p.excluded.end());
    return true;
}

/// Books what a change of its bonds has taken off the energy of a particle, and returns it. Another fit of F may
/// store more, and heat would fall: F then stays as it was, by vectors without misfit to it; and what has too few
/// bonds for that, or weighs more so, forgets its strain.
template <int Dim>
double MaterialVectors<Dim>::book_loss(std::size_t k, double energy, const Fit& kept,
                                       const ConstState<Dim>& state) {
    const double* const x = parts_->table.places(state.position().data());
    const double rounding = 1e-12 * parts_->volume[k] * material_.law(k).stiffness();
    const auto loss = [&] { return energy - energy_of(fit(x, k), k, state); };
    double lost = loss();
    if (lost < -rounding && anchor(k, kept, x)) lost = loss();
    if (lost < -rounding) {
        anchor(k, {}, x);
        lost = loss();
    }
    parts_->heat[k] += lost;
    return lost;
}

/// X = F^-1 r for all bonds, which leaves them their weights; X = r where there is no F^-1. Returns whether there is.
template <int Dim>
bool MaterialVectors<Dim>::anchor(std::size_t k, const Fit& fit, const double* x) {
    BondTable<Dim>& table = parts_->table;
    const bool invertible =
        std::abs(determinant(fit.F)) > 1e-3 && Wholeness::of(fit.K, parts_->N0).spans();
    Mat<Dim> back;
    for (int a = 0; a < Dim; ++a) back(a, a) = 1.0;
    if (invertible) back = inverse(fit.F);
    for (std::size_t m = 0; m < table.row(k); ++m)
        table.set_bond(k, m, back * table.separation(x, k, table.partner(k, m)), table.g(k, m));
    return invertible;
}

template <int Dim>
void MaterialVectors<Dim>::Parts::add_other_pairs(
    std::vector<std::array<std::uint32_t, 2>>& pairs) const {
    if (!table.others().none()) {
        const auto of_all =
            spam::Parts::here().gather(std::span<const std::array<std::uint32_t, 2>>(pairs));
        pairs.clear();
        for (const auto& some : of_all) pairs.insert(pairs.end(), some.begin(), some.end());
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

template <int Dim>
void MaterialVectors<Dim>::Parts::keep_own(std::vector<std::array<std::uint32_t, 2>>& pairs) const {
    const auto own = [&](std::uint32_t number) { return is_own(table.others().place(number)); };
    std::erase_if(pairs, [&](const auto& pair) { return !own(pair[0]) && !own(pair[1]); });
}

/// After rows have been made anew: pairs that have broken weigh nothing until they have been apart.
template <int Dim>
void MaterialVectors<Dim>::exclude(const double* x) {
    Parts& p = *parts_;
    const auto apart = [&](const std::array<std::uint32_t, 2>& pair) {
        const std::uint32_t a = p.table.others().place(pair[0]),
                            b = p.table.others().place(pair[1]);
        if (a == OtherPartners::nowhere || b == OtherPartners::nowhere) return true;
        const Vec<Dim> r = p.table.separation(x, a, b);
        if (dot(r, r) >= scheme_.range * scheme_.range) return true;
        p.part(pair);
        return false;
    };
    p.excluded.erase(std::remove_if(p.excluded.begin(), p.excluded.end(), apart), p.excluded.end());
}

template <int Dim>
void MaterialVectors<Dim>::tell_breaks(std::vector<Remark>& remarks) {
    const BondBreaks& breaks = parts_->breaks;
    std::size_t& told = parts_->told;
    if (breaks.pairs == 0 || breaks.pairs < 2 * told) return;
    told = breaks.pairs;
    // Filled in place: GCC 12 wrongly warns of a string that is moved out of a temporary.
    const auto tell = [&](const char* what, double value) {
        Remark& remark = remarks.emplace_back();
        remark.what = what;
        remark.value = value;
    };
    tell("pairs of particles whose bond has broken", static_cast<double>(told));
    if (breaks.gains > 0) tell("energy that breaking bonds have taken from heat", breaks.gained);
}

template <int Dim>
const BondBreaks& MaterialVectors<Dim>::breaks() const {
    return parts_->breaks;
}

#define SPAM_INSTANTIATE(D)                                                                       \
    template SymTensor<D> MaterialVectors<D>::kirchhoff_stress(std::size_t, const ConstState<D>&) \
        const;                                                                                    \
    template bool MaterialVectors<D>::break_bonds(const ConstState<D>&);                          \
    template double MaterialVectors<D>::book_loss(std::size_t, double, const Fit&,                \
                                                  const ConstState<D>&);                          \
    template bool MaterialVectors<D>::anchor(std::size_t, const Fit&, const double*);             \
    template void MaterialVectors<D>::Parts::keep_own(std::vector<std::array<std::uint32_t, 2>>&) \
        const;                                                                                    \
    template void MaterialVectors<D>::exclude(const double*);                                     \
    template void MaterialVectors<D>::tell_breaks(std::vector<Remark>&);                          \
    template const BondBreaks& MaterialVectors<D>::breaks() const;
SPAM_INSTANTIATE(2)
SPAM_INSTANTIATE(3)

}  // namespace spam
