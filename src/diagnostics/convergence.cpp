// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/convergence.hpp>
#include <spam/diagnostics/fits.hpp>

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
    double sum = 0.0;
    for (; first > 0 && serves[first - 1] != 0; --first) {
        if (step[first - 1] > rule.span * step[last]) break;
        const double here = slope(step, error, first - 1);
        const auto n = static_cast<double>(last - first);
        if (n > 0.0 && std::abs(here - sum / n) > rule.spread) break;
        sum += here;
    }
    return first;
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
        if (n < rule.points) continue;
        std::vector<double> x, y;
        for (std::size_t k = first; k <= last; ++k) {
            x.push_back(std::log(step[k]));
            y.push_back(std::log(error[k]));
        }
        const LineFit line = fit_line(x, y);
        return {line.slope, line.slope_error, step[first], step[last], n};
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
        if (!std::isnan(most) && !(std::abs(c) <= most)) most = std::abs(c);  // NaN stays
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
