// SPDX-License-Identifier: GPL-3.0-or-later
#include "stirred_fluid.hpp"

#include "../wall_step.hpp"
#include <spam/material/embedded_atom.hpp>

namespace stirred {

Fluid fluid_of(const Parameters& p, double nu) {
    return {EmbeddedAtom{1.0, 1.0},
            NewtonViscosity::shear_and_bulk(nu, 0.0, 2),
            {},
            p.friction == FrictionBy::pairs};
}

std::unique_ptr<FluidModel<2>> make_model(const Parameters& p, int cells, const Box<2>& box,
                                          double disorder, int seed) {
    Points<2> x = cell_centres<2>({cells, cells});
    displace(x, disorder, seed);
    return std::make_unique<FluidModel<2>>(make_particles<2>(x, 1.0, 1.0, box),
                                           fluid_of(p, p.viscosity(cells)), p.scheme, box);
}

void set_pressure(const Model<2>& model, std::vector<double>& y,
                  const std::function<double(const Point<2>&)>& pressure) {
    if (!model.layout().has(Field::density)) return;
    const State<2> state(model.layout(), y);
    const EmbeddedAtom law{1.0, 1.0};
    for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
        // P = x^2 (x - 1) by Newton's method from x = 1.
        const double P = pressure(state.position().col(i));
        double rho = 1.0;
        for (int n = 0; n < 6; ++n) rho -= (law.pressure(rho) - P) / law.sound_speed_squared(rho);
        state.density()(0, i) = rho;
        state.energy()(0, i) = law.cold_energy(rho);
    }
}

double step_of(const Parameters& p, double nu, const Box<2>& box) {
    bool free_edges = false;
    for (const int a : {0, 1})
        for (const bool upper : {false, true})
            free_edges = free_edges || (!box.periodic(a) && !box.wall(a, upper).has_images());
    return std::min({(free_edges ? 0.025 : 0.1) * p.scheme.range,
                     0.4 / nu * std::min(1.0, p.reynolds),
                     0.5 * p.scheme.range / (4.0 * p.scheme.shifting), step_beside_walls(box)});
}

void add_options(Options& options, Parameters& p, const std::string& speed_of_what) {
    options.integer("cells", p.cells, "particles along each side", between(8, 400));
    options.number("speed", p.speed, speed_of_what + "; that of sound is 1", between(1e-6, 0.5));
    options.number("reynolds", p.reynolds,
                   "Reynolds number: speed times side by the kinematic viscosity",
                   between(0.1, 1e4));
    options.choice<Transport>("transport", p.scheme.transport,
                              {Transport::plain, Transport::shifting},
                              "velocity that moves the particles: v, or v with shifting from where "
                              "they crowd to where they are missing");
    options.number("shifting", p.scheme.shifting,
                   "strength of shifting: its coefficient by sound speed times range",
                   between(0.01, 5.0));
    options.only_when(
        {"shifting"}, {"transport"}, [&p] { return p.shifted(); },
        "has no meaning with {by}; it needs shifting");
    options.choice<Density>("density", p.scheme.density, {Density::continuity, Density::summed},
                            "by the continuity equation, or as a sum over neighbours");
    add_friction_option(options, p.friction);
    options.choice<Kernel>("kernel", p.scheme.kernel, all_kernels(), "weight function");
    options.number("range", p.scheme.range, "range h of the weight function", between(1.2, 6.0));
    options.flag("compare", p.compare,
                 "compute half as many and twice as many along each side as well");
}

const std::vector<std::string>& decisive_options() {
    static const std::vector<std::string> names{"speed",   "reynolds", "transport", "shifting",
                                                "density", "friction", "kernel",    "range"};
    return names;
}

}  // namespace stirred
