// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parallel.hpp>
#include <spam/neighbors/ghosts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {

template <int Dim>
void Ghosts<Dim>::find_bounds(const Points<Dim>& position) {
    low_.fill(std::numeric_limits<double>::infinity());
    high_.fill(-std::numeric_limits<double>::infinity());
    for (Eigen::Index i = 0; i < position.cols(); ++i)
        for (std::size_t a = 0; a < Dim; ++a) {
            const double x = position(static_cast<Eigen::Index>(a), i);
            low_[a] = std::min(low_[a], x);
            high_[a] = std::max(high_[a], x);
        }
}

/// By the walls, or as many periods away as have room between the particles' bounds.
template <int Dim>
void Ghosts<Dim>::find_images(const Box<Dim>& box, int a, double reach) {
    const auto axis = static_cast<std::size_t>(a);
    Along& along = along_[axis];
    const double from = low_[axis] - reach, to = high_[axis] + reach;
    along.numbers.clear();
    along.image.fill({});
    along.low = -std::numeric_limits<double>::infinity(), along.high = -along.low;
    const auto add = [&](std::uint32_t number, const Image<Dim>& image) {
        const auto [sign, shift] = image.position[axis];
        along.numbers.push_back(number);
        along.image[number] = image;
        const bool below = number < middle;
        const double end = below ? from : to;  // where the image is just within the reach
        if ((sign > 0.0) == below)
            along.high = std::min(along.high, sign * (end - shift));
        else
            along.low = std::max(along.low, sign * (end - shift));
    };
    // Walls across a direction are further apart than the range (ClusterList): images of images in them
    // have no neighbours.
    for (const bool upper : {false, true})
        if (const auto& wall = box.wall(a, upper); wall.has_images())
            add(upper ? middle + 1 : middle - 1, wall.image(a));
    if (!box.periodic(a)) return;
    const double L = box.length(a);
    int most = 0;
    while (most + 1 < static_cast<int>(middle) &&
           (most + 1) * L <= high_[axis] - low_[axis] + reach)
        ++most;
    for (int k = -most; k <= most; ++k) {
        if (k == 0) continue;
        Image<Dim> image;
        image.position[axis].shift = k * L;
        add(static_cast<std::uint32_t>(static_cast<int>(middle) + k), image);
    }
}

/// All combinations of the images along each direction: so corners are images of images.
template <int Dim>
void Ghosts<Dim>::add_images(std::uint32_t owner, const Point<Dim>& x, double reach) {
    struct Option {
        std::uint32_t number;
        double x;
    };
    std::array<std::array<Option, most_images>, Dim> options;
    std::array<std::size_t, Dim> count{}, chosen{};
    for (std::size_t a = 0; a < Dim; ++a) {
        const double now = x[static_cast<Eigen::Index>(a)];
        const auto append = [&](std::uint32_t number, double image) {
            options[a][count[a]++] = {number, image};
        };
        bool passed = false;
        for (const std::uint32_t number : along_[a].numbers) {
            if (number > middle && !passed) append(middle, now), passed = true;
            const auto change = along_[a].image[number].position[a];
            const double image = change.sign * now + change.shift;
            if (!(image >= low_[a] - reach && image <= high_[a] + reach)) continue;
            append(number, image);
        }
        if (!passed) append(middle, now);
    }
    for (;;) {
        Place place{owner, 0, {}};
        for (std::size_t a = 0; a < Dim; ++a) {
            const Option& option = options[a][chosen[a]];
            place.code = place.code * most_images + option.number;
            place.x[static_cast<Eigen::Index>(a)] = option.x;
        }
        if (place.code != itself) places_.push_back(place);
        std::size_t a = Dim;
        while (a > 0 && ++chosen[a - 1] == count[a - 1]) chosen[--a] = 0;
        if (a == 0) return;
    }
}

template <int Dim>
void Ghosts<Dim>::collect(double reach, const Points<Dim>& position,
                          std::span<const std::uint32_t> slot_of) {
    for (Eigen::Index i = 0; i < position.cols(); ++i) {
        bool inside = true;
        for (std::size_t a = 0; a < Dim; ++a) {
            const double x = position(static_cast<Eigen::Index>(a), i);
            inside = inside && x > along_[a].low && x < along_[a].high;
        }
        if (inside) continue;
        add_images(slot_of[static_cast<std::size_t>(i)], position.col(i), reach);
    }
}

/// The image of that code and the wall it is behind.
template <int Dim>
void Ghosts<Dim>::add_image(const Box<Dim>& box, std::uint32_t code) {
    Image<Dim> image;
    int wall = -1;
    for (int a = 0; a < Dim; ++a) {
        const std::uint32_t number = code >> 4 * (Dim - 1 - a) & (most_images - 1);
        image = image.then(along_[static_cast<std::size_t>(a)].image[number]);
        if (number != middle && box.walled(a)) wall = 2 * a + (number > middle ? 1 : 0);
    }
    images_.push_back(image);
    wall_of_.push_back(wall);
}

template <int Dim>
void Ghosts<Dim>::build(const Box<Dim>& box, double reach, const Points<Dim>& position,
                        std::span<const std::uint32_t> slot_of, std::size_t first,
                        std::array<std::vector<double>, Dim>& x) {
    first_ = static_cast<std::uint32_t>(first);
    places_.clear();
    if (position.cols() > 0 && (box.periodic() || box.walled())) {
        find_bounds(position);
        for (int a = 0; a < Dim; ++a) find_images(box, a, reach);
        collect(reach, position, slot_of);
    }
    const std::size_t count = places_.size();
    for (auto& coordinate : x) coordinate.resize(first + count + 8);
    owner_.resize(count);
    code_.resize(count);
    image_.resize(count);
    images_.clear();
    wall_of_.clear();
    constexpr std::uint32_t unseen = 0xffffffff;
    std::array<std::uint32_t, 1U << 4 * Dim> image_of;
    if (count > 0) image_of.fill(unseen);
    for (std::size_t g = 0; g < count; ++g) {
        const Place& place = places_[g];
        owner_[g] = place.owner;
        code_[g] = place.code;
        for (std::size_t a = 0; a < Dim; ++a)
            x[a][first + g] = place.x[static_cast<Eigen::Index>(a)];
        std::uint32_t& number = image_of[place.code];
        if (number == unseen) {
            number = static_cast<std::uint32_t>(images_.size());
            add_image(box, place.code);
        }
        image_[g] = number;
    }
}

template <int Dim>
void Ghosts<Dim>::refresh(double* records, std::size_t stride, std::span<const NumberKind> numbers,
                          std::size_t from) const {
    if (owner_.empty()) return;
    const std::size_t count = std::min(numbers.size(), stride) - from;
    changes_.resize(2 * count * images_.size());
    double* change = changes_.data();
    for (const auto& image : images_)
        for (std::size_t k = 0; k < count; ++k) {
            const auto [sign, shift] = image.of(numbers[from + k]);
            change[k] = sign, change[count + k] = shift;
            if (k + 1 == count) change += 2 * count;
        }
    parallel_for(owner_.size(), [&](std::size_t g) {
        const double* const sign = changes_.data() + 2 * count * image_[g];
        const double* const shift = sign + count;
        const double* const own = records + owner_[g] * stride + from;
        double* const ghost = records + (first_ + g) * stride + from;
        // A sign and, for positions, a shift on the grid of the period: exact.
        for (std::size_t k = 0; k < count; ++k) ghost[k] = sign[k] * own[k] + shift[k];
    });
}

template class Ghosts<1>;
template class Ghosts<2>;
template class Ghosts<3>;

}  // namespace spam
