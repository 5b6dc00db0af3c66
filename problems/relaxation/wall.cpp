// SPDX-License-Identifier: GPL-3.0-or-later
#include "wall.hpp"

#include <spam/core/exact_sum.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace relaxation {
namespace {

using std::numbers::pi;

constexpr int pieces_per_range = 8;
/// Gauss' three points of a piece, as parts of it, and their weights.
struct Node {
    double part, weight;
};
const std::array<Node, 3> gauss{
    {{0.5 - std::sqrt(0.15), 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + std::sqrt(0.15), 5.0 / 18.0}}};

/// (1/r^2) integral of w r' dr' from 0 to r, for Lucy's w = (5/(pi h^2)) (1 - 6u^2 + 8u^3 - 3u^4): its
/// divergence is w where multiplied by r.
double flux(double r, double h) {
    const double u = r / h;
    if (u >= 1.0) return 1.0 / (2.0 * pi * r * r);
    return 5.0 / (pi * h * h) * (0.5 + u * u * (-1.5 + u * (1.6 - 0.5 * u)));
}

}  // namespace

OuterMatter::OuterMatter(const Region& region, double range) : region_(region), weight_(range) {
    const Points<2>& polygon = region.polygon();
    std::vector<Piece> all;
    for (Eigen::Index k = 0; k < polygon.cols(); ++k) {
        const Point<2> a = polygon.col(k), side = polygon.col((k + 1) % polygon.cols()) - a;
        const int n =
            std::max(1, static_cast<int>(std::ceil(side.norm() * pieces_per_range / range)));
        const Point<2> normal(side.y() / n, -side.x() / n);  // counterclockwise: outwards
        for (int p = 0; p < n; ++p)
            all.push_back({a + side * (double(p) / n), a + side * (double(p + 1) / n), normal});
    }
    corner_ = polygon.rowwise().minCoeff() - Point<2>::Constant(0.5 * range);
    const Point<2> size = polygon.rowwise().maxCoeff() - corner_;
    columns_ = static_cast<int>(size.x() / range) + 1;
    rows_ = static_cast<int>(size.y() / range) + 1;
    const auto cell_of = [&](const Piece& piece) {
        const Point<2> at = (0.5 * (piece.from + piece.to) - corner_) / range;
        return cell(static_cast<int>(at.x()), static_cast<int>(at.y()));
    };
    std::stable_sort(all.begin(), all.end(),
                     [&](const Piece& a, const Piece& b) { return cell_of(a) < cell_of(b); });
    start_.assign(cell(0, rows_) + 1, 0);
    for (const Piece& piece : all) ++start_[cell_of(piece) + 1];
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    pieces_ = std::move(all);
}

/// All pieces with a point nearer than the range, and some more: two cells to all sides, because pieces
/// are sorted by their middles.
template <class Visit>
void OuterMatter::for_each_near(const Point<2>& r, const Visit& visit) const {
    const Point<2> at = (r - corner_) / weight_.range();
    if (!(at.x() > -3.0 && at.x() < columns_ + 3.0 && at.y() > -3.0 && at.y() < rows_ + 3.0))
        return;
    const int column = static_cast<int>(std::floor(at.x())),
              row = static_cast<int>(std::floor(at.y()));
    for (int y = std::max(0, row - 2); y <= std::min(rows_ - 1, row + 2); ++y)
        for (int x = std::max(0, column - 2); x <= std::min(columns_ - 1, column + 2); ++x)
            for (std::uint32_t k = start_[cell(x, y)]; k < start_[cell(x, y) + 1]; ++k)
                visit(pieces_[k]);
}

Point<2> OuterMatter::force(const Point<2>& r) const {
    Point<2> sum = Point<2>::Zero();
    for_each_near(r, [&](const Piece& piece) {
        double w = 0.0;
        for (const auto& [part, weight] : gauss)
            w += weight * weight_.value((piece.from + part * (piece.to - piece.from) - r).norm());
        sum -= w * piece.normal;
    });
    return sum + spring(r).force;
}

double OuterMatter::energy(const Point<2>& r) const { return weight_outside(r) + spring(r).energy; }

/// A side from s_1 to s_2 along itself, at the distance d of its line, adds
///     I = integral of (d^2 + s^2)^-3/2 ds = (s_2/rho_2 - s_1/rho_1)/d^2,   rho^2 = d^2 + s^2,
/// and to the slope 3 (n J + t K), n from r to the line, t along it, with
///     J = integral of (d^2 + s^2)^-5/2 ds = I ((1/rho_1^2 + 1/rho_2^2)/2 + d^2 I^2/6),
///     K = (1/rho_1^3 - 1/rho_2^3)/3.
/// Where both ends lie to the same side of r, I is written without the division by d, which may be 0.
OuterMatter::Spring OuterMatter::spring(const Point<2>& r) const {
    if (region_.contains(r)) return {};
    const Points<2>& polygon = region_.polygon();
    double sum = 0.0;
    Point<2> slope = Point<2>::Zero();
    for (Eigen::Index k = 0; k < polygon.cols(); ++k) {
        const Point<2> a = polygon.col(k) - r, b = polygon.col((k + 1) % polygon.cols()) - r;
        const double length = (b - a).norm(), rho_1 = a.norm(), rho_2 = b.norm();
        const Point<2> t = (b - a) / length;
        const double s_1 = a.dot(t), s_2 = b.dot(t);
        const Point<2> n = a - s_1 * t;
        const double d_d = n.squaredNorm();
        const double i = s_1 * s_2 > 0.0
                             ? length * (s_1 + s_2) / (rho_1 * rho_2 * (s_2 * rho_1 + s_1 * rho_2))
                             : (s_2 / rho_2 - s_1 / rho_1) / d_d;
        const double j = i * (0.5 / (rho_1 * rho_1) + 0.5 / (rho_2 * rho_2) + d_d * i * i / 6.0);
        sum += i;
        slope += 3.0 * j * n + (std::pow(rho_1, -3) - std::pow(rho_2, -3)) * t;
    }
    if (!(sum < 1e30)) return {};  // on the border
    return {1.0 / sum, slope / sum / sum};
}

/// By the divergence theorem: the weight inside is the flux of flux(r) r through the border, which far
/// away is the angle of view over 2 pi. Only where it differs from that the pieces matter.
double OuterMatter::weight_outside(const Point<2>& r) const {
    double inside = region_.contains(r) ? 1.0 : 0.0;
    for_each_near(r, [&](const Piece& piece) {
        const Point<2> a = piece.from - r, b = piece.to - r;
        double through = 0.0;
        bool near = false;
        for (const auto& [part, weight] : gauss) {
            const Point<2> s = a + part * (b - a);
            near = near || s.norm() < weight_.range();
            through += weight * flux(s.norm(), weight_.range()) * s.dot(piece.normal);
        }
        if (!near) return;
        const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
        inside += through - angle / (2.0 * pi);
    });
    return 1.0 - inside;
}

/// A hundredth of the range inside: on the border itself round-off decides what is inside.
double OuterMatter::least_weight_on_border() const {
    double least = 1.0;
    for (const Piece& piece : pieces_) {
        const Point<2> inwards = -0.01 * weight_.range() * piece.normal.normalized();
        least = std::min(least, weight_outside(0.5 * (piece.from + piece.to) + inwards));
    }
    return least;
}

void OuterMatter::add_density(const ConstState<2>& state, std::vector<double>& rho) const {
    const auto x = state.position();
    for (std::size_t i = 0; i < rho.size(); ++i)
        rho[i] += weight_outside(x.col(static_cast<Eigen::Index>(i)));
}

}  // namespace relaxation
