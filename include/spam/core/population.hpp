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
    /// Of the periodic box by whose nearest images reference positions of merged particles were averaged; 0: none.
    Point<Dim> periods = Point<Dim>::Zero();
};

/// F^-1, which takes a way in space to one in the material; 1 where it has no meaning (|det F| <= 1e-3).
template <int Dim>
Mat<Dim> into_material(const Mat<Dim>& F) {
    if (std::abs(determinant(F)) > 1e-3) return inverse(F);
    Mat<Dim> one;
    for (int a = 0; a < Dim; ++a) one(a, a) = 1.0;
    return one;
}

}  // namespace spam
