// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/problem/remake.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

template <int Dim>
using MadeOf = std::vector<typename Population<Dim>::Part>;

/// Sets the offsets of the parts to their centre of mass, by the images nearest to the first.
template <int Dim>
void place(const Eigen::Ref<const Points<Dim>>& x, const Box<Dim>& box, MadeOf<Dim>& parts) {
    const Point<Dim> first = x.col(static_cast<Eigen::Index>(parts.front().particle));
    Point<Dim> away = Point<Dim>::Zero();
    for (auto& part : parts) {
        Point<Dim> r = x.col(static_cast<Eigen::Index>(part.particle)) - first;
        for (int a = 0; a < Dim; ++a)
            if (box.periodic(a)) r[a] -= box.length(a) * std::round(r[a] / box.length(a));
        away += part.share * (r + part.offset);
        part.offset = -r;
    }
    for (auto& part : parts) part.offset += away;
}

/// What the parts move about their centre, by mass.
template <int Dim>
double inner_motion(const ConstState<Dim>& from, const MadeOf<Dim>& parts,
                    const Point<Dim>& centre) {
    const auto v = from.velocity();
    double energy = 0.0;
    for (const auto& part : parts)
        energy += 0.5 * part.share *
                  (v.col(static_cast<Eigen::Index>(part.particle)) - centre).squaredNorm();
    return energy;
}

template <int Dim>
Change<Dim> change_of(const Model<Dim>& model, std::span<const double> y,
                      const Population<Dim>& population) {
    const ConstState<Dim> from(model.layout(), y);
    const auto x = from.position();
    Change<Dim> change{population.parts, {}, model.particles().id};
    for (const Mat<Dim>& F : model.deformation_gradients(y))
        change.back.push_back(into_material(F));
    const bool remembers = !change.back.empty();
    change.back.resize(model.particles().size(), into_material(Mat<Dim>{}));
    for (std::size_t k = 0; k < change.parts.size(); ++k) {
        auto& parts = change.parts[k];
        const auto& part = parts.front();
        if (remembers && parts.size() == 1) {
            // A law that remembers places in the material would store another strain there.
            using Square = Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>;
            const Point<Dim> in_material =
                Eigen::Map<const Square>(change.back[part.particle].c.data()) * part.offset;
            const Point<Dim> placed =
                population.particles.reference_position.col(static_cast<Eigen::Index>(k)) -
                model.particles().reference_position.col(static_cast<Eigen::Index>(part.particle));
            if (!((placed - in_material).norm() <= 1e-6 * in_material.norm()))
                throw InputError(fmt::format(
                    "population: particle {} is split by offsets that do not turn and stretch with "
                    "it; give Repopulation the model's deformation_gradients() of this state",
                    change.id[part.particle]));
        }
        place<Dim>(x, model.box(), parts);
    }
    return change;
}

/// The elements of the next model are those of this one, and no corner has changed: each has four.
template <int Dim>
void expect_elements(const Model<Dim>& model, const Change<Dim>& change, const Model<Dim>& next) {
    const auto elements = model.quadrilaterals(), then = next.quadrilaterals();
    bool same = elements.size() == then.size();
    for (std::size_t e = 0; same && e < elements.size(); ++e)
        for (std::size_t c = 0; c < 4; ++c)
            same = same && then[e][c] < change.parts.size() && change.same(then[e][c]) &&
                   change.parts[then[e][c]].front().particle == elements[e][c];
    if (!same)
        throw InputError(
            "population: an element has four corners, which cannot be split, merged or removed; the "
            "next model must have the same elements between the same particles");
}

}  // namespace

template <int Dim>
Remade<Dim> remake(Model<Dim>& model, std::span<const double> y, const Population<Dim>& population,
                   Model<Dim>& next) {
    if (next.particles().size() != population.parts.size())
        throw InputError(fmt::format("population: the next model has {} particles, and {} are made",
                                     next.particles().size(), population.parts.size()));
    const Change<Dim> change = change_of<Dim>(model, y, population);
    expect_elements<Dim>(model, change, next);
    Remade<Dim> remade{
        std::vector<double>(next.layout().size(), 0.0), measure_invariants<Dim>(model, y), {}};
    const ConstState<Dim> from(model.layout(), y);
    const State<Dim> to(next.layout(), remade.y);
    for (const auto& block : next.layout().blocks()) {
        const auto* old = model.layout().find(block.field, block.holder);
        if (old == nullptr) continue;
        next.layout().set_scale(block.field, old->scale);
        double* const made = remade.y.data() + block.offset;
        if (block.field.role() == Role::account || block.holder == Holder::element)
            std::ranges::copy(y.subspan(old->offset, old->size), made);
        else
            change.carry(block.field, y.data() + old->offset, made, block.components);
    }
    if (to.has(Field::energy))
        for (std::size_t k = 0; k < change.parts.size(); ++k) {
            const auto column = static_cast<Eigen::Index>(k);
            to.energy()(0, column) +=
                inner_motion<Dim>(from, change.parts[k], to.velocity().col(column));
        }
    Archive memory;
    model.remember(memory);
    Archive remembered(memory.bytes());
    Memory<Dim> carried(remembered, change);
    next.remember(carried);
    remembered.expect_end();
    next.take_over(model, y, change, remade.y);
    remade.after = measure_invariants<Dim>(next, remade.y);
    auto& gains = next.gains();
    gains.work += remade.after.energy - remade.before.energy;
    gains.impulse += remade.after.momentum - remade.before.momentum;
    gains.angular_impulse += remade.after.angular_momentum - remade.before.angular_momentum;
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

template Remade<1> remake(Model<1>&, std::span<const double>, const Population<1>&, Model<1>&);
template Remade<2> remake(Model<2>&, std::span<const double>, const Population<2>&, Model<2>&);
template Remade<3> remake(Model<3>&, std::span<const double>, const Population<3>&, Model<3>&);
template std::vector<double> restated(const Model<1>&, std::span<const double>, const Model<1>&);
template std::vector<double> restated(const Model<2>&, std::span<const double>, const Model<2>&);
template std::vector<double> restated(const Model<3>&, std::span<const double>, const Model<3>&);

}  // namespace spam
