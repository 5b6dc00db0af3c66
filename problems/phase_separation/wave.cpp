// SPDX-License-Identifier: GPL-3.0-or-later
#include "separation.hpp"
#include <spam/kernel/weight_integrals.hpp>

namespace phase_separation {
namespace {

constexpr double start = 1e-6;       // amplitude, in spacings
constexpr double most_growth = 7.0;  // of its logarithm: second-order terms stay below 1e-6
constexpr double longest = 30.0;

double wave_number(const Parameters& p, int mode) {
    return 2.0 * std::numbers::pi * mode / p.box().length(0);
}

/// The transform of w, by its moments: a Bessel function's series.
double transform(const AnyWeight<2>& weight, double k) {
    double sum = 0.0, factor = 1.0;
    for (int m = 0; m < 40; ++m) {
        sum += factor * moment(weight, 2 * m);
        factor *= -0.25 * k * k / ((m + 1) * (m + 1));
    }
    return sum;
}

/// Coefficient of sin kx in the displacements.
double amplitude(const Model<2>& model, std::span<const double> y, double k) {
    const auto& sites = model.particles().reference_position;
    const Eigen::ArrayXd moved =
        (ConstState<2>(model.layout(), y).position().row(0) - sites.row(0)).transpose();
    return 2.0 * (moved * (k * sites.row(0).transpose().array()).sin()).mean();
}

}  // namespace

/// With displacements u_i of the sites, energies e of particles and e', e'' at the density of a site, to second order
///     Phi = sum_i e'' (d rho_i)^2/2 + e' d^2 rho_i,   d rho_i = sum_j (u_j - u_i) w'(r) x/r
/// of which a wave sin kx has
///     rate^2 = -(e'' G^2 + 2 e' J),   G = sum_j w'(r) (x/r) sin kx,   J = sum_j w_xx (1 - cos kx).
/// In the continuum G = -rho k W(k) and J = rho k^2 W(k), W the transform of w.
WaveTheory wave_theory(const Parameters& p, double k) {
    const AnyWeight<2> weight = p.weight();
    const int sites = static_cast<int>(std::ceil(p.range / p.spacing()));
    double rho = weight.value(0.0), G = 0.0, J = 0.0;
    for (int i = -sites; i <= sites; ++i)
        for (int n = -sites; n <= sites; ++n) {
            const double x = i * p.spacing(), r = std::hypot(x, n * p.spacing());
            if (r == 0.0 || r >= p.range) continue;
            const double slope = -weight.minus_slope_over_r(r);
            const double w_xx = slope + (weight.second_derivative(r) - slope) * (x / r) * (x / r);
            rho += weight.value(r);
            G += slope * x * std::sin(k * x);
            J += w_xx * (1.0 - std::cos(k * x));
        }
    const auto law = p.law();
    const auto rate_squared = [&law](double density, double g, double j) {
        const double first = law.pressure(density) / (density * density);
        const double second =
            (law.sound_speed_squared(density) - 2.0 * density * first) / (density * density);
        return -(second * g * g + 2.0 * first * j);
    };
    const double W = transform(weight, k);
    return {rate_squared(rho, G, J),
            rate_squared(p.density, p.density * k * W, p.density * k * k * W)};
}

namespace {

void draw(Session& session, const Parameters& p, const RunRecord& run,
          std::optional<double> found) {
    const double k = wave_number(p, *p.wave), rate2 = wave_theory(p, k).lattice;
    CurvePanel growth = frame("amplitude", "t", "amplitude by that at the start", true);
    Curve measured = over_time("particles", run.history, "amplitude");
    measured.y = divided(measured.y, run.history.first("amplitude"));
    measured.mark = Mark::points;
    growth.curves.push_back(std::move(measured));
    growth.curves.push_back(
        graph("sums over the lattice", 0.0, run.history.last("t"), 200, [&](double t) {
            return rate2 > 0.0 ? std::cosh(std::sqrt(rate2) * t) : std::cos(std::sqrt(-rate2) * t);
        }));
    CurvePanel all = frame("all waves", "k", "rate²");
    const double last = std::max(1.5 * k, 0.5 * wave_number(p, p.cells / 2));
    all.curves.push_back(graph("sums over the lattice", 1e-3 * last, last, 200,
                               [&](double q) { return wave_theory(p, q).lattice; }));
    all.curves.push_back(graph("continuum", 1e-3 * last, last, 200,
                               [&](double q) { return wave_theory(p, q).continuum; }));
    if (found)
        all.curves.push_back(
            {.title = "particles", .x = {k}, .y = {*found * *found}, .mark = Mark::points});
    draw_curves(session, "growth",
                fmt::format("Wave {} in a van der Waals fluid at T = {:g}", *p.wave, p.temperature),
                {growth, all});
}

}  // namespace

void grow_wave(Session& session, const Parameters& p) {
    if (!(*p.wave < p.cells / 2.0))
        refuse(
            "wave: {} particles along the box resolve no more than {} waves; give that or less, "
            "or more --cells",
            p.cells, (p.cells - 1) / 2);
    const double k = wave_number(p, *p.wave);
    const WaveTheory theory = wave_theory(p, k);
    if (!std::isfinite(theory.lattice))
        refuse(
            "density: where particles of a lattice of {:g} are, it sums up to 1/b = {:g} or "
            "more; give less",
            p.density, 1.0 / van_der_waals_b);
    const double rate = std::sqrt(std::max(0.0, theory.lattice));
    auto model = std::make_shared<DensityPotentialModel<2>>(p.particles(), p.potentials(), p.box());
    auto y0 = initial_state<2>(*model, p.density, 1.0, at_rest<2>());
    auto x = State<2>(model->layout(), y0).position();
    x.row(0).array() +=
        start * p.spacing() * (k * model->particles().reference_position.row(0).array()).sin();
    Plan<2> plan;
    plan.t_end = session.end(std::min(longest, most_growth / rate), 5.0);
    plan.record({{"amplitude", [k](const Model<2>& one, std::span<const double> y) {
                      return amplitude(one, y, k);
                  }}});
    const RunRecord run = session.run<2>(*model, std::move(y0), std::move(plan));

    const Findings findings(session);
    const History& h = run.history;
    const double by_start = h.last("amplitude") / h.first("amplitude");
    // From rest it is cosh(rate t), which needs no part of the theory, or cos.
    std::optional<double> found;
    const bool long_enough = run.complete && rate * h.last("t") > 1.0;
    if (by_start > 1.0) found = std::acosh(by_start) / h.last("t");
    findings.measure("rate_of_lattice", rate, "sums over the lattice; 0: swings");
    findings.measure("rate_of_continuum", std::sqrt(std::max(0.0, theory.continuum)),
                     "integrals of the weight function");
    if (rate > 0.0 && found)
        findings.claim("growth_rate", *found, rate, 1e-4 * rate, "sums over the lattice",
                       long_enough && run.history.largest("amplitude") < 0.01 * p.spacing());
    else
        findings.check(
            "largest_amplitude",
            std::max(h.largest("amplitude"), -h.smallest("amplitude")) / h.first("amplitude"), 1.0,
            1e-6, "sums over the lattice: the wave swings");
    findings.check_promises(run);
    if (session.plots()) draw(session, p, run, found);
}

}  // namespace phase_separation
