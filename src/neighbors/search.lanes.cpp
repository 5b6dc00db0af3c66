// SPDX-License-Identifier: GPL-3.0-or-later
#include "search.hpp"

#include <spam/core/lanes.hpp>

namespace spam {
namespace {

template <int Dim, int W>
std::uint32_t* near_members(const SearchInput<Dim>& in, std::size_t first_slot, unsigned members,
                            const std::uint32_t* slots, std::size_t count, std::uint32_t* out,
                            std::size_t& pairs) {
    using T = LanesOf<W>;
    T x[Dim];
    const double* all[Dim];
    for (int a = 0; a < Dim; ++a) {
        all[a] = in.x[a];
        for (int l = 0; l < W; ++l) set_lane(x[a], l, all[a][first_slot + std::size_t(l)]);
    }
    const T cutoff2(in.cutoff2);
    const std::uint32_t stride = in.stride;
    const unsigned counted = (1U << members) - 1;
    std::size_t found = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t j = slots[k];
        T r2(0.0);
        for (int a = 0; a < Dim; ++a) {
            const T s = x[a] - T(all[a][j]);
            r2 += s * s;
        }
        const unsigned near = lanes_below(r2, cutoff2);
        *out = j * stride;
        out += near != 0;
        found += static_cast<unsigned>(__builtin_popcount(near & counted));
    }
    pairs += found;
    return out;
}

/// Numbers next to each other in single precision, or as many slots.
#if defined(__AVX512F__)
struct Row {
    static constexpr std::size_t lanes = 16;
    using Numbers = __m512;
    using Slots = __m512i;
    static Numbers all(float x) { return _mm512_set1_ps(x); }
    static Numbers load(const float* x) { return _mm512_loadu_ps(x); }
    static Slots load(const std::uint32_t* k) { return _mm512_loadu_si512(k); }
    static Numbers size(Numbers x) { return _mm512_abs_ps(x); }
    static Numbers positive(Numbers x) { return _mm512_maskz_max_ps(0xffff, x, all(0.0F)); }
    static unsigned below(Numbers a, Numbers b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
    static Slots times(Slots k, std::uint32_t n) {
        return _mm512_mullo_epi32(k, _mm512_set1_epi32(static_cast<int>(n)));
    }
    /// Writes those of which `which` has a bit, one after the other, and something behind them.
    static void pick(unsigned which, Numbers x, float* out) {
        _mm512_storeu_ps(out, _mm512_maskz_compress_ps(static_cast<__mmask16>(which), x));
    }
    static void pick(unsigned which, Slots k, std::uint32_t* out) {
        _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(static_cast<__mmask16>(which), k));
    }
};
#elif defined(__AVX2__) && defined(__BMI2__)
struct Row {
    static constexpr std::size_t lanes = 8;
    using Numbers = __m256;
    using Slots = __m256i;
    static Numbers all(float x) { return _mm256_set1_ps(x); }
    static Numbers load(const float* x) { return _mm256_loadu_ps(x); }
    static Slots load(const std::uint32_t* k) {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(k));
    }
    static Numbers size(Numbers x) { return _mm256_andnot_ps(all(-0.0F), x); }
    static Numbers positive(Numbers x) { return _mm256_max_ps(x, all(0.0F)); }
    static unsigned below(Numbers a, Numbers b) {
        return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LT_OQ)));
    }
    static Slots times(Slots k, std::uint32_t n) {
        return _mm256_mullo_epi32(k, _mm256_set1_epi32(static_cast<int>(n)));
    }
    /// The lanes of which `which` has a bit.
    static __m256i lanes_of(unsigned which) {
        const std::uint64_t bytes = _pdep_u64(which, 0x0101010101010101) * 0xff;
        return _mm256_cvtepu8_epi32(
            _mm_cvtsi64_si128(static_cast<long long>(_pext_u64(0x0706050403020100, bytes))));
    }
    static void pick(unsigned which, Numbers x, float* out) {
        _mm256_storeu_ps(out, _mm256_permutevar8x32_ps(x, lanes_of(which)));
    }
    static void pick(unsigned which, Slots k, std::uint32_t* out) {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out),
                            _mm256_permutevar8x32_epi32(k, lanes_of(which)));
    }
};
#elif defined(__SSE4_1__)
/// By the bits of four lanes: the bytes of those that have one, the first first.
struct BytesOfLanes {
    signed char of[16][16] = {};
    constexpr BytesOfLanes() {
        for (int bits = 0; bits < 16; ++bits)
            for (int lane = 0, to = 0; lane < 4; ++lane)
                for (int b = 0; b < 4 && (bits >> lane & 1) != 0; ++b)
                    of[bits][to++] = static_cast<signed char>(4 * lane + b);
    }
};
constexpr BytesOfLanes bytes_of_lanes;
struct Row {
    static constexpr std::size_t lanes = 4;
    using Numbers = __m128;
    using Slots = __m128i;
    static Numbers all(float x) { return _mm_set1_ps(x); }
    static Numbers load(const float* x) { return _mm_loadu_ps(x); }
    static Slots load(const std::uint32_t* k) {
        return _mm_loadu_si128(reinterpret_cast<const __m128i*>(k));
    }
    static Numbers size(Numbers x) { return _mm_andnot_ps(all(-0.0F), x); }
    static Numbers positive(Numbers x) { return _mm_max_ps(x, all(0.0F)); }
    static unsigned below(Numbers a, Numbers b) {
        return static_cast<unsigned>(_mm_movemask_ps(_mm_cmplt_ps(a, b)));
    }
    static Slots times(Slots k, std::uint32_t n) {
        return _mm_mullo_epi32(k, _mm_set1_epi32(static_cast<int>(n)));
    }
    static void pick(unsigned which, Slots k, std::uint32_t* out) {
        const auto* const bytes = reinterpret_cast<const __m128i*>(bytes_of_lanes.of[which]);
        _mm_storeu_si128(reinterpret_cast<__m128i*>(out),
                         _mm_shuffle_epi8(k, _mm_loadu_si128(bytes)));
    }
    static void pick(unsigned which, Numbers x, float* out) {
        const auto* const bytes = reinterpret_cast<const __m128i*>(bytes_of_lanes.of[which]);
        _mm_storeu_ps(
            out, _mm_castsi128_ps(_mm_shuffle_epi8(_mm_castps_si128(x), _mm_loadu_si128(bytes))));
    }
};
#else
struct Row {
    static constexpr std::size_t lanes = 1;
    using Numbers = float;
    using Slots = std::uint32_t;
    static Numbers all(float x) { return x; }
    static Numbers load(const float* x) { return *x; }
    static Slots load(const std::uint32_t* k) { return *k; }
    static Numbers size(Numbers x) { return __builtin_fabsf(x); }
    static Numbers positive(Numbers x) { return x > 0.0F ? x : 0.0F; }
    static unsigned below(Numbers a, Numbers b) { return a < b ? 1U : 0U; }
    static Slots times(Slots k, std::uint32_t n) { return k * n; }
    static void pick(unsigned, Numbers x, float* out) { *out = x; }
    static void pick(unsigned, Slots k, std::uint32_t* out) { *out = k; }
};
#endif

