// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>

#include <random>

namespace spam::test {

/// 1 and normal deviations of that size.
template <int Dim>
Mat<Dim> random_gradient(unsigned seed, double size) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> g;
    Mat<Dim> F;
    for (double& f : F.c) f = size * g(random);
    for (int a = 0; a < Dim; ++a) F(a, a) += 1.0;
    return F;
}

}  // namespace spam::test
