// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/problem/repopulation.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace spam {

template <int Dim>
Repopulation<Dim>::Repopulation(const Model<Dim>& model, std::span<const double> y)
    : Repopulation(model.particles(), model.deformation_gradients(y), model.box()) {}

template <int Dim>
Repopulation<Dim>::Repopulation(const Particles<Dim>& before, std::vector<Mat<Dim>> deformation,
                                const Box<Dim>& box)
    : before_(before),
      deformation_(std::move(deformation)),
      box_(box),
      change_(before.size(), -1) {
    if (!deformation_.empty() && deformation_.size() != before.size())
        throw InputError(
            fmt::format("population: there are {} deformation gradients of {} particles",
                        deformation_.size(), before.size()));
}

namespace {

/// Each particle may have one change. `times`: how often this one names it.
void require_unchanged(std::size_t i, const std::vector<int>& change,
                       const std::vector<std::int64_t>& id, std::ptrdiff_t times = 1) {
    if (i >= change.size())
        throw InputError(
            fmt::format("population: there is no particle {} among {}", i, change.size()));
    if (change[i] != -1 || times > 1)
        throw InputError(fmt::format(
            "population: particle {} is split, merged or removed twice; make two steps of it",
            id[i]));
}

}  // namespace

template <int Dim>
typename Repopulation<Dim>::Change& Repopulation<Dim>::change_of(std::size_t i) {
    require_unchanged(i, change_, before_.id);
    change_[i] = static_cast<int>(changes_.size());
    return changes_.emplace_back();
}

template <int Dim>
void Repopulation<Dim>::split(std::size_t i, const Points<Dim>& offsets) {
    const double size = offsets.cwiseAbs().sum();
    if (offsets.cols() < 2 || !offsets.allFinite() ||
        offsets.rowwise().sum().cwiseAbs().sum() > 1e-14 * size)
        throw InputError(
            fmt::format("population: the children of particle {} must be two or more, at places "
                        "whose sum is zero: else their angular momentum would not be its own",
                        i < before_.size() ? before_.id[i] : -1));
    change_of(i).offsets = offsets;
}

template <int Dim>
void Repopulation<Dim>::merge(const std::vector<std::size_t>& particles) {
    if (particles.size() < 2)
        throw InputError("population: it takes two particles or more to merge");
    const auto material = [&](std::size_t i) {
        return before_.material.empty() ? 0 : before_.material[i];
    };
    // All are looked at before the first one is marked: a merge that is refused changes nothing.
    for (const std::size_t i : particles) {
        require_unchanged(i, change_, before_.id, std::ranges::count(particles, i));
        if (material(i) != material(particles.front()))
            throw InputError(fmt::format(
                "population: particles {} and {} are of different materials and cannot be one",
                before_.id[particles.front()], before_.id[i]));
        if (before_.body[i] != before_.body[particles.front()])
            throw InputError(fmt::format(
                "population: particles {} and {} are of different bodies and cannot be one",
                before_.id[particles.front()], before_.id[i]));
    }
    for (const std::size_t i : particles) change_[i] = -2;
    const std::size_t first = *std::ranges::min_element(particles);
    change_[first] = static_cast<int>(changes_.size());
    changes_.push_back({particles});
}

template <int Dim>
void Repopulation<Dim>::merge(const std::vector<std::size_t>& particles, const Point<Dim>& d) {
    if (particles.size() < 3 || !d.allFinite() || !(d.norm() > 0.0))
        throw InputError(
            "population: it takes three particles or more to merge into two, and a distance above 0");
    merge(particles);
    changes_.back().apart = d;
}

template <int Dim>
void Repopulation<Dim>::remove(std::size_t i) {
    change_of(i).removed = true;
}

template <int Dim>
Population<Dim> Repopulation<Dim>::finish(std::int64_t first_new) const {
    using Part = typename Population<Dim>::Part;
    Population<Dim> after;
    Particles<Dim>& p = after.particles;
    p.spacing = before_.spacing;
    for (int a = 0; a < Dim; ++a) after.periods[a] = box_.length(a);
    std::int64_t next_id = first_new;
    for (const auto id : before_.id) next_id = std::max(next_id, id + 1);
    std::vector<Point<Dim>> reference;
    const auto in_material = [&](std::size_t i, const Point<Dim>& d) -> Point<Dim> {
        const Mat<Dim> back = into_material(deformation_.empty() ? Mat<Dim>{} : deformation_[i]);
        return Eigen::Map<const Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>>(back.c.data()) *
               d;
    };
    const auto add = [&](std::size_t like, double mass, std::int64_t id, const Point<Dim>& place,
                         std::vector<Part> parts) {
        p.mass.push_back(mass);
        p.id.push_back(id);
        p.body.push_back(before_.body[like]);
        if (!before_.material.empty()) p.material.push_back(before_.material[like]);
        reference.push_back(place);
        after.parts.push_back(std::move(parts));
    };
    for (std::size_t i = 0; i < before_.size(); ++i) {
        if (change_[i] == -2) continue;
        const auto number = static_cast<std::uint32_t>(i);
        const Point<Dim> X = before_.reference_position.col(static_cast<Eigen::Index>(i));
        if (change_[i] == -1) {
            add(i, before_.mass[i], before_.id[i], X, {{number, 1.0, Point<Dim>::Zero()}});
            continue;
        }
        const Change& change = changes_[static_cast<std::size_t>(change_[i])];
        if (change.removed) {
            after.removed.push_back(number);
        } else if (change.merged.empty()) {
            const Eigen::Index n = change.offsets.cols();
            const double children = static_cast<double>(n);
            for (Eigen::Index k = 0; k < n; ++k)
                add(i, before_.mass[i] / children, next_id++,
                    X + in_material(i, change.offsets.col(k)),
                    {{number, 1.0, change.offsets.col(k), 1.0 / children}});
        } else {
            double mass = 0.0;
            for (const std::size_t j : change.merged) mass += before_.mass[j];
            const auto X_of = [&](std::size_t j) -> Point<Dim> {
                return before_.reference_position.col(static_cast<Eigen::Index>(j));
            };
            const Point<Dim> first = X_of(change.merged.front());
            Point<Dim> centre = first;
            std::vector<Part> parts;
            for (const std::size_t j : change.merged) {
                const double share = before_.mass[j] / mass;
                centre += share * box_.nearest(X_of(j) - first);
                parts.push_back({static_cast<std::uint32_t>(j), share, Point<Dim>::Zero()});
            }
            if (change.apart.isZero()) {
                add(i, mass, before_.id[change.merged.front()], centre, std::move(parts));
                continue;
            }
            for (const std::size_t twin : {0u, 1u}) {
                const Point<Dim> d = twin == 0 ? change.apart : Point<Dim>(-change.apart);
                for (Part& part : parts) {
                    part.offset = d;
                    part.of = 0.5;
                }
                add(i, 0.5 * mass, before_.id[change.merged[twin]], centre + in_material(i, d),
                    parts);
            }
        }
    }
    p.reference_position.resize(Dim, static_cast<Eigen::Index>(reference.size()));
    for (std::size_t k = 0; k < reference.size(); ++k)
        p.reference_position.col(static_cast<Eigen::Index>(k)) = reference[k];
    return after;
}

SPAM_COMPILED(template class Repopulation);

}  // namespace spam
