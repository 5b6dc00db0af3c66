// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/neighbors/connected_parts.hpp>
#include <spam/neighbors/strip_sort.hpp>
#include <spam/setup/lattices.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {

Points<2> triangular_hexagon(int n, double spacing) {
    const Eigen::Index count = 1 + 3 * static_cast<Eigen::Index>(n) * (n + 1);
    Points<2> points(2, count);
    Eigen::Index k = 0;
    for (int row = -n; row <= n; ++row) {
        const int columns = 2 * n + 1 - std::abs(row);
        for (int c = 0; c < columns; ++c, ++k) {
            points(0, k) = spacing * (c - 0.5 * (columns - 1));
            points(1, k) = spacing * row * std::sqrt(0.75);
        }
    }
    return points;
}

namespace {

/// Those of which the first `axes` coordinates are not farther than the radius.
template <int Dim>
Points<Dim> within(const Points<Dim>& points, Eigen::Index axes, double radius) {
    std::vector<Eigen::Index> inside;
    for (Eigen::Index k = 0; k < points.cols(); ++k)
        if (points.col(k).head(axes).norm() <= radius * (1.0 + 1e-12)) inside.push_back(k);
    return points(Eigen::all, inside);
}

}  // namespace

Points<2> triangular_disk(double radius, double spacing) {
    // The hexagon around it: its sides are sqrt(3/4) of its corners' distance away.
    const Points<2> hexagon =
        triangular_hexagon(static_cast<int>(radius / spacing / std::sqrt(0.75)) + 1, spacing);
    return within(hexagon, 2, radius);
}

Points<2> triangular_block(int columns, int rows, double spacing) {
    Points<2> points(2, static_cast<Eigen::Index>(columns) * rows);
    Eigen::Index k = 0;
    for (int row = 0; row < rows; ++row)
        for (int c = 0; c < columns; ++c, ++k) {
            points(0, k) = spacing * (c + 0.5 * (row % 2));
            points(1, k) = spacing * row * std::sqrt(0.75);
        }
    return points;
}

Box<2> triangular_box(int columns, int rows, double spacing) {
    if (rows % 2 != 0)
        throw InputError(fmt::format(
            "cells: {} rows of triangular lattice are not periodic; use an even number", rows));
    return Box<2>({spacing * columns, spacing * rows * std::sqrt(0.75)});
}

template <int Dim>
Points<Dim> square_lattice(const std::array<int, Dim>& cells, double spacing) {
    Eigen::Index count = 1;
    for (const int c : cells) count *= c;
    Points<Dim> points(Dim, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        Eigen::Index rest = k;
        for (int a = 0; a < Dim; ++a) {
            const int n = cells[static_cast<std::size_t>(a)];
            points(a, k) = spacing * static_cast<double>(rest % n);
            rest /= n;
        }
    }
    return points;
}

double cubic_edge(CubicLattice lattice) {
    return lattice == CubicLattice::sc    ? 1.0
           : lattice == CubicLattice::fcc ? std::sqrt(2.0)
                                          : 2.0 / std::sqrt(3.0);
}

Points<3> cubic_lattice(CubicLattice lattice, const std::array<int, 3>& cells, double spacing) {
    std::vector<Point<3>> basis{Point<3>::Zero()};
    if (lattice == CubicLattice::fcc)
        basis.insert(basis.end(), {{0.0, 0.5, 0.5}, {0.5, 0.0, 0.5}, {0.5, 0.5, 0.0}});
    if (lattice == CubicLattice::bcc) basis.emplace_back(0.5, 0.5, 0.5);
    const Points<3> corners = square_lattice<3>(cells);
    Points<3> points(3, corners.cols() * static_cast<Eigen::Index>(basis.size()));
    Eigen::Index k = 0;
    for (const auto& corner : corners.colwise())
        for (const Point<3>& site : basis)
            points.col(k++) = spacing * cubic_edge(lattice) * (corner + site);
    return points;
}

Points<3> ball_of(const Points<3>& points, double radius) { return within(points, 3, radius); }
Points<3> cylinder_of(const Points<3>& points, double radius) { return within(points, 2, radius); }

template <int Dim>
Particles<Dim> make_particles(const Points<Dim>& position, double mass, double spacing,
                              const Box<Dim>& box, double reach) {
    const auto n = static_cast<std::size_t>(position.cols());
    StripSort<Dim> strips;
    strips.build(box.wrapped(position), box);
    const auto order = strips.order();
    Particles<Dim> particles;
    particles.spacing = spacing;
    particles.mass.assign(n, mass);
    particles.id.resize(n);
    particles.reference_position.resize(Dim, position.cols());
    for (std::size_t k = 0; k < n; ++k) {
        particles.id[k] = order[k];
        particles.reference_position.col(static_cast<Eigen::Index>(k)) = position.col(order[k]);
    }
    particles.body = connected_parts<Dim>(particles.reference_position,
                                          reach > 0.0 ? reach : 1.5 * spacing, box);
    return particles;
}

template <int Dim>
Particles<Dim> joined(const std::vector<Particles<Dim>>& parts) {
    Particles<Dim> all;
    Eigen::Index n = 0;
    for (const auto& part : parts) n += part.reference_position.cols();
    all.reference_position.resize(Dim, n);
    const auto append = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    for (const auto& part : parts) {
        if (part.spacing != parts.front().spacing)
            throw InputError(fmt::format(
                "spacing: {} and {} of two bodies differ, and a model has one; give both "
                "the same",
                parts.front().spacing, part.spacing));
        if (part.material.empty() != parts.front().material.empty())
            throw InputError(
                "material: one body names its materials and another does not; name those of both");
        std::int64_t next_id = 0;
        for (const auto id : all.id) next_id = std::max(next_id, id + 1);
        const std::int32_t next_body = all.bodies();
        all.reference_position.middleCols(static_cast<Eigen::Index>(all.size()),
                                          part.reference_position.cols()) = part.reference_position;
        for (const auto id : part.id) all.id.push_back(id + next_id);
        for (const auto body : part.body) all.body.push_back(body + next_body);
        append(all.mass, part.mass);
        append(all.material, part.material);
        all.spacing = part.spacing;
    }
    return all;
}

#define SPAM_INSTANTIATE(D)                                                                  \
    template Particles<D> joined<D>(const std::vector<Particles<D>>&);                       \
    template Points<D> square_lattice<D>(const std::array<int, D>&, double);                 \
    template Particles<D> make_particles<D>(const Points<D>&, double, double, const Box<D>&, \
                                            double);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
