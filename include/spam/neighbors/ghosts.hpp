// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/bounds.hpp>
#include <spam/neighbors/box.hpp>
#include <spam/neighbors/image.hpp>
#include <spam/neighbors/strip_sort.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace spam {

/// Images of particles that others have for neighbours, beyond the borders of a periodic box and behind
/// walls: slots behind those of the particles themselves. A ghost is its owner's slot and how its numbers follow from the
/// owner's; these are made anew (refresh) whenever those that neighbours read have changed. Ghosts are
/// neighbours only, never particles whose sums are wanted, and so sweeps know nothing of them.
template <int Dim>
class Ghosts {
  public:
    /// Finds all images of the first `particles` slots that lie within `reach` of the bounds of these
    /// particles; images of images among them. x: coordinates by slot; those of ghosts are written from
    /// slot `first` on.
    void build(const Box<Dim>& box, double reach, std::size_t particles, std::size_t first,
               std::array<std::vector<double>, Dim>& x);

    std::size_t size() const { return owner_.size(); }
    /// The slot of the particle whose image ghost number g is.
    std::uint32_t owner(std::size_t g) const { return owner_[g]; }
    /// Which of a particle's images: the same number at every build.
    std::uint32_t which(std::size_t g) const { return code_[g]; }

    /// Whether ghost number g is behind that wall across direction a; where it is an image of an image, the
    /// wall of the last direction counts. Precondition: the side is not open.
    bool behind(std::size_t g, int a, bool upper) const {
        return wall_of_[image_[g]] == 2 * a + upper;
    }

    /// Whether there may be ghosts within `reach` of the bounds.
    bool near(const Bounds<Dim>& bounds, double reach) const;
    /// visit(first, last): ranges of slots that hold all ghosts within the reach of the bounds.
    template <class Visit>
    void for_each_range(const Bounds<Dim>& bounds, double reach, const Visit& visit) const {
        Point<Dim> low, high;
        for (int a = 0; a < Dim; ++a) {
            low[a] = bounds.centre[a] - bounds.half[a] - reach;
            high[a] = bounds.centre[a] + bounds.half[a] + reach;
        }
        strips_.for_each_range(low, high, [&](std::uint32_t from, std::uint32_t to) {
            if (from < to) visit(first_ + from, first_ + to);
        });
    }

    /// The numbers from `from` on in the records of all ghosts, as those of their owners are now.
    void refresh(double* records, std::size_t stride, std::span<const NumberKind> numbers,
                 std::size_t from = 0) const;

  private:
    struct Place {
        std::uint32_t owner, code;
        Point<Dim> x;
    };
    /// Every image along one direction; number 0 is the particle itself.
    static constexpr std::uint32_t most_images = 16;

    void find_images(const Box<Dim>& box, int a, double low, double high, double reach);
    void collect(std::vector<Place>& places, double reach, std::size_t particles,
                 const std::array<std::vector<double>, Dim>& x);

    std::array<std::vector<Image<Dim>>, Dim> along_;  ///< images along each direction
    std::array<double, Dim> low_{}, high_{};          ///< of the particles
    std::array<double, Dim> below_{}, above_{};       ///< nearest ghosts made along each direction
    std::uint32_t first_ = 0;
    std::vector<std::uint32_t> owner_, code_, image_;
    std::vector<Image<Dim>> images_;  ///< those that occur
    std::vector<int> wall_of_;        ///< 2 a + (1 for the upper one); -1: behind none
    StripSort<Dim> strips_;
    mutable std::vector<double> changes_;  ///< sign and shift of every number, by image
};

extern template class Ghosts<1>;
extern template class Ghosts<2>;
extern template class Ghosts<3>;

}  // namespace spam
