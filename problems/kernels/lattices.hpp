// SPDX-License-Identifier: GPL-3.0-or-later
// How evenly the particles of a lattice fill space.
#pragma once

#include <spam/core/state.hpp>
#include <spam/kernel/any_weight.hpp>

#include <Eigen/LU>

#include <cmath>
#include <string>

namespace kernels {

using spam::AnyWeight;
using spam::Point;

/// Sites of a lattice of spacing 1: whole multiples of the columns of `cell`.
template <int Dim>
struct Lattice {
    std::string name;
    Eigen::Matrix<double, Dim, Dim> cell;

    double volume() const { return std::abs(cell.determinant()); }
};

inline Lattice<1> line() { return {"line", Eigen::Matrix<double, 1, 1>(1.0)}; }
inline Lattice<2> square() { return {"square", Eigen::Matrix2d::Identity()}; }
inline Lattice<2> triangular() {
    return {"triangular", (Eigen::Matrix2d() << 1.0, 0.5, 0.0, std::sqrt(0.75)).finished()};
}

/// sum_j w(|r - r_j|) volume at r = cell . fraction
template <int Dim>
double relative_density(const Lattice<Dim>& lattice, const AnyWeight<Dim>& w,
                        const Point<Dim>& fraction) {
    // Rows of sites are no nearer to each other than sqrt(3/4).
    const int m = static_cast<int>(std::ceil(w.range() / std::sqrt(0.75))) + 1;
    double sum = 0.0;
    const auto add = [&](const Point<Dim>& site) {
        sum += w.value((lattice.cell * (fraction - site)).norm());
    };
    for (int a = -m; a <= m; ++a) {
        if constexpr (Dim == 1) {
            add(Point<1>(double(a)));
        } else {
            for (int b = -m; b <= m; ++b) add(Point<2>(double(a), double(b)));
        }
    }
    return sum * lattice.volume();
}

/// The largest of sign * density within `half` of `centre`, which moves there, of a grid of n x n.
template <int Dim>
double best_of_grid(const Lattice<Dim>& lattice, const AnyWeight<Dim>& w, double sign,
                    Point<Dim>& centre, double half, int n) {
    Point<Dim> best = centre;
    double value = -HUGE_VAL;
    for (int k = 0; k < (Dim == 1 ? n + 1 : (n + 1) * (n + 1)); ++k) {
        Point<Dim> at = centre;
        at(0) += half * (2.0 * (k % (n + 1)) / n - 1.0);
        if constexpr (Dim == 2) at(1) += half * (2.0 * (k / (n + 1)) / n - 1.0);
        const double here = sign * relative_density(lattice, w, at);
        if (here > value) {
            value = here;
            best = at;
        }
    }
    centre = best;
    return value;
}

struct Extremes {
    double least, largest;

    double ripple() const { return largest - least; }
};

/// Over a cell: the best of a grid of points, then finer and finer about it.
template <int Dim>
Extremes density_extremes(const Lattice<Dim>& lattice, const AnyWeight<Dim>& w) {
    const auto extreme = [&](double sign) {
        Point<Dim> centre = Point<Dim>::Constant(0.5);
        double half = 0.5, value = best_of_grid(lattice, w, sign, centre, half, 24);
        for (half /= 12.0; half > 1e-6; half /= 2.0)
            value = std::max(value, best_of_grid(lattice, w, sign, centre, half, 4));
        return sign * value;
    };
    return {extreme(-1.0), extreme(1.0)};
}

}  // namespace kernels
