// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parallel.hpp>
#include <spam/neighbors/ghosts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {

/// By the walls, or k periods away, by ascending |k|: as many as have room between the particles' bounds.
/// So a number says the same of every list.
template <int Dim>
void Ghosts<Dim>::find_images(const Box<Dim>& box, int a, double low, double high, double reach) {
    const auto axis = static_cast<std::size_t>(a);
    along_[axis].assign(1, {});
    // Walls across a direction are further apart than the range (ClusterList): images of images in them
    // have no neighbours.
    for (const bool upper : {false, true})
        if (const auto& wall = box.wall(a, upper); wall.has_images())
            along_[axis].push_back(wall.image(a));
    if (!box.periodic(a)) return;
    const double L = box.length(a);
    for (int k = 1; 2 * k < static_cast<int>(most_images) && k * L <= high - low + reach; ++k)
        for (const int sign : {-1, 1}) {
            Image<Dim> image;
            image.position[axis].shift = sign * k * L;
            along_[axis].push_back(image);
        }
}

/// Direction by direction, of the particles and of the ghosts made along the directions before: so corners
/// are images of images.
template <int Dim>
void Ghosts<Dim>::collect(std::vector<Place>& places, double reach, std::size_t particles,
                          const std::array<std::vector<double>, Dim>& x) {
    std::uint32_t digit = 1;
    for (std::size_t a = 0; a < Dim; ++a, digit *= most_images) {
        const auto axis = static_cast<Eigen::Index>(a);
        const double from = low_[a] - reach, to = high_[a] + reach;
        const std::size_t before = places.size();
        for (std::uint32_t number = 1; number < along_[a].size(); ++number) {
            const auto change = along_[a][number].position[a];
            const auto enter = [&](double now, auto make) {
                const double image = change.sign * now + change.shift;
                if (!(image >= from && image <= to)) return;
                Place place = make();
                place.code += number * digit;
                place.x[axis] = image;
                places.push_back(place);
                const bool is_below = image < now;
                double& nearest = is_below ? below_[a] : above_[a];
                nearest = is_below ? std::max(nearest, image) : std::min(nearest, image);
            };
            for (std::size_t slot = 0; slot < particles; ++slot)
                enter(x[a][slot], [&] {
                    Place place{static_cast<std::uint32_t>(slot), 0, {}};
                    for (std::size_t b = 0; b < Dim; ++b)
                        place.x[static_cast<Eigen::Index>(b)] = x[b][slot];
                    return place;
                });
            for (std::size_t k = 0; k < before; ++k)
                enter(places[k].x[axis], [&] { return places[k]; });
        }
    }
}

template <int Dim>
void Ghosts<Dim>::build(const Box<Dim>& box, double reach, std::size_t particles, std::size_t first,
                        std::array<std::vector<double>, Dim>& x) {
    first_ = static_cast<std::uint32_t>(first);
    std::vector<Place> places;
    below_.fill(-std::numeric_limits<double>::infinity());
    above_.fill(std::numeric_limits<double>::infinity());
    if (particles > 0 && (box.periodic() || box.has_images())) {
        for (std::size_t a = 0; a < Dim; ++a) {
            const auto end = x[a].begin() + static_cast<std::ptrdiff_t>(particles);
            const auto [low, high] = std::minmax_element(x[a].begin(), end);
            low_[a] = *low, high_[a] = *high;
            find_images(box, static_cast<int>(a), low_[a], high_[a], reach);
        }
        collect(places, reach, particles, x);
    }
    Points<Dim> at(Dim, static_cast<Eigen::Index>(places.size()));
    for (std::size_t k = 0; k < places.size(); ++k)
        at.col(static_cast<Eigen::Index>(k)) = places[k].x;
    strips_.build(at, {});
    for (auto& coordinate : x) coordinate.resize(first + places.size() + 8);
    owner_.resize(places.size());
    code_.resize(places.size());
    image_.resize(places.size());
    std::uint32_t codes = 1;
    for (int a = 0; a < Dim; ++a) codes *= most_images;
    constexpr std::uint32_t unseen = 0xffffffff;
    std::vector<std::uint32_t> number(places.empty() ? 0 : codes, unseen);
    images_.clear();
    wall_of_.clear();
    const auto order = strips_.order();
    for (std::size_t g = 0; g < places.size(); ++g) {
        const Place& place = places[order[g]];
        owner_[g] = place.owner;
        code_[g] = place.code;
        for (std::size_t a = 0; a < Dim; ++a)
            x[a][first + g] = place.x[static_cast<Eigen::Index>(a)];
        std::uint32_t& of_code = number[place.code];
        if (of_code == unseen) {
            of_code = static_cast<std::uint32_t>(images_.size());
            Image<Dim> image;
            int wall = -1;
            for (std::uint32_t a = 0, rest = place.code; a < Dim; ++a, rest /= most_images) {
                const std::uint32_t along = rest % most_images;
                image = image.then(along_[a][along]);
                const auto axis = static_cast<int>(a);
                if (along == 0 || box.periodic(axis)) continue;
                const bool upper = along == 2 || !box.wall(axis, false).has_images();
                wall = 2 * axis + (upper ? 1 : 0);
            }
            images_.push_back(image);
            wall_of_.push_back(wall);
        }
        image_[g] = of_code;
    }
}

template <int Dim>
bool Ghosts<Dim>::near(const Bounds<Dim>& bounds, double reach) const {
    if (owner_.empty()) return false;
    for (std::size_t a = 0; a < Dim; ++a) {
        const double most = bounds.half[a] + reach;
        if (bounds.centre[a] - most <= below_[a] || bounds.centre[a] + most >= above_[a])
            return true;
    }
    return false;
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
