// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/vec.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

// What the compiler may use in this source file becomes part of the type's name: the same source is
// compiled for several instruction sets, and the linker must never take one's functions for
// another's.
#if defined(__AVX512F__) && defined(__AVX512VL__)
#define SPAM_LANES lanes_avx512
#elif defined(__AVX2__) && defined(__FMA__)
#define SPAM_LANES lanes_avx2
#elif defined(__SSE4_2__)
#define SPAM_LANES lanes_sse4
#else
#define SPAM_LANES lanes_base
#endif

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"  // never crosses a call: everything here is inlined

namespace spam {
inline namespace SPAM_LANES {

#define SPAM_INLINE [[gnu::always_inline]] inline
#define SPAM_FLAT __attribute__((always_inline))  // of a lambda

namespace detail {
template <int W>
struct VectorOf;
// One by one: a vector_size that depends on a template parameter is ignored by GCC.
#define SPAM_VECTOR(W)                                                  \
    template <>                                                         \
    struct VectorOf<W> {                                                \
        typedef double Numbers __attribute__((vector_size(8 * W)));     \
        typedef std::uint64_t Bits __attribute__((vector_size(8 * W))); \
    };
SPAM_VECTOR(2)
SPAM_VECTOR(4)
SPAM_VECTOR(8)
#undef SPAM_VECTOR
}  // namespace detail

/// W doubles that are computed with at once: the arithmetic type of pair bodies in the engine. The
/// compiler's own vectors, so that any W works with any instruction set, most quickly the one that
/// fills a register (2 for SSE, 4 for AVX2, 8 for AVX-512). One lane is a plain double.
template <int W>
struct Lanes {
    using Vector = typename detail::VectorOf<W>::Numbers;

    Vector v;

    SPAM_INLINE Lanes() : v{} {}
    SPAM_INLINE Lanes(const Vector& x) : v(x) {}
    SPAM_INLINE Lanes(double x) : v(x - Vector{}) {}  // x in every lane

    SPAM_INLINE Lanes& operator+=(const Lanes& o) { return v += o.v, *this; }
    SPAM_INLINE Lanes& operator-=(const Lanes& o) { return v -= o.v, *this; }
    SPAM_INLINE Lanes& operator*=(const Lanes& o) { return v *= o.v, *this; }
    SPAM_INLINE friend Lanes operator+(const Lanes& a, const Lanes& b) { return a.v + b.v; }
    SPAM_INLINE friend Lanes operator-(const Lanes& a, const Lanes& b) { return a.v - b.v; }
    SPAM_INLINE friend Lanes operator*(const Lanes& a, const Lanes& b) { return a.v * b.v; }
    /// To a unit in the last place; b finite and not zero.
    SPAM_INLINE friend Lanes operator/(const Lanes& a, const Lanes& b) { return divide(a, b); }
    SPAM_INLINE friend Lanes operator-(const Lanes& a) { return -a.v; }

    /// Bit l is set where lane l of a is below that of b.
    SPAM_INLINE friend unsigned lanes_below(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
        if constexpr (W == 8) return _mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_LT_OQ);
#endif
#if defined(__AVX__)
        if constexpr (W == 4)
            return unsigned(
                _mm256_movemask_pd(_mm256_cmp_pd((__m256d)a.v, (__m256d)b.v, _CMP_LT_OQ)));
#endif
#if defined(__SSE2__)
        if constexpr (W == 2)
            return unsigned(_mm_movemask_pd(_mm_cmplt_pd((__m128d)a.v, (__m128d)b.v)));
#endif
        unsigned bits = 0;
        for (int l = 0; l < W; ++l) bits |= unsigned(a.v[l] < b.v[l]) << l;
        return bits;
    }

    /// A NaN in x stays one.
    SPAM_INLINE friend Lanes max(const Lanes& x, const Lanes& least) {
#if defined(__AVX512F__)
        if constexpr (W == 8)
            return Vector(_mm512_maskz_max_pd(0xff, (__m512d)least.v, (__m512d)x.v));
#endif
#if defined(__AVX__)
        if constexpr (W == 4) return Vector(_mm256_max_pd((__m256d)least.v, (__m256d)x.v));
#endif
#if defined(__SSE2__)
        if constexpr (W == 2) return Vector(_mm_max_pd((__m128d)least.v, (__m128d)x.v));
#endif
        return x.v < least.v ? least.v : x.v;
    }
    SPAM_INLINE friend Lanes positive_part(const Lanes& x) { return max(x, Lanes(0.0)); }

    /// x in the lanes where a is below b, 0 in the others.
    SPAM_INLINE friend Lanes where_below(const Lanes& a, const Lanes& b, const Lanes& x) {
#if defined(__AVX512F__)
        if constexpr (W == 8)
            return Vector(_mm512_maskz_mov_pd(
                _mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_LT_OQ), (__m512d)x.v));
#endif
        return a.v < b.v ? x.v : Vector{};
    }

