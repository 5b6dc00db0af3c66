// SPDX-License-Identifier: GPL-3.0-or-later
#include "rezoning_candidates.hpp"
#include <spam/core/error.hpp>
#include <spam/problem/remake.hpp>
#include <spam/rhs/particle_model.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {
namespace {

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
    Repopulation<Dim> change(model, y);
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

SPAM_COMPILED(template struct Rezoning);

}  // namespace spam
