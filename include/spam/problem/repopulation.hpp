// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/population.hpp>
#include <spam/rhs/model.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spam {

/// Splits, merges and removes particles, each of them at most once. Particles that nothing is said of stay
/// as they are; the order in memory is kept, children take their parent's place. Ids stay with those
/// that stay; a merged particle has the first one's, children have numbers that were not there.
template <int Dim>
class Repopulation {
  public:
    /// Of the particles of `model`, which must outlive it, in the state `y` in which they are split and merged.
    Repopulation(const Model<Dim>& model, std::span<const double> y);
    /// Of `before`, which must outlive it, where no law remembers places in the material; else give `deformation`, F of
    /// each (Model::deformation_gradients()), and the box of the model.
    explicit Repopulation(const Particles<Dim>& before, std::vector<Mat<Dim>> deformation = {},
                          const Box<Dim>& box = {});

    /// Particle i in offsets.cols() >= 2 of equal mass, at these places d (Dim x children) from its own, and
    /// F^-1 d from its reference position; their sum must be zero (then momentum and angular momentum are
    /// kept), or InputError.
    void split(std::size_t i, const Points<Dim>& offsets);
    /// Two or more particles in one, at the centre of mass of their nearest images, now and in the reference
    /// positions. Throws InputError for different materials or bodies.
    void merge(const std::vector<std::size_t>& particles);
    /// Three or more particles in two of equal mass, at d and -d from their centre of mass (Rezoning says which d is
    /// best): they turn about each other so that the angular momentum is kept. Throws InputError as the other.
    void merge(const std::vector<std::size_t>& particles, const Point<Dim>& d);
    /// Takes particle i away. Throws InputError where it is split, merged or removed already.
    void remove(std::size_t i);

    /// The new set, and what each of its particles is made of; remake() carries a state over. Children have numbers
    /// from `first_new` on, or above all that there are: a run that does so often keeps the numbers of those gone free.
    Population<Dim> finish(std::int64_t first_new = 0) const;

  private:
    struct Change {
        std::vector<std::size_t> merged{};
        Points<Dim> offsets{};
        bool removed = false;
        Point<Dim> apart = Point<Dim>::Zero();  ///< of two that are made of more
    };
    Change& change_of(std::size_t i);

    const Particles<Dim>& before_;
    std::vector<Mat<Dim>> deformation_;
    Box<Dim> box_;
    std::vector<int>
        change_;  ///< by particle, place in changes_; -1: none; -2: goes into another one
    std::vector<Change> changes_;
};

SPAM_COMPILED(extern template class Repopulation);

}  // namespace spam
