// SPDX-License-Identifier: GPL-3.0-or-later
#include "domains.hpp"

#include <spam/diagnostics/field_interpolation.hpp>

namespace phase_separation {

double contour_length(const FieldGrid<2>& grid, std::span<const double> values, double level) {
    const int columns = grid.nodes[0], rows = grid.nodes[1];
    struct Node {
        Point<2> place;
        double above;
    };
    const auto node = [&](int i, int k) {
        const auto at = static_cast<std::size_t>((k % rows) * columns + i % columns);
        return Node{{i * grid.spacing[0], k * grid.spacing[1]}, values[at] - level};
    };
    const auto in_triangle = [](const Node& a, const Node& b, const Node& c) {
        Points<2> ends(2, 2);
        Eigen::Index found = 0;
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
            if ((from.above < 0.0) != (to.above < 0.0))
                ends.col(found++) =
                    from.place + from.above / (from.above - to.above) * (to.place - from.place);
        return found == 0 ? 0.0 : (ends.col(1) - ends.col(0)).norm();
    };
    double length = 0.0;
    for (int k = 0; k < rows; ++k)
        for (int i = 0; i < columns; ++i) {
            const Node low = node(i, k), high = node(i + 1, k + 1);
            length +=
                in_triangle(low, node(i + 1, k), high) + in_triangle(low, high, node(i, k + 1));
        }
    return length;
}

DensityField::DensityField(const AnyWeight<2>& weight, const Points<2>& position, const Box<2>& box)
    : grid(FieldGrid<2>::over(box, {static_cast<int>(std::ceil(box.length(0))),
                                    static_cast<int>(std::ceil(box.length(1)))})) {
    const std::vector<double> mass(static_cast<std::size_t>(position.cols()), 1.0);
    const Eigen::RowVectorXd rho =
        FieldInterpolation<2>(weight, mass, position, box).density(grid.points());
    values.assign(rho.begin(), rho.end());
}

double DensityField::domain_size(double level) const {
    return grid.spacing.prod() * static_cast<double>(grid.size()) /
           contour_length(grid, values, level);
}

double DensityField::mean_wavelength() const {
    const WaveSpectrum waves = wave_spectrum(grid, values);
    double power = 0.0, moment = 0.0;
    for (std::size_t n = 1; n < waves.k.size(); ++n) {
        power += waves.power[n];
        moment += waves.k[n] * waves.power[n];
    }
    return 2.0 * std::numbers::pi * power / moment;
}

double DensityField::phase_density(double level, bool liquid, double distance) const {
    const int columns = grid.nodes[0], rows = grid.nodes[1];
    std::vector<std::array<int, 2>> near;
    const int reach = static_cast<int>(std::ceil(distance / grid.spacing.minCoeff()));
    for (int k = -reach; k <= reach; ++k)
        for (int i = -reach; i <= reach; ++i)
            if (std::hypot(i * grid.spacing[0], k * grid.spacing[1]) <= distance)
                near.push_back({i, k});
    const auto value = [&](int i, int k) {
        return values[static_cast<std::size_t>(((k % rows + rows) % rows) * columns +
                                               (i % columns + columns) % columns)];
    };
    double sum = 0.0;
    int count = 0;
    for (int k = 0; k < rows; ++k)
        for (int i = 0; i < columns; ++i)
            if (std::all_of(near.begin(), near.end(), [&](const auto& off) {
                    return (value(i + off[0], k + off[1]) >= level) == liquid;
                })) {
                sum += value(i, k);
                ++count;
            }
    return sum / count;
}

}  // namespace phase_separation
