// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/box.hpp>
#include <spam/neighbors/image.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace spam {

/// Images of particles that others have for neighbours, beyond the borders of a periodic box and behind
/// walls, and particles of other parts of the run (core/parts.hpp) with their images: slots behind those of the
/// particles themselves. A ghost is its owner's slot and how its numbers follow from the owner's; these are made
/// anew (refresh) whenever those that neighbours read have changed. Ghosts are neighbours only, never particles
/// whose sums are wanted, and so sweeps know nothing of them.
///
/// The owner's part makes an image, and gives its numbers to the part that needs it; both keep the list of these from
/// one build to the next. With one part there is nothing to give.
template <int Dim>
class Ghosts {
  public:
    /// Which of a particle's images, along the last direction in the lowest four bits: the walls below and
    /// above or the periods from the particle, counted from 8, ascending with the coordinate. So this order
    /// of the images of one particle, itself among them, is the same whichever of them is at home.
    static constexpr std::uint32_t itself = Dim == 1 ? 0x8 : Dim == 2 ? 0x88 : 0x888;

    /// Finds all images of particles that lie within `reach` of the bounds of these particles; images of
    /// images among them. Positions Dim x N by number, at home; slots by number. Coordinates x by slot; those of ghosts
    /// are written from slot `first` on, in ascending number of their owner in the whole run and ascending `which`.
    void build(const Box<Dim>& box, double reach, const Points<Dim>& position,
               std::span<const std::uint32_t> slot_of, std::size_t first,
               std::array<std::vector<double>, Dim>& x);

    std::size_t size() const { return owner_.size(); }
    /// The slot of the particle whose image ghost number g is. Precondition: it is of this part.
    std::uint32_t owner(std::size_t g) const { return owner_[g]; }
    /// The number of that particle in the whole run.
    std::uint32_t number(std::size_t g) const { return number_[g]; }
    /// Which of its images: the same number at every build, but for the period of the particle's home.
    std::uint32_t which(std::size_t g) const { return code_[g]; }
    /// Where its slot is.
    std::size_t slot(std::size_t g) const { return first_ + g; }

    /// Whether ghost number g is behind that wall across direction a. In a corner of two walls it is behind one of
    /// them: that which passes energy, for what it takes does not stay with an insulated mirror; of two that are alike
    /// the one across the last direction.
    bool behind(std::size_t g, int a, bool upper) const {
        const auto side_of = [&](int b) {
            const std::uint32_t number = number_along(code_[g], b);
            const std::size_t side = 2 * static_cast<std::size_t>(b) + (number > middle ? 1 : 0);
            return std::pair(number == middle ? Gives::nothing : gives_[side], side);
        };
        const auto [own, side] = side_of(a);
        if (own == Gives::nothing || (side % 2 == 1) != upper) return false;
        for (int b = 0; b < Dim; ++b)
            if (const Gives other = side_of(b).first; other > own || (other == own && b > a))
                return false;
        return true;
    }

    /// The numbers from `from` on in the records of all ghosts, as those of their owners are now. Returns whether
    /// records are `valid` in every part; where they are not, nothing is given to others.
    bool refresh(double* records, std::size_t stride, std::span<const NumberKind> numbers,
                 std::size_t from = 0, bool valid = true) const;

  private:
    /// Every image along one direction; number 8 is the particle itself.
    static constexpr std::uint32_t most_images = 16, middle = 8;
    struct Along {
        std::vector<std::uint32_t> numbers;  ///< of the images there are, ascending
        std::array<Image<Dim>, most_images> image;
        double low, high;  ///< a particle between these has none within the reach
    };
    /// Owners in part p are `elsewhere` - p.
    static constexpr std::uint32_t elsewhere = 0xffffffff;
    /// In at_: no image of that code has occurred since the build began.
    static constexpr std::uint32_t unseen = 0xffffffff;
    struct Place {
        std::uint32_t owner, number, code, unused;
        std::array<double, Dim> x;
    };
    /// What is behind a side.
    enum class Gives : unsigned char { nothing, forces, energy };
    struct Corners {
        std::array<double, Dim> low, high;
    };
    /// Slots and images whose numbers are given to a part, and the ghosts whose numbers come from there.
    struct Exchange {
        std::vector<std::uint32_t> slot, image, ghost;
    };

    static std::uint32_t number_along(std::uint32_t code, int a) {
        return code >> 4 * (Dim - 1 - a) & (most_images - 1);
    }
    static Corners bounds_of(const Points<Dim>& position);
    void find_images(const Box<Dim>& box, int a, double reach, const Corners& own);
    void collect(double reach, const Points<Dim>& position, std::span<const std::uint32_t> slot_of,
                 bool itself_too);
    void add_images(std::uint32_t owner, std::uint32_t number, const double* x, double reach,
                    bool itself_too);
    void meet_other_parts(const Box<Dim>& box, double reach, const Points<Dim>& position,
                          std::span<const std::uint32_t> slot_of, const Corners& own);
    void take_places(const Box<Dim>& box, std::array<std::vector<double>, Dim>& x);
    /// Where the image of that code is among those that occur.
    std::uint32_t image_of(const Box<Dim>& box, std::uint32_t code) {
        return at_[code] != unseen ? at_[code] : add_image(box, code);
    }
    std::uint32_t add_image(const Box<Dim>& box, std::uint32_t code);
    bool give(double* records, std::size_t stride, std::size_t count, std::size_t from,
              bool valid) const;
    /// A sign and, for positions, a shift on the grid of the period: exact.
    void make(const double* own, std::uint32_t image, std::size_t count, double* ghost) const {
        const double* const sign = changes_.data() + 2 * count * image;
        const double* const shift = sign + count;
        for (std::size_t k = 0; k < count; ++k) ghost[k] = sign[k] * own[k] + shift[k];
    }

    std::array<Along, Dim> along_;
    std::vector<Place> places_;
    Corners around_{};  ///< the particles of a part, for which images are looked for
    std::uint32_t first_ = 0;
    std::vector<std::uint32_t> owner_, number_, code_, image_;
    std::array<Gives, 2 * std::size_t{Dim}> gives_{};  ///< lower and upper side of each direction
    std::vector<Image<Dim>> images_;                   ///< those that occur
    std::array<std::uint32_t, 1U << 4 * Dim> at_;      ///< in images_, by code
    std::vector<Exchange> parts_;                      ///< empty where there is one part
    mutable std::vector<double> changes_;              ///< sign and shift of every number, by image
};

SPAM_COMPILED(extern template class Ghosts);

}  // namespace spam
