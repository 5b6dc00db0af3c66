// SPDX-License-Identifier: GPL-3.0-or-later
#include "search.hpp"

#include <spam/core/lanes.hpp>

namespace spam {
namespace {

template <int Dim, int W, bool Wraps>
std::uint32_t* search(const SearchInput<Dim>& in, std::size_t first_slot, unsigned members,
                      const SlotRange* candidates, int count, std::uint32_t* out,
                      std::size_t& pairs) {
    using T = LanesOf<W>;
    T x[Dim];
    for (int a = 0; a < Dim; ++a)
        for (int l = 0; l < W; ++l) set_lane(x[a], l, in.x[a][first_slot + std::size_t(l)]);
    const T cutoff2(in.cutoff2);
    const unsigned counted = (1U << members) - 1;
    std::size_t found = 0;
    for (int k = 0; k < count; ++k) {
        for (std::uint32_t j = candidates[k].first; j < candidates[k].last; ++j) {
            T r2(0.0);
            for (int a = 0; a < Dim; ++a) {
                T s = x[a] - T(in.x[a][j]);
                if constexpr (Wraps) s -= T(in.length[a]) * nearest_integer(s * T(in.inverse[a]));
                r2 += s * s;
            }
            const unsigned near = lanes_below(r2, cutoff2);
            *out = j;
            out += near != 0;
            found += static_cast<unsigned>(__builtin_popcount(near & counted));
        }
    }
    pairs += found;
    return out;
}

/// With one copy for boxes that wrap around and one for those that do not.
template <int Dim, int W>
std::uint32_t* search_in(const SearchInput<Dim>& in, std::size_t first_slot, unsigned members,
                         const SlotRange* candidates, int count, std::uint32_t* out,
                         std::size_t& pairs) {
    return in.wraps ? search<Dim, W, true>(in, first_slot, members, candidates, count, out, pairs)
                    : search<Dim, W, false>(in, first_slot, members, candidates, count, out, pairs);
}

}  // namespace

template <int Dim, InstructionSet Level>
Search<Dim> search_for(int width) {
    switch (width) {
        case 8:
            return search_in<Dim, 8>;
        case 4:
            return search_in<Dim, 4>;
        case 2:
            return search_in<Dim, 2>;
        default:
            return search_in<Dim, 1>;
    }
}

template Search<1> search_for<1, InstructionSet::SPAM_LEVEL>(int);
template Search<2> search_for<2, InstructionSet::SPAM_LEVEL>(int);
template Search<3> search_for<3, InstructionSet::SPAM_LEVEL>(int);

}  // namespace spam
