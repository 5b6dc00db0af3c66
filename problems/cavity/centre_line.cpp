// SPDX-License-Identifier: GPL-3.0-or-later
#include "centre_line.hpp"

#include <spam/diagnostics/field_interpolation.hpp>
#include <spam/diagnostics/wall_images.hpp>

#include <algorithm>
#include <cmath>

namespace cavity {

std::span<const LinePoint> ghia() {
    static constexpr LinePoint points[] = {{.1016, -.06434}, {.1719, -.10150}, {.2813, -.15662},
                                           {.4531, -.21090}, {.5, -.20581},    {.6172, -.13641},
                                           {.7344, .00332},  {.8516, .23151},  {.9531, .68717}};
    return points;
}

std::vector<double> centre_line(const Model<2>& model, const Scheme& scheme, double speed,
                                std::span<const double> y, const std::vector<double>& heights) {
    const ConstState<2> state(model.layout(), y);
    const Points<2> x = state.position(), v = state.velocity();
    const auto images = images_behind_walls<2>(model.box(), scheme.range, x, v);
    Points<2> position(2, x.cols() + images.count()), velocity(2, position.cols());
    position << x, images.position;
    velocity << v, images.velocity;
    std::vector<double> mass = model.particles().mass;
    for (const Eigen::Index owner : images.owner)
        mass.push_back(mass[static_cast<std::size_t>(owner)]);
    const FieldInterpolation<2> fields(weight_function<2>(to_string(scheme.kernel), scheme.range),
                                       mass, position, {});
    const double side = model.box().wall(0, true).at;
    Points<2> at(2, static_cast<Eigen::Index>(heights.size()));
    for (std::size_t k = 0; k < heights.size(); ++k)
        at.col(static_cast<Eigen::Index>(k)) = Point<2>(0.5, heights[k]) * side;
    const Eigen::MatrixXd u = fields.value(velocity, at);
    std::vector<double> along;
    for (Eigen::Index k = 0; k < u.cols(); ++k) along.push_back(u(0, k) / speed);
    return along;
}

CentreLine::CentreLine(const Scheme& scheme, double speed, double since)
    : scheme_(scheme),
      speed_(speed),
      since_(since) {
    for (const auto& point : ghia()) heights_.push_back(point.y);
    for (int k = 0; k <= 100; ++k) heights_.push_back(0.01 * k);
    sum_.assign(heights_.size(), 0.0);
}

Observer<2> CentreLine::observer(bool known) {
    Observer<2> observer;
    observer.on_row = [this](double t, const Model<2>& model, std::span<const double> y) {
        latest_ = centre_line(model, scheme_, speed_, y, heights_);
        if (t < since_) return;
        for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] += latest_[k];
        ++rows_;
    };
    if (known)
        observer.columns.push_back(
            {"off_ghia_now",
             [this](const Model<2>&, std::span<const double>) { return off_ghia(latest_); }});
    observer.memory = [this](Archive& archive) { archive(sum_, rows_); };
    return observer;
}

std::vector<double> CentreLine::mean() const {
    if (rows_ == 0) return latest_;
    std::vector<double> mean = sum_;
    for (double& u : mean) u /= static_cast<double>(rows_);
    return mean;
}

double CentreLine::off_ghia(const std::vector<double>& u) {
    double largest = 0.0;
    for (std::size_t k = 0; k < ghia().size(); ++k)
        largest = std::max(largest, std::abs(u[k] - ghia()[k].u));
    return largest;
}

}  // namespace cavity
