// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parallel.hpp>
#include <spam/core/parts.hpp>
#include <spam/neighbors/ghosts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {

template <int Dim>
auto Ghosts<Dim>::bounds_of(const Points<Dim>& position) -> Corners {
    Corners bounds;
    bounds.low.fill(std::numeric_limits<double>::infinity());
    bounds.high.fill(-std::numeric_limits<double>::infinity());
    for (Eigen::Index i = 0; i < position.cols(); ++i)
        for (std::size_t a = 0; a < Dim; ++a) {
            const double x = position(static_cast<Eigen::Index>(a), i);
            bounds.low[a] = std::min(bounds.low[a], x);
            bounds.high[a] = std::max(bounds.high[a], x);
        }
    return bounds;
}

/// By the walls, or as many periods away as have room between our own particles and those of `around_`.
template <int Dim>
void Ghosts<Dim>::find_images(const Box<Dim>& box, int a, double reach, const Corners& own) {
    const auto axis = static_cast<std::size_t>(a);
    Along& along = along_[axis];
    const double from = around_.low[axis] - reach, to = around_.high[axis] + reach;
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
    const double L = box.length(a), extent = std::max(around_.high[axis], own.high[axis]) -
                                             std::min(around_.low[axis], own.low[axis]);
    int most = 0;
    while (most + 1 < static_cast<int>(middle) && (most + 1) * L <= extent + reach) ++most;
    for (int k = -most; k <= most; ++k) {
        if (k == 0) continue;
        Image<Dim> image;
        image.position[axis].shift = k * L;
        add(static_cast<std::uint32_t>(static_cast<int>(middle) + k), image);
    }
}

/// All combinations of the images along each direction: so corners are images of images.
template <int Dim>
void Ghosts<Dim>::add_images(std::uint32_t owner, std::uint32_t number, const double* x,
                             double reach, bool itself_too) {
    struct Option {
        std::uint32_t number;
        double x;
    };
    std::array<std::array<Option, most_images>, Dim> options;
    std::array<std::size_t, Dim> count{}, chosen{};
    for (std::size_t a = 0; a < Dim; ++a) {
        const double from = around_.low[a] - reach, to = around_.high[a] + reach;
        const auto append = [&](std::uint32_t of, double image) {
            if (image >= from && image <= to) options[a][count[a]++] = {of, image};
        };
        bool passed = false;
        for (const std::uint32_t of : along_[a].numbers) {
            if (of > middle && !passed) append(middle, x[a]), passed = true;
            const auto change = along_[a].image[of].position[a];
            append(of, change.sign * x[a] + change.shift);
        }
        if (!passed) append(middle, x[a]);
        if (count[a] == 0) return;
    }
    for (;;) {
        Place place{owner, number, 0, 0, {}};
        for (std::size_t a = 0; a < Dim; ++a) {
            const Option& option = options[a][chosen[a]];
            place.code = place.code * most_images + option.number;
            place.x[a] = option.x;
        }
        if (itself_too || place.code != itself) places_.push_back(place);
        std::size_t a = Dim;
        while (a > 0 && ++chosen[a - 1] == count[a - 1]) chosen[--a] = 0;
        if (a == 0) return;
    }
}

/// `itself_too`: for another part.
template <int Dim>
void Ghosts<Dim>::collect(double reach, const Points<Dim>& position,
                          std::span<const std::uint32_t> slot_of, bool itself_too) {
    const Parts& parts = Parts::here();
    places_.clear();
    for (std::size_t i = 0; i < slot_of.size(); ++i) {
        const double* const x = position.data() + Dim * i;
        bool inside = !itself_too;
        for (std::size_t a = 0; a < Dim; ++a)
            inside = inside && x[a] > along_[a].low && x[a] < along_[a].high;
        if (!inside) add_images(slot_of[i], parts.number(i), x, reach, itself_too);
    }
}

template <int Dim>
std::uint32_t Ghosts<Dim>::add_image(const Box<Dim>& box, std::uint32_t code) {
    Image<Dim> image;
    for (int a = 0; a < Dim; ++a) {
        const std::uint32_t number = number_along(code, a);
        if (number == middle) continue;
        Image<Dim> along;
        if (box.periodic(a))
            along.position[static_cast<std::size_t>(a)].shift =
                (static_cast<int>(number) - static_cast<int>(middle)) * box.length(a);
        else
            along = box.wall(a, number > middle).image(a);
        image = image.then(along);
    }
    images_.push_back(image);
    return at_[code] = static_cast<std::uint32_t>(images_.size() - 1);
}

