// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/convergence.hpp>
#include <spam/diagnostics/fits.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace spam {
namespace {

double slope(std::span<const double> step, std::span<const double> error, std::size_t k) {
    return std::log(error[k] / error[k + 1]) / std::log(step[k] / step[k + 1]);
}

/// From the smallest step, point `last`, to larger ones: the first point of the range.
std::size_t first_of_range(std::span<const double> step, std::span<const double> error,
                           std::span<const char> serves, std::size_t last,
                           const ConvergenceRule& rule) {
    std::size_t first = last;
    double sum = 0.0, before = 0.0;
    for (; first > 0 && serves[first - 1] != 0; --first) {
        if (step[first - 1] > rule.span * step[last]) break;
        const double here = slope(step, error, first - 1);
        const auto n = static_cast<double>(last - first);
        if (n > 0.0 && std::abs(here - (rule.pure ? sum / n : before)) > rule.spread) break;
        sum += here;
        before = here;
    }
    return first;
}

/// log error = a + p log step + c step, by least squares: p and its standard error.
ConvergenceFit fit_range(std::span<const double> step, std::span<const double> error, bool pure) {
    const auto n = static_cast<Eigen::Index>(step.size());
    Eigen::MatrixXd terms(n, pure ? 2 : 3);
    Eigen::VectorXd values(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const double h = step[static_cast<std::size_t>(k)];
        terms(k, 0) = 1.0;
        terms(k, 1) = std::log(h / step.back());
        if (!pure) terms(k, 2) = h / step.back();
        values(k) = std::log(error[static_cast<std::size_t>(k)]);
    }
    const Eigen::VectorXd best = terms.householderQr().solve(values);
    const double variance =
        (terms * best - values).squaredNorm() / static_cast<double>(n - terms.cols());
    const Eigen::MatrixXd covariance = (terms.transpose() * terms).inverse();
    return {best(1), std::sqrt(variance * covariance(1, 1)), step.front(), step.back(),
            step.size()};
}

}  // namespace

ConvergenceFit fit_convergence(std::span<const double> step, std::span<const double> error,
                               double floor, const ConvergenceRule& rule) {
    std::vector<char> serves;
    for (const double e : error)
        serves.push_back(std::isfinite(e) && e > 0.0 && e >= rule.above_floor * floor &&
                         e <= rule.below);
    for (std::size_t last = error.size(); last-- > 0;) {
        if (serves[last] == 0) continue;
        const std::size_t first = first_of_range(step, error, serves, last, rule);
        const std::size_t n = last - first + 1;
        if (n >= rule.points)
            return fit_range(step.subspan(first, n), error.subspan(first, n), rule.pure);
    }
    return {};
}

std::string_view GrowthFit::kind() const {
    if (!above_round_off) return "round-off";
    return exponent < 0.25 ? "bounded" : exponent < 0.75 ? "random walk" : "secular";
}

GrowthFit fit_growth(std::span<const double> t, std::span<const double> change, double round_off) {
    constexpr int times = 40;
    std::vector<double> envelope;
    double most = 0.0;
    for (const double c : change) {
        if (!(std::abs(c) <= most)) most = std::abs(c);  // NaN stays
        envelope.push_back(most);
    }
    GrowthFit fit{0.0, most, most > round_off};
    if (!(most > 0.0) || !std::isfinite(most)) return fit;
    std::vector<double> x, y;
    for (int n = 0; n <= times; ++n) {
        const double at = t.back() * std::pow(10.0, static_cast<double>(n) / times - 1.0);
        const auto row = std::upper_bound(t.begin(), t.end(), at * (1.0 + 1e-12)) - t.begin();
        const double here = row > 0 ? envelope[static_cast<std::size_t>(row - 1)] : 0.0;
        if (!(here > 0.0)) continue;
        x.push_back(std::log(at));
        y.push_back(std::log(here));
    }
    if (x.size() >= 3) fit.exponent = fit_line(x, y).slope;
    return fit;
}

}  // namespace spam
