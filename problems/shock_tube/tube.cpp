// SPDX-License-Identifier: GPL-3.0-or-later
#include "tube.hpp"

#include <spam/material/gamma_gas.hpp>

namespace shock_tube {
namespace {

/// How far the end of a gas that streams reaches in a time: a fan's head, or a shock before a wall, which is
/// slower than (gamma - 1) |u|/2 + c.
double disturbed(const GasState& gas, double gamma, double t) {
    if (gas.u == 0.0) return 0.0;
    const double streams = std::max(1.0, 0.5 * (gamma - 1.0)) * std::abs(gas.u);
    return 1.05 * t * (streams + gas.sound_speed(gamma));
}

/// Median over the particles in the middle half of what lies between two speeds.
double median_between(const Tube& tube, const std::vector<double>& values,
                      std::span<const double> y, double t, double from, double to) {
    const auto x = ConstState<1>(tube.model->layout(), y).position();
    std::vector<double> all;
    const double width = to - from;
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        if (const double s = x(0, i) / t; s > from + 0.25 * width && s < to - 0.25 * width)
            all.push_back(values[static_cast<std::size_t>(i)]);
    if (all.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2),
                     all.end());
    return all[all.size() / 2];
}

}  // namespace

const Setting& sod() {
    static const Setting setting{"Sod's shock tube", {1.0, 0.0, 1.0}, {0.125, 0.0, 0.1}, 0.2};
    return setting;
}

const Setting& toro(int number) {
    static const std::array<Setting, toro_tests> all{
        {{"Toro's test 1 (Sod)", {1.0, 0.0, 1.0}, {0.125, 0.0, 0.1}, 0.25},
         {"Toro's test 2 (two fans)", {1.0, -2.0, 0.4}, {1.0, 2.0, 0.4}, 0.15, 10.0, 1.0, false},
         {"Toro's test 3 (left blast)", {1.0, 0.0, 1000.0}, {1.0, 0.0, 0.01}, 0.012, 6.0},
         {"Toro's test 4 (right blast)", {1.0, 0.0, 0.01}, {1.0, 0.0, 100.0}, 0.035, 6.0},
         {"Toro's test 5 (two shocks)",
          {5.99924, 19.5975, 460.894},
          {5.99242, -6.19633, 46.0950},
          0.035,
          6.0}}};
    return all.at(static_cast<std::size_t>(number - 1));
}

void Parameters::settle(const Session& session) {
    if (toro) setting = shock_tube::toro(*toro);
    if (toro && !session.given("work")) scheme.work = Work::own;
    if (!session.given("range")) scheme.range = setting.range;
    if (!session.given("viscosity")) scheme.viscosity = setting.viscosity;
}

bool Parameters::standard(const Session& session) const {
    return !session.common().smoke && scheme.density == Density::continuity &&
           scheme.kernel == Kernel::w4 && scheme.range == setting.range &&
           scheme.viscosity == setting.viscosity;
}

/// That of Sod's gas, whose left half carries sound at sqrt(1.4), is 0.1 by the number of particles.
double Parameters::step(int particles) const {
    const GasState &left = setting.left, &right = setting.right;
    const double fastest = std::max(
        {left.sound_speed(gamma), right.sound_speed(gamma), 1.5 * std::abs(left.u - right.u)});
    return 0.1 / particles * (std::sqrt(1.4) / std::max(fastest, std::sqrt(1.4)));
}

