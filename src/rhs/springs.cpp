// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/rhs/springs.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

template <int Dim>
Springs<Dim>::Springs(const Selection<Dim>& among, const HarmonicSpring& spring)
    : Term<Dim>(among),
      spring_(spring),
      bond_reach_(1.2 * this->particles().spacing) {
    const PairList<Dim> list(this->particles().reference_position, bond_reach_, this->box());
    start_.push_back(0);
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (const std::uint32_t j : list.neighbours(i))
            if (j != i) partner_.push_back(j);
        start_.push_back(partner_.size());
    }
}

/// Nearest image of x_i - x_j.
template <int Dim>
template <class View>
Point<Dim> Springs<Dim>::bond(const View& x, std::size_t i, std::size_t j) const {
    Point<Dim> r;
    for (int a = 0; a < Dim; ++a) {
        const auto ci = static_cast<Eigen::Index>(i), cj = static_cast<Eigen::Index>(j);
        r[a] = this->box().periodic(a)
                   ? this->box().nearest_image(
                         a, this->box().wrap(a, x(a, ci)) - this->box().wrap(a, x(a, cj)))
                   : x(a, ci) - x(a, cj);
    }
    return r;
}

template <int Dim>
std::string Springs<Dim>::rates(const Now& now) {
    const auto x = now.state.position();
    Eigen::Map<Points<Dim>> v_dot(now.v_dot, Dim, x.cols());
    parallel_for(this->particles().size(), [&](std::size_t i) {
        Point<Dim> force = Point<Dim>::Zero();
        for (std::size_t k = start_[i]; k < start_[i + 1]; ++k) {
            const Point<Dim> r_ij = bond(x, i, partner_[k]);
            const double r = r_ij.norm();
            force += (spring_.force(r) / r) * r_ij;
        }
        v_dot.col(static_cast<Eigen::Index>(i)) = force / this->particles().mass[i];
    });
    return {};
}

template <int Dim>
double Springs<Dim>::energy(std::span<const double> y) const {
    const auto x = this->state_of(y).position();
    ExactSum sum;
    for (std::size_t i = 0; i < this->particles().size(); ++i)
        for (std::size_t k = start_[i]; k < start_[i + 1]; ++k)
            if (partner_[k] > i) sum += spring_.energy(bond(x, i, partner_[k]).norm());
    return sum;
}

template <int Dim>
double Springs<Dim>::neighbour_forces(std::span<const double> y) const {
    const auto x = this->state_of(y).position();
    ExactSum sum;
    for (std::size_t i = 0; i < this->particles().size(); ++i)
        for (std::size_t k = start_[i]; k < start_[i + 1]; ++k)
            sum += std::abs(spring_.force(bond(x, i, partner_[k]).norm()));
    return sum;
}

template <int Dim>
std::vector<SymTensor<Dim>> Springs<Dim>::stress(std::span<const double> y, double volume) const {
    const auto x = this->state_of(y).position();
    std::vector<SymTensor<Dim>> all(this->particles().size());
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t k = start_[i]; k < start_[i + 1]; ++k) {
            const Point<Dim> r_ij = bond(x, i, partner_[k]);
            const double r = r_ij.norm(), tension = -spring_.force(r) / (2.0 * volume * r);
            for (int a = 0; a < Dim; ++a)
                for (int b = a; b < Dim; ++b) all[i](a, b) += tension * r_ij[a] * r_ij[b];
        }
    return all;
}

template <int Dim>
void Springs<Dim>::take_over(const Term<Dim>& /*before*/, const ConstState<Dim>& /*was*/,
                             const Change<Dim>& change, const ConstState<Dim>& /*now*/) {
    for (std::size_t k = 0; k < change.parts.size(); ++k)
        if (!change.same(k))
            throw InputError(fmt::format(
                "population: all springs have one length, and those of particle {} would have others "
                "once it is split or merged; it can be removed only",
                change.id[change.parts[k].front().particle]));
}

template <int Dim>
std::string Springs<Dim>::describe() const {
    return fmt::format(
        "molecular dynamics, {} harmonic springs kappa = {:g}, rest length {:g}, between initial "
        "neighbours",
        pairs(), spring_.kappa, spring_.rest_length);
}

template class Springs<1>;
template class Springs<2>;
template class Springs<3>;

}  // namespace spam
