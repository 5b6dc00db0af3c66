// SPDX-License-Identifier: GPL-3.0-or-later
#include "nvector_operations.hpp"

#include <spam/core/exact_sum.hpp>
#include <spam/core/instruction_set.hpp>
#include <spam/core/lanes.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/parts.hpp>

#include <nvector/nvector_serial.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>

namespace spam {
namespace {

constexpr std::size_t most_blocks = 512;
constexpr std::size_t threads_from =
    16384;  // below, to tell other threads of it costs more than the loop

/// Blocks fit the first-level cache as long as there are not too many of them; they depend on the
/// length alone, so that sums over blocks do.
std::size_t block_size(std::size_t n) {
    return std::max<std::size_t>(4096, (n + most_blocks - 1) / most_blocks);
}

struct Span {
    double* p;
    std::size_t n;
};
Span of(N_Vector v) { return {NV_DATA_S(v), static_cast<std::size_t>(NV_LENGTH_S(v))}; }

/// body(first, last) for every block of [0, n).
template <class Body>
void for_blocks(std::size_t n, const Body& body) {
    const std::size_t size = block_size(n), blocks = (n + size - 1) / size;
    parallel_for(
        blocks, [&](std::size_t b) { body(b * size, std::min(n, (b + 1) * size)); },
        n < threads_from ? 0 : size);
}

/// z[k] = f(k) for all k.
template <class F>
void fill(N_Vector z, const F& f) {
    double* const p = of(z).p;
    for_blocks(of(z).n, [&](std::size_t first, std::size_t last) {
#pragma GCC ivdep  // z may be x or y itself: entry by entry that is no hindrance
        for (std::size_t k = first; k < last; ++k) p[k] = f(k);
    });
}

constexpr int width = native_lanes(InstructionSet::SPAM_LEVEL);
using Register = Lanes<width>;

Register load(const double* p) { return load_lanes<width>(p); }

/// Sum of term(x_k, y_k). Its bits do not depend on which threads share the work.
template <class Term>
double sum(N_Vector x, N_Vector y, const Term& term) {
    const double *const p = of(x).p, *const q = of(y).p;
    return exact_sums_of_blocks<1>(
        of(x).n,
        [=](std::size_t first, std::size_t count, auto& rows) {
            std::size_t k = 0;
            for (; k + width <= count; k += width)
                store_lanes(&rows[0][k], term(load(p + first + k), load(q + first + k)));
            for (; k < count; ++k) rows[0][k] = term(p[first + k], q[first + k]);
            return true;
        },
        threads_from)[0];
}

/// N_VClone_Serial, but on whole cache lines.
N_Vector clone(N_Vector like) {
    constexpr std::size_t line = 64;
    N_Vector v = N_VCloneEmpty_Serial(like);
    if (v == nullptr || of(like).n == 0) return v;
    const std::size_t bytes = (of(like).n * sizeof(double) + line - 1) / line * line;
    NV_DATA_S(v) = static_cast<double*>(std::aligned_alloc(line, bytes));
    NV_OWN_DATA_S(v) = SUNTRUE;
    if (NV_DATA_S(v) != nullptr) return v;
    N_VDestroy(v);
    return nullptr;
}

void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
    const double *p = of(x).p, *q = of(y).p;
    fill(z, [=](std::size_t k) { return a * p[k] + b * q[k]; });
}
void constant(double c, N_Vector z) {
    fill(z, [=](std::size_t) { return c; });
}
void product(N_Vector x, N_Vector y, N_Vector z) {
    const double *p = of(x).p, *q = of(y).p;
    fill(z, [=](std::size_t k) { return p[k] * q[k]; });
}
void quotient(N_Vector x, N_Vector y, N_Vector z) {
    const double *p = of(x).p, *q = of(y).p;
    fill(z, [=](std::size_t k) { return p[k] / q[k]; });
}
void scale(double c, N_Vector x, N_Vector z) {
    const double* p = of(x).p;
    fill(z, [=](std::size_t k) { return c * p[k]; });
}
void absolute(N_Vector x, N_Vector z) {
    const double* p = of(x).p;
    fill(z, [=](std::size_t k) { return std::abs(p[k]); });
}
void inverse(N_Vector x, N_Vector z) {
    const double* p = of(x).p;
    fill(z, [=](std::size_t k) { return 1.0 / p[k]; });
}
void add_constant(N_Vector x, double b, N_Vector z) {
    const double* p = of(x).p;
    fill(z, [=](std::size_t k) { return p[k] + b; });
}
double dot_product(N_Vector x, N_Vector y) {
    return sum(x, y, [](const auto& a, const auto& b) { return a * b; });
}
double weighted_rms_norm(N_Vector x, N_Vector w) {
    const double total = sum(x, w, [](const auto& a, const auto& b) { return (a * b) * (a * b); });
    // Entries that every part of a run has a copy of are accounts, of weight 0.
    const std::size_t copies = Parts::here().alone() ? 0 : Parts::here().copies;
    const std::size_t n = Parts::here().total(of(x).n - copies) + copies;
    return std::sqrt(total / static_cast<double>(n));
}
double largest_magnitude(N_Vector x) {
    double largest = 0.0;
    for (std::size_t k = 0; k < of(x).n; ++k) largest = std::max(largest, std::abs(of(x).p[k]));
    return Parts::here().most(largest);
}
double smallest(N_Vector x) {
    double least = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k < of(x).n; ++k) least = std::min(least, of(x).p[k]);
    return -Parts::here().most(-least);
}

