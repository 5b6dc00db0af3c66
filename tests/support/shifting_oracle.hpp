// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/any_weight.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/lattices.hpp>

#include <cmath>
#include <random>

/// Shifting by sums over all particles and all their images, and boxes to try it in.
namespace spam::test::shifting {

inline constexpr int n = 12;

/// One thing wrong with the law.
enum class Mutation {
    none,
    uphill,       ///< to where particles crowd
    own_density,  ///< m_j/rho_i in place of m_j/rho_ij
    flat_images   ///< images behind walls that do not see the particles' own
};

template <int Dim>
Box<Dim> periodic_box(double L = n) {
    std::array<double, Dim> lengths;
    lengths.fill(L);
    return Box<Dim>(lengths);
}

/// Periodic across x, between no-slip walls across y of which the upper one moves.
inline Box<2> channel() {
    Box<2> box({double(n), 0.0});
    box.set_wall(1, false, {WallKind::no_slip, 0.0});
    box.set_wall(1, true, {WallKind::no_slip, double(n), {0.3, 0.0}});
    return box;
}

inline Box<2> cavity() {
    Box<2> box;
    for (const int a : {0, 1}) box.set_wall(a, false, {WallKind::no_slip, 0.0});
    box.set_wall(0, true, {WallKind::no_slip, double(n)});
    box.set_wall(1, true, {WallKind::mirror, double(n)});
    return box;
}

template <int Dim>
Particles<Dim> disordered(const Box<Dim>& box, unsigned seed, double disorder = 0.3) {
    std::array<int, Dim> cells;
    cells.fill(n);
    Points<Dim> x = square_lattice<Dim>(cells);
    x.colwise() += Point<Dim>::Constant(0.5) - x.rowwise().minCoeff().eval();
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (auto& c : x.reshaped()) c += disorder * u(random);
    auto particles = make_particles<Dim>(x, 1.0, 1.0, box);
    if (disorder > 0.0)
        for (double& m : particles.mass) m += 0.1 * u(random);
    return particles;
}

/// Where the images of x are along one direction, itself first.
inline std::vector<double> images(const Box<2>& box, int a, double x) {
    if (box.periodic(a)) return {x, x - box.length(a), x + box.length(a)};
    return {x, 2.0 * box.wall(a, false).at - x, 2.0 * box.wall(a, true).at - x};
}

/// u - v of every particle by sums over all of them and all images.
inline Points<2> brute_force(const FluidModel<2>& model, const ConstState<2>& state,
                             Mutation mutation = Mutation::none) {
    const Scheme& scheme = model.scheme();
    const auto weight = weight_function<2>(to_string(scheme.kernel), scheme.range);
    const auto& mass = model.particles().mass;
    const auto each_image = [&](const Points<2>& x, Eigen::Index i, const auto& f) {
        for (Eigen::Index j = 0; j < x.cols(); ++j)
            for (const double across : images(model.box(), 0, x(0, j)))
                for (const double up : images(model.box(), 1, x(1, j))) {
                    const bool behind = up != x(1, j) && !model.box().periodic(1);
                    if (mutation == Mutation::flat_images && behind) continue;
                    f(j, Point<2>(Point<2>(across, up) - x.col(i)));
                }
    };
    // Density at rest, in the mean over the reference configuration.
    const Points<2>& X = model.particles().reference_position;
    double rest = 0.0;
    for (Eigen::Index i = 0; i < X.cols(); ++i)
        for (Eigen::Index j = 0; j < X.cols(); ++j)
            for (const double across : images(model.box(), 0, X(0, j)))
                for (const double up : images(model.box(), 1, X(1, j)))
                    rest += mass[static_cast<std::size_t>(j)] *
                            weight.value((Point<2>(across, up) - X.col(i)).norm()) /
                            static_cast<double>(X.cols());
    const double D = scheme.shifting * model.fluid().state.sound_speed(rest, 0.0) * scheme.range;
    const Points<2> x = state.position();
    std::vector<double> rho(mass.size(), 0.0);
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (state.has(Field::density))
            rho[k] = state.density()(0, i);
        else
            each_image(x, i, [&](Eigen::Index j, const Point<2>& r) {
                rho[k] += mass[static_cast<std::size_t>(j)] * weight.value(r.norm());
            });
    }
    Points<2> u = Points<2>::Zero(2, x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        each_image(x, i, [&](Eigen::Index j, const Point<2>& r) {
            const double a = rho[static_cast<std::size_t>(i)], b = rho[static_cast<std::size_t>(j)];
            double mean = scheme.mean_density == MeanDensityKind::arithmetic ? 0.5 * (a + b)
                                                                             : std::sqrt(a * b);
            if (mutation == Mutation::own_density) mean = a;
            const double sign = mutation == Mutation::uphill ? 1.0 : -1.0;
            u.col(i) += sign * D * mass[static_cast<std::size_t>(j)] / mean *
                        weight.minus_slope_over_r(r.norm()) * r;
        });
    return u;
}

}  // namespace spam::test::shifting
