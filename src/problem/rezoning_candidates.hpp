// SPDX-License-Identifier: GPL-3.0-or-later
// Which particles a rule of rezoning splits and merges.
#pragma once

#include "reach_in.hpp"
#include <spam/core/error.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/problem/remake.hpp>
#include <spam/problem/repopulation.hpp>
#include <spam/problem/rezoning.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace spam {

// Of any size: one instance of these solvers, each of which takes seconds to compile.
inline Eigen::MatrixXd least_squares(const Eigen::MatrixXd& moments, const Eigen::MatrixXd& sums) {
    return moments.completeOrthogonalDecomposition().solve(sums);
}
inline Eigen::VectorXd least_axis(const Eigen::MatrixXd& symmetric) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvectors().col(0);
}

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
        Point<Dim> r = x_.col(static_cast<Eigen::Index>(i)) - x_.col(static_cast<Eigen::Index>(j));
        for (int a = 0; a < Dim; ++a)
            if (const double L = model_.box().length(a); L > 0.0) r[a] -= L * std::round(r[a] / L);
        return r;
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

    /// The slopes that fit the differences of the neighbours' values best, by w = (1 - u)^2: d value_b/d x_a.
    template <int Values, class ValueOf>
    Eigen::Matrix<double, Dim, Values> slopes(std::size_t i, const ValueOf& value_of) const {
        Eigen::Matrix<double, Dim, Dim> moments = Eigen::Matrix<double, Dim, Dim>::Zero();
        Eigen::Matrix<double, Dim, Values> sums = Eigen::Matrix<double, Dim, Values>::Zero();
        const Eigen::Matrix<double, Values, 1> own = value_of(i);
        for (const std::uint32_t j : near_.neighbours(i)) {
            const Point<Dim> r = way(j, i);
            const double w = std::pow(1.0 - r.norm() / range_, 2);
            moments += w * r * r.transpose();
            sums += w * r * (value_of(j) - own).transpose();
        }
        return least_squares(moments, sums);
    }
    double steepness(std::size_t i) const {
        const auto rho = [&](std::size_t j) { return Point<1>(rho_[j]); };
        return slopes<1>(i, rho).norm() * range_ / rho_[i];
    }
    /// Whether the matter around it becomes thinner.
    bool expands(std::size_t i) const {
        const auto v = ConstState<Dim>(model_.layout(), y_).velocity();
        const auto velocity = [&](std::size_t j) -> Point<Dim> {
            return v.col(static_cast<Eigen::Index>(j));
        };
        return slopes<Dim>(i, velocity).trace() > 0.0;
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
        Eigen::Matrix<double, Dim, Dim> near = Eigen::Matrix<double, Dim, Dim>::Zero();
        for (const std::uint32_t j : near_.neighbours(i)) {
            const Point<Dim> r = way(j, i);
            if (r.squaredNorm() > 0.0)
                near += r * r.transpose() / std::pow(r.squaredNorm(), 0.5 * Dim + 2.0);
        }
        return least_axis(near);
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
