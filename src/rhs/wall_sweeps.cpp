// SPDX-License-Identifier: GPL-3.0-or-later
#include "wall_sweeps.hpp"

#include <algorithm>
#include <numeric>

namespace spam {

template <int Dim>
WallSweeps<Dim>::WallSweeps(const Box<Dim>& box) {
    for (int a = 0; a < Dim; ++a)
        for (const bool upper : {false, true})
            if (box.wall(a, upper).has_images()) {
                parts_.emplace_back();
                parts_.back().rates.axis = a;
                parts_.back().rates.upper = upper;
            }
}

template <int Dim>
const WallRates<Dim>* WallSweeps<Dim>::find(int a, bool upper) const {
    for (const Part& part : parts_)
        if (part.rates.axis == a && part.rates.upper == upper) return &part.rates;
    return nullptr;
}

/// Clusters that have images behind the wall for neighbours, and these images, as a list of its own.
template <int Dim>
void WallSweeps<Dim>::gather(Part& part, const ClusterList<Dim>& list, std::size_t stride) {
    const ClusterView behind = list.behind_wall(part.rates.axis, part.rates.upper);
    const auto width = static_cast<std::size_t>(list.width());
    part.slots.clear(), part.entries.clear(), part.clusters.clear();
    std::size_t filled_up = 0;  // lanes behind the last particle
    for (std::size_t c = 0; c < behind.clusters; ++c) {
        const auto [first, count] = behind.entries[c];
        if (count == 0) continue;
        for (std::size_t slot = c * width; slot < (c + 1) * width; ++slot)
            part.slots.push_back(static_cast<std::uint32_t>(slot));
        filled_up = std::max(behind.particles, (c + 1) * width) - behind.particles;
        part.clusters.push_back({nullptr, count});
        part.entries.insert(part.entries.end(), first, first + count);
    }
    const std::size_t lanes = part.slots.size();
    part.particles = lanes - filled_up;
    std::vector<std::uint32_t> images = part.entries;
    std::sort(images.begin(), images.end());
    images.erase(std::unique(images.begin(), images.end()), images.end());
    for (std::uint32_t& entry : part.entries) {
        const auto at = std::lower_bound(images.begin(), images.end(), entry) - images.begin();
        entry = static_cast<std::uint32_t>((lanes + static_cast<std::size_t>(at)) * stride);
    }
    part.entries.insert(part.entries.end(), 2, 0);  // sweeps look one ahead
    for (const std::uint32_t image : images)
        part.slots.push_back(image / static_cast<std::uint32_t>(stride));
    const std::uint32_t* next = part.entries.data();
    for (ClusterView::Entries& cluster : part.clusters) {
        cluster.first = next;
        next += cluster.count;
    }
    part.records.resize(part.slots.size() * stride);
    part.not_wanted.resize((Dim + 2) * lanes);
    number_places(part, list);
}

/// Sums over the particles are to be in the order of their numbers, whatever the list.
template <int Dim>
void WallSweeps<Dim>::number_places(Part& part, const ClusterList<Dim>& list) {
    WallRates<Dim>& rates = part.rates;
    const auto number = [&](std::uint32_t place) { return list.order()[part.slots[place]]; };
    rates.place.resize(part.particles);
    std::iota(rates.place.begin(), rates.place.end(), 0U);
    std::sort(rates.place.begin(), rates.place.end(),
              [&](std::uint32_t p, std::uint32_t q) { return number(p) < number(q); });
    rates.particle.resize(part.particles);
    std::transform(rates.place.begin(), rates.place.end(), rates.particle.begin(), number);
    const std::size_t lanes = part.clusters.size() * static_cast<std::size_t>(list.width());
    part.order.resize(lanes);
    std::iota(part.order.begin(), part.order.end(), 0U);
    rates.v_dot.assign(Dim * lanes, 0.0);
    rates.e_dot.assign(lanes, 0.0);
}

template <int Dim>
void WallSweeps<Dim>::sweep(const ClusterList<Dim>& list, const SweepInput<Dim>& in,
                            Sweep<Dim> run) {
    const std::size_t stride = in.records.stride;
    for (Part& part : parts_) {
        if (part.build != list.builds()) gather(part, list, stride);
        part.build = list.builds();
        if (part.clusters.empty()) continue;
        for (std::size_t k = 0; k < part.slots.size(); ++k)
            std::copy_n(in.records.numbers + part.slots[k] * stride, stride,
                        part.records.data() + k * stride);
        SweepInput<Dim> behind = in;
        behind.list = {part.particles, part.clusters.size(), part.order.data(),
                       part.clusters.data()};
        behind.records.numbers = part.records.data();
        const std::size_t lanes = part.order.size();
        SweepOutput<Dim> out;
        out.v_dot = part.rates.v_dot.data();
        out.e_dot = out.approach = part.rates.e_dot.data();
        out.x_dot = part.not_wanted.data();
        out.rho_dot = part.not_wanted.data() + Dim * lanes;
        out.spread = part.not_wanted.data() + (Dim + 1) * lanes;
        run(behind, out);
    }
}

template class WallSweeps<1>;
template class WallSweeps<2>;
template class WallSweeps<3>;

}  // namespace spam
