// SPDX-License-Identifier: GPL-3.0-or-later
// Which particles a rule of rezoning splits and merges.
#pragma once

#include "reach_in.hpp"
#include <spam/core/error.hpp>
#include <spam/core/symmetric_eigen.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/problem/remake.hpp>
#include <spam/problem/repopulation.hpp>
#include <spam/problem/rezoning.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace spam {

/// What is known of all particles before any is changed.
template <int Dim>
class Candidates {
  public:
    Candidates(const Rezoning<Dim>& rezoning, const Model<Dim>& model, std::span<const double> y)
        : rezoning_(rezoning),
          model_(model),
          y_(y),
          x_(ConstState<Dim>(model.layout(), y).position()),
          range_(reach_in(rezoning, model, y)),
          near_(x_, range_, model.box()),
          rho_(model.density(y)),
          taken_(near_.size(), false) {
        if (rho_.empty())
            throw InputError("no law of the model knows a density; use smooth particles");
        for (std::size_t i = 0; i < near_.size(); ++i)
            volume_.push_back(model.particles().mass[i] / rho_[i]);
    }

    /// Those to be split, each with its children, then those to be merged.
    bool apply(Repopulation<Dim>& change) {
        bool any = false;
        std::vector<std::size_t> small;
        for (std::size_t i = 0; i < near_.size(); ++i) {
            const Votes votes = votes_of(i);
            may_join_.push_back(votes.joins);
            if (votes.splits) {
                const Points<Dim> offsets = children(i);
                if (beyond_walls({i}, offsets)) continue;
                change.split(i, offsets);
                taken_[i] = any = true;
            } else if (votes.merges && !expands(i)) {
                small.push_back(i);
            }
        }
        std::ranges::stable_sort(
            small, [&](std::size_t a, std::size_t b) { return volume_[a] < volume_[b]; });
        for (const std::size_t i : small) {
            if (taken_[i]) continue;
            const auto group = group_of(i);
            if (group.size() < 3) continue;
            const Point<Dim> d = twin_offset<Dim>(model_, y_, group);
            Points<Dim> twins(Dim, 2);
            twins << d, -d;
            if (!(d.norm() > 0.0) || beyond_walls(group, twins)) continue;
            change.merge(group, d);
            for (const std::size_t j : group) taken_[j] = true;
            any = true;
        }
        return any;
    }

  private:
    /// From j to i.
    Point<Dim> way(std::size_t i, std::size_t j) const {
        return model_.box().nearest(x_.col(static_cast<Eigen::Index>(i)) -
                                    x_.col(static_cast<Eigen::Index>(j)));
    }

    struct Votes {
        bool splits = false;
        bool merges = true;  ///< with others near it
        bool joins =
            true;  ///< others that merge: on the same side of the middle between the limits
    };
    Votes votes_of(std::size_t i) const {
        Votes votes;
        const auto vote = [&](const std::optional<RezoningLimits>& limits, double value) {
            if (!limits) return;
            const bool above = limits->split > limits->merge;
            // Where nothing is split, 0 or infinite: then others join whatever they are.
            const double middle = std::sqrt(limits->split * limits->merge);
            votes.splits |= above ? value > limits->split : value < limits->split;
            votes.merges &= above ? value < limits->merge : value > limits->merge;
            votes.joins &= above ? value < middle : value > middle;
        };
        vote(rezoning_.volume, volume_[i]);
        vote(rezoning_.neighbours, static_cast<double>(near_.neighbours(i).size() - 1));
        if (rezoning_.gradient) vote(rezoning_.gradient, steepness(i));
        votes.merges &= !votes.splits;
        votes.joins &= !votes.splits;
        return votes;
    }

    /// The slopes that fit the differences of the neighbours' values best, by w = (1 - u)^2: d value_b/d x_a. None
    /// across a line or a plane in which all neighbours are.
    template <int Values, class ValueOf>
    std::array<Vec<Dim>, Values> slopes(std::size_t i, const ValueOf& value_of) const {
        SymTensor<Dim> moments;
        std::array<Vec<Dim>, Values> sums{}, slopes{};
        const auto own = value_of(i);
        for (const std::uint32_t j : near_.neighbours(i)) {
            const Point<Dim> r = way(j, i);
            const double u = r.norm() / range_, w = (1.0 - u) * (1.0 - u);
            const auto other = value_of(j);
            for (int a = 0; a < Dim; ++a) {
                for (int b = a; b < Dim; ++b) moments(a, b) += w * r[a] * r[b];
                for (std::size_t k = 0; k < Values; ++k)
                    sums[k][a] += w * r[a] * (other[k] - own[k]);
            }
        }
        const auto eigen = symmetric_eigen(moments);
        double most = 0.0;
        for (int a = 0; a < Dim; ++a) most = std::max(most, eigen.value[a]);
        for (int a = 0; a < Dim; ++a) {
            if (!(eigen.value[a] > 1e-13 * most)) continue;
            for (std::size_t k = 0; k < Values; ++k) {
                double along = 0.0;
                for (int b = 0; b < Dim; ++b) along += eigen.vectors(b, a) * sums[k][b];
                for (int b = 0; b < Dim; ++b)
                    slopes[k][b] += eigen.vectors(b, a) * along / eigen.value[a];
            }
        }
        return slopes;
    }
    double steepness(std::size_t i) const {
        const auto rho = [&](std::size_t j) { return std::array{rho_[j]}; };
        const Vec<Dim> slope = slopes<1>(i, rho)[0];
        return std::sqrt(dot(slope, slope)) * range_ / rho_[i];
    }
    /// Whether the matter around it becomes thinner.
    bool expands(std::size_t i) const {
        const double* const v = ConstState<Dim>(model_.layout(), y_).velocity().data();
        const auto slope = slopes<Dim>(i, [&](std::size_t j) { return v + Dim * j; });
        double trace = 0.0;
        for (int a = 0; a < Dim; ++a) trace += slope[static_cast<std::size_t>(a)][a];
        return trace > 0.0;
    }

