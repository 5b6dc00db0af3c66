// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/problem/remake.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

template <int Dim>
using Parts = std::vector<typename Population<Dim>::Part>;

/// The mean of a field over the parts, by mass.
template <int Dim>
Eigen::VectorXd mean(const ConstState<Dim>& from, Field field, const Parts<Dim>& parts) {
    const auto values = from.field(field);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(values.rows());
    for (const auto& part : parts)
        sum += part.share * values.col(static_cast<Eigen::Index>(part.particle));
    return sum;
}

/// Their centre of mass, by the images nearest to the first.
template <int Dim>
Point<Dim> place(const ConstState<Dim>& from, const Box<Dim>& box, const Parts<Dim>& parts) {
    const auto x = from.position();
    const Point<Dim> first = x.col(static_cast<Eigen::Index>(parts.front().particle));
    Point<Dim> away = Point<Dim>::Zero();
    for (const auto& part : parts) {
        Point<Dim> r = x.col(static_cast<Eigen::Index>(part.particle)) - first;
        for (int a = 0; a < Dim; ++a)
            if (box.periodic(a)) r[a] -= box.length(a) * std::round(r[a] / box.length(a));
        away += part.share * (r + part.offset);
    }
    return first + away;
}

/// What the parts move about their centre, by mass.
template <int Dim>
double inner_motion(const ConstState<Dim>& from, const Parts<Dim>& parts) {
    const auto v = from.velocity();
    const Point<Dim> centre = mean<Dim>(from, Field::velocity, parts);
    double energy = 0.0;
    for (const auto& part : parts)
        energy += 0.5 * part.share *
                  (v.col(static_cast<Eigen::Index>(part.particle)) - centre).squaredNorm();
    return energy;
}

/// Into the accounts what the change of particles gave.
template <int Dim>
void book(const Invariants<Dim>& before, const Invariants<Dim>& after, const State<Dim>& to) {
    if (!to.has(Field::work)) return;
    to.field(Field::work)(0, 0) += after.energy - before.energy;
    to.field(Field::impulse) += after.momentum - before.momentum;
    if constexpr (Dim > 1)
        to.field(Field::angular_impulse) += after.angular_momentum - before.angular_momentum;
}

}  // namespace

template <int Dim>
Remade<Dim> remake(const Model<Dim>& model, std::span<const double> y,
                   const Population<Dim>& population, Model<Dim>& next) {
    if (next.particles().size() != population.parts.size())
        throw InputError(fmt::format("population: the next model has {} particles, and {} are made",
                                     next.particles().size(), population.parts.size()));
    if (!model.quadrilaterals().empty())
        throw InputError("population: nodes of elements cannot be split, merged or removed");
    Remade<Dim> remade{
        std::vector<double>(next.layout().size(), 0.0), measure_invariants<Dim>(model, y), {}};
    const ConstState<Dim> from(model.layout(), y);
    const State<Dim> to(next.layout(), remade.y);
    for (const auto& block : next.layout().blocks()) {
        const auto* old = model.layout().find(block.field);
        if (old == nullptr) continue;
        next.layout().set_scale(block.field, old->scale);
        if (block.field.role() == Role::account) {
            to.field(block.field) = from.field(block.field);
            continue;
        }
        for (std::size_t k = 0; k < population.parts.size(); ++k)
            to.field(block.field).col(static_cast<Eigen::Index>(k)) =
                mean<Dim>(from, block.field, population.parts[k]);
    }
    for (std::size_t k = 0; k < population.parts.size(); ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        to.position().col(column) = place<Dim>(from, model.box(), population.parts[k]);
        if (to.has(Field::energy))
            to.energy()(0, column) += inner_motion<Dim>(from, population.parts[k]);
    }
    remade.after = measure_invariants<Dim>(next, remade.y);
    book<Dim>(remade.before, remade.after, to);
    return remade;
}

template <int Dim>
std::vector<double> restated(const Model<Dim>& model, std::span<const double> y,
                             const Model<Dim>& next) {
    if (!std::ranges::equal(model.particles().id, next.particles().id))
        throw InputError("start: the next model has other particles than the one before");
    std::vector<double> started(next.layout().size(), 0.0);
    if (!std::ranges::equal(model.quadrilaterals(), next.quadrilaterals()))
        throw InputError("start: the next model has other elements than the one before");
    for (const auto& to : next.layout().blocks()) {
        const auto* from = model.layout().find(to.field, to.holder);
        if (to.field.role() != Role::account && from != nullptr)
            std::ranges::copy(y.subspan(from->offset, to.size),
                              started.begin() + static_cast<std::ptrdiff_t>(to.offset));
    }
    return started;
}

template Remade<1> remake(const Model<1>&, std::span<const double>, const Population<1>&,
                          Model<1>&);
template Remade<2> remake(const Model<2>&, std::span<const double>, const Population<2>&,
                          Model<2>&);
template Remade<3> remake(const Model<3>&, std::span<const double>, const Population<3>&,
                          Model<3>&);
template std::vector<double> restated(const Model<1>&, std::span<const double>, const Model<1>&);
template std::vector<double> restated(const Model<2>&, std::span<const double>, const Model<2>&);
template std::vector<double> restated(const Model<3>&, std::span<const double>, const Model<3>&);

}  // namespace spam
