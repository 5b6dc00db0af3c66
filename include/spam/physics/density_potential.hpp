// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/lanes.hpp>
#include <spam/core/tensor.hpp>
#include <spam/kernel/weight_function.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string>
#include <vector>

/// Potentials of the density, [HH07] 6 to 8: energies that depend on the particles' places through
/// the summed density and its derivatives at the particles,
///     Phi = sum_i phi(f_i),   f_i = sum_j m_j K(r_ij),   K = w, grad w, or second derivatives of w.
/// With G_i = d phi/d f_i the forces are
///     F_i = -d Phi/d r_i = -sum_j (m_j G_i +- m_i G_j) . grad_i K(r_ij),   + for even K, - for odd K:
/// equal and opposite for every pair, and, as Phi does not know how space is turned, without torque on
/// the whole. Two sums over pairs, in double: for set-up, tests and as the oracle of passes.
namespace spam {

/// The weight function at r_ij, seen from i.
template <int Dim, class T = double>
struct WeightAt {
    Vec<Dim, T> r_ij;
    Vec<Dim, T> n;    ///< r_ij/r; zero where the particles coincide
    T value;          ///< w
    T slope_over_r;   ///< w'/r
    T second;         ///< w''
    T second_over_r;  ///< (w'' - w'/r)/r, without the part that is the same in all directions; zero
                      ///< where the particles coincide
    T third;          ///< w'''

    template <SmoothWeightFunction Weight>
    WeightAt(const Weight& weight, const Vec<Dim, T>& separation)
        : WeightAt(weight, separation, dot(separation, separation),
                   std::sqrt(dot(separation, separation))) {}
    template <SmoothWeightFunction Weight>
    SPAM_INLINE WeightAt(const Weight& weight, const Vec<Dim, T>& separation, const T& r2,
                         const T& r)
        : r_ij(separation) {
        const T inverse_r = r / (r2 + T(1e-300));  // zero at r = 0, without a branch
        n = inverse_r * r_ij;
        value = weight.value(r);
        slope_over_r = -weight.minus_slope_over_r(r);
        second = weight.second_derivative(r);
        second_over_r = (second - slope_over_r) * inverse_r;
        third = weight.third_derivative(r);
    }
};

/// One potential of the density: `name`; `density_derivatives`, how often the density is
/// differentiated in K; `parity` of K, 1 or -1; `Field`, what f_i is: a number, a Vec or a SymTensor.
/// `weigh` gives K, `energy` phi, `slope` G, and `pull` the vector G . grad_i K. Sums over pairs
/// (physics/density_passes.hpp) need `weigh` and `pull` over the arithmetic type T as well.
template <class Term, int Dim>
concept DensityTerm = requires(const Term term, const WeightAt<Dim>& at, double mass,
                               const typename Term::template Field<Dim>& f) {
    { Term::name } -> std::convertible_to<std::string>;
    { Term::density_derivatives } -> std::convertible_to<int>;
    { Term::parity } -> std::convertible_to<double>;
    { Term::template weigh<Dim>(at) } -> std::same_as<typename Term::template Field<Dim>>;
    { term.template energy<Dim>(mass, f) } -> std::same_as<double>;
    { term.template slope<Dim>(mass, f) } -> std::same_as<typename Term::template Field<Dim>>;
    { Term::template pull<Dim>(f, at) } -> std::same_as<Vec<Dim>>;
};

/// Forces are continuous only where one more derivative of w is than the density's in the potential.
/// Throws InputError otherwise, and where the potential needs more dimensions.
template <int Dim, DensityTerm<Dim> Term, SmoothWeightFunction Weight>
void check_smooth_enough(const Term& term, const Weight& weight) {
    (void)term;
    const int needed = Term::density_derivatives + 1;
    if (weight.continuous_derivatives < needed)
        throw InputError(fmt::format(
            "kernel: a {} potential needs a weight function with {} continuous derivatives, this "
            "one "
            "has {}: forces would jump where a neighbour passes the range; use w{} or smoother",
            Term::name, needed, int(weight.continuous_derivatives), needed + 1));
    if constexpr (requires { Term::least_dimension; })
        if (Dim < Term::least_dimension)
            throw InputError(
                fmt::format("potential: a {} potential is always zero in {} dimension; it "
                            "needs {} or more",
                            Term::name, Dim, int(Term::least_dimension)));
}

template <int Dim>
struct EnergyAndForces {
    double energy = 0.0;
    Points<Dim> force;  ///< Dim x N

    EnergyAndForces& operator+=(const EnergyAndForces& o) {
        energy += o.energy;
        force += o.force;
        return *this;
    }
};

/// Particles and which are near each other: `position` Dim x N, `mass` N; the list's reach must not be below the
/// range. Refers to what it is made of.
template <int Dim>
struct ListedParticles {
    const Points<Dim>& position;
    std::span<const double> mass;
    const PairList<Dim>& pairs;
    const Box<Dim>& box;

    std::size_t size() const { return mass.size(); }
    /// r_i - r_j
    Vec<Dim> separation(std::size_t i, std::size_t j) const {
        const Point<Dim> r = box.nearest(position.col(static_cast<Eigen::Index>(i)) -
                                         position.col(static_cast<Eigen::Index>(j)));
        return numbers_at<Vec<Dim>>(r.data());
    }
};

/// f_i of all particles. The particle itself is counted.
template <int Dim, DensityTerm<Dim> Term, SmoothWeightFunction Weight>
std::vector<typename Term::template Field<Dim>> density_fields(const Term&, const Weight& weight,
                                                               const ListedParticles<Dim>& near) {
    std::vector<typename Term::template Field<Dim>> f(near.size());
    for (std::size_t i = 0; i < near.size(); ++i)
        for (const std::uint32_t j : near.pairs.neighbours(i)) {
            const WeightAt<Dim> at(weight, near.separation(i, j));
            f[i] = f[i] + near.mass[j] * Term::template weigh<Dim>(at);
        }
    return f;
}

/// Phi and F of one potential. A density outside the law of `term` makes both NaN. Throws InputError
/// as check_smooth_enough() does.
template <int Dim, DensityTerm<Dim> Term, SmoothWeightFunction Weight>
EnergyAndForces<Dim> energy_and_forces(const Term& term, const Weight& weight,
                                       const ListedParticles<Dim>& near) {
    check_smooth_enough<Dim>(term, weight);
    const auto f = density_fields<Dim>(term, weight, near);
    std::vector<typename Term::template Field<Dim>> G(near.size());
    ExactSum energy;
    for (std::size_t i = 0; i < near.size(); ++i) {
        energy += term.template energy<Dim>(near.mass[i], f[i]);
        G[i] = term.template slope<Dim>(near.mass[i], f[i]);
    }
    EnergyAndForces<Dim> result{energy, Points<Dim>(Dim, near.position.cols())};
    for (std::size_t i = 0; i < near.size(); ++i) {
        Vec<Dim> F;
        for (const std::uint32_t j : near.pairs.neighbours(i)) {
            if (j == i) continue;
            const WeightAt<Dim> at(weight, near.separation(i, j));
            F -= Term::template pull<Dim>(
                near.mass[j] * G[i] + (Term::parity * near.mass[i]) * G[j], at);
        }
        for (int a = 0; a < Dim; ++a) result.force(a, static_cast<Eigen::Index>(i)) = F[a];
    }
    return result;
}

}  // namespace spam
