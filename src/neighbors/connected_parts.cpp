// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/neighbors/connected_parts.hpp>
#include <spam/neighbors/pair_list.hpp>

namespace spam {

template <int Dim>
std::vector<std::int32_t> connected_parts(const Points<Dim>& position, double reach,
                                          const Box<Dim>& box) {
    const auto n = static_cast<std::size_t>(position.cols());
    const PairList<Dim> list(position, reach, box);
    std::vector<std::int32_t> body(n, -1);
    std::vector<std::uint32_t> frontier;
    std::int32_t bodies = 0;
    for (std::size_t first = 0; first < n; ++first) {
        if (body[first] >= 0) continue;
        body[first] = bodies;
        frontier.assign(1, static_cast<std::uint32_t>(first));
        while (!frontier.empty()) {
            const std::uint32_t i = frontier.back();
            frontier.pop_back();
            for (const std::uint32_t j : list.neighbours(i)) {
                if (body[j] >= 0) continue;
                body[j] = bodies;
                frontier.push_back(j);
            }
        }
        ++bodies;
    }
    return body;
}

template std::vector<std::int32_t> connected_parts(const Points<1>&, double, const Box<1>&);
template std::vector<std::int32_t> connected_parts(const Points<2>&, double, const Box<2>&);
template std::vector<std::int32_t> connected_parts(const Points<3>&, double, const Box<3>&);

}  // namespace spam
