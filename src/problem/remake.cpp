// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/symmetric_eigen.hpp>
#include <spam/problem/remake.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

template <int Dim>
using MadeOf = std::vector<typename Population<Dim>::Part>;
template <int Dim>
using SquareMatrix = Eigen::Matrix<double, Dim, Dim>;

/// Along which `spread` is largest, or least.
template <int Dim>
Point<Dim> axis_of(const SquareMatrix<Dim>& spread, bool longest = true) {
    SymTensor<Dim> A;
    for (int a = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b) A(a, b) = spread(a, b);
    return Point<Dim>(principal_axis(symmetric_eigen(A), longest).c.data());
}

/// Sets the offsets of the parts to their centre of mass, by the images nearest to the first.
template <int Dim>
void place(const Eigen::Ref<const Points<Dim>>& x, const Box<Dim>& box, MadeOf<Dim>& parts) {
    const Point<Dim> first = x.col(static_cast<Eigen::Index>(parts.front().particle));
    Point<Dim> away = Point<Dim>::Zero();
    for (auto& part : parts) {
        const Point<Dim> r = box.nearest(x.col(static_cast<Eigen::Index>(part.particle)) - first);
        away += part.share * (r + part.offset);
        part.offset = -r;
    }
    for (auto& part : parts) part.offset += away;
}

/// What parts do about their centre, which moves with `mean`, by their mass.
template <int Dim>
struct InnerMotion {
    double energy = 0.0;
    SquareMatrix<Dim> flow = SquareMatrix<Dim>::Zero();    ///< sum share r u
    SquareMatrix<Dim> spread = SquareMatrix<Dim>::Zero();  ///< sum share r r

    /// r_of(part): from the centre to the part.
    template <class Where>
    InnerMotion(const ConstState<Dim>& from, const MadeOf<Dim>& parts, const Point<Dim>& mean,
                const Where& r_of) {
        for (const auto& part : parts) {
            const Point<Dim> u =
                from.velocity().col(static_cast<Eigen::Index>(part.particle)) - mean;
            const Point<Dim> r = r_of(part);
            energy += 0.5 * part.share * u.squaredNorm();
            flow += part.share * r * u.transpose();
            spread += part.share * r * r.transpose();
        }
    }
    /// The angular momentum, as a tensor.
    SquareMatrix<Dim> turning() const { return flow - flow.transpose(); }
    /// Projects on the plane across the angular momentum in space; where there is none, across the shortest axis.
    SquareMatrix<Dim> across() const {
        SquareMatrix<Dim> plane = SquareMatrix<Dim>::Identity();
        if constexpr (Dim == 3) {
            const auto L = turning();
            Point<3> l(L(1, 2), L(2, 0), L(0, 1));
            if (l.norm() > 1e-12 * std::sqrt(2.0 * energy * spread.trace()))
                l.normalize();
            else
                l = axis_of<3>(spread, false);
            plane -= l * l.transpose();
        }
        return plane;
    }
    /// Of the particle at d, where another is at -d: the two turn with the angular momentum of the parts and come
    /// together or part as fast as these do across it. That is a part of their motion: it takes no more energy.
    Point<Dim> of_twin(const Point<Dim>& d) const {
        return (turning().transpose() * d + (across() * flow).trace() * d) / d.squaredNorm();
    }
};

/// Gives what was merged the motion of its parts about their centre: as heat, where particles have a heat, and where
/// two are made of more, as V + L x d/(M d^2) + a d of one and V - ... of the other, a what they come together with.
template <int Dim>
void pass_inner_motion(const ConstState<Dim>& from, const Change<Dim>& change,
                       const Population<Dim>& population, const State<Dim>& to) {
    for (std::size_t k = 0; k < change.parts.size(); ++k) {
        const auto& parts = change.parts[k];
        if (parts.size() == 1) continue;
        const auto column = static_cast<Eigen::Index>(k);
        const Point<Dim> d = population.parts[k].front().offset, V = to.velocity().col(column);
        const InnerMotion<Dim> inner(
            from, parts, V, [&](const auto& part) -> Point<Dim> { return d - part.offset; });
        Point<Dim> turn = Point<Dim>::Zero();
        if (Population<Dim>::is_twin(parts)) turn = inner.of_twin(d);
        to.velocity().col(column) += turn;
        if (to.has(Field::energy))
            to.energy()(0, column) += inner.energy - 0.5 * turn.squaredNorm();
    }
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
        for (int a = 0; a < Dim && remembers && parts.size() > 1; ++a)
            if (population.periods[a] != model.box().length(a))
                throw InputError(fmt::format(
                    "population: particle {} is merged with others in another box than the model's, where other "
                    "images are the nearest; give Repopulation the model, or its box",
                    change.id[part.particle]));
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
    next.take_scales(model);
    for (const auto& block : next.layout().blocks()) {
        const auto* old = model.layout().find(block.field, block.holder);
        if (old == nullptr) continue;
        double* const made = remade.y.data() + block.offset;
        if (block.field.role() == Role::account || block.holder == Holder::element)
            std::ranges::copy(y.subspan(old->offset, old->size), made);
        else
            change.carry(block.field, y.data() + old->offset, made, block.components);
    }
    pass_inner_motion<Dim>(from, change, population, to);
    Archive memory;
    model.remember(memory);
    Archive remembered(memory.bytes());
    Memory<Dim> carried(remembered, change);
    next.remember(carried);
    remembered.expect_end();
    next.take_over(model, y, change, remade.y);
    remade.after = measure_invariants<Dim>(next, remade.y);
    auto& gains = next.gains();
    gains = model.gains();
    gains.work += remade.after.energy - remade.before.energy;
    gains.impulse += remade.after.momentum - remade.before.momentum;
    gains.angular_impulse += remade.after.angular_momentum - remade.before.angular_momentum;
    return remade;
}

/// Of one axis the moment of inertia per mass is the square of d. In space it is seen along the angular momentum: d
/// lies across it, or two particles could not have it.
template <int Dim>
Point<Dim> twin_offset(const Model<Dim>& model, std::span<const double> y,
                       const std::vector<std::size_t>& group) {
    const ConstState<Dim> state(model.layout(), y);
    MadeOf<Dim> parts;
    double mass = 0.0;
    for (const std::size_t i : group) mass += model.particles().mass[i];
    Point<Dim> mean = Point<Dim>::Zero();
    for (const std::size_t i : group) {
        parts.push_back(
            {static_cast<std::uint32_t>(i), model.particles().mass[i] / mass, Point<Dim>::Zero()});
        mean += parts.back().share * state.velocity().col(static_cast<Eigen::Index>(i));
    }
    place<Dim>(state.position(), model.box(), parts);
    const InnerMotion<Dim> inner(state, parts, mean,
                                 [](const auto& part) -> Point<Dim> { return -part.offset; });
    const SquareMatrix<Dim> across = inner.across(), spread = across * inner.spread * across;
    return std::sqrt(std::max(0.0, spread.trace())) * axis_of<Dim>(spread);
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

#define SPAM_INSTANTIATE(D)                                                             \
    template Remade<D> remake(Model<D>&, std::span<const double>, const Population<D>&, \
                              Model<D>&);                                               \
    template Point<D> twin_offset(const Model<D>&, std::span<const double>,             \
                                  const std::vector<std::size_t>&);                     \
    template std::vector<double> restated(const Model<D>&, std::span<const double>,     \
                                          const Model<D>&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