/// Around particles that follow each other in the order of slots, and are near each other there. Where those of several
/// parts are mixed, the bounds of a whole part hold many particles that have no neighbour in it.
template <class Corners, int Dim>
std::vector<Corners> bounds_of_runs(const Points<Dim>& position,
                                    std::span<const std::uint32_t> slot_of) {
    constexpr std::size_t run = 64, most = 256;
    const std::size_t n = slot_of.size(), each = std::max(run, (n + most - 1) / most);
    Corners none;
    none.low.fill(std::numeric_limits<double>::infinity());
    none.high.fill(-std::numeric_limits<double>::infinity());
    std::vector<Corners> bounds(n / each + 1, none);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t a = 0; a < Dim; ++a) {
            Corners& own = bounds[slot_of[i] / each];
            own.low[a] = std::min(own.low[a], position.data()[Dim * i + a]);
            own.high[a] = std::max(own.high[a], position.data()[Dim * i + a]);
        }
    return bounds;
}

/// Leaves the places that are within reach of one of these bounds.
template <class Place, class Corners>
void keep_near(std::vector<Place>& places, const std::vector<Corners>& bounds, double reach) {
    const auto near = [reach](const auto& x, const Corners& one) {
        for (std::size_t a = 0; a < x.size(); ++a)
            if (x[a] < one.low[a] - reach || x[a] > one.high[a] + reach) return false;
        return true;
    };
    std::erase_if(places, [&](const Place& place) {
        return std::ranges::none_of(bounds, [&](const Corners& one) { return near(place.x, one); });
    });
}

/// Every part tells each other one which of its particles, and images of them, are near there; what is near here comes
/// among our own images, by number.
template <int Dim>
void Ghosts<Dim>::meet_other_parts(const Box<Dim>& box, double reach, const Points<Dim>& position,
                                   std::span<const std::uint32_t> slot_of, const Corners& own) {
    Parts& parts = Parts::here();
    const auto runs = bounds_of_runs<Corners>(position, slot_of);
    const auto bounds = parts.gather(std::span<const Corners>(runs));
    keep_near(places_, runs, reach);
    std::vector<Place> all = std::move(places_);
    std::vector<Parts::Bytes> messages(parts.count());
    parts_.assign(parts.count(), {});
    for (std::size_t p = 0; p < parts.count(); ++p) {
        if (p == parts.own()) continue;
        around_ = bounds[p].front();
        for (const Corners& one : bounds[p])
            for (std::size_t a = 0; a < Dim; ++a) {
                around_.low[a] = std::min(around_.low[a], one.low[a]);
                around_.high[a] = std::max(around_.high[a], one.high[a]);
            }
        for (int a = 0; a < Dim; ++a) find_images(box, a, reach, own);
        collect(reach, position, slot_of, true);
        keep_near(places_, bounds[p], reach);
        for (const Place& place : places_) {
            parts_[p].slot.push_back(place.owner);
            parts_[p].image.push_back(image_of(box, place.code));
        }
        messages[p] = Parts::bytes_of(std::span<const Place>(places_));
    }
    const auto received = parts.exchange(std::move(messages));
    for (std::size_t p = 0; p < parts.count(); ++p)
        if (p != parts.own())
            for (Place place : Parts::values_of<Place>(received[p])) {
                place.owner = elsewhere - static_cast<std::uint32_t>(p);
                all.push_back(place);
            }
    std::stable_sort(all.begin(), all.end(), [](const Place& a, const Place& b) {
        return std::pair(a.number, a.code) < std::pair(b.number, b.code);
    });
    for (std::size_t g = 0; g < all.size(); ++g)
        if (all[g].owner > elsewhere - parts.count())
            parts_[elsewhere - all[g].owner].ghost.push_back(static_cast<std::uint32_t>(g));
    places_ = std::move(all);
}

