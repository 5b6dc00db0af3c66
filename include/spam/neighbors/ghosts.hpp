// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/box.hpp>
#include <spam/neighbors/image.hpp>

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
    /// Which of a particle's images, along the last direction in the lowest four bits: the walls below and
    /// above or the periods from the particle, counted from 8, ascending with the coordinate. So this order
    /// of the images of one particle, itself among them, is the same whichever of them is at home.
    static constexpr std::uint32_t itself = Dim == 1 ? 0x8 : Dim == 2 ? 0x88 : 0x888;

    /// Finds all images of particles that lie within `reach` of the bounds of these particles; images of
    /// images among them. Positions Dim x N by number, at home; slots by number. Coordinates x by slot; those of ghosts are written from slot `first` on, in
    /// ascending number of their owner and ascending `which`.
    void build(const Box<Dim>& box, double reach, const Points<Dim>& position,
               std::span<const std::uint32_t> slot_of, std::size_t first,
               std::array<std::vector<double>, Dim>& x);

    std::size_t size() const { return owner_.size(); }
    /// The slot of the particle whose image ghost number g is.
    std::uint32_t owner(std::size_t g) const { return owner_[g]; }
    /// Which of its images: the same number at every build, but for the period of the particle's home.
    std::uint32_t which(std::size_t g) const { return code_[g]; }
    /// Where its slot is.
    std::size_t slot(std::size_t g) const { return first_ + g; }

    /// Whether ghost number g is behind that wall across direction a; where it is an image of an image, the
    /// wall of the last direction counts. Precondition: the side is not open.
    bool behind(std::size_t g, int a, bool upper) const {
        return wall_of_[image_[g]] == 2 * a + upper;
    }

    /// The numbers from `from` on in the records of all ghosts, as those of their owners are now.
    void refresh(double* records, std::size_t stride, std::span<const NumberKind> numbers,
                 std::size_t from = 0) const;

  private:
    /// Every image along one direction; number 8 is the particle itself.
    static constexpr std::uint32_t most_images = 16, middle = 8;
    struct Along {
        std::vector<std::uint32_t> numbers;  ///< of the images there are, ascending
        std::array<Image<Dim>, most_images> image;
        double low, high;  ///< a particle between these has none within the reach
    };
    struct Place {
        std::uint32_t owner, code;
        Point<Dim> x;
    };

    void find_bounds(const Points<Dim>& position);
    void find_images(const Box<Dim>& box, int a, double reach);
    void collect(double reach, const Points<Dim>& position, std::span<const std::uint32_t> slot_of);
    void add_images(std::uint32_t owner, const Point<Dim>& x, double reach);
    void add_image(const Box<Dim>& box, std::uint32_t code);

    std::array<Along, Dim> along_;
    std::vector<Place> places_;
    std::array<double, Dim> low_{}, high_{};  ///< of the particles
    std::uint32_t first_ = 0;
    std::vector<std::uint32_t> owner_, code_, image_;
    std::vector<Image<Dim>> images_;       ///< those that occur
    std::vector<int> wall_of_;             ///< 2 a + (1 for the upper one); -1: behind none
    mutable std::vector<double> changes_;  ///< sign and shift of every number, by image
};

extern template class Ghosts<1>;
extern template class Ghosts<2>;
extern template class Ghosts<3>;

}  // namespace spam