    Points<Dim> children(std::size_t i) const {
        const double d = 0.25 * std::pow(volume_[i], 1.0 / Dim);
        if (rezoning_.in_two) {
            Points<Dim> two(Dim, 2);
            two.col(0) = d * sparse_direction(i);
            two.col(1) = -two.col(0);
            return two;
        }
        Points<Dim> corners(Dim, 1 << Dim);
        for (int k = 0; k < 1 << Dim; ++k)
            for (int a = 0; a < Dim; ++a) corners(a, k) = (k >> a) & 1 ? d : -d;
        return corners;
    }

    /// In which the nearest neighbours are farthest.
    Point<Dim> sparse_direction(std::size_t i) const {
        SymTensor<Dim> near;
        for (const std::uint32_t j : near_.neighbours(i)) {
            const Point<Dim> r = way(j, i);
            if (!(r.squaredNorm() > 0.0)) continue;
            const double share = std::pow(r.squaredNorm(), -0.5 * Dim - 2.0);
            for (int a = 0; a < Dim; ++a)
                for (int b = a; b < Dim; ++b) near(a, b) += r[a] * r[b] * share;
        }
        return Point<Dim>(principal_axis(symmetric_eigen(near), false).c.data());
    }

    /// Whether the place of a particle, or the middle of a group, with these offsets is beyond a wall: now, or in the
    /// reference configuration, of which the model of the new particles is made.
    bool beyond_walls(const std::vector<std::size_t>& group, const Points<Dim>& offsets) const {
        for (const Points<Dim>* places : {&x_, &model_.particles().reference_position}) {
            Point<Dim> middle = Point<Dim>::Zero();
            double mass = 0.0;
            for (const std::size_t i : group) {
                middle += model_.particles().mass[i] * places->col(static_cast<Eigen::Index>(i));
                mass += model_.particles().mass[i];
            }
            middle /= mass;
            for (int a = 0; a < Dim; ++a)
                for (const bool upper : {false, true}) {
                    const Wall<Dim>& wall = model_.box().wall(a, upper);
                    if (wall.open()) continue;
                    const auto at = offsets.row(a).array() + (middle[a] - wall.at);
                    if (upper ? (at > 0.0).any() : (at < 0.0).any()) return true;
                }
        }
        return false;
    }

    /// Whether they are of one kind: body, material, and fields in which particles that become one must not differ.
    bool alike(std::size_t i, std::size_t j) const {
        const auto& p = model_.particles();
        if (p.body[i] != p.body[j] || (!p.material.empty() && p.material[i] != p.material[j]))
            return false;
        for (const auto& block : model_.layout().blocks())
            if (block.field.share() == Share::equal && block.holder == Holder::particle &&
                block.field.role() != Role::account)
                for (std::size_t c = 0; c < block.components; ++c)
                    if (y_[block.offset + i * block.components + c] !=
                        y_[block.offset + j * block.components + c])
                        return false;
        return true;
    }

    /// It and the nearest that may join it, at most as many as two splits make, such that the two that come of them are
    /// not soon split again.
    std::vector<std::size_t> group_of(std::size_t i) const {
        std::vector<std::pair<double, std::size_t>> others;
        for (const std::uint32_t j : near_.neighbours(i))
            if (j != i && may_join_[j] && !taken_[j] && alike(i, j))
                others.emplace_back(way(i, j).squaredNorm(), j);
        std::ranges::sort(others);
        std::vector<std::size_t> group{i};
        const double most = rezoning_.volume ? 1.5 * rezoning_.volume->split
                                             : std::numeric_limits<double>::infinity();
        double volume = volume_[i];
        for (const auto& [distance, j] : others) {
            if (group.size() == std::size_t{2} << Dim) break;
            if (volume + volume_[j] > most) break;
            volume += volume_[j];
            group.push_back(j);
        }
        return group;
    }

    const Rezoning<Dim>& rezoning_;
    const Model<Dim>& model_;
    std::span<const double> y_;
    Points<Dim> x_;
    double range_;
    PairList<Dim> near_;
    std::vector<double> rho_, volume_;
    std::vector<bool> taken_, may_join_;
};

}  // namespace spam
