// SPDX-License-Identifier: GPL-3.0-or-later
#include "grid.hpp"

#include <spam/core/nvector.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace rayleigh_benard {

using std::numbers::pi;

double Layer::eta() const { return (hot - cold) * L / std::sqrt(0.5 * (hot + cold) * rayleigh); }

/// From the stream function (roll L/pi) sin(pi x/L) sin^2(pi y/L).
double Layer::seed_u(double x, double y) const {
    return roll * std::sin(pi * x / L) * std::sin(2.0 * pi * y / L);
}
double Layer::seed_v(double x, double y) const {
    const double s = std::sin(pi * y / L);
    return -roll * std::cos(pi * x / L) * s * s;
}

Grid::Grid(const Layer& layer, const spam::Box<2>& box, int cells)
    : layer_(layer),
      box_(box),
      nx_(2 * cells),
      ny_(cells),
      d_(layer.L / cells),
      eta_(layer.eta()) {
    values_.resize(this->cells());
}

std::vector<double> Grid::start() const {
    std::vector<double> y(4 * cells() + 2, 0.0);
    const std::size_t n = cells();
    for (int j = 0; j < ny_; ++j)
        for (int i = 0; i < nx_; ++i) {
            const auto k = static_cast<std::size_t>(j * nx_ + i);
            const double X = (i + 0.5) * d_, Y = (j + 0.5) * d_;
            const double u = layer_.seed_u(X, Y), v = layer_.seed_v(X, Y);
            y[k] = 1.0;
            y[n + k] = u;
            y[2 * n + k] = v;
            y[3 * n + k] = layer_.temperature(Y) + 0.5 * (u * u + v * v);
        }
    return y;
}

Grid::Values Grid::image(const Values& cell, int axis, bool upper) const {
    const auto image = box_.wall(axis, upper).image(axis);
    const auto changed = [](double value, const auto& change) {
        return change.sign * value + change.shift;
    };
    return {cell.rho, changed(cell.u, image.velocity[0]), changed(cell.v, image.velocity[1]),
            changed(cell.T, image.temperature)};
}

Grid::Values Grid::at(int i, int j) const {
    if (box_.periodic(0)) i = (i + nx_) % nx_;
    const int column = std::clamp(i, 0, nx_ - 1), row = std::clamp(j, 0, ny_ - 1);
    Values values = values_[static_cast<std::size_t>(row * nx_ + column)];
    if (column != i) values = image(values, 0, i > column);
    if (row != j) values = image(values, 1, j > row);
    return values;
}

double Grid::pressure(int i, int j, int axis) const {
    const int dx = axis == 0 ? 1 : 0, dy = 1 - dx;
    const bool periodic = box_.periodic(axis);
    const int k = axis == 0 ? i : j, last = (axis == 0 ? nx_ : ny_) - 1;
    if (!periodic && k < 0)
        return 1.5 * at(i + dx, j + dy).P() - 0.5 * at(i + 2 * dx, j + 2 * dy).P();
    if (!periodic && k == last) return 1.5 * at(i, j).P() - 0.5 * at(i - dx, j - dy).P();
    return 0.5 * (at(i, j).P() + at(i + dx, j + dy).P());
}

Grid::Flux Grid::across_x(int i, int j) const {
    const Values l = at(i, j), r = at(i + 1, j);
    const Values ln = at(i, j + 1), ls = at(i, j - 1), rn = at(i + 1, j + 1), rs = at(i + 1, j - 1);
    const double u = 0.5 * (l.u + r.u), v = 0.5 * (l.v + r.v), T = 0.5 * (l.T + r.T);
    const double P = pressure(i, j, 0), heat = -eta_ * (r.T - l.T) / d_;
    const double m = 0.5 * (l.rho + r.rho) * u;
    const double u_x = (r.u - l.u) / d_, v_x = (r.v - l.v) / d_;
    const double u_y = (ln.u - ls.u + rn.u - rs.u) / (4.0 * d_);
    const double v_y = (ln.v - ls.v + rn.v - rs.v) / (4.0 * d_);
    const double xx = eta_ * (u_x - v_y), xy = eta_ * (u_y + v_x);  // lambda = -eta
    return {m, m * u + P - xx, m * v - xy,
            m * (T + 0.5 * (l.u * r.u + l.v * r.v)) + (P - xx) * u - xy * v + heat, heat};
}

Grid::Flux Grid::across_y(int i, int j) const {
    const Values s = at(i, j), n = at(i, j + 1);
    const Values se = at(i + 1, j), sw = at(i - 1, j), ne = at(i + 1, j + 1), nw = at(i - 1, j + 1);
    const double u = 0.5 * (s.u + n.u), v = 0.5 * (s.v + n.v), T = 0.5 * (s.T + n.T);
    const double P = pressure(i, j, 1), heat = -eta_ * (n.T - s.T) / d_;
    const double m = 0.5 * (s.rho + n.rho) * v;
    const double u_y = (n.u - s.u) / d_, v_y = (n.v - s.v) / d_;
    const double u_x = (se.u - sw.u + ne.u - nw.u) / (4.0 * d_);
    const double v_x = (se.v - sw.v + ne.v - nw.v) / (4.0 * d_);
    const double yy = eta_ * (v_y - u_x), xy = eta_ * (u_y + v_x);
    return {m, m * u - xy, m * v + P - yy,
            m * (T + 0.5 * (s.u * n.u + s.v * n.v)) + (P - yy) * v - xy * u + heat, heat};
}

