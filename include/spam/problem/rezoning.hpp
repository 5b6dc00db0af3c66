// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/problem/observer.hpp>

#include <cstdint>
#include <memory>
#include <optional>

namespace spam {

/// Particles are split beyond the first and merged beyond the second: above and below for volumes and gradients,
/// below and above for numbers of neighbours.
struct RezoningLimits {
    double split, merge;
};

/// What has been done so far, part of every checkpoint.
struct RezoningMemory {
    std::int64_t next_id = 0;  ///< numbers are never used again
    std::size_t splits = 0;    ///< particles that were split
    std::size_t merges = 0;    ///< groups that were merged into two
    double heat = 0.0;         ///< what merges made of motion
    void remember(Archive& archive) { archive(next_id, splits, merges, heat); }
};

/// How the number of particles changes on the way of a run (Plan::rezone): at given times particles that stand for too
/// much are split, and groups of those that stand for too little are merged into two. Mass, momentum, angular momentum
/// and energy are kept. Of a problem it takes
///     plan.rezone({.every = 0.5, .volume = RezoningLimits{2.0, 0.5}, .make = model_of});
///
/// A change is made as a checkpoint is written: ids, masses, bodies, y and what laws and integrator remember are all
/// that goes on, in a model made anew, also of the run that was never stopped. So a run that is restarted, before or
/// behind a change, has the same bits. A change does not begin a new case: rows, accounts, events, snapshots and
/// checkpoints continue.
///
/// Observers and columns must look at the model that they are given, not at one that they know.
template <int Dim>
struct Rezoning {
    /// Time between looks at the criteria.
    double every = 0.0;
    /// m/rho, mass by density: above the first a particle is split, below the second it may be merged. There must be
    /// room between them: what has been split is not merged at once.
    std::optional<RezoningLimits> volume{};
    /// Particles within the range of one: below the first it is split (0: never), above the second it may be merged.
    std::optional<RezoningLimits> neighbours{};
    /// |grad rho| range/rho: above the first it is split, below the second it may be merged. A particle is split where
    /// one criterion asks for it, and may be merged where all that are given allow it and the matter around it does not
    /// become thinner: else particles on a surface, small by nature, would be merged, and their parts be missing soon.
    std::optional<RezoningLimits> gradient{};
    /// In which neighbours are counted, gradients measured and groups gathered; 0: as far as the laws reach.
    double range = 0.0;
    /// Children of a particle lie at the corners of a square (cube) of half the edge of its volume; with this there are
    /// two, in the direction in which neighbours are farthest apart.
    bool in_two = false;
    /// Makes the model of other particles: the same laws and externals in the same order. Needed.
    std::function<std::shared_ptr<Model<Dim>>(Particles<Dim> particles)> make{};
    std::shared_ptr<RezoningMemory> memory = std::make_shared<RezoningMemory>();

    /// Children of a particle that is split.
    std::size_t children() const { return in_two ? 2 : std::size_t{1} << Dim; }
    /// Columns `particles`, `splits`, `merges`, `rezoning_heat` and a part of every checkpoint.
    Observer<Dim> observer() const;
    /// Throws InputError, with what to do instead, where the limits have no meaning, and where laws of the model
    /// forbid it: those that remember pairs, and those whose energy follows from places alone.
    void check(const Model<Dim>& model) const;
    /// The particles of a model in state y as the criteria want them; nothing where all stay.
    std::optional<Population<Dim>> looked_at(Model<Dim>& model, std::span<const double> y) const;
    /// A change: the next model and its y, remarks for events.csv.
    struct Next {
        std::shared_ptr<Model<Dim>> model;
        std::vector<double> y;
        std::vector<Remark> remarks;
    };
    /// What goes on in place of the model in state y; nothing where all particles stay. Throws GuardStop where the
    /// laws forbid the change, or would not keep the invariants.
    std::optional<Next> change(Model<Dim>& model, std::span<const double> y) const;
};

SPAM_COMPILED(extern template struct Rezoning);

}  // namespace spam
