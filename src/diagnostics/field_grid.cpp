// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/diagnostics/field_grid.hpp>

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numbers>

namespace spam {

template <int Dim>
FieldGrid<Dim> FieldGrid<Dim>::over(const Box<Dim>& box, const std::array<int, Dim>& nodes) {
    FieldGrid grid{Point<Dim>::Zero(), {}, nodes};
    for (int a = 0; a < Dim; ++a) {
        const int n = nodes[static_cast<std::size_t>(a)];
        if (n < 1)
            throw InputError(fmt::format("grid: {} nodes in a direction; use at least 1", n));
        if (!box.periodic(a))
            throw InputError(fmt::format(
                "grid: direction {} of the box is not periodic and has no length; give the "
                "grid's corners",
                a));
        grid.spacing(a) = box.length(a) / n;
    }
    return grid;
}

template <int Dim>
FieldGrid<Dim> FieldGrid<Dim>::between(const Point<Dim>& low, const Point<Dim>& high, double d) {
    if (!(d > 0.0)) throw InputError(fmt::format("grid: spacing {:g}; it must be above 0", d));
    FieldGrid grid{low, Point<Dim>::Constant(d), {}};
    double all = 1.0;
    for (int a = 0; a < Dim; ++a) {
        // A length that is a whole number of spacings, but for rounding, gets no node more.
        const double n = std::max(0.0, std::ceil((high(a) - low(a)) / d - 1e-9)) + 1.0;
        all *= n;
        if (!(all <= double(std::numeric_limits<int>::max())))
            throw InputError(
                fmt::format("grid: spacing {:g} makes too many nodes; use a larger one", d));
        grid.nodes[static_cast<std::size_t>(a)] = static_cast<int>(n);
    }
    return grid;
}

template <int Dim>
std::size_t FieldGrid<Dim>::size() const {
    std::size_t n = 1;
    for (const int k : nodes) n *= static_cast<std::size_t>(k);
    return n;
}

template <int Dim>
Points<Dim> FieldGrid<Dim>::points(std::size_t first, std::size_t count) const {
    Points<Dim> at(Dim, static_cast<Eigen::Index>(count));
    for (Eigen::Index p = 0; p < at.cols(); ++p) {
        Eigen::Index rest = static_cast<Eigen::Index>(first) + p;
        for (int a = 0; a < Dim; ++a) {
            const int n = nodes[static_cast<std::size_t>(a)];
            at(a, p) = origin(a) + spacing(a) * static_cast<double>(rest % n);
            rest /= n;
        }
    }
    return at;
}

namespace {

/// f_k of half of the waves, n_x = 0 ... nodes_x/2 fastest; the others are their conjugates.
template <int Dim>
std::vector<std::complex<double>> half_transform(const FieldGrid<Dim>& grid,
                                                 std::span<const double> values) {
    std::array<int, Dim> slowest_first;  // FFTW's order
    std::reverse_copy(grid.nodes.begin(), grid.nodes.end(), slowest_first.begin());
    const auto half = static_cast<std::size_t>(grid.nodes[0] / 2 + 1);
    std::vector<std::complex<double>> wave(grid.size() / static_cast<std::size_t>(grid.nodes[0]) *
                                           half);
    std::vector<double> in(values.begin(), values.end());
    // FFTW_ESTIMATE: no plan depends on a clock.
    const std::unique_ptr<std::remove_pointer_t<fftw_plan>, decltype(&fftw_destroy_plan)> plan(
        fftw_plan_dft_r2c(Dim, slowest_first.data(), in.data(),
                          reinterpret_cast<fftw_complex*>(wave.data()), FFTW_ESTIMATE),
        &fftw_destroy_plan);
    fftw_execute(plan.get());
    for (auto& f : wave) f /= static_cast<double>(values.size());
    return wave;
}

}  // namespace

template <int Dim>
WaveSpectrum wave_spectrum(const FieldGrid<Dim>& grid, std::span<const double> values) {
    assert(values.size() == grid.size());
    const auto wave = half_transform(grid, values);
    Point<Dim> unit;  // 2 pi/L
    for (int a = 0; a < Dim; ++a)
        unit(a) =
            2.0 * std::numbers::pi / (grid.spacing(a) * grid.nodes[static_cast<std::size_t>(a)]);
    const double d = unit.minCoeff();
    WaveSpectrum spectrum;
    const int half = grid.nodes[0] / 2 + 1;
    for (std::size_t p = 0; p < wave.size(); ++p) {
        std::size_t rest = p;
        double k2 = 0.0;
        int copies = 1;
        for (std::size_t a = 0; a < Dim; ++a) {
            const int nodes = grid.nodes[a], length = a == 0 ? half : nodes;
            int n = static_cast<int>(rest % static_cast<std::size_t>(length));
            rest /= static_cast<std::size_t>(length);
            if (a == 0)
                copies = n == 0 || 2 * n == nodes ? 1 : 2;  // with the conjugate wave
            else if (2 * n > nodes)
                n -= nodes;
            k2 += std::pow(n * unit(static_cast<Eigen::Index>(a)), 2);
        }
        const auto shell = static_cast<std::size_t>(std::lround(std::sqrt(k2) / d));
        while (spectrum.k.size() <= shell) {
            spectrum.k.push_back(d * static_cast<double>(spectrum.k.size()));
            spectrum.power.push_back(0.0);
            spectrum.waves.push_back(0);
        }
        spectrum.power[shell] += copies * std::norm(wave[p]);
        spectrum.waves[shell] += copies;
    }
    return spectrum;
}

SPAM_COMPILED(template struct FieldGrid);
template WaveSpectrum wave_spectrum(const FieldGrid<1>&, std::span<const double>);
template WaveSpectrum wave_spectrum(const FieldGrid<2>&, std::span<const double>);
template WaveSpectrum wave_spectrum(const FieldGrid<3>&, std::span<const double>);

}  // namespace spam
