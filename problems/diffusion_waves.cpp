// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: heat and momentum diffuse through smooth particles, at rates known exactly; 1 s
//
// Newton's viscosity and Fourier's law in smooth particles, [HH07] 4, on a square lattice of cells x cells
// particles of an ideal gas or of van der Waals' fluid, periodic in both directions:
//
//     thermal   T = T0 + amplitude sin kx, particles nailed down      T at k = 2 pi/cells
//     shear     v_x = amplitude sin ky, particles free                ~~~~~>  <~~~~~
//
// Gradients of smooth particles are filters, and diffusion is two of them in turn: heat decays at
// kappa k^2 c^2/(rho_s^3 c_v) instead of kappa k^2/(rho c_v), and the friction of a shear wave is smaller
// by the same factor (diffusion_waves/diffusion_waves.hpp derives it: 0.9398 for 24 cells and h = 3). A
// lattice that shears has besides a weak spring, of either sign, proportional to its pressure.
#include "diffusion_waves/diffusion_waves.hpp"

#include "common.hpp"
#include <spam/external/clamp.hpp>
#include <spam/material/van_der_waals.hpp>

namespace {

using namespace spam;

enum class Wave { both, thermal, shear };

std::string_view to_string(Wave wave) {
    return wave == Wave::both ? "both" : wave == Wave::thermal ? "thermal" : "shear";
}

enum class Matter { ideal_gas, van_der_waals };

std::string_view to_string(Matter matter) {
    return matter == Matter::ideal_gas ? "ideal_gas" : "van_der_waals";
}

struct Parameters {
    Wave wave = Wave::both;
    Matter matter = Matter::ideal_gas;
    double attraction = 0.5, excluded = 0.2;  // a and b
    int cells = 24;
    double amplitude = 1e-4, temperature = 1.0, conductivity = 1.0, viscosity = 1.0;
    Scheme scheme{.density = Density::summed};

