// SPDX-License-Identifier: GPL-3.0-or-later
#include "centre_line.hpp"

#include <spam/diagnostics/field_interpolation.hpp>
#include <spam/diagnostics/wall_images.hpp>

namespace cavity {

std::span<const LinePoint> ghia() {
    static constexpr LinePoint points[] = {{.1016, -.06434}, {.1719, -.10150}, {.2813, -.15662},
                                           {.4531, -.21090}, {.5, -.20581},    {.6172, -.13641},
                                           {.7344, .00332},  {.8516, .23151},  {.9531, .68717}};
    return points;
}

std::span<const LinePoint> converged() {
    static constexpr LinePoint points[] = {
        {1.0 / 16.0, -0.041974991},  {2.0 / 16.0, -0.077125399},  {3.0 / 16.0, -0.109816214},
        {4.0 / 16.0, -0.141930064},  {5.0 / 16.0, -0.172712391},  {6.0 / 16.0, -0.198470859},
        {7.0 / 16.0, -0.212962392},  {8.0 / 16.0, -0.209149142},  {9.0 / 16.0, -0.182080595},
        {10.0 / 16.0, -0.131256301}, {11.0 / 16.0, -0.060245594}, {12.0 / 16.0, 0.027874448},
        {13.0 / 16.0, 0.140425325},  {14.0 / 16.0, 0.31055709},   {15.0 / 16.0, 0.597466694}};
    return points;
}

namespace {

/// Of the values from number `first` on.
double largest_difference(std::span<const LinePoint> points, const std::vector<double>& u,
                          std::size_t first) {
    double largest = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k)
        largest = std::max(largest, std::abs(u[first + k] - points[k].u));
    return largest;
}

}  // namespace

std::vector<double> centre_line(const Model<2>& model, const Scheme& scheme, double side,
                                double speed, std::span<const double> y,
                                const std::vector<double>& heights) {
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
    Points<2> at(2, static_cast<Eigen::Index>(heights.size()));
    for (std::size_t k = 0; k < heights.size(); ++k)
        at.col(static_cast<Eigen::Index>(k)) = Point<2>(0.5, heights[k]) * side;
    const Eigen::MatrixXd u = fields.value(velocity, at);
    std::vector<double> along;
    for (Eigen::Index k = 0; k < u.cols(); ++k) along.push_back(u(0, k) / speed);
    return along;
}

CentreLine::CentreLine(const Scheme& scheme, double side, double speed, double since)
    : scheme_(scheme),
      side_(side),
      speed_(speed),
      since_(since) {
    for (const auto& point : ghia()) heights_.push_back(point.y);
    for (const auto& point : converged()) heights_.push_back(point.y);
    for (int k = 0; k <= 100; ++k) heights_.push_back(0.01 * k);
    sum_.assign(heights_.size(), 0.0);
}

Observer<2> CentreLine::observer(bool known) {
    Observer<2> observer;
    observer.on_row = [this](double t, const Model<2>& model, std::span<const double> y) {
        latest_ = centre_line(model, scheme_, side_, speed_, y, heights_);
        if (t < since_) return;
        for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] += latest_[k];
        ++rows_;
    };
    if (known)
        observer.columns = {
            {"off_ghia_now",
             [this](const Model<2>&, std::span<const double>) { return off_ghia(latest_); }},
            {"off_converged_now",
             [this](const Model<2>&, std::span<const double>) { return off_converged(latest_); }}};
    // A run that goes on to a later end takes its mean over a later part.
    observer.memory = [this](Archive& archive) {
        double since = since_;
        archive(since, sum_, rows_);
        if (since == since_) return;
        sum_.assign(heights_.size(), 0.0);
        rows_ = 0;
    };
    return observer;
}

std::vector<double> CentreLine::mean() const {
    if (rows_ == 0) return latest_;
    std::vector<double> mean = sum_;
    for (double& u : mean) u /= static_cast<double>(rows_);
    return mean;
}

double CentreLine::off_ghia(const std::vector<double>& u) {
    return largest_difference(ghia(), u, 0);
}

double CentreLine::off_converged(const std::vector<double>& u) {
    return largest_difference(converged(), u, ghia().size());
}

std::pair<std::vector<double>, std::vector<double>> CentreLine::profile() const {
    const auto even = static_cast<std::ptrdiff_t>(ghia().size() + converged().size());
    const auto u = mean();
    return {{heights_.begin() + even, heights_.end()}, {u.begin() + even, u.end()}};
}

}  // namespace cavity
