// SPDX-License-Identifier: GPL-3.0-or-later
#include "reach_in.hpp"
#include <spam/core/error.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/problem/remake.hpp>
#include <spam/problem/rezoning.hpp>
#include <spam/rhs/particle_model.hpp>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {
namespace {

// Of any size: one instance of these solvers, each of which takes seconds to compile.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& moments, const Eigen::MatrixXd& sums) {
    return moments.completeOrthogonalDecomposition().solve(sums);
}
Eigen::VectorXd least_axis(const Eigen::MatrixXd& symmetric) {
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
                if (beyond_walls(i, offsets)) continue;
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
            if (!(d.norm() > 0.0)) continue;
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
            if (j != i) near += r * r.transpose() / std::pow(r.squaredNorm(), 0.5 * Dim + 2.0);
        }
        return least_axis(near);
    }

    bool beyond_walls(std::size_t i, const Points<Dim>& offsets) const {
        for (int a = 0; a < Dim; ++a)
            for (const bool upper : {false, true}) {
                const Wall<Dim>& wall = model_.box().wall(a, upper);
                if (wall.open()) continue;
                const auto at =
                    x_(a, static_cast<Eigen::Index>(i)) + offsets.row(a).array() - wall.at;
                if (upper ? (at > 0.0).any() : (at < 0.0).any()) return true;
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

void expect_room(const char* name, const std::optional<RezoningLimits>& limits, bool above,
                 double ratio, const char* why) {
    if (!limits) return;
    const auto [split, merge] = *limits;
    const double wide = above ? split / merge : merge / split;  // infinite where nothing is split
    if (!(split >= 0.0) || !(merge > 0.0) || !std::isfinite(merge) || !(wide >= ratio))
        throw InputError(fmt::format(
            "rezoning: splitting {} {} {:g} and merging {} {:g} leaves too little room between: {}; "
            "give limits that differ by a factor of {:g} or more",
            above ? "above" : "below", name, split, above ? "below" : "above", merge, why, ratio));
}

/// Whether what must stay has stayed, to rounding.
template <int Dim>
void expect_kept(const Model<Dim>& model, std::span<const double> y, const Remade<Dim>& remade) {
    const auto &a = remade.before, &b = remade.after;
    const auto scales = measure_scales<Dim>(model, y);
    const auto refuse = [](const char* what, double change) {
        throw GuardStop(fmt::format(
            "rezoning: the laws of the model would change the {} by {:.2g} of its size; use remake() between two "
            "runs, which books it",
            what, change));
    };
    const double energy = a.kinetic + std::abs(a.internal);
    if (std::abs(b.energy - a.energy) > 1e-12 * energy)
        refuse("energy", std::abs(b.energy - a.energy) / energy);
    if ((b.momentum - a.momentum).norm() > 1e-12 * scales.momentum)
        refuse("momentum", (b.momentum - a.momentum).norm() / scales.momentum);
    const double turned = (b.angular_momentum - a.angular_momentum).norm();
    if (!model.box().periodic() && turned > 1e-12 * scales.angular_momentum)
        refuse("angular momentum", turned / scales.angular_momentum);
}

}  // namespace

template <int Dim>
Observer<Dim> Rezoning<Dim>::observer() const {
    const auto number = [](std::string name, auto value) -> Column<Dim> {
        return {std::move(name),
                [value](const Model<Dim>& model, std::span<const double>) -> double {
                    return static_cast<double>(value(model));
                }};
    };
    const auto done = memory;
    return {
        .columns = {number("particles", [](const auto& model) { return model.particles().size(); }),
                    number("splits", [done](const auto&) { return done->splits; }),
                    number("merges", [done](const auto&) { return done->merges; }),
                    number("rezoning_heat", [done](const auto&) { return done->heat; })},
        .memory = [done](Archive& archive) { archive(*done); }};
}

template <int Dim>
void Rezoning<Dim>::check(const Model<Dim>& model) const {
    if (!(every > 0.0) || !std::isfinite(every))
        throw InputError(
            fmt::format("rezoning: {} is no time between looks; give one above 0", every));
    if (!make || !(volume || neighbours || gradient))
        throw InputError(
            "rezoning: give a criterion (volume, neighbours or gradient) and what makes a model of other particles");
    const auto n = static_cast<double>(children());
    expect_room("m/rho", volume, true, n, "what has been split would be merged again");
    expect_room("a number of neighbours", neighbours, false, n,
                "what has been split would be merged again");
    expect_room("|grad rho| range/rho", gradient, true, 1.2,
                "particles would be split and merged in turn");
    if (!(range > 0.0) && !std::isfinite(model.reach()))
        throw InputError(
            "rezoning: all particles act on each other; give a range for the criteria");
    if (!model.quadrilaterals().empty() ||
        dynamic_cast<const ParticleModel<Dim>*>(&model) == nullptr)
        throw InputError(
            "rezoning: elements cannot be split or merged; use a model of particles alone");
    const bool carried = model.layout().has(Field::energy);
    for (const auto& term : dynamic_cast<const ParticleModel<Dim>&>(model).terms()) {
        const auto& nature = term->nature();
        if (!nature.no_rezoning.empty()) throw InputError("rezoning: " + nature.no_rezoning);
        if (nature.potential && !nature.own_heat && !carried)
            throw InputError(fmt::format(
                "rezoning: the energy of '{}' follows from places alone, and nothing can pay for what changes of it; "
                "use a law with an energy, such as GammaGas",
                nature.description));
    }
}

template <int Dim>
std::optional<Population<Dim>> Rezoning<Dim>::looked_at(Model<Dim>& model,
                                                        std::span<const double> y) const {
    Repopulation<Dim> change(model.particles(), model.deformation_gradients(y));
    if (!Candidates<Dim>(*this, model, y).apply(change)) return {};
    return change.finish(memory->next_id);
}

template <int Dim>
auto Rezoning<Dim>::change(Model<Dim>& model, std::span<const double> y) const
    -> std::optional<Next> {
    const auto before = model.particles().size();
    const auto& ids = model.particles().id;
    memory->next_id = std::max(memory->next_id, *std::ranges::max_element(ids) + 1);
    try {
        const auto population = looked_at(model, y);
        if (!population) return {};
        Next next{make(population->particles), {}, {}};
        auto remade = remake<Dim>(model, y, *population, *next.model);
        expect_kept<Dim>(model, y, remade);
        std::size_t children_made = 0, twins = 0;
        for (const auto& parts : population->parts) {
            children_made += parts.size() == 1 && parts.front().of < 1.0 ? 1 : 0;
            twins += Population<Dim>::is_twin(parts) ? 1 : 0;
        }
        for (const auto id : population->particles.id)
            memory->next_id = std::max(memory->next_id, id + 1);
        memory->splits += children_made / children();
        memory->merges += twins / 2;
        if (twins > 0) memory->heat += remade.after.internal - remade.before.internal;
        next.y = std::move(remade.y);
        next.remarks.push_back(
            {fmt::format("{} particles split and {} groups merged: {} in place of {}",
                         children_made / children(), twins / 2, next.model->particles().size(),
                         before),
             static_cast<double>(next.model->particles().size())});
        return next;
    } catch (const InputError& refusal) {
        throw GuardStop(fmt::format("rezoning: {}", refusal.what()));
    }
}

template struct Rezoning<1>;
template struct Rezoning<2>;
template struct Rezoning<3>;

}  // namespace spam
