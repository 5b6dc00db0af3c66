// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/physics/record.hpp>
#include <spam/rhs/springs.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {
namespace {

template <int Dim>
using Positions = RecordOf<Dim, double, column::Position>;

}  // namespace

template <int Dim>
Springs<Dim>::Springs(const Selection<Dim>& among, const HarmonicSpring& spring)
    : Term<Dim>(among),
      spring_(spring),
      near_(1.2 * this->particles().spacing, ListUse::for_good, this->box(), 1, Dim,
            Positions<Dim>::kinds) {
    const Points<Dim>& X = this->particles().reference_position;
    require_one_image(this->box(), near_.range());
    this->look_after(near_);
    near_.build(X);
    load(near_, X.data());
    for (std::size_t slot = 0; slot < near_.list().size(); ++slot)
        each_bond(near_, slot, [&](const Point<Dim>&, double r, std::size_t) {
            if (r == 0.0)
                throw InputError(fmt::format(
                    "springs: particle {} is where another one or its own image is, and no spring has a "
                    "direction there; move it off, from a mirror by half a spacing",
                    this->particles().id[near_.list().particle(slot)]));
        });
    this->nature_.description = fmt::format(
        "molecular dynamics, {} harmonic springs kappa = {:g}, rest length {:g}, between initial "
        "neighbours",
        this->counts().pairs, spring_.kappa, spring_.rest_length);
    this->nature_.reach = near_.range();
    this->nature_.no_rezoning =
        "all springs have one length, and those of a split or merged particle would have others; use smooth "
        "particles";
}

template <int Dim>
void Springs<Dim>::load(Neighbourhood<Dim>& near, const double* x) const {
    near.template write<Positions<Dim>>(
        0, Dim, [x](std::size_t i, double* to) { std::copy_n(x + Dim * i, Dim, to); });
}

/// visit(r_ij, |r_ij|, slot of j): of every bond of the particle i at a slot, in ascending j.
template <int Dim>
template <class Visit>
void Springs<Dim>::each_bond(const Neighbourhood<Dim>& near, std::size_t slot, const Visit& visit) {
    const auto at = [&](std::size_t k) { return Eigen::Map<const Point<Dim>>(near.record(k)); };
    for (const std::uint32_t entry : near.list().entries(slot)) {
        const std::size_t other = entry / Dim;
        if (other == slot) continue;
        const Point<Dim> r_ij = at(slot) - at(other);
        visit(r_ij, r_ij.norm(), other);
    }
}

template <int Dim>
std::string Springs<Dim>::rates(const Now& now) {
    load(near_, now.state.position().data());
    Eigen::Map<Points<Dim>> v_dot(now.v_dot, Dim, now.state.position().cols());
    parallel_for(near_.list().size(), [&](std::size_t slot) {
        const std::size_t i = near_.list().order()[slot];
        Point<Dim> force = Point<Dim>::Zero();
        each_bond(near_, slot, [&](const Point<Dim>& r_ij, double r, std::size_t) {
            force += (spring_.force(r) / r) * r_ij;
        });
        v_dot.col(static_cast<Eigen::Index>(i)) = force / this->particles().mass[i];
    });
    near_.for_each_wall([&](BehindWall<Dim>& wall) {
        wall.load(near_.list(), near_.record(0), Dim);
        for (std::size_t k = 0; k < wall.particle.size(); ++k) {
            Point<Dim> force = Point<Dim>::Zero();
            wall.each_neighbour(wall.place[k], [&](const double* x_i, const double* x_j) {
                const Point<Dim> r_ij =
                    Eigen::Map<const Point<Dim>>(x_i) - Eigen::Map<const Point<Dim>>(x_j);
                force += (spring_.force(r_ij.norm()) / r_ij.norm()) * r_ij;
            });
            Eigen::Map<Point<Dim>>(&wall.v_dot[Dim * wall.place[k]]) =
                force / this->particles().mass[wall.particle[k]];
        }
    });
    return {};
}

/// Sum of of_bond(|r_ij|)/2 over both directions of every bond: of one across a mirror our side is a half.
template <int Dim>
template <class OfBond>
double Springs<Dim>::half_of_bonds(std::span<const double> y, const OfBond& of_bond) const {
    Neighbourhood<Dim> own = near_.for_observer();
    load(own, this->state_of(y).position().data());
    ExactSum sum;
    for (std::size_t slot = 0; slot < own.list().size(); ++slot)
        each_bond(own, slot,
                  [&](const Point<Dim>&, double r, std::size_t) { sum += 0.5 * of_bond(r); });
    add_other_parts({&sum, 1});
    return sum;
}

template <int Dim>
auto Springs<Dim>::answer(Ask what, std::span<const double> y) const -> Answer {
    if (what == Ask::energy) return {half_of_bonds(y, [&](double r) { return spring_.energy(r); })};
    if (what == Ask::neighbour_forces)
        return {2.0 * half_of_bonds(y, [&](double r) { return std::abs(spring_.force(r)); })};
    return {};
}

template <int Dim>
std::optional<std::vector<PairForce<Dim>>> Springs<Dim>::pair_forces(
    std::span<const double> y) const {
    Neighbourhood<Dim> own = near_.for_observer();
    load(own, this->state_of(y).position().data());
    std::vector<PairForce<Dim>> pairs;
    const auto number = [&](std::size_t slot) {
        return this->among().first() + own.list().particle(slot);
    };
    for (std::size_t slot = 0; slot < own.list().size(); ++slot)
        each_bond(own, slot, [&](const Point<Dim>& r_ij, double r, std::size_t other) {
            const std::size_t i = number(slot), j = number(other);
            if (j < i) pairs.push_back({i, j, r_ij, spring_.energy(r), spring_.force(r) / r});
        });
    return pairs;
}

template <int Dim>
std::vector<SymTensor<Dim>> Springs<Dim>::stress(std::span<const double> y, double volume) const {
    Neighbourhood<Dim> own = near_.for_observer();
    load(own, this->state_of(y).position().data());
    std::vector<SymTensor<Dim>> all(own.list().size());
    for (std::size_t slot = 0; slot < all.size(); ++slot) {
        SymTensor<Dim>& sigma = all[own.list().order()[slot]];
        each_bond(own, slot, [&](const Point<Dim>& r_ij, double r, std::size_t) {
            const double tension = -spring_.force(r) / (2.0 * volume * r);
            for (int a = 0; a < Dim; ++a)
                for (int b = a; b < Dim; ++b) sigma(a, b) += tension * r_ij[a] * r_ij[b];
        });
    }
    return all;
}

template <int Dim>
void Springs<Dim>::take_over(const Term<Dim>& /*before*/, const ConstState<Dim>& /*was*/,
                             const Change<Dim>& change, const State<Dim>& /*now*/) {
    for (std::size_t k = 0; k < change.parts.size(); ++k)
        if (!change.same(k))
            throw InputError(fmt::format(
                "population: all springs have one length, and those of particle {} would have others "
                "once it is split or merged; it can be removed only",
                change.id[change.parts[k].front().particle]));
}

SPAM_COMPILED(template class Springs);

}  // namespace spam
