// SPDX-License-Identifier: GPL-3.0-or-later
#include "nvector_operations.hpp"

#include <nvector/nvector_serial.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace spam {
namespace {

constexpr std::size_t block_size = 4096;  // fits the first-level cache several times
constexpr std::size_t threads_from =
    4 * block_size;  // below, fork and join cost more than the loop

struct Span {
    double* p;
    std::size_t n;
};
Span of(N_Vector v) { return {NV_DATA_S(v), static_cast<std::size_t>(NV_LENGTH_S(v))}; }

/// body(first, last) for every block of [0, n).
template <class Body>
void for_blocks(std::size_t n, const Body& body) {
    const std::size_t blocks = (n + block_size - 1) / block_size;
#pragma omp parallel for schedule(static) if (n >= threads_from)
    for (std::size_t b = 0; b < blocks; ++b)
        body(b * block_size, std::min(n, (b + 1) * block_size));
}

/// z[k] = f(k) for all k.
template <class F>
void fill(N_Vector z, const F& f) {
    double* const p = of(z).p;
    for_blocks(of(z).n, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) p[k] = f(k);
    });
}

/// Sum of term(k): in four lanes within a block, blocks in order.
template <class Term>
double sum(std::size_t n, const Term& term) {
    const std::size_t blocks = (n + block_size - 1) / block_size;
    std::vector<double> partial(blocks);
    for_blocks(n, [&](std::size_t first, std::size_t last) {
        double lane[4] = {0.0, 0.0, 0.0, 0.0};
        std::size_t k = first;
        for (; k + 4 <= last; k += 4)
            for (std::size_t l = 0; l < 4; ++l) lane[l] += term(k + l);
        for (; k < last; ++k) lane[0] += term(k);
        partial[first / block_size] = (lane[0] + lane[1]) + (lane[2] + lane[3]);
    });
    double total = 0.0;
    for (const double p : partial) total += p;
    return total;
}

void linear_sum(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
    const double *p = of(x).p, *q = of(y).p;
    fill(z, [=](std::size_t k) { return a * p[k] + b * q[k]; });
}
void constant(realtype c, N_Vector z) {
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
void scale(realtype c, N_Vector x, N_Vector z) {
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
void add_constant(N_Vector x, realtype b, N_Vector z) {
    const double* p = of(x).p;
    fill(z, [=](std::size_t k) { return p[k] + b; });
}
realtype dot_product(N_Vector x, N_Vector y) {
    const double *p = of(x).p, *q = of(y).p;
    return sum(of(x).n, [=](std::size_t k) { return p[k] * q[k]; });
}
realtype weighted_rms_norm(N_Vector x, N_Vector w) {
    const double *p = of(x).p, *q = of(w).p;
    const double total = sum(of(x).n, [=](std::size_t k) { return (p[k] * q[k]) * (p[k] * q[k]); });
    return std::sqrt(total / static_cast<double>(of(x).n));
}
realtype largest_magnitude(N_Vector x) {
    double largest = 0.0;
    for (std::size_t k = 0; k < of(x).n; ++k) largest = std::max(largest, std::abs(of(x).p[k]));
    return largest;
}
realtype smallest(N_Vector x) {
    double least = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k < of(x).n; ++k) least = std::min(least, of(x).p[k]);
    return least;
}

/// z = sum c_m x_m in one pass over memory; z may be x_0.
int linear_combination(int count, realtype* c, N_Vector* x, N_Vector z) {
    const double* p[32];
    if (count < 1 || count > 32) return -1;
    for (int m = 0; m < count; ++m) p[m] = of(x[m]).p;
    double* const out = of(z).p;
    for_blocks(of(z).n, [&](std::size_t first, std::size_t last) {
        double block[block_size];
        const std::size_t n = last - first;
        for (std::size_t k = 0; k < n; ++k) block[k] = c[0] * p[0][first + k];
        for (int m = 1; m < count; ++m)
            for (std::size_t k = 0; k < n; ++k) block[k] += c[m] * p[m][first + k];
        std::copy(block, block + n, out + first);
    });
    return 0;
}

}  // namespace

void use_own_operations(N_Vector v) {
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

}  // namespace spam