void Grid::rates(std::span<const double> y, std::span<double> y_dot) {
    const std::size_t n = cells();
    for (std::size_t k = 0; k < n; ++k) {
        const double rho = y[k], u = y[n + k] / rho, v = y[2 * n + k] / rho;
        if (!(rho > 0.0)) {
            std::fill(y_dot.begin(), y_dot.end(), std::numeric_limits<double>::quiet_NaN());
            return;
        }
        values_[k] = {rho, u, v, y[3 * n + k] / rho - 0.5 * (u * u + v * v)};
    }
    const double g = layer_.gravity();
    for (std::size_t k = 0; k < n; ++k) {
        y_dot[k] = y_dot[n + k] = 0.0;
        y_dot[2 * n + k] = -g * y[k];
        y_dot[3 * n + k] = -g * y[2 * n + k];
    }
    y_dot[4 * n] = y_dot[4 * n + 1] = 0.0;
    const auto add = [&](int i, int j, const Flux& flux, double part) {
        if (box_.periodic(0)) i = (i + nx_) % nx_;
        if (i < 0 || i >= nx_ || j < 0 || j >= ny_) return;
        const auto k = static_cast<std::size_t>(j * nx_ + i);
        y_dot[k] += part * flux.mass;
        y_dot[n + k] += part * flux.x;
        y_dot[2 * n + k] += part * flux.y;
        y_dot[3 * n + k] += part * flux.energy;
    };
    for (int j = 0; j < ny_; ++j)
        for (int i = box_.periodic(0) ? 0 : -1; i < nx_; ++i) {
            const Flux flux = across_x(i, j);
            add(i, j, flux, -1.0 / d_);
            add(i + 1, j, flux, 1.0 / d_);
        }
    for (int i = 0; i < nx_; ++i)
        for (int j = -1; j < ny_; ++j) {
            const Flux flux = across_y(i, j);
            add(i, j, flux, -1.0 / d_);
            add(i, j + 1, flux, 1.0 / d_);
            if (j < 0) y_dot[4 * n] += d_ * flux.heat;
            if (j + 1 == ny_) y_dot[4 * n + 1] -= d_ * flux.heat;
        }
}

std::vector<double> Grid::field(std::span<const double> y, int which) const {
    const std::size_t n = cells();
    std::vector<double> field(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double rho = y[k], u = y[n + k] / rho, v = y[2 * n + k] / rho;
        field[k] = which == 0   ? rho
                   : which == 1 ? u
                   : which == 2 ? v
                                : y[3 * n + k] / rho - 0.5 * (u * u + v * v);
    }
    return field;
}

double Grid::kinetic(std::span<const double> y) const {
    const std::size_t n = cells();
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k)
        sum += 0.5 * (y[n + k] * y[n + k] + y[2 * n + k] * y[2 * n + k]) / y[k];
    return sum * d_ * d_;
}

double Grid::roll_amplitude(std::span<const double> y) const {
    const std::size_t n = cells();
    std::complex<double> sum = 0.0;
    for (int j = 0; j < ny_; ++j)
        for (int i = 0; i < nx_; ++i) {
            const auto k = static_cast<std::size_t>(j * nx_ + i);
            sum += y[2 * n + k] / y[k] * std::sin(pi * (j + 0.5) / ny_) *
                   std::polar(1.0, pi * (i + 0.5) / ny_);
        }
    return 4.0 * std::abs(sum) / static_cast<double>(n);
}

GridRun run_grid(Grid& grid, const std::vector<double>& times) {
    GridRun run;
    const std::vector<double> start = grid.start();
    const spam::SundialsContext context;
    spam::Vector y(start.size(), context);
    std::copy(start.begin(), start.end(), y.span().begin());
    spam::Ode ode;
    ode.rates = [&grid](double, std::span<const double> now, std::span<double> y_dot) {
        grid.rates(now, y_dot);
    };
    ode.failure = [] { return std::string("a density of the grid is not positive"); };
    ode.entry_name = [](std::size_t k) { return "number " + std::to_string(k) + " of the grid"; };
    ode.absolute_tolerance.assign(start.size(), 1e-9);
    ode.blocks = {{"grid", 0, start.size()}};
    const spam::IntegratorOptions options{
        .method = "arkode:DORMAND_PRINCE_7_4_5", .dt = {}, .rtol = 1e-7};
    const auto integrator = spam::make_integrator(options, ode, y, 0.0, context);
    for (const double t : times) {
        while (integrator->t() < t) integrator->step(t);
        const std::span<const double> now = y.span();
        run.t.push_back(t);
        run.kinetic.push_back(grid.kinetic(now));
        run.roll.push_back(grid.roll_amplitude(now));
        run.heat_bottom.push_back(grid.heat(now, false));
        run.heat_top.push_back(grid.heat(now, true));
    }
    run.y.assign(y.span().begin(), y.span().end());
    run.statistics = integrator->statistics();
    return run;
}

}  // namespace rayleigh_benard