    SPAM_INLINE friend Lanes sqrt(const Lanes& x) {
#if defined(__AVX512F__)
        if constexpr (W == 8) return Vector(_mm512_maskz_sqrt_pd(0xff, (__m512d)x.v));
#endif
#if defined(__AVX__)
        if constexpr (W == 4) return Vector(_mm256_sqrt_pd((__m256d)x.v));
#endif
#if defined(__SSE2__)
        if constexpr (W == 2) return Vector(_mm_sqrt_pd((__m128d)x.v));
#endif
        Lanes r;
        for (int l = 0; l < W; ++l) r.v[l] = std::sqrt(x.v[l]);
        return r;
    }

    /// The same, within two units in the last place, for loops that have little else to do than wait
    /// for it; x > 0.
    SPAM_INLINE friend Lanes sqrt_by_products(const Lanes& x) {
#if defined(__AVX512F__)
        if constexpr (W == 8) return Vector(products_for_root<false>((__m512d)x.v));
#endif
        return sqrt(x);
    }
    /// 1/sqrt(x), likewise.
    SPAM_INLINE friend Lanes inverse_sqrt_by_products(const Lanes& x) {
#if defined(__AVX512F__)
        if constexpr (W == 8) return Vector(products_for_root<true>((__m512d)x.v));
#endif
        return Lanes(1.0) / sqrt(x);
    }

    /// Nearest integers, halves to even.
    SPAM_INLINE friend Lanes nearest_integer(const Lanes& x) {
#if defined(__AVX512F__)
        if constexpr (W == 8) return Vector(_mm512_maskz_roundscale_pd(0xff, (__m512d)x.v, 0));
#endif
#if defined(__AVX__)
        if constexpr (W == 4) return Vector(_mm256_round_pd((__m256d)x.v, 0));
#endif
#if defined(__SSE4_1__)
        if constexpr (W == 2) return Vector(_mm_round_pd((__m128d)x.v, 0));
#endif
        Lanes r;
        for (int l = 0; l < W; ++l) r.v[l] = std::nearbyint(x.v[l]);
        return r;
    }

    /// 2^k of numbers that were made by adding a whole k from -1022 to 1023 to 1.5 2^52: k is then in their lowest
    /// bits.
    SPAM_INLINE friend Lanes power_of_two(const Lanes& shifted) {
        using Bits = typename detail::VectorOf<W>::Bits;
        return Vector(((Bits)shifted.v + 1023) << 52);
    }

  private:
    SPAM_INLINE static Lanes divide(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
        if constexpr (W == 8) return Vector(fast_quotient((__m512d)a.v, (__m512d)b.v));
#endif
        return a.v / b.v;
    }

#if defined(__AVX512F__)
    // The divider needs as long for a full register of quotients as the multipliers for half of a
    // pair's other work, and has the square root to do as well: the quotients are left to the
    // multipliers. From an estimate of 14 bits, with residue e, three terms of the series.
    // (maskz with all lanes: in the plain forms GCC 12 complains of its own undefined operand.)
    SPAM_INLINE static __m512d fast_quotient(__m512d a, __m512d b) {
        const __m512d y = _mm512_maskz_rcp14_pd(0xff, b);
        const __m512d q = _mm512_mul_pd(a, y);  // a/b = q/(1 - e)
        const __m512d e = _mm512_fnmadd_pd(b, y, _mm512_set1_pd(1.0));
        const __m512d c = _mm512_fmadd_pd(e, e, e);
        return _mm512_fmadd_pd(q, _mm512_fmadd_pd(c, e, e), q);
    }

    // From an estimate y of 1/sqrt(x) to 14 bits, e = 1 - x y^2 and s = x y: sqrt(x) = s (1 - e)^(-1/2).
    // Likewise 1/sqrt(x) = y (1 - e)^(-1/2).
    template <bool Inverse>
    SPAM_INLINE static __m512d products_for_root(__m512d x) {
        const __m512d y = _mm512_maskz_rsqrt14_pd(0xff, x);
        const __m512d s = _mm512_mul_pd(x, y);
        const __m512d e = _mm512_fnmadd_pd(s, y, _mm512_set1_pd(1.0));
        const __m512d p = _mm512_fmadd_pd(_mm512_set1_pd(0.3125), e, _mm512_set1_pd(0.375));
        const __m512d q = _mm512_fmadd_pd(p, e, _mm512_set1_pd(0.5));
        const __m512d first = Inverse ? y : s;
        return _mm512_fmadd_pd(_mm512_mul_pd(first, e), q, first);
    }
#endif
};