    double k() const { return 2.0 * std::numbers::pi / cells; }
    SquareLatticeDiffusion exact() const {
        return {weight_function<2>(to_string(scheme.kernel), scheme.range), k()};
    }
    AnyEquationOfState state() const {
        if (matter == Matter::ideal_gas) return IdealGas{2, 1.0};
        return VanDerWaals{attraction, excluded, 2};
    }
    /// Of amplitudes, without the filters.
    double continuum_rate(Wave of) const {
        return (of == Wave::thermal ? conductivity : viscosity) * k() * k();
    }
    /// What is left of the amplitude: by lattice sums.
    double expected(Wave of, double t) const {
        const SquareLatticeDiffusion lattice = exact();
        if (of == Wave::thermal) return std::exp(-continuum_rate(of) * lattice.factor * t);
        const double rho = lattice.site_density;
        const double P = state().pressure(rho, state().starting_energy(rho, temperature));
        return lattice.shear_wave(t, k(), viscosity, P);
    }
};

constexpr double lattice_life = 60.0;

struct Experiment : Variant<2, Model<2>> {
    Wave wave;
};

/// `only_described`: in a dry run, which computes no state.
Experiment prepare(const Parameters& p, Wave wave, bool only_described) {
    const double side = p.cells;
    const Box<2> box({side, side});
    Fluid gas{p.state()};
    if (wave == Wave::thermal)
        gas.conduction = FourierConduction{p.conductivity};
    else
        gas.viscosity = NewtonViscosity::shear_and_bulk(p.viscosity, 0.0, 2);
    auto model = std::make_unique<FluidModel<2>>(
        make_particles<2>(square_lattice<2>({p.cells, p.cells}), 1.0, 1.0, box), gas, p.scheme,
        box);
    const Points<2> x = model->particles().reference_position;
    Points<2> v = Points<2>::Zero(2, x.cols());
    if (wave == Wave::shear) v.row(0) = p.amplitude * (p.k() * x.row(1).array()).sin();
    Experiment e{{}, wave};
    if (wave == Wave::thermal) model->add(std::make_unique<Clamp<2>>());  // only energies change
    if (!only_described) {
        e.y0 = model->state(x, v, p.temperature);
        if (wave == Wave::thermal)
            State<2>(model->layout(), e.y0).energy().array() +=
                p.amplitude * (p.k() * x.row(0).array()).sin();  // c_v = 1
    }
    e.model = std::move(model);
    return e;
}

/// The sine in the temperature (that is in e) or the velocity, by its value at the start.
Column<2> amplitude_column(const Parameters& p, Wave wave) {
    return {
        "amplitude",
        [k = p.k(), start = p.amplitude, wave](const Model<2>& model, std::span<const double> y) {
            const ConstState<2> state(model.layout(), y);
            const auto n = static_cast<double>(model.particles().size());
            const int along = wave == Wave::thermal ? 0 : 1;
            const Eigen::ArrayXd sine = (k * state.position().row(along).array()).sin().transpose();
            const Eigen::ArrayXd field = wave == Wave::thermal
                                             ? Eigen::ArrayXd(state.energy().row(0).transpose())
                                             : Eigen::ArrayXd(state.velocity().row(0).transpose());
            return 2.0 / n * (sine * field).sum() / start;
        }};
}

/// Where lattice sums are all there is. Steps must be exact to more digits than are claimed, amplitudes
/// stand out from rounding, displacements (amplitude/rate) be small, and springs neither jump (w_2, a
/// range on a shell of neighbours) nor push so hard that shorter waves grow out of rounding and the
/// lattice, which has no strength, leaves its sites.
bool is_known(const Session& session, const Parameters& p, Wave wave, double t) {
    const double rate = p.continuum_rate(wave), range = p.scheme.range;
    const auto& steps = session.integrator();
    const bool exact = steps.method == "rk4" && *steps.dt * rate < 0.02 && *steps.dt <= 0.1;
    const bool visible = p.amplitude >= 1e-6 && rate * t > 0.01 && rate * t < 5.0;
    if (wave == Wave::thermal) return exact && visible;
    const bool calm = p.temperature <= 2.0 && p.matter == Matter::ideal_gas && t <= lattice_life;
    const bool smooth = p.scheme.kernel != Kernel::w2 && range >= 2.0;
    const bool decays = std::abs(p.expected(wave, t)) <= 1.0;  // springs are of either sign
    return exact && p.amplitude >= 1e-6 && calm && smooth && decays && p.amplitude / rate < 0.01;
}

void report(Session& session, const Parameters& p, const Experiment& e, const RunRecord& run) {
    const Findings findings(session, e.prefix);
    const Wave wave = e.wave;
    findings.check_promises(run);
    const History& h = run.history;
    const double t = h.last("t"), left = h.last("amplitude");
    const bool known = is_known(session, p, wave, t);
    findings.claim("amplitude_left", left, p.expected(wave, t), wave == Wave::thermal ? 1e-6 : 1e-4,
                   "[HH07] 4, with gradient sums over the lattice", known);
    if (wave == Wave::thermal && left > 0.0)
        findings.claim("rate_by_continuum", -std::log(left) / (t * p.continuum_rate(wave)),
                       p.exact().factor, 1e-4,
                       "c^2/rho_s^3 of the lattice: 0.9398 for 24 cells, h = 3", known);
    findings.measure("amplitude_left_in_continuum", std::exp(-p.continuum_rate(wave) * t),
                     "for comparison");
}

void draw(Session& session, const Parameters& p, const std::vector<Experiment>& experiments,
          const std::vector<RunRecord>& runs) {
    std::vector<CurvePanel> panels;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const Wave wave = experiments[k].wave;
        const auto t = runs[k].history.column("t");
        CurvePanel panel = frame(wave == Wave::thermal ? "temperature, particles nailed down"
                                                       : "shear wave, particles free",
                                 "t", "amplitude by its start", true);
        Curve lattice{"lattice sums", t, {}};
        Curve continuum{"continuum", t, {}};
        for (const double time : t) {
            lattice.y.push_back(p.expected(wave, time));
            continuum.y.push_back(std::exp(-p.continuum_rate(wave) * time));
        }
        Curve measured{"smooth particles", {}, {}, Mark::points};
        const auto amplitude = runs[k].history.column("amplitude");
        for (std::size_t row = 0; row < t.size(); row += std::max<std::size_t>(1, t.size() / 24))
            add_point(measured, t[row], amplitude[row]);
        panel.curves = {lattice, continuum, measured};
        panels.push_back(panel);
    }
    draw_curves(session, "decay",
                fmt::format("{0} × {0} smooth particles, range {1:g}", p.cells, p.scheme.range),
                panels);
}

