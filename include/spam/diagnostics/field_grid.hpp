// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/box.hpp>

#include <span>
#include <vector>

namespace spam {

/// A regular grid of nodes, [HH01] ("a rectangular mesh is required ... for some graphics programs and
/// for computing fast Fourier transforms"): node (n_x, n_y, ...) at origin + n spacing, numbered with
/// n_x fastest.
template <int Dim>
struct FieldGrid {
    Point<Dim> origin, spacing;
    std::array<int, Dim> nodes;

    /// Nodes at k L/n, k = 0 ... n-1, of a box that is periodic in every direction. Throws InputError
    /// where it is not and for n < 1.
    static FieldGrid over(const Box<Dim>& box, const std::array<int, Dim>& nodes);
    /// Nodes of spacing d from `low` to the first at or beyond `high`. Throws InputError for d <= 0 and
    /// for more than 2^31 - 1 nodes.
    static FieldGrid between(const Point<Dim>& low, const Point<Dim>& high, double d);

    std::size_t size() const;
    /// Dim x `count`: nodes first, first + 1, ...
    Points<Dim> points(std::size_t first, std::size_t count) const;
    /// Dim x size()
    Points<Dim> points() const { return points(0, size()); }
};

/// The mean square of a field, wave number by wave number.
struct WaveSpectrum {
    std::vector<double> k;      ///< middle of the shell: 0, d, 2d, ... with d = 2 pi/(longest side)
    std::vector<double> power;  ///< sum of |f_k|^2 over the shell; sum of all = mean of f^2
    std::vector<int> waves;     ///< wave vectors in the shell
};

/// `values`, one a node of a periodic grid (FieldGrid::over), analysed into waves by FFTW:
///     f_k = (1/M) sum_nodes f exp(-i k . r),   k_a = 2 pi n_a/L_a, |n_a| <= nodes_a/2,
/// collected in shells of |k| to the nearest multiple of d. One call at a time (FFTW's plans).
template <int Dim>
WaveSpectrum wave_spectrum(const FieldGrid<Dim>& grid, std::span<const double> values);

SPAM_COMPILED(extern template struct FieldGrid);

}  // namespace spam