Tube make_tube(const Parameters& p, int cells, bool only_described) {
    const GasState &left = p.setting.left, &right = p.setting.right;
    const double spacing = 1.0 / cells;
    const auto extra = [&](const GasState& gas) {
        return static_cast<int>(std::ceil(disturbed(gas, p.gamma, p.setting.t_end) / spacing));
    };
    const int before = extra(left), behind = extra(right), all = before + cells + behind;
    const auto box =
        p.sides->box<1>(Point<1>(-0.5 - spacing * before), Point<1>(0.5 + spacing * behind));
    Points<1> x(1, all);
    for (int k = 0; k < all; ++k) x(0, k) = spacing * (k - before + 0.5) - 0.5;
    auto particles = make_particles<1>(x, spacing, spacing, box);
    Scheme scheme = p.scheme;
    scheme.range *= spacing;
    for (Eigen::Index i = 0; i < all; ++i)
        particles.mass[static_cast<std::size_t>(i)] *=
            particles.reference_position(0, i) > 0.0 ? right.rho : left.rho;
    Tube tube{{}, cells, before, behind, RiemannProblem(left, right, p.gamma)};
    tube.model = std::make_shared<FluidModel<1>>(std::move(particles), Fluid{GammaGas{p.gamma}},
                                                 scheme, box);
    if (only_described) return tube;
    const Points<1>& at = tube.model->particles().reference_position;
    Points<1> v(1, all);
    for (Eigen::Index i = 0; i < all; ++i) v(0, i) = at(0, i) < 0.0 ? left.u : right.u;
    tube.y0 = tube.model->state(at, v, 1.0);
    const State<1> state(tube.model->layout(), tube.y0);
    // Of the same pressures on both sides with the densities as they are summed.
    const auto rho = tube.model->density(tube.y0);
    double most = 0.0;
    for (Eigen::Index i = 0; i < all; ++i) {
        const double P = at(0, i) < 0.0 ? left.P : right.P;
        state.energy()(0, i) = P / ((p.gamma - 1.0) * rho[static_cast<std::size_t>(i)]);
        most = std::max(most, state.energy()(0, i));
    }
    tube.model->layout().set_scale(Field::velocity, std::sqrt(most));
    tube.model->layout().set_scale(Field::energy, most);
    return tube;
}

std::vector<double> found(const Tube& tube, std::span<const double> y, std::size_t quantity) {
    const ConstState<1> state(tube.model->layout(), y);
    if (quantity == 0) return tube.model->density(y);
    if (quantity == 2) return tube.model->pressure(y);
    const double* const first = quantity == 1 ? state.velocity().data() : state.energy().data();
    return {first, first + tube.particles()};
}

double exact_value(const Tube& tube, double gamma, std::size_t quantity, double x, double t) {
    const GasState s = tube.exact.at(x, t);
    return quantity == 0 ? s.rho : quantity == 1 ? s.u : quantity == 2 ? s.P : s.energy(gamma);
}

double density_error(const Tube& tube, std::span<const double> y, double t) {
    const auto rho = tube.model->density(y);
    const auto x = ConstState<1>(tube.model->layout(), y).position();
    double sum = 0.0, count = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        if (std::abs(x(0, i)) > 0.5) continue;
        sum += std::abs(rho[static_cast<std::size_t>(i)] - tube.exact.at(x(0, i), t).rho);
        count += 1.0;
    }
    return sum / count;
}

double integral_error(const Tube& tube, double gamma, std::size_t quantity,
                      std::span<const double> y, double t) {
    const auto values = found(tube, y, quantity), rho = tube.model->density(y);
    const auto x = ConstState<1>(tube.model->layout(), y).position();
    double sum = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (std::abs(x(0, i)) < 0.5)
            sum += tube.model->particles().mass[k] / rho[k] *
                   std::abs(values[k] - exact_value(tube, gamma, quantity, x(0, i), t));
    }
    return sum;
}

std::vector<Plateau> plateaus(const Tube& tube, double gamma, std::span<const double> y, double t) {
    if (tube.exact.vacuum()) return {};
    const RiemannProblem& exact = tube.exact;
    const double u = exact.velocity(), left = exact.inner_speed(false),
                 right = exact.inner_speed(true);
    const auto rho = found(tube, y, 0), v = found(tube, y, 1), P = found(tube, y, 2);
    const auto between = [&](const std::vector<double>& values, double from, double to) {
        return median_between(tube, values, y, t, from, to);
    };
    std::vector<Plateau> all;
    const auto add = [&](std::string name, double value, double median, double scale) {
        all.push_back({std::move(name), value, median, scale});
    };
    const auto behind = [&](bool right_wave) {
        const std::string kind = exact.shock(right_wave) ? "shock" : "fan";
        const bool both = exact.shock(false) == exact.shock(true);
        return "density_behind_" + (both ? (right_wave ? "right_" : "left_") + kind : kind);
    };
    for (const bool right_wave : {false, true}) {
        const double rho_star = exact.density(right_wave);
        add(behind(right_wave), rho_star,
            right_wave ? between(rho, u, right) : between(rho, left, u), rho_star);
    }
    const double P_star = exact.pressure();
    add("pressure", P_star, between(P, left, right), P_star);
    // Where the gas in the middle is at rest, its sound is what a speed is small beside.
    const double c = GasState{exact.density(false), u, P_star}.sound_speed(gamma);
    add("velocity", u, between(v, left, right), std::max(std::abs(u), 0.1 * c));
    return all;
}

}  // namespace shock_tube
