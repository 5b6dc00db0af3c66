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
    no_images     ///< nothing behind the walls across y
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

/// f(i, j, x_j - x_i) for every particle i and every image of every particle j, itself included.
template <class F>
void for_each_image(const Box<2>& box, const Points<2>& x, const F& f) {
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        for (Eigen::Index j = 0; j < x.cols(); ++j)
            for (const double across : images(box, 0, x(0, j)))
                for (const double up : images(box, 1, x(1, j)))
                    f(i, j, Point<2>(Point<2>(across, up) - x.col(i)));
}

/// u - v of every particle by sums over all of them and all images.
inline Points<2> brute_force(const FluidModel<2>& model, const ConstState<2>& state,
                             Mutation mutation = Mutation::none) {
    const Scheme& scheme = model.scheme();
    const auto weight = weight_function<2>(to_string(scheme.kernel), scheme.range);
    const auto& mass = model.particles().mass;
    // Density at rest, in the mean over the reference configuration.
    const Points<2>& X = model.particles().reference_position;
    const auto m = [&](Eigen::Index i) { return mass[static_cast<std::size_t>(i)]; };
    double rest = 0.0;
    for_each_image(model.box(), X, [&](Eigen::Index, Eigen::Index j, const Point<2>& r) {
        rest += m(j) * weight.value(r.norm()) / static_cast<double>(X.cols());
    });
    const double D = scheme.shifting * model.fluid().state.sound_speed(rest, 0.0) * scheme.range;
    const Points<2> x = state.position();
    Eigen::RowVectorXd rho = Eigen::RowVectorXd::Zero(x.cols());
    if (state.has(Field::density))
        rho = state.density();
    else
        for_each_image(model.box(), x, [&](Eigen::Index i, Eigen::Index j, const Point<2>& r) {
            rho[i] += m(j) * weight.value(r.norm());
        });
    Points<2> u = Points<2>::Zero(2, x.cols());
    for_each_image(model.box(), x, [&](Eigen::Index i, Eigen::Index j, const Point<2>& r) {
        const bool behind = !model.box().periodic(1) && r[1] != x(1, j) - x(1, i);
        if (mutation == Mutation::no_images && behind) return;
        double mean = scheme.mean_density == MeanDensityKind::arithmetic
                          ? 0.5 * (rho[i] + rho[j])
                          : std::sqrt(rho[i] * rho[j]);
        if (mutation == Mutation::own_density) mean = rho[i];
        const double sign = mutation == Mutation::uphill ? 1.0 : -1.0;
        u.col(i) += sign * D * m(j) / mean * weight.minus_slope_over_r(r.norm()) * r;
    });
    return u;
}

}  // namespace spam::test::shifting
