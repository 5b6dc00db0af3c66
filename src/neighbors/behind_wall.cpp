// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/look_ahead.hpp>
#include <spam/neighbors/behind_wall.hpp>

#include <algorithm>
#include <numeric>

namespace spam {

/// Clusters that have images behind the wall for neighbours, and these images, as a list of its own.
template <int Dim>
void BehindWall<Dim>::gather(const ClusterList<Dim>& list, std::size_t stride) {
    const auto width = static_cast<std::size_t>(list.width());
    slots_.clear();
    entries_.clear();
    clusters_.clear();
    std::size_t filled_up = 0;  // lanes behind the last particle
    for (std::size_t c = 0; c < list.clusters(); ++c) {
        const std::size_t before = entries_.size();
        for (const std::uint32_t entry : list.entries(c))
            if (list.behind(entry / stride, axis_, upper_)) entries_.push_back(entry);
        if (entries_.size() == before) continue;
        for (std::size_t slot = c * width; slot < (c + 1) * width; ++slot)
            slots_.push_back(static_cast<std::uint32_t>(slot));
        filled_up = std::max(list.size(), (c + 1) * width) - list.size();
        clusters_.push_back({nullptr, static_cast<std::uint32_t>(entries_.size() - before)});
    }
    const std::size_t lanes = slots_.size();
    particles_ = lanes - filled_up;
    std::vector<std::uint32_t> images = entries_;
    std::sort(images.begin(), images.end());
    images.erase(std::unique(images.begin(), images.end()), images.end());
    for (std::uint32_t& entry : entries_) {
        const auto at = std::lower_bound(images.begin(), images.end(), entry) - images.begin();
        entry = static_cast<std::uint32_t>((lanes + static_cast<std::size_t>(at)) * stride);
    }
    entries_.insert(entries_.end(), entries_ahead, 0);
    for (const std::uint32_t image : images)
        slots_.push_back(image / static_cast<std::uint32_t>(stride));
    const std::uint32_t* next = entries_.data();
    for (ClusterView::Entries& cluster : clusters_) {
        cluster.first = next;
        next += cluster.count;
    }
    records_.resize(slots_.size() * stride);
    not_wanted.resize((Dim + 2) * lanes);
    number_places(list);
}

/// Particles in the order of their numbers, whatever the list.
template <int Dim>
void BehindWall<Dim>::number_places(const ClusterList<Dim>& list) {
    const auto number = [&](std::uint32_t at) { return list.order()[slots_[at]]; };
    place.resize(particles_);
    std::iota(place.begin(), place.end(), 0U);
    std::sort(place.begin(), place.end(),
              [&](std::uint32_t p, std::uint32_t q) { return number(p) < number(q); });
    particle.resize(particles_);
    std::transform(place.begin(), place.end(), particle.begin(), number);
    const std::size_t lanes = clusters_.size() * static_cast<std::size_t>(list.width());
    order_.resize(lanes);
    std::iota(order_.begin(), order_.end(), 0U);
    v_dot.assign(Dim * lanes, 0.0);
    e_dot.assign(lanes, 0.0);
}

template <int Dim>
bool BehindWall<Dim>::load(const ClusterList<Dim>& list, const double* records,
                           std::size_t stride) {
    if (build_ != list.builds()) gather(list, stride);
    build_ = list.builds();
    for (std::size_t k = 0; k < slots_.size(); ++k)
        std::copy_n(records + slots_[k] * stride, stride, records_.data() + k * stride);
    return !clusters_.empty();
}

SPAM_COMPILED(template class BehindWall);

}  // namespace spam
