// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/particles.hpp>
#include <spam/core/tensor.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace spam {

/// Another set of particles made of an earlier one, and what each is made of.
template <int Dim>
struct Population {
    /// A part of a new particle: an old one, where the new one lies from it, and which share of the new
    /// one's mass comes from it.
    struct Part {
        /// Number of the old particle.
        std::uint32_t particle;
        /// Of the new particle's mass, 0 to 1.
        double share;
        /// From the old particle to the new one, in units of length; of several from their centre of mass.
        Point<Dim> offset;
        /// Of the old particle's mass, 0 to 1.
        double of = 1.0;
    };
    /// Whether these parts were merged into two particles, which turn about each other as the parts did.
    static bool is_twin(const std::vector<Part>& parts) {
        return parts.size() > 1 && parts.front().of < 1.0;
    }
    /// The new set.
    Particles<Dim> particles;
    std::vector<std::vector<Part>> parts;  ///< by new particle; shares of each sum to 1
    std::vector<std::uint32_t> removed;    ///< old particles that none is made of
};

/// F^-1, which takes a way in space to one in the material; 1 where it has no meaning (|det F| <= 1e-3).
template <int Dim>
Mat<Dim> into_material(const Mat<Dim>& F) {
    if (std::abs(determinant(F)) > 1e-3) return inverse(F);
    Mat<Dim> one;
    for (int a = 0; a < Dim; ++a) one(a, a) = 1.0;
    return one;
}

/// Splits, merges and removes particles, each of them at most once. Particles that nothing is said of stay
/// as they are; the order in memory is kept, children take their parent's place. Ids stay with those
/// that stay; a merged particle has the first one's, children have numbers that were not there.
template <int Dim>
class Repopulation {
  public:
    /// Of `before`, which must outlive it. `deformation`: F of each, Model::deformation_gradients() of the state in
    /// which they are split; empty where the model remembers no places in the material.
    explicit Repopulation(const Particles<Dim>& before, std::vector<Mat<Dim>> deformation = {});

    /// Particle i in offsets.cols() >= 2 of equal mass, at these places d (Dim x children) from its own, and
    /// F^-1 d from its reference position; their sum must be zero (then momentum and angular momentum are
    /// kept), or InputError.
    void split(std::size_t i, const Points<Dim>& offsets);
    /// Two or more particles in one, at their centre of mass, now and in the reference positions. Throws InputError
    /// for different materials or bodies.
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
    std::vector<int>
        change_;  ///< by particle, place in changes_; -1: none; -2: goes into another one
    std::vector<Change> changes_;
};

SPAM_COMPILED(extern template class Repopulation);

}  // namespace spam
