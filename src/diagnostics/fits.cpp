// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/fits.hpp>

#include <gsl/gsl_fit.h>

#include <cassert>
#include <cmath>
#include <vector>

namespace spam {

LineFit fit_line(std::span<const double> x, std::span<const double> y) {
    assert(x.size() == y.size() && x.size() >= 3);
    LineFit fit{};
    double c00 = 0.0, c01 = 0.0, c11 = 0.0, residual = 0.0;
    gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &fit.intercept, &fit.slope, &c00, &c01, &c11,
                   &residual);
    fit.slope_error = std::sqrt(c11);
    return fit;
}

double best_factor(std::span<const double> of, std::span<const double> to) {
    double product = 0.0, norm = 0.0;
    for (std::size_t n = 0; n < of.size(); ++n) {
        product += of[n] * to[n];
        norm += to[n] * to[n];
    }
    return product / norm;
}

double period_of_zeros(std::span<const double> t, std::span<const double> value) {
    std::vector<double> number, zero;
    std::size_t last = 0;  // the latest row that is not 0
    for (std::size_t r = 1; r < t.size(); ++r) {
        if (value[r] == 0.0) continue;
        const double before = value[last], now = value[r];
        if (before != 0.0 && (before < 0.0) != (now < 0.0)) {
            number.push_back(static_cast<double>(zero.size()));
            zero.push_back(last + 1 < r ? t[last + 1]
                                        : t[last] + (t[r] - t[last]) * before / (before - now));
        }
        last = r;
    }
    return zero.size() < 3 ? 0.0 : 2.0 * fit_line(number, zero).slope;
}

bool resolves(std::span<const double> t, double period) {
    return t.size() > 1 &&
           t.back() - t.front() <= static_cast<double>(t.size() - 1) * period / 20.0;
}

double observed_order(std::span<const double> step, std::span<const double> error) {
    std::vector<double> log_step, log_error;
    for (const double h : step) log_step.push_back(std::log(h));
    for (const double e : error) log_error.push_back(std::log(e));
    return fit_line(log_step, log_error).slope;
}

}  // namespace spam
