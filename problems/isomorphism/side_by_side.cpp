// SPDX-License-Identifier: GPL-3.0-or-later
#include "side_by_side.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace isomorphism {
namespace {

Particles<2> together(const std::vector<std::unique_ptr<Model<2>>>& parts) {
    Particles<2> all = parts.front()->particles();
    const auto n = static_cast<Eigen::Index>(all.size());
    all.reference_position.resize(2, n * static_cast<Eigen::Index>(parts.size()));
    all.mass.clear();
    all.id.clear();
    all.body.clear();
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const Particles<2>& one = parts[k]->particles();
        all.mass.insert(all.mass.end(), one.mass.begin(), one.mass.end());
        for (const auto id : one.id) all.id.push_back(id + static_cast<std::int64_t>(k) * n);
        all.body.insert(all.body.end(), one.body.begin(), one.body.end());
        all.reference_position.middleCols(static_cast<Eigen::Index>(k) * n, n) =
            one.reference_position;
    }
    return all;
}

std::vector<Field> fields_of(const std::vector<std::unique_ptr<Model<2>>>& parts) {
    std::vector<Field> fields;
    for (const auto& part : parts)
        for (const auto& block : part->layout().blocks())
            if (std::find(fields.begin(), fields.end(), block.field) == fields.end())
                fields.push_back(block.field);
    return fields;
}

}  // namespace

SideBySide::SideBySide(std::vector<std::unique_ptr<Model<2>>> parts)
    : Model<2>(together(parts), parts.front()->box(), fields_of(parts)),
      parts_(std::move(parts)) {
    for (const auto& part : parts_) {
        if (!part->events().empty())
            throw std::invalid_argument("models side by side have no events");
        for (const auto& block : part->layout().blocks())
            if (block.field.role() == Role::history)
                throw std::invalid_argument("models side by side have no memory");
        y_.emplace_back(part->layout().size());
        y_dot_.emplace_back(part->layout().size());
        for (const auto& block : part->layout().blocks())
            layout().set_scale(block.field, block.scale);
    }
}

void SideBySide::copy_part(std::size_t k, std::span<double> of_part,
                           std::span<const double> y) const {
    for (const auto& block : parts_[k]->layout().blocks()) {
        const std::size_t size = block.size;
        std::copy_n(
            y.begin() + static_cast<std::ptrdiff_t>(layout().find(block.field)->offset + k * size),
            size, of_part.begin() + static_cast<std::ptrdiff_t>(block.offset));
    }
}

std::vector<double> SideBySide::part(std::size_t k, std::span<const double> y) const {
    std::vector<double> of_part(parts_[k]->layout().size());
    copy_part(k, of_part, y);
    return of_part;
}

void SideBySide::set_part(std::size_t k, std::span<const double> of_part,
                          std::span<double> y) const {
    for (const auto& block : parts_[k]->layout().blocks()) {
        const std::size_t size = block.size;
        std::copy_n(
            of_part.begin() + static_cast<std::ptrdiff_t>(block.offset), size,
            y.begin() + static_cast<std::ptrdiff_t>(layout().find(block.field)->offset + k * size));
    }
}

void SideBySide::rates(double t, std::span<const double> y, std::span<double> y_dot) {
    failure_.clear();
    std::fill(y_dot.begin(), y_dot.end(), 0.0);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        copy_part(k, y_[k], y);
        parts_[k]->rates(t, y_[k], y_dot_[k]);
        if (!parts_[k]->failure().empty()) return fail(y_dot, parts_[k]->failure());
        set_part(k, y_dot_[k], y_dot);
    }
}

double SideBySide::internal_energy(std::span<const double> y) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < parts_.size(); ++k) sum += parts_[k]->internal_energy(part(k, y));
    return sum;
}

std::vector<double> SideBySide::density(std::span<const double> y) const {
    std::vector<double> all;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        const auto one = parts_[k]->density(part(k, y));
        all.insert(all.end(), one.begin(), one.end());
    }
    return all;
}

/// What all of them keep.
Promises SideBySide::promises() const {
    Promises all = parts_.front()->promises();
    for (const auto& part : parts_) {
        const Promises p = part->promises();
        all.mass = std::max(all.mass, p.mass);
        all.momentum = std::max(all.momentum, p.momentum);
        all.angular_momentum = std::max(all.angular_momentum, p.angular_momentum);
        all.energy = std::max(all.energy, p.energy);
    }
    return all;
}

double SideBySide::neighbour_forces(std::span<const double> y) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < parts_.size(); ++k) sum += parts_[k]->neighbour_forces(part(k, y));
    return sum;
}

bool SideBySide::smooth() const {
    return std::all_of(parts_.begin(), parts_.end(),
                       [](const auto& part) { return part->smooth(); });
}

std::string SideBySide::describe() const {
    std::string words;
    for (const auto& part : parts_)
        words += (words.empty() ? "" : " | beside it: ") + part->describe();
    return words;
}

std::size_t SideBySide::pairs() const {
    std::size_t sum = 0;
    for (const auto& part : parts_) sum += part->pairs();
    return sum;
}

double SideBySide::reach() const {
    double farthest = 0.0;
    for (const auto& part : parts_) farthest = std::max(farthest, part->reach());
    return farthest;
}

std::vector<Remark> SideBySide::watch(double t, std::span<const double> y) {
    std::vector<Remark> all;
    for (std::size_t k = 0; k < parts_.size(); ++k)
        for (Remark& remark : parts_[k]->watch(t, part(k, y))) all.push_back(std::move(remark));
    return all;
}

/// Why one of them is.
std::string SideBySide::inseparable() const {
    for (const auto& part : parts_)
        if (auto why = part->inseparable(); !why.empty()) return why;
    return {};
}

double SideBySide::fastest_damping() const {
    double fastest = 0.0;
    for (const auto& part : parts_) fastest = std::max(fastest, part->fastest_damping());
    return fastest;
}

void SideBySide::remember(Archive& archive) {
    Model<2>::remember(archive);
    for (const auto& part : parts_) part->remember(archive);
}

double SideBySide::separation(std::size_t a, std::size_t b, std::span<const double> y) const {
    const auto x = ConstState<2>(layout(), y).position();
    const auto n = x.cols() / static_cast<Eigen::Index>(parts_.size());
    const auto of = [&](std::size_t k) {
        return x.middleCols(static_cast<Eigen::Index>(k) * n, n);
    };
    return std::sqrt((of(a) - of(b)).squaredNorm() / static_cast<double>(n));
}

}  // namespace isomorphism
