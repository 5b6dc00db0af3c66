// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/analysis/wave_vectors.hpp>
#include <spam/setup/lattices.hpp>

#include <cmath>
#include <numbers>

namespace spam {

using std::numbers::pi;

template <int Dim>
Points<Dim> allowed_wave_vectors(const Box<Dim>& box, const std::array<int, Dim>& cells) {
    Points<Dim> all = square_lattice<Dim>(cells, 2.0 * pi);
    for (int a = 0; a < Dim; ++a) all.row(a) /= box.length(a);
    return all;
}

Point<2> first_zone(const Point<2>& k, double spacing) {
    const Point<2> g1 = 2.0 * pi / spacing * Point<2>(1.0, -1.0 / std::sqrt(3.0));
    const Point<2> g2 = 2.0 * pi / spacing * Point<2>(0.0, 2.0 / std::sqrt(3.0));
    // Coordinates of k in units of g1 and g2; the shortest is next to one of the four around it.
    const double p = k.x() * spacing / (2.0 * pi);
    const double q = 0.5 * (k.y() * spacing * std::sqrt(3.0) / (2.0 * pi) + p);
    const auto angle = [](const Point<2>& v) {
        const double phi = std::atan2(v.y(), v.x());
        return phi < -1e-9 ? phi + 2.0 * pi : phi;
    };
    Point<2> best = k;
    bool any = false;
    for (int a = -1; a <= 2; ++a)
        for (int b = -1; b <= 2; ++b) {
            const Point<2> image = k - (std::floor(p) + a) * g1 - (std::floor(q) + b) * g2;
            const double longer = image.norm() - best.norm();
            const bool equal = any && std::abs(longer) * spacing < 1e-9;
            if (any && (equal ? angle(image) >= angle(best) - 1e-9 : longer > 0.0)) continue;
            best = image;
            any = true;
        }
    return best;
}

WavePath triangular_path(int points, double spacing) {
    const Point<2> gamma = Point<2>::Zero(), K(4.0 * pi / 3.0 / spacing, 0.0),
                   M = Point<2>(pi, pi / std::sqrt(3.0)) / spacing;
    const std::vector<Point<2>> stops{gamma, K, M, gamma};
    const double length = K.norm() + (M - K).norm() + M.norm();
    WavePath path;
    std::vector<Point<2>> k;
    double start = 0.0;
    path.corners.push_back({"Γ", 0.0});
    const std::vector<std::string> names{"K", "M", "Γ"};
    for (std::size_t leg = 0; leg < names.size(); ++leg) {
        const Point<2> along = stops[leg + 1] - stops[leg];
        const int parts =
            std::max(1, static_cast<int>(std::lround(points * along.norm() / length)));
        for (int s = leg == 0 ? 0 : 1; s <= parts; ++s) {
            const double fraction = static_cast<double>(s) / parts;
            k.push_back(stops[leg] + fraction * along);
            path.distance.push_back(start + fraction * along.norm());
        }
        start += along.norm();
        path.corners.push_back({names[leg], start});
    }
    path.k.resize(2, static_cast<Eigen::Index>(k.size()));
    for (std::size_t s = 0; s < k.size(); ++s) path.k.col(static_cast<Eigen::Index>(s)) = k[s];
    return path;
}

template Points<1> allowed_wave_vectors<1>(const Box<1>&, const std::array<int, 1>&);
template Points<2> allowed_wave_vectors<2>(const Box<2>&, const std::array<int, 2>&);
template Points<3> allowed_wave_vectors<3>(const Box<3>&, const std::array<int, 3>&);

}  // namespace spam