/// z = sum c_m p_m over [first, last) in one pass over memory.
template <int Count>
void combine(const double* c, const double* const* p, double* z, std::size_t first,
             std::size_t last) {
    Register factor[Count];
    for (int m = 0; m < Count; ++m) factor[m] = Register(c[m]);
    std::size_t k = first;
    for (; k + width <= last; k += width) {
        Register total = factor[0] * load(p[0] + k);
        for (int m = 1; m < Count; ++m) total += factor[m] * load(p[m] + k);
        store_lanes(z + k, total);
    }
    for (; k < last; ++k) {
        double total = c[0] * p[0][k];
        for (int m = 1; m < Count; ++m) total += c[m] * p[m][k];
        z[k] = total;
    }
}
using Combine = void (*)(const double*, const double* const*, double*, std::size_t, std::size_t);
constexpr Combine combinations[] = {combine<1>, combine<2>, combine<3>, combine<4>,
                                    combine<5>, combine<6>, combine<7>, combine<8>};
constexpr int most_at_once = 8;

/// z = sum c_m x_m; z may be x_0. More than eight vectors are added to z in turns of seven.
int linear_combination(int count, double* c, N_Vector* x, N_Vector z) {
    double* const out = of(z).p;
    for (int done = 0; done < count;) {
        double factor[most_at_once];
        const double* p[most_at_once];
        int n = 0;
        if (done > 0) factor[n] = 1.0, p[n++] = out;
        for (; n < most_at_once && done < count; ++n, ++done)
            factor[n] = c[done], p[n] = of(x[done]).p;
        for_blocks(of(z).n, [&](std::size_t first, std::size_t last) {
            combinations[n - 1](factor, p, out, first, last);
        });
    }
    return 0;
}

}  // namespace

template <InstructionSet Level>
void use_operations(N_Vector v) {
    v->ops->nvclone = clone;
    v->ops->nvlinearsum = linear_sum;
    v->ops->nvconst = constant;
    v->ops->nvprod = product;
    v->ops->nvdiv = quotient;
    v->ops->nvscale = scale;
    v->ops->nvabs = absolute;
    v->ops->nvinv = inverse;
    v->ops->nvaddconst = add_constant;
    v->ops->nvdotprod = dot_product;
    v->ops->nvwrmsnorm = weighted_rms_norm;
    v->ops->nvmaxnorm = largest_magnitude;
    v->ops->nvmin = smallest;
    v->ops->nvlinearcombination = linear_combination;
}

template void use_operations<InstructionSet::SPAM_LEVEL>(N_Vector);

}  // namespace spam