template <int Dim>
void Ghosts<Dim>::take_places(const Box<Dim>& box, std::array<std::vector<double>, Dim>& x) {
    const std::size_t count = places_.size();
    for (auto& coordinate : x) coordinate.resize(first_ + count + 8);
    owner_.resize(count);
    number_.resize(count);
    code_.resize(count);
    image_.resize(count);
    for (std::size_t g = 0; g < count; ++g) {
        const Place& place = places_[g];
        owner_[g] = place.owner;
        number_[g] = place.number;
        code_[g] = place.code;
        for (std::size_t a = 0; a < Dim; ++a) x[a][first_ + g] = place.x[a];
        image_[g] = image_of(box, place.code);
    }
}

template <int Dim>
void Ghosts<Dim>::build(const Box<Dim>& box, double reach, const Points<Dim>& position,
                        std::span<const std::uint32_t> slot_of, std::size_t first,
                        std::array<std::vector<double>, Dim>& x) {
    const bool alone = Parts::here().alone();
    first_ = static_cast<std::uint32_t>(first);
    places_.clear();
    images_.clear();
    for (std::size_t side = 0; side < gives_.size(); ++side) {
        const Wall<Dim>& wall = box.wall(static_cast<int>(side / 2), side % 2 == 1);
        gives_[side] = wall.open()            ? Gives::nothing
                       : wall.passes_energy() ? Gives::energy
                                              : Gives::forces;
    }
    if (alone && !box.periodic() && !box.walled()) return take_places(box, x);
    at_.fill(unseen);
    const Corners own = around_ = bounds_of(position);
    for (int a = 0; a < Dim; ++a) find_images(box, a, reach, own);
    collect(reach, position, slot_of, false);
    if (!alone) meet_other_parts(box, reach, position, slot_of, own);
    take_places(box, x);
}

/// The numbers of images that other parts have, for those of theirs that are here. A message of a part whose
/// records are valid is never empty.
template <int Dim>
bool Ghosts<Dim>::give(double* records, std::size_t stride, std::size_t count, std::size_t from,
                       bool valid) const {
    Parts& parts = Parts::here();
    std::vector<Parts::Bytes> messages(parts.count());
    for (std::size_t p = 0; valid && p < parts.count(); ++p) {
        if (p >= parts_.size()) {
            messages[p].resize(sizeof(double));
            continue;
        }
        // Made and read where they travel, without a copy before and behind.
        messages[p] = Parts::room_for((parts_[p].slot.size() * count + 1) * sizeof(double));
        auto* const numbers = reinterpret_cast<double*>(messages[p].data());
        for (std::size_t n = 0; n < parts_[p].slot.size(); ++n)
            make(records + parts_[p].slot[n] * stride + from, parts_[p].image[n], count,
                 numbers + n * count);
    }
    const auto received = parts.exchange(std::move(messages), Parts::Content::images);
    for (const Parts::Bytes& message : received)
        if (message.empty()) return false;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        const auto* const numbers = reinterpret_cast<const double*>(received[p].data());
        for (std::size_t n = 0; n < parts_[p].ghost.size(); ++n)
            std::copy_n(numbers + n * count, count,
                        records + (first_ + parts_[p].ghost[n]) * stride + from);
    }
    return true;
}

template <int Dim>
bool Ghosts<Dim>::refresh(double* records, std::size_t stride, std::span<const NumberKind> numbers,
                          std::size_t from, bool valid) const {
    const bool alone = Parts::here().alone();
    if (alone && (!valid || owner_.empty())) return valid;
    const std::size_t count = std::min(numbers.size(), stride) - from;
    changes_.resize(2 * count * images_.size());
    double* change = changes_.data();
    for (const auto& image : images_)
        for (std::size_t k = 0; k < count; ++k) {
            const auto [sign, shift] = image.of(numbers[from + k]);
            change[k] = sign, change[count + k] = shift;
            if (k + 1 == count) change += 2 * count;
        }
    if (!alone && !give(records, stride, count, from, valid)) return false;
    const auto refreshed = [&](std::size_t g) {
        make(records + owner_[g] * stride + from, image_[g], count,
             records + (first_ + g) * stride + from);
    };
    if (alone)
        parallel_for(owner_.size(), refreshed);
    else
        parallel_for(owner_.size(), [&](std::size_t g) {
            if (owner_[g] < first_) refreshed(g);
        });
    return true;
}

SPAM_COMPILED(template class Ghosts);

}  // namespace spam
