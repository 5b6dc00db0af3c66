// SPDX-License-Identifier: GPL-3.0-or-later
#include "search.hpp"

#include <spam/core/lanes.hpp>

#include <algorithm>

namespace spam {
namespace {

/// f(slot) for those in the ranges listed.
struct Ranges {
    using Place = SlotRange;
    template <class F>
    [[gnu::always_inline]] static void for_each(const SlotRange* ranges, std::size_t count,
                                                std::size_t, const F& f) {
        for (std::size_t k = 0; k < count; ++k)
            for (std::uint32_t slot = ranges[k].first; slot < ranges[k].last; ++slot) f(slot);
    }
};
/// f(slot) for all that belong to the clusters listed.
template <int W>
struct Clusters {
    using Place = std::uint32_t;
    template <class F>
    [[gnu::always_inline]] static void for_each(const std::uint32_t* ids, std::size_t count,
                                                std::size_t all, const F& f) {
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint32_t first = ids[k] * W;
            if (first + W <= all)
                for (std::uint32_t l = 0; l < W; ++l) f(first + l);
            else
                for (std::uint32_t slot = first; slot < all; ++slot) f(slot);
        }
    }
};

template <int Dim, int W, class Places>
std::uint32_t* search(const SearchInput<Dim>& in, std::size_t first_slot, unsigned members,
                      const typename Places::Place* places, std::size_t count, std::uint32_t* out,
                      std::size_t& pairs) {
    using T = LanesOf<W>;
    T x[Dim];
    for (int a = 0; a < Dim; ++a)
        for (int l = 0; l < W; ++l) set_lane(x[a], l, in.x[a][first_slot + std::size_t(l)]);
    const T cutoff2(in.cutoff2);
    const unsigned counted = (1U << members) - 1;
    std::size_t found = 0;
    Places::for_each(places, count, in.slots, [&](std::uint32_t j) {
        T r2(0.0);
        for (int a = 0; a < Dim; ++a) {
            const T s = x[a] - T(in.x[a][j]);
            r2 += s * s;
        }
        const unsigned near = lanes_below(r2, cutoff2);
        *out = j * in.stride;
        out += near != 0;
        found += static_cast<unsigned>(__builtin_popcount(near & counted));
    });
    pairs += found;
    return out;
}

/// slots first, first + 1, ... times `stride` where `bits` says so. Returns the end; writes W.
template <int W>
[[gnu::always_inline]] inline std::uint32_t* append(std::uint32_t first, std::uint32_t stride,
                                                    unsigned bits, std::uint32_t* out) {
#if defined(__AVX512F__) && defined(__AVX512VL__)
    if constexpr (W == 8) {
        const __m256i lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
        const __m256i slots = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)), lanes);
        const __m256i entries =
            _mm256_mullo_epi32(slots, _mm256_set1_epi32(static_cast<int>(stride)));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out),
                            _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), entries));
        return out + __builtin_popcount(bits);
    }
#endif
    for (unsigned l = 0; l < W; ++l) {
        *out = (first + l) * stride;
        out += bits >> l & 1U;
    }
    return out;
}

template <int Dim, int W>
std::uint32_t* around_bounds(const SearchInput<Dim>& in, const Bounds<Dim>& bounds,
                             const SlotRange* ranges, std::size_t count, std::uint32_t* out) {
    using std::max;
    using T = LanesOf<W>;
    const T reach2(4.0 * in.reach2);
    const std::uint32_t stride = in.stride;
    for (std::size_t k = 0; k < count; ++k) {
        const SlotRange range = ranges[k];
        for (std::uint32_t first = range.first; first < range.last; first += W) {
            T d2(0.0);
            for (int a = 0; a < Dim; ++a) {
                const T s = load_lanes<W>(in.x[a] + first) - T(bounds.centre[a]);
                const T gap = max(s, -s) - T(bounds.half[a]);
                const T apart = positive_part(gap + gap);
                d2 += apart * apart;
            }
            const std::uint32_t left = range.last - first;
            const unsigned valid = left < W ? (1U << left) - 1 : (1U << W) - 1;
            out = append<W>(first, stride, lanes_below(d2, reach2) & valid, out);
        }
    }
    return out;
}

template <int Dim>
std::size_t keep_near(const SearchInput<Dim>& in, const Bounds<Dim>& bounds,
                      const std::uint32_t* ids, std::size_t count, std::uint32_t* kept) {
    const Bounds<Dim> b = bounds;
    std::size_t found = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t id = ids[k];
        const Bounds<Dim>& other = in.bounds[id];
        double d2 = 0.0;
        for (int a = 0; a < Dim; ++a) {
            const double s = other.centre[a] - b.centre[a];
            const double gap = __builtin_fabs(s) - (other.half[a] + b.half[a]);
            const double twice =
                gap + __builtin_fabs(gap);  // of its positive part, without a branch
            d2 += twice * twice;
        }
        kept[found] = id;
        found += d2 < 4.0 * in.reach2;
    }
    return found;
}

template <int Dim, int W>
constexpr Search<Dim> functions() {
    return {keep_near<Dim>, search<Dim, W, Ranges>, search<Dim, W, Clusters<W>>,
            around_bounds<Dim, W>};
}

}  // namespace

template <int Dim, InstructionSet Level>
Search<Dim> search_for(int width) {
    switch (width) {
        case 8:
            return functions<Dim, 8>();
        case 4:
            return functions<Dim, 4>();
        case 2:
            return functions<Dim, 2>();
        default:
            return functions<Dim, 1>();
    }
}

template Search<1> search_for<1, InstructionSet::SPAM_LEVEL>(int);
template Search<2> search_for<2, InstructionSet::SPAM_LEVEL>(int);
template Search<3> search_for<3, InstructionSet::SPAM_LEVEL>(int);

}  // namespace spam
