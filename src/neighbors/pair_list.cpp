// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/neighbors/cluster_list.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <algorithm>

namespace spam {

template <int Dim>
PairList<Dim>::PairList(const Points<Dim>& position, double reach, const Box<Dim>& box) {
    // Clusters of one particle lie as well in one order as in another: slots are particle numbers, and
    // entries, which are in ascending slot, ascend.
    ClusterList<Dim> clusters(reach, 0.0, box, 1);
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
                       [&](std::uint32_t k) { return order[k]; });
    }
}

template class PairList<1>;
template class PairList<2>;
template class PairList<3>;

}  // namespace spam
