// SPDX-License-Identifier: GPL-3.0-or-later
#include "convection.hpp"

#include <spam/external/gravity.hpp>

#include <complex>

namespace rayleigh_benard {

using std::numbers::pi;

namespace {

void refuse_without_plates(const Box<2>& box) {
    for (const bool upper : {false, true})
        if (!box.wall(1, upper).temperature)
            refuse(
                "{}: heat must come from below and leave above; give a wall with a temperature, as "
                "no-slip@{}",
                Sides::name(1, upper), upper ? "0.5" : "1.5");
    const double hot = *box.wall(1, false).temperature, cold = *box.wall(1, true).temperature;
    if (!(hot > cold))
        refuse(
            "bottom: its temperature {:g} must be above that of --top, {:g}; nothing else drives the "
            "gas",
            hot, cold);
}

}  // namespace

Convection make_convection(const Parameters& p, double rayleigh, bool only_described) {
    const double L = p.height;
    const Box<2> box = p.sides->box<2>(Point<2>::Zero(), Point<2>(2.0 * L, L));
    refuse_without_plates(box);
    const Layer layer{.L = L,
                      .rayleigh = rayleigh,
                      .roll = p.roll,
                      .hot = *box.wall(1, false).temperature,
                      .cold = *box.wall(1, true).temperature};
    const Points<2> x = cell_centres<2>({2 * p.height, p.height});
    const Fluid gas{IdealGas{2}, NewtonViscosity::shear_and_bulk(layer.eta(), 0.0, 2),
                    FourierConduction{layer.eta()}, p.friction == FrictionBy::pairs};
    const Scheme scheme{.density = p.density, .work = p.work, .kernel = p.kernel, .range = p.range};
    Convection convection{{}, layer};
    convection.model =
        std::make_shared<FluidModel<2>>(make_particles<2>(x, 1.0, 1.0, box), gas, scheme, box);
    FluidModel<2>& model = *convection.model;
    model.add(std::make_unique<Gravity<2>>(Point<2>(0.0, -layer.gravity())));
    if (only_described) return convection;
    const Points<2>& at = model.particles().reference_position;
    Points<2> v(2, at.cols());
    for (Eigen::Index i = 0; i < at.cols(); ++i)
        v.col(i) = Point<2>(layer.seed_u(at(0, i), at(1, i)), layer.seed_v(at(0, i), at(1, i)));
    convection.y0 = model.state(at, v, 1.0);
    const State<2> state(model.layout(), convection.y0);
    for (Eigen::Index i = 0; i < at.cols(); ++i)
        state.energy()(0, i) = layer.temperature(at(1, i));  // e = T
    model.layout().set_scale(Field::velocity, 0.1);
    return convection;
}

Column<2> roll_amplitude_column(const Layer& layer) {
    return {"roll_amplitude", [layer](const Model<2>& model, std::span<const double> y) {
                const ConstState<2> state(model.layout(), y);
                const auto x = state.position(), v = state.velocity();
                std::complex<double> sum = 0.0;
                for (Eigen::Index i = 0; i < x.cols(); ++i)
                    sum += v(1, i) * std::sin(pi * x(1, i) / layer.L) *
                           std::polar(1.0, pi * x(0, i) / layer.L);
                return 4.0 * std::abs(sum) / static_cast<double>(x.cols());
            }};
}

double nusselt(const Layer& layer, const std::vector<double>& t, const std::vector<double>& heat,
               std::size_t from, std::size_t to, bool upper) {
    return (upper ? -1.0 : 1.0) * (heat[to] - heat[from]) / (t[to] - t[from]) / layer.conducted();
}

std::vector<double> nusselt(const Layer& layer, const std::vector<double>& t,
                            const std::vector<double>& heat, bool upper) {
    std::vector<double> all;
    for (std::size_t k = 1; k < t.size(); ++k)
        all.push_back(nusselt(layer, t, heat, k - 1, k, upper));
    return all;
}

std::size_t middle(const std::vector<double>& t) {
    std::size_t k = 0;
    while (k + 2 < t.size() && t[k] < 0.5 * t.back()) ++k;
    return k;
}

double growth_rate(const std::vector<double>& t, const std::vector<double>& amplitude) {
    std::vector<double> time, log;
    for (std::size_t k = middle(t); k < t.size(); ++k) {
        time.push_back(t[k]);
        log.push_back(std::log(amplitude[k]));
    }
    return fit_line(time, log).slope;
}

}  // namespace rayleigh_benard
