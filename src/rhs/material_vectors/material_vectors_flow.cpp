// SPDX-License-Identifier: GPL-3.0-or-later
// Flow of a solid with material vectors, after accepted steps.
#include "material_vector_parts.hpp"

#include <cmath>

namespace spam {
namespace {

// By V and the stiffness: what new weights may add to the energy of a particle.
constexpr double stored_by_weights = 1e-3;

}  // namespace

/// Particles are looked at by the loops in lanes, and one by one only where they flow.
template <int Dim>
bool MaterialVectors<Dim>::flow(const ConstState<Dim>& state) {
    Parts& p = *parts_;
    const double limit = p.misfit_limit;
    return p.count_particles(
               state.position().data(), limit * limit, HUGE_VAL,
               [&](std::size_t k, const Mat<Dim>& F, bool beyond) -> std::size_t {
                   const bool changed = beyond && flow_of_bonds(k, F, state);
                   return ((changed || material_.flow(k, F)) && flow_of_particle(k, state)) ||
                          changed;
               }) > 0;
}

/// F <- F G, X <- G^-1 X: F X stays. So does g until rows are made anew: then F is the same fit, and rates change by
/// rounding alone.
template <int Dim>
bool MaterialVectors<Dim>::flow_of_particle(std::size_t k, const ConstState<Dim>& state) {
    Parts& p = *parts_;
    const double* const x = p.table.places(state.position().data());
    const Fit before = fit(x, k);
    if (!Wholeness::of(before.K, p.N0).spans()) return false;
    const std::optional<Mat<Dim>> G = material_.flow(k, before.F);
    if (!G) return false;
    const Mat<Dim> back = inverse(*G);
    for (std::size_t m = 0; m < p.table.row(k); ++m)
        p.table.set_bond(k, m, back * p.table.X(k, m), p.table.g(k, m));
    book_loss(k, energy_of(before, k, state), fit(x, k), state);
    return true;
}

/// Where |e| > limit |F X|, X takes up what is beyond, X += F^-1 (e - e'), e' = e limit |F X|/|e|.
template <int Dim>
bool MaterialVectors<Dim>::flow_of_bonds(std::size_t k, const Mat<Dim>& F,
                                         const ConstState<Dim>& state) {
    Parts& p = *parts_;
    const double* const x = p.table.places(state.position().data());
    const double limit = scheme_.bond_yield * material_.law(k).yield_strain();
    const double limit2 = limit * limit, range2 = scheme_.range * scheme_.range;
    // How far the misfit is beyond its limit, as part of it; 0 where it is not.
    const auto excess = [&](const Mat<Dim>& gradient, std::size_t m, Vec<Dim>& e) {
        if (!(p.table.g(k, m) > 0.0)) return 0.0;
        const Vec<Dim> r = p.table.separation(x, k, p.table.partner(k, m));
        if (!(dot(r, r) < range2)) return 0.0;
        const Vec<Dim> FX = gradient * p.table.X(k, m);
        e = r;
        e -= FX;
        const double e2 = dot(e, e), most2 = limit2 * dot(FX, FX);
        return e2 > (1.0 + 1e-10) * most2 ? 1.0 - std::sqrt(most2 / e2) : 0.0;
    };
    Vec<Dim> e;
    std::size_t m = 0;
    while (m < p.table.row(k) && excess(F, m, e) == 0.0) ++m;
    if (m == p.table.row(k)) return false;
    const Fit before = fit(x, k);
    if (!Wholeness::of(before.K, p.N0).spans() || std::abs(determinant(before.F)) < 1e-3)
        return false;
    const Mat<Dim> back = inverse(before.F);
    bool flowed = false;
    for (m = 0; m < p.table.row(k); ++m)
        if (const double part = excess(before.F, m, e); part > 0.0) {
            p.table.set_X(k, m, p.table.X(k, m) + back * (part * e));
            flowed = true;
        }
    if (flowed) book_loss(k, energy_of(before, k, state), before, state);
    return flowed;
}

/// g by the vectors, where these have changed by flow. The fit F then changes by as much as there is misfit, and the
/// energy by little and in both directions. Not where vectors are far from what they were when rows were made:
/// there F may jump, particles may even be turned inside out, and heat would pay for that. Weights stay as they are
/// where they would store more than a little. (To refuse any gain, however small, would leave it to rounding whose
/// weights follow, and motion would not converge with the step.)
template <int Dim>
bool MaterialVectors<Dim>::weigh(const ConstState<Dim>& state) {
    Parts& p = *parts_;
    const double* const x = p.table.places(state.position().data());
    return parallel_count(p.numbers.size(), [&](std::size_t k) -> std::size_t {
               const auto changed = [&](std::size_t m) {
                   const Vec<Dim> X = p.table.X(k, m);
                   const double g = p.table.g(k, m);
                   const double own = scheme_.weight(std::sqrt(dot(X, X)), scheme_.range);
                   return g > 0.0 && std::abs(g - own) > 1e-14;  // rounding apart
               };
               std::size_t m = 0;
               while (m < p.table.row(k) && !changed(m)) ++m;
               if (m == p.table.row(k)) return 0;
               const double before = energy_of(fit(x, k), k, state);
               std::vector<double> weights;
               for (std::size_t n = 0; n < p.table.row(k); ++n) weights.push_back(p.table.g(k, n));
               for (; m < p.table.row(k); ++m)
                   if (changed(m)) p.table.set_X(k, m, p.table.X(k, m));
               const double loss = before - energy_of(fit(x, k), k, state);
               if (loss < -stored_by_weights * p.volume[k] * material_.law(k).stiffness()) {
                   for (std::size_t n = 0; n < p.table.row(k); ++n)
                       p.table.set_bond(k, n, p.table.X(k, n), weights[n]);
                   return 0;
               }
               p.heat[k] += loss;
               return 1;
           }) > 0;
}

#define SPAM_INSTANTIATE(D)                                                                \
    template bool MaterialVectors<D>::flow(const ConstState<D>&);                          \
    template bool MaterialVectors<D>::flow_of_particle(std::size_t, const ConstState<D>&); \
    template bool MaterialVectors<D>::flow_of_bonds(std::size_t, const Mat<D>&,            \
                                                    const ConstState<D>&);                 \
    template bool MaterialVectors<D>::weigh(const ConstState<D>&);
SPAM_INSTANTIATE(2)
SPAM_INSTANTIATE(3)

}  // namespace spam