void refuse_impossible(const Parameters& p) {
    if (p.cells <= 2.0 * p.scheme.range)
        refuse(
            "cells: a box of {} must be wider than twice the range {:g}; give at least {} "
            "cells, or a shorter --range",
            p.cells, p.scheme.range, static_cast<int>(2.0 * p.scheme.range) + 1);
    if (p.wave != Wave::shear && p.amplitude >= p.temperature)
        refuse("amplitude: {:g} takes the temperature {:g} below zero; give a smaller one",
               p.amplitude, p.temperature);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("diffusion_waves",
                    "heat and momentum diffuse through smooth particles, [HH07] 4");
    problem.units(gas_units());
    Parameters p;
    auto& options = problem.options();
    options.choice<Wave>("wave", p.wave, {Wave::both, Wave::thermal, Wave::shear},
                         "which wave to compute, or both");
    options.integer("cells", p.cells, "n x n particles at spacing 1, one wavelength",
                    between(4, 2000));
    options.number("amplitude", p.amplitude, "initial amplitude of the temperature or velocity",
                   between(1e-7, 1e3));
    options.number("temperature", p.temperature, "initial temperature of the fluid",
                   between(1e-6, 1e6));
    options.choice<Matter>("equation-of-state", p.matter,
                           {Matter::ideal_gas, Matter::van_der_waals},
                           "equation of state of the fluid");
    options.number("attraction", p.attraction, "constant a of van der Waals' equation",
                   between(0.0, 1e6));
    options.number("excluded", p.excluded,
                   "constant b of van der Waals' equation, a volume per mass", between(0.0, 1e3));
    options.only_when(
        {"attraction", "excluded"}, {"equation-of-state"},
        [&p] { return p.matter == Matter::van_der_waals; },
        "an ideal gas has none; add --equation-of-state van_der_waals, or leave it "
        "out");
    options.number("conductivity", p.conductivity, "heat conductivity kappa", between(1e-6, 1e6))
        .only_when(
            {"wave"}, [&p] { return p.wave != Wave::shear; },
            "has no part in a shear wave; leave it out");
    options
        .number("viscosity", p.viscosity, "shear viscosity eta (there is no bulk viscosity)",
                between(1e-6, 1e6))
        .only_when(
            {"wave"}, [&p] { return p.wave != Wave::thermal; },
            "has no part in a thermal wave; leave it out");
    add_density_option(options, p.scheme.density);
    options.choice<MeanDensityKind>("mean-density", p.scheme.mean_density,
                                    {MeanDensityKind::arithmetic, MeanDensityKind::geometric},
                                    "mean density of a pair, in gradients");
    options.only_when(
        {"density", "mean-density"}, {"wave"}, [&p] { return p.wave != Wave::thermal; },
        "has no effect with {by}, where particles stay on their lattice; leave it out");
    options.choice<Kernel>("kernel", p.scheme.kernel, all_kernels(), "weight function");
    options.number("range", p.scheme.range, "range h of the weight function", between(1.2, 20.0));

    return problem.main(argc, argv, [&](Session& session) {
        refuse_impossible(p);
        std::vector<Experiment> experiments;
        for (const Wave wave : {Wave::thermal, Wave::shear})
            if (p.wave == wave || p.wave == Wave::both)
                experiments.push_back(prepare(p, wave, session.common().dry_run));
        if (p.wave == Wave::both)
            for (auto& e : experiments) e.call(std::string(to_string(e.wave)));
        const auto runs = run_all(session, experiments, [&](const Experiment& e) {
            Plan<2> plan;
            const double life = 1.0 / p.continuum_rate(e.wave);
            plan.t_end = session.end(
                e.wave == Wave::thermal ? 3.0 * life : std::min(3.0 * life, lattice_life),
                0.1 * life);
            plan.record({amplitude_column(p, e.wave)});
            return plan;
        });
        for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, experiments[k], runs[k]);
        if (session.plots()) draw(session, p, experiments, runs);
    });
}