namespace detail {
template <class Number>
SPAM_INLINE void round_in_place(Number& x) {
#if defined(__has_builtin)
#if __has_builtin(__builtin_assoc_barrier)
    x = __builtin_assoc_barrier(x);
    return;
#endif
#endif
#if defined(__x86_64__) && !defined(__CUDA__) && !defined(__HIP__)
#if defined(__AVX512F__)
    constexpr std::size_t widest = 64;
#elif defined(__AVX__)
    constexpr std::size_t widest = 32;
#else
    constexpr std::size_t widest = 16;
#endif
    if constexpr (sizeof(x) <= widest) {
        __asm__("" : "+x"(x));
    } else {  // lanes of more than a register, in code that is compiled for no certain level
        for (std::size_t l = 0; l < sizeof(x) / sizeof(double); ++l) {
            double one = x[l];
            __asm__("" : "+x"(one));
            x[l] = one;
        }
    }
#endif
}

template <int W>
struct LaneType {
    using type = Lanes<W>;
};
template <>
struct LaneType<1> {
    using type = double;
};
}  // namespace detail

/// The arithmetic type of W lanes.
template <int W>
using LanesOf = typename detail::LaneType<W>::type;

/// W adjacent numbers, aligned or not.
template <int W>
SPAM_INLINE LanesOf<W> load_lanes(const double* from) {
    if constexpr (W == 1) {
        return *from;
    } else {
        typename Lanes<W>::Vector v;
        __builtin_memcpy(&v, from, sizeof v);
        return v;
    }
}
template <int W>
SPAM_INLINE void store_lanes(double* to, const Lanes<W>& x) {
    __builtin_memcpy(to, &x.v, sizeof x.v);
}

/// x as a number of its own, where a product that becomes part of a fused operation would not be one.
template <class T>
SPAM_INLINE T rounded(const T& x) {
    T y = x;
    if constexpr (requires { y.v; })
        detail::round_in_place(y.v);
    else
        detail::round_in_place(y);
    return y;
}

SPAM_INLINE double sqrt_by_products(double x) { return std::sqrt(x); }
SPAM_INLINE double inverse_sqrt_by_products(double x) { return 1.0 / std::sqrt(x); }
SPAM_INLINE unsigned lanes_below(double a, double b) { return a < b ? 1U : 0U; }
SPAM_INLINE double where_below(double a, double b, double x) { return a < b ? x : 0.0; }
SPAM_INLINE double power_of_two(double shifted) {
    return std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);
}

/// e^x to two units in the last place, and with the same bits in any number of lanes; beyond -700 and 700 as there.
/// x = k ln 2 + r, and the series of e^r, |r| < .35, to r^13.
template <class T>
SPAM_INLINE T exponential(const T& given) {
    using std::max;
    const T x = -max(-max(given, T(-700.0)), T(-700.0));
    constexpr double magic = 0x1.8p52;  // the next whole number is rounded to
    const T shifted = rounded(x * T(0x1.71547652b82fep0)) + T(magic);
    const T k = rounded(shifted) - T(magic);
    const T r = (x - k * T(0x1.62e42fefa0000p-1)) - k * T(0x1.cf79abc9e3b3ap-40);
    T sum = T(1.0 / 6227020800.0);
    for (const double factorial : {479001600.0, 39916800.0, 3628800.0, 362880.0, 40320.0, 5040.0,
                                   720.0, 120.0, 24.0, 6.0, 2.0, 1.0, 1.0})
        sum = sum * r + T(1.0 / factorial);
    return sum * power_of_two(shifted);
}

SPAM_INLINE double lane(double x, int) { return x; }
template <int W>
SPAM_INLINE double lane(const Lanes<W>& x, int l) {
    return x.v[l];
}
SPAM_INLINE void set_lane(double& x, int, double value) { x = value; }
template <int W>
SPAM_INLINE void set_lane(Lanes<W>& x, int l, double value) {
    x.v[l] = value;
}

}  // namespace SPAM_LANES
}  // namespace spam

#pragma GCC diagnostic pop
