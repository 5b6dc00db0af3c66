// SPDX-License-Identifier: GPL-3.0-or-later
// Momentum at places between molecules: what it changes by, and what passes.
#include "molecules.hpp"

namespace md_fields {
namespace {

using State = std::span<const double>;

/// d(rho u)/dt, and -div(rho u u + P) with bonds along their lines and with halves at molecules.
struct Balance {
    Points<2> rate, along_bonds, at_particles;

    static double size(const Points<2>& f) { return std::sqrt(f.colwise().squaredNorm().mean()); }
    double error() const {
        return std::sqrt((rate - along_bonds).colwise().squaredNorm().maxCoeff()) / size(rate);
    }
    double halves_error() const { return size(rate - at_particles) / size(rate); }
};

Balance balance_at(const Molecules& one, State y, const AnyWeight<2>& weight,
                   const Points<2>& places) {
    const MolecularFields<2> fields(weight, *one.model, y);
    const auto divergence = [&](BondStress stress) {
        const double d = 1e-4 * weight.range();
        Points<2> sum = Points<2>::Zero(2, places.cols());
        for (int a = 0; a < 2; ++a) {
            const auto at = [&](double by) {
                Points<2> moved = places;
                moved.row(a).array() += by;
                return fields.momentum_flux(moved, stress);
            };
            const Eigen::MatrixXd slope =
                (8.0 * (at(d) - at(-d)) - (at(2.0 * d) - at(-2.0 * d))) / (12.0 * d);
            sum += slope(std::array{a == 0 ? 0 : 2, a == 0 ? 2 : 1}, Eigen::all);
        }
        return sum;
    };
    std::vector<double> y_dot(y.size());
    one.model->rates(0.0, y, y_dot);
    const ConstState<2> state(one.model->layout(), y), rate(one.model->layout(), y_dot);
    // d/dt of m v w(|r - x|)
    Points<2> exact = Points<2>::Zero(2, places.cols());
    for (Eigen::Index k = 0; k < places.cols(); ++k)
        for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
            const Point<2> s = one.model->box().separation(places.col(k), state.position().col(i));
            const double r = s.norm(), m = one.model->particles().mass[static_cast<std::size_t>(i)];
            if (!(r < weight.range())) continue;
            const Point<2> v = state.velocity().col(i);
            exact.col(k) += m * (weight.value(r) * rate.velocity().col(i) +
                                 weight.minus_slope_over_r(r) * s.dot(v) * v);
        }
    return {exact, -divergence(BondStress::along_bonds), -divergence(BondStress::at_particles)};
}

/// Anywhere within a range of some molecule.
Points<2> random_places(const Points<2>& x, double range, int count, int seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed) + 1);
    Points<2> places(2, count);
    for (auto place : places.colwise()) {
        const auto i = static_cast<Eigen::Index>(drawn(random) * static_cast<double>(x.cols()));
        const double r = range * drawn(random), angle = 2.0 * std::numbers::pi * drawn(random);
        place = x.col(i) + r * Point<2>(std::cos(angle), std::sin(angle));
    }
    return places;
}

}  // namespace

void report_balance(const Findings& findings, const Molecules& one, const Parameters& p,
                    const RunRecord& run, bool known) {
    const Points<2> x = ConstState<2>(one.model->layout(), run.y).position();
    const auto balance = balance_at(one, run.y, p.weight(), random_places(x, p.range, 100, p.seed));
    findings.claim("balance_error", balance.error(), 0.0, 1e-6,
                   "exact: the largest of 100, by d(rho u)/dt",
                   p.kernel != Kernel::w2);  // whose slope jumps
    findings.claim("halves_error", balance.halves_error(), 0.13, 0.04,
                   "half of each bond at each molecule; another program, at one place", known);
}

void draw_balance(Session& session, const Molecules& one, const Parameters& p,
                  const RunRecord& run) {
    constexpr int pieces = 240;
    const double side = one.model->box().length(0), length = std::min(side, 24.0);
    Points<2> places(2, pieces + 1);
    std::vector<double> x;
    for (int k = 0; k <= pieces; ++k) {
        x.push_back(length * k / pieces);
        places.col(k) << x.back(), 0.5 * side;
    }
    const Balance balance = balance_at(one, run.y, p.weight(), places);
    const auto along = [](const Points<2>& f) {
        const Eigen::RowVectorXd row = f.row(0);
        return std::vector<double>(row.data(), row.data() + row.size());
    };
    CurvePanel both = frame("change of momentum by volume", "x", "d(ρu)/dt"),
               left = frame("what is left", "x", "", true);
    Curve exact{"−div(ρuu + P), bonds along their lines", {}, {}, Mark::points};
    const auto rate = along(balance.rate), bonds = along(balance.along_bonds),
               halves = along(balance.at_particles);
    for (std::size_t k = 0; k < x.size(); k += 4) add_point(exact, x[k], bonds[k]);
    both.curves = {{"d(ρu)/dt", x, rate}, exact, {"−div(ρuu + P), halves at molecules", x, halves}};
    Curve none{"bonds along their lines", x, {}}, some{"halves at molecules", x, {}};
    for (std::size_t k = 0; k < x.size(); ++k) {
        none.y.push_back(bonds[k] - rate[k]);
        some.y.push_back(halves[k] - rate[k]);
    }
    none.style = 2;
    some.style = 3;
    left.curves = {none, some};
    draw_curves(session, "balance",
                fmt::format("Momentum of {} molecules along a line, range {:g}",
                            one.model->particles().size(), p.range),
                {both, left});
}

}  // namespace md_fields
