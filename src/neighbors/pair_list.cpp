// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/neighbors/cluster_list.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {

template <int Dim>
void require_one_image(const Box<Dim>& box, double reach) {
    for (int a = 0; a < Dim; ++a)
        if (box.periodic(a) && !(box.length(a) > 2.0 * reach))
            throw InputError(fmt::format(
                "box: periodic length {} of direction {} must exceed twice the range, {}; enlarge the "
                "box or shorten --range",
                box.length(a), "xyz"[a], 2.0 * reach));
}

template <int Dim>
PairList<Dim>::PairList(const Points<Dim>& position, double reach, const Box<Dim>& box) {
    require_one_image(box, reach);
    // Clusters of one particle: entries ascend with the particles' numbers.
    ClusterList<Dim> clusters(reach, 0.0, box.without_walls(), 1);
    clusters.build(position);
    const auto order = clusters.order();
    start_.assign(clusters.size() + 1, 0);
    for (std::size_t slot = 0; slot < clusters.size(); ++slot)
        start_[order[slot] + 1] = clusters.entries(slot).size();
    for (std::size_t i = 0; i < clusters.size(); ++i) start_[i + 1] += start_[i];
    entries_.resize(start_.back());
    for (std::size_t slot = 0; slot < clusters.size(); ++slot) {
        const auto entries = clusters.entries(slot);
        std::transform(entries.begin(), entries.end(),
                       entries_.begin() + static_cast<std::ptrdiff_t>(start_[order[slot]]),
                       [&](std::uint32_t k) { return clusters.particle(k); });
    }
}

#define SPAM_INSTANTIATE(D) template void require_one_image(const Box<D>&, double);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)
SPAM_COMPILED(template class PairList);

}  // namespace spam