template <int Dim>
std::size_t narrow(const Candidates<Dim>& in, const float* low, const float* high, float* const* x,
                   std::uint32_t* slots) {
    const Candidates<Dim> from = in;
    typename Row::Numbers least[Dim], most[Dim];
    float* out[Dim];
    for (int a = 0; a < Dim; ++a)
        least[a] = Row::all(low[a]), most[a] = Row::all(high[a]), out[a] = x[a];
    std::size_t found = 0;
    const std::size_t chunk = from.chunks == nullptr ? from.count : ClusterCells<Dim>::chunk;
    for (std::size_t begin = 0; begin < from.count; begin += chunk) {
        bool outside = false;
        for (int a = 0; a < Dim && from.chunks != nullptr; ++a) {
            const float* const bounds = from.chunks[begin / chunk].data() + 2 * a;
            outside |= !(low[a] < bounds[1] && bounds[0] < high[a]);
        }
        if (outside) continue;
        for (std::size_t k = begin; k < from.count && k < begin + chunk; k += Row::lanes) {
            typename Row::Numbers own[Dim];
            unsigned near = ~0U;
            for (int a = 0; a < Dim; ++a) {
                own[a] = Row::load(from.x[a] + k);
                near &= Row::below(least[a], own[a]) & Row::below(own[a], most[a]);
            }
            if (near == 0) continue;  // often, where numbers follow each other in space
            for (int a = 0; a < Dim; ++a) Row::pick(near, own[a], out[a] + found);
            Row::pick(near, Row::load(from.slots + k), slots + found);
            found += static_cast<unsigned>(__builtin_popcount(near));
        }
    }
    for (int a = 0; a < Dim; ++a)
        for (std::size_t k = found; k < found + Row::lanes; ++k) out[a][k] = nowhere;
    return found;
}

template <int Dim>
std::uint32_t* near_bounds(const Candidates<Dim>& in, const Bounds<Dim>& bounds,
                           std::uint32_t factor, std::uint32_t* out) {
    const Candidates<Dim> from = in;
    typename Row::Numbers centre[Dim], half[Dim];
    for (int a = 0; a < Dim; ++a) {
        centre[a] = Row::all(static_cast<float>((bounds.centre[a] - from.middle[a]) * from.scale));
        half[a] = Row::all(static_cast<float>(bounds.half[a] * from.scale));
    }
    const auto reach2 = Row::all(static_cast<float>(from.reach * from.reach));
    for (std::size_t k = 0; k < from.count; k += Row::lanes) {
        auto d2 = Row::all(0.0F);
        for (int a = 0; a < Dim; ++a) {
            const auto gap =
                Row::positive(Row::size(Row::load(from.x[a] + k) - centre[a]) - half[a]);
            d2 += gap * gap;
        }
        const unsigned near = Row::below(d2, reach2);
        Row::pick(near, Row::times(Row::load(from.slots + k), factor), out);
        out += __builtin_popcount(near);
    }
    return out;
}

template <int Dim, int W>
constexpr Search<Dim> functions() {
    return {near_members<Dim, W>, narrow<Dim>, near_bounds<Dim>};
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

#define SPAM_INSTANTIATE(D) template Search<D> search_for<D, InstructionSet::SPAM_LEVEL>(int);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
